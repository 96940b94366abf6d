#!/bin/sh
# GNU Octave's control package: impulse() is less exact with a smaller step, and by a quarter.
#
# One expects: a smaller step gives the same samples, only more of them: the response is computed with a matrix
#   exponential.
# What happens: (s + 1.2)/((s + 1)(s + 2)) at t = 1 s is 0.2 e⁻¹ + 0.8 e⁻² = 0.1818. With dt = 1e-3 that comes; with
#   dt = 5e-4 and below it is 0.1353 = e⁻²: in z the zero and the pole lie within 1e-4 of one another and are
#   cancelled as if they were equal.
# Seen with: GNU Octave 7.3.0, control 3.4.0 (Debian: octave-control). Not installed here; without them this ends with
#   77.
# Why it matters: rigs are sampled at 1 to 2 ms and simulated finer. step() and initial() do not do this; an impulse
#   is initial() from x = b.
set -eu
if ! octave-cli --no-gui --eval "pkg load control" > /dev/null 2>&1; then
    echo "skipped: needs octave-cli and its control package"
    exit 77
fi
octave-cli --no-gui --quiet --eval '
warning("off", "all"); pkg load control
info = pkg("describe", "control");
printf("GNU Octave %s, control %s\n", OCTAVE_VERSION, info{1}.version);
G = ss([-1, 0; 0, -2], [1; 1], [0.2, 0.8], 0);
exact = 0.2 * exp(-1) + 0.8 * exp(-2);
for dt = [1e-2, 1e-3, 5e-4, 2e-4]
  found = [impulse(G, 1, dt)(end), initial(G, [1; 1], 1, dt)(end)];
  printf("dt %g: impulse %.5f, initial from b %.5f, exact %.5f\n", dt, found, exact);
end
assert(abs(impulse(G, 1, 1e-3)(end) - exact) < 1e-6);
assert(abs(initial(G, [1; 1], 1, 5e-4)(end) - exact) < 1e-6);
assert(abs(impulse(G, 1, 5e-4)(end) - exp(-2)) < 1e-6);
'
