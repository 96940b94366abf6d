"""What stands where in the arrays that the kernels share with their callers."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..signals import fixed

# c: the rig's parameters (α = J_p + m l²), gains u = G y + offset, limits, references, back-calculation,
# pitch travel, volts that disturb the motors, and torques about both axes from outside, N·m
K_PP, K_PY, K_YP, K_YY, ALPHA, J_Y, ML2, MGL, B_P, B_Y, K_S = range(11)
GAIN, OFFSET, LIMIT, WANTED, TRACKING, TRAVEL, DISTURBANCE, TORQUE, CONSTANTS = (
    11,
    23,
    25,
    27,
    29,
    33,
    34,
    36,
    38,
)

# c goes on for a rig whose rotors, friction or estimator are modelled: time constants, dead zones, squares s of the
# thrust curves (0: linear), both frictions; the gains of both motors on the states behind the sixth; and the
# estimator, six rows by state, by what the motors get, and a constant (`FULL` + 3 columns each); and how large the
# states behind the sixth are as a rule, by which their errors are judged
TAU, DEAD, SQUARE, COULOMB, BREAKAWAY, MORE_GAIN, ESTIMATOR, USUAL = 38, 40, 42, 44, 46, 48, 64, 166
MORE_CONSTANTS = 174
PLAIN, LAGGED, FULL = 6, 8, 14
"""States of the loop: θ, ψ, θ̇, ψ̇, z_p, z_y; with both rotors' speeds v_p, v_y; with six states of an estimator."""
INNER = FULL - PLAIN
"""States behind the sixth."""
SIZES: Any = ((np.int64(0),) * PLAIN, fixed(np.zeros(LAGGED)), fixed(np.zeros(FULL)))
"""What kernels take for `size`, whose length it is. That of a tuple is a constant for Numba, so that loops over the
states of the paper's rig unroll; that of an array is not, so that one function serves all others (a tenth slower, and
unrolled they took minutes to compile)."""
PAPER = SIZES[0]
"""The size of the paper's rig."""

# m: each motor's mode and which limit it is at (±1), the stop that pitch rests on (0, ±1), the motor
# that each integrator drives, and the kind of anti-windup
SIDE, REST, MOTOR_OF, WINDUP, MODES = 2, 4, 5, 7, 8
# m goes on where the size is not PLAIN: each rotor's part of its thrust curve (−1 backward, 0 dead zone, 1 forward)
# and which way each axis slips on its friction (0: stuck; 1 without friction)
ZONE, SLIP, MORE_MODES = 8, 10, 12
INSIDE, BEYOND, SLIDING = 0, 1, 2
NO_ANTI_WINDUP, CLAMPING, BACK_CALCULATION = 0, 1, 2

# d: the digital controller's sample time, encoder steps (0: none), filter (0: true rates) as x⁺ = F x + b θ
# and rate = w x₂, in F row by row, then b, w; computation delay in samples, and the voltages that the motors have
# until the first computed ones arrive
TIME, STEP, FILTERED, F, BETA, RATE, DELAY, BEFORE, SETTINGS = 0, 1, 3, 4, 8, 10, 11, 12, 14

FILTER_FREQUENCY = 2.0 * np.pi * 20.0
"""Natural frequency of the rig's rate filters, rad/s (Quanser 2-DOF Helicopter, laboratory manual)."""
FILTER_DAMPING = 0.85

ESTIMATED = (6, 11)
"""Shape of a digital controller's estimator, a row per state: w⁺ by w (6), measured angles (2), voltages (2), 1."""

# x: an experiment's references, start θ, ψ, θ̇, ψ̇, limits, travel, whether the trim is fed forward, kind of
# anti-windup, gains of back-calculation, and volts that disturb the motors
REFERENCE, START, BOUND, STOP, FED, ANTI_WINDUP, BACK, VOLTS, EXPERIMENT = 0, 2, 6, 8, 9, 10, 11, 15, 17

STATIC, PI, OWN = 0, 1, 2
"""What is around the state feedback: Ĝ(0)⁻¹, two PI loops, or the placement method's own integral action."""

WORKSPACE = (24, FULL + 2)
"""Shape of the integrator's scratch array: slopes, continuous output, states; from row 16 on the digital rig's."""

DIVERGED = 1e3
"""An angle, rad, beyond which a response counts as diverged and is held at its last value."""
NODES = 256
"""Most intervals of a stretch of a linear course that is looked at as a whole; a power of 2."""


def exact_shapes(size: int) -> tuple[tuple[int, int], tuple[int, int, int], tuple[int, int]]:
    """Shapes of a linear response's scratch arrays, whose states are those of the loop and a constant 1.

    The augmented matrix, the voltages' rows and their rates', and seven matrices; powers of the linear loop's step,
    each the square of the one before; and nodes: the states and both voltages.
    """
    order = size + 1
    return (8 * order + 4, order), (80, order, order), (order + 2, NODES + 1)


