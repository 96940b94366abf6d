"""What stands where in the arrays that the kernels share with their callers."""

from __future__ import annotations

# c: the rig's parameters (α = J_p + m l²), gains u = G y + offset, limits, references, back-calculation,
# pitch travel, and volts that disturb the motors
K_PP, K_PY, K_YP, K_YY, ALPHA, J_Y, ML2, MGL, B_P, B_Y, K_S = range(11)
GAIN, OFFSET, LIMIT, WANTED, TRACKING, TRAVEL, DISTURBANCE, CONSTANTS = 11, 23, 25, 27, 29, 33, 34, 36

# m: each motor's mode and which limit it is at (±1), the stop that pitch rests on (0, ±1), the motor
# that each integrator drives, and the kind of anti-windup
SIDE, REST, MOTOR_OF, WINDUP, MODES = 2, 4, 5, 7, 8
INSIDE, BEYOND, SLIDING = 0, 1, 2
NO_ANTI_WINDUP, CLAMPING, BACK_CALCULATION = 0, 1, 2

# d: the digital controller's sample time, encoder steps (0: none), filter (0: true rates) as x⁺ = F x + b θ
# and rate = w x₂, in F row by row, then b, w; computation delay in samples, and the voltages that the motors have
# until the first computed ones arrive
TIME, STEP, FILTERED, F, BETA, RATE, DELAY, BEFORE, SETTINGS = 0, 1, 3, 4, 8, 10, 11, 12, 14

# x: an experiment's references, start θ, ψ, θ̇, ψ̇, limits, travel, whether the trim is fed forward, kind of
# anti-windup, gains of back-calculation, and volts that disturb the motors
REFERENCE, START, BOUND, STOP, FED, ANTI_WINDUP, BACK, VOLTS, EXPERIMENT = 0, 2, 6, 8, 9, 10, 11, 15, 17

STATIC, PI, OWN = 0, 1, 2
"""What is around the state feedback: Ĝ(0)⁻¹, two PI loops, or the placement method's own integral action."""

WORKSPACE = (24, 8)
"""Shape of the integrator's scratch array: slopes, continuous output, states; from row 16 on the digital rig's."""

AUGMENTED = 7
"""States of a linear response: up to six of the loop, and the constant 1 that carries the references."""
DIVERGED = 1e3
"""An angle, rad, beyond which a response counts as diverged and is held at its last value."""
LINEAR_WORKSPACE = (4 * AUGMENTED + 2, AUGMENTED)
"""Shape of its scratch array: the augmented matrix, the voltages' rows, and three for the exponential."""

# Columns of an axis' metrics, of a motor's, of its margins, and of what both motors bear
RISE_TIME, SETTLING_TIME, OVERSHOOT, PEAK, PEAK_TIME, STEADY_STATE_ERROR, IAE, ITAE, AXIS_METRICS = range(9)
PEAK_VOLTAGE, EFFORT, MOTOR_METRICS = range(3)
# What else is known of a course: both axes' largest deviations from the start, shares of time at the limits, the
# first sample that is held, how the integration ended, impacts on the stops
DEVIATION, SHARE, HELD, OUTCOME, IMPACTS, COURSE = 0, 2, 4, 5, 6, 7
GAIN_MARGIN, GAIN_REDUCTION_MARGIN, PHASE_MARGIN, DELAY_MARGIN, MARGINS = range(5)
SENSITIVITY_PEAK, PEAK_FREQUENCY, DISK_MARGIN, DISK_FREQUENCY, SENSITIVITY = range(5)

POLYNOMIALS = (2, 2, 16)
"""Shape of the loop as matrices of polynomials: `kernels.frequency.describe`."""
POLYNOMIAL_WORKSPACE = (11, 16)
FREQUENCIES = 100
"""Grid of the search over frequency, from a hundredth of the slowest to a hundred times the fastest pole."""

SENSITIVITIES = 11
"""Columns of a recorded course's derivatives: by θ, ψ, θ̇, ψ̇ at its start, then by seven parameters."""
RECORDED_WORKSPACE = (4, SENSITIVITIES + 1, 4)
"""Shape of the scratch array of `kernels.recorded`: state, stage, slope and their sum."""
