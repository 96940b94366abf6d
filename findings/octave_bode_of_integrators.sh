#!/bin/sh
# GNU Octave's control package: bode() of a transfer function with two integrators is 360° too low; of the same loop
#   as ss it is right.
#
# One expects: the phase of (s + 1)/s² at 1 rad/s is −180° + 45° = −135°, however the loop is written.
# What happens: as tf it is −495°. The phase of a tf is lowered by 360° where it has two or more poles that are
#   exactly 0, though it is negative already; (s + 1)²/s³ comes out right by it. A pole at 1e-9 instead of 0, or
#   ss(L), gives −135°.
# Seen with: GNU Octave 7.3.0, control 3.4.0 (Debian: octave-control). Not installed here; without them this ends with
#   77.
# Why it matters: an inertia under PI control has two integrators. Margins read off the plot against −180° are off by
#   a turn, and the curve moves when a parameter is no longer exactly 0.
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
at = @(L) nthargout(2, @bode, L, 1);
L = (s + 1) / s^2;
near = (s + 1) / (s * (s + 1e-9));
found = [at(L), at(ss(L)), at(near), at((s + 1)^2 / s^3)];
printf("tf %.2f, ss %.2f, tf with a pole at -1e-9 %.2f; (s+1)^2/s^3 %.2f degrees\n", found);
right = arg((1i + 1) / (1i)^2) * 180 / pi;
printf("arg L(j) = %.2f degrees, or as much and whole turns\n", right);
assert(max(abs(found - [-495, -135, -135, -180])) < 0.01);
'