# Columns of a motor's metrics (an axis': `kernels.figures`), of its margins, and of what both motors bear
PEAK_VOLTAGE, EFFORT, MOTOR_METRICS = range(3)
BAND = 0.02
"""How far from its reference an axis may be that has settled, as a share of its step."""
# f: what is known of a course so far. Rows 0 and 1, an axis: its start, 1/step (1 where it is not stepped), whether
# it is stepped, highest and lowest share of the step with their times, how many of the levels of the rise it has
# reached and when, whether it is within the settling band and since when, ∫ |1 − share| dt and ∫ t |1 − share| dt.
# Rows 2 and 3, a motor: PEAK_VOLTAGE, EFFORT, the time at its limit, its voltage at rest
FROM, BY, STEPPED, TOP, TOP_AT, BOTTOM, BOTTOM_AT = range(7)
RISEN, AT_LOW, AT_HIGH, WITHIN, SINCE, AREA, MOMENT = range(7, 14)
AT_LIMIT, CALM = 2, 3
FOLLOWED = (4, 14)
# What else is known of a course: both axes' largest deviations from the start, shares of time at the limits, the
# first sample that is held, how the integration ended, impacts on the stops, and until when it was followed, s
DEVIATION, SHARE, HELD, OUTCOME, IMPACTS, REACHED, COURSE = 0, 2, 4, 5, 6, 7, 8
ENDED, OUT_OF_STEPS, OUT_OF_SWITCHES, OUT_OF_BOUNDS = range(4)
"""How a course ended: as asked, given up for its steps or its switches, or beyond DIVERGED."""
GAIN_MARGIN, GAIN_REDUCTION_MARGIN, PHASE_MARGIN, DELAY_MARGIN, MARGINS = range(5)
SENSITIVITY_PEAK, PEAK_FREQUENCY, DISK_MARGIN, DISK_FREQUENCY, SENSITIVITY = range(5)

ROUNDING = 1e-15
"""The one tolerance of what is 0 or on the imaginary axis: a sum below this share of the sizes of its terms is 0.

A, B and K are floats, each right to a few 1e-16 of the terms that it is made of, and sums of their products round as
often again. So a coefficient of the loop's polynomial that is smaller than this has a sign by rounding alone. A pole
at −σ counts as on the axis likewise where σ is below this share of the loop's fastest rate.
"""

POLYNOMIALS = (2, 2, 20)
"""Shape of the loop as matrices of polynomials: `kernels.polynomials`."""
POLYNOMIAL_WORKSPACE = (17, 16)
# Where rotors take time or something is estimated, the loop is eight polynomials (`kernels.whole`), each its
# coefficients and the sizes of their terms: det M, the same with a motor opened, what S has beside its diagonal times
# det M, and the loop by the time constant τ of both rotors: what det M is without τ, by τ s, and by τ² s²
WHOLE_CLOSED, WHOLE_OPENED, WHOLE_ACROSS, WHOLE_LAG, WHOLE = 0, 1, 3, 5, 8
VALUE, TERMS = 0, 1
WHOLE_POLYNOMIALS = (WHOLE, 2, 16)
WHOLE_ROWS, WHOLE_MINORS = (12, 4, 2, 8), (14, 2, 16)
"""Shapes of the scratch arrays of `kernels.whole`: rows of polynomials, and their minors."""
# What a controller is to `kernels.whole`, (5, 10): in its first two rows K by x and by both rotors' speeds, and the
# law by measured angles and by integrals; then in rows 2 and 3 the lower halves of the observer's A (4), B (2), L (2)
# and the upper half of L (2); in row 4 what is measured, ω and ζ of the filters, the observer's time constants
K_STATES, K_SPEEDS, BY_ANGLES, BY_INTEGRALS = 0, 4, 6, 8
OWN_A, OWN_B, OWN_L, OWN_L_ANGLES = 0, 4, 6, 8
OBSERVER_ROW, KIND_ROW = 2, 4
KIND, OMEGA, ZETA, OWN_TAU = 0, 1, 2, 3
ALL_STATES, FILTERED_RATES, OBSERVED = 0.0, 1.0, 2.0
CONTROLLER = (5, 10)
LAG_WORKSPACE = (29, 32)
FREQUENCIES = 6000
"""Most frequencies at which the sensitivity is looked at: its steps grow with the distance from the poles, so that
fifty are common, and seven pairs of poles as near the axis as `ROUNDING` allows ask for three quarters of these."""

SENSITIVITIES = 11
"""Columns of a recorded course's derivatives: by θ, ψ, θ̇, ψ̇ at its start, then by seven parameters."""
RECORDED_WORKSPACE = (4, SENSITIVITIES + 1, 4)
"""Shape of the scratch array of `kernels.recorded`: state, stage, slope and their sum."""
ACTUATED_SENSITIVITIES = SENSITIVITIES + 4
"""Of a course with rotors and friction: then by τ_p, τ_y, and Coulomb friction in pitch and yaw."""
ACTUATED_WORKSPACE = (6, ACTUATED_SENSITIVITIES + 1, 4)
"""Shape of the scratch array of `kernels.actuated`: as above, the step's beginning, and thrusts and directions."""
