#!/bin/sh
# GNU Octave's control package: margin() reports the phase margin of the wrong crossing where a lead is what the loop
#   cannot bear.
#
# One expects: of two crossings of |L| = 1, with 30.3° of lead and with 135.8° of lag to instability, the nearer one:
#   −30.3°, as python-control says.
# What happens: margins are taken into 0 … 360° before the smallest is chosen. −30.3° becomes 329.7°, and 135.8° is
#   reported. The crossing at ω = 0 (gain margin 2.13, since L(0) = −0.47) is dropped: Inf. Unstable loops get 345.3°
#   for −14.7°.
# Seen with: GNU Octave 7.3.0, control 3.4.0 (Debian: octave-control). Not installed here; without them this ends with
#   77.
# Why it matters: a lightly damped axis whose spring the controller partly cancels is such a loop; the rig has a
#   quarter of the margin printed.
set -eu
if ! octave-cli --no-gui --eval "pkg load control" > /dev/null 2>&1; then
    echo "skipped: needs octave-cli and its control package"
    exit 77
fi
octave-cli --no-gui --quiet --eval '
warning("off", "all"); pkg load control
info = pkg("describe", "control");
printf("GNU Octave %s, control %s\n", OCTAVE_VERSION, info{1}.version);
s = tf("s");
L = (0.38 * s - 0.47) / (s^2 + 0.02 * s + 1);
[gain, phase, ~, w] = margin(L);
printf("margin: gain %g, phase %.2f degrees at %.3f rad/s\n", gain, phase, w);
closed = @(turn) max(real(roots([1, 0.02, 1] + exp(1i * turn) * [0, 0.38, -0.47])));
printf("largest real part of the poles: %.4f; with 31 degrees of lead %.4f\n", closed(0), closed(31 * pi / 180));
assert(closed(0) < 0 && closed(31 * pi / 180) > 0);
at_zero = max(real(roots([1, 0.02, 1] + 2.2 * [0, 0.38, -0.47])));
printf("with 2.2 times the gain %.4f\n", at_zero);
assert(at_zero > 0);
assert(isinf(gain) && abs(phase - 135.84) < 0.01);
[~, unstable] = margin(100 / ((s + 1) * (s + 2) * (s + 3)));
printf("unstable loop: %.2f degrees\n", unstable);
assert(abs(unstable - 345.32) < 0.01);
'
