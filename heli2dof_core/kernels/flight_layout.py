"""What stands where in the arrays of a flight: what acts on the rig, its controller, its memory, and its course."""

from __future__ import annotations

from .layout import SETTINGS

# u: what acts from outside, as long as nobody changes it: whether the sticks are the motors' voltages, and these, V;
# references θ, ψ, rad, and how fast they move, rad/s, from which tick on; torques of a hand, N·m; a gust's largest
# torques, N·m, its first tick and how many it lasts; shares of their thrust that the motors have; what a mass hung on
# adds to m l², kg·m², and to m g l, N·m; whether an encoder sticks; noise on measured angles, rad, and its seed
MANUAL, STICK, REFERENCE, TURN, TURN_FROM, PUSH, GUST, GUST_FROM, GUST_TICKS = 0, 1, 3, 5, 7, 8, 10, 12, 13
THRUST, HUNG, STUCK, NOISE, SEED, FLIGHT_INPUTS = 14, 16, 18, 20, 22, 23

# k: the digital controller's settings as `layout` has them (SETTINGS), then ∂u/∂r row by row; the voltages at x = 0
# and a reference at the operating point; θ₀; the trim; what is measured; the estimator's order; ticks in a sample
BY_REFERENCE, BASE, ZERO_ANGLE, TRIM, MEASURED_AS, ORDER, TICKS = (
    SETTINGS,
    SETTINGS + 4,
    SETTINGS + 6,
    SETTINGS + 7,
    SETTINGS + 9,
    SETTINGS + 10,
    SETTINGS + 11,
)
FLIGHT_CONTROLLER = SETTINGS + 12

# s: what a flight remembers beside its state: both rate filters' states; the voltages that the motors have, and those
# that were computed last; what was measured (θ, ψ, θ̇, ψ̇, and room); the encoders' last readings; ticks since the
# sample; the tick; how it ended; voltages as asked; impacts on the stops; torques from outside
FILTERS, HAS, COMPUTED, SEEN, READ, PHASE, TICK, ENDED_AS, WISHED, HITS, PUSHED = (
    0,
    4,
    6,
    8,
    18,
    20,
    21,
    22,
    23,
    25,
    26,
)
FLIGHT_MEMORY = 28

# A row of its course, at a tick: the state; what was measured at the last sample; the motors' voltages, and as asked;
# rotors' speeds; references; torques from outside; the stop that pitch rests on
STATE, SENSED, VOLTAGE, UNLIMITED, SPEED, WISH, OUTSIDE, ON_STOP, FLIGHT_ROW = 0, 4, 8, 10, 12, 14, 16, 18, 19

# What a change of controller tells: jumps of both voltages that remain, V; those that there would be with the
# integrals as they were; whether the integrals could prevent both
JUMP, JUMP_WITHOUT, BUMPLESS, TOLD = 0, 2, 4, 5

LONGEST_TICK = 0.002
"""Longest tick, s: where samples are farther apart, one has several, so that hands and gusts act at once."""
