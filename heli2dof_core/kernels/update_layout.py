"""What stands where in the numbers that the kernel `update` takes, and in the block that it fills."""

from __future__ import annotations

from math import prod
from typing import Any

import numpy as np

from ..figures import AXIS_METRICS
from .layout import (
    CONSTANTS,
    CONTROLLER,
    COURSE,
    ESTIMATED,
    EXPERIMENT,
    FOLLOWED,
    FREQUENCIES,
    INNER,
    LAG_WORKSPACE,
    MARGINS,
    MODES,
    MORE_CONSTANTS,
    MORE_MODES,
    MOTOR_METRICS,
    PLAIN,
    POLYNOMIAL_WORKSPACE,
    POLYNOMIALS,
    SENSITIVITY,
    SETTINGS,
    WHOLE_MINORS,
    WHOLE_POLYNOMIALS,
    WHOLE_ROWS,
    WORKSPACE,
    exact_shapes,
)

# The numbers, in the contract's units. The rig: its parameters in their own order, θ₀, limits (V_p, V_y, θ; infinite
# where there is none)
PARAMETERS, ANGLE, LIMITS = 0, 12, 13
# Poles asked for, real and imaginary part by turns: four, then the rotors' real ones; whether these are placed
POLES, ROTOR_POLES, ROTORS_PLACED = 16, 24, 26
# Which of `couplings.STRUCTURES`, whether it has a shift of its own, and that
FAMILY, SHIFTED, SHIFT = 27, 28, 29
# Whether PI loops are closed, k_p and T_i of pitch, of yaw, whether they are paired crosswise, whether decoupled
PI_LOOPS, PI_GAINS, CROSSWISE, DECOUPLED = 30, 31, 35, 36
# Rotors, pitch's and yaw's: time constants, whether their curves are quadratic, dead zones, where they are matched
# (0: left out); friction: Coulomb's of both axes, then what holds them at rest
LAGS, QUADRATIC, DEAD_ZONES, MATCHED, FRICTION = 37, 39, 41, 43, 45
# What is measured (ALL_STATES, FILTERED_RATES, OBSERVED), the observer's poles as above, its family
MEASURED, OBSERVER_POLES, OBSERVER_FAMILY = 49, 50, 58
# The experiment: references θ, ψ and start θ, ψ, θ̇, ψ̇ (NaN: at rest at the operating point), duration, whether
# voltages are limited, kind of anti-windup, tracking time (0: each loop's own), whether there are stops, whether the
# trim is fed forward, tolerance
ASKED, BEGINNING, DURATION, SATURATION, WINDUP_KIND = 59, 61, 65, 66, 67
TRACKING_TIME, STOPS, FEEDFORWARD, RTOL = 68, 69, 70, 71
# A digital controller: whether there is one, sample time, whether it is late, counts of both encoders, whether rates
# are filtered; a disturbance: whether there is one, volts, and when
DIGITAL, SAMPLE_TIME, LATE, COUNTS, RATES_FILTERED = 72, 73, 74, 75, 77
DISTURBED, DISTURBANCE_VOLTS, DISTURBED_FROM = 78, 79, 81
# Whether each axis is stepped alone, too; steps after which a response is given up
EACH_AXIS, MOST_STEPS = 82, 83
# What another method or an exact computation has found: whether K is given, K (2×6), Ĝ(0)⁻¹ (2×2), whether it has an
# integral action of its own, that (2×2), whether it aims at the poles; whether L is given, L (4×2)
K_GIVEN, GIVEN_K, GIVEN_INVERSE, OWN_INTEGRAL, GIVEN_INTEGRAL, AIMS = 84, 85, 97, 101, 102, 106
L_GIVEN, GIVEN_L = 107, 108
# What is left out (0: nothing): margins and sensitivity, the lag margin, the linear model's experiments, the rig's,
# the scenario's own experiment, so that the axes' alone are all there are; and all experiments of an unstable loop
WITHOUT_MARGINS, WITHOUT_LAG_MARGIN, WITHOUT_LINEAR, WITHOUT_RIG = 116, 117, 118, 119
WITHOUT_SCENARIO, WITHOUT_UNSTABLE, NUMBERS = 120, 121, 122

# How an update ended: all is filled; K takes exact numbers, as a closed form would lose digits; the motors act alike;
# the family is none of this rig's; a dead zone reaches beyond its motor's limit; a thrust curve has no slope at the
# trim, or a rotor no lag, so that it cannot be placed; eigenvalues were not found
DONE, EXACT, UNCONTROLLABLE, NO_STRUCTURE, NO_CURVE, NO_SLOPE, NO_EIGENVALUES = range(7)

# Figures, in one row: det Ĝ(0)⁻¹ (0 where a pole lies at 0), whether the placed poles are stable, ‖K‖_F, ‖K‖₂, κ₂ of
# the eigenvectors (NaN where there are too few), the pole error and its bound, whether these take exact numbers, λ₁₁
# (NaN without steady state), whether the loop is stable, its lag margin (infinite where there is none), how many of
# its states are connected
DETERMINANT, PLACED_STABLE, NORM, SPECTRAL_NORM, CONDITION, POLE_ERROR, POLE_ERROR_BOUND, DOUBTFUL = range(8)
RELATIVE_GAIN, STABLE, LAG_MARGIN, CONNECTED, FIGURES = 8, 9, 10, 11, 12

# The estimator, rows of one array: F (6×6), G (6×2), H (6×2), x̂ by w (6×6) and by angles (6×2)
ESTIMATOR_F, ESTIMATOR_G, ESTIMATOR_H, BY_STATE, BY_ANGLE, ESTIMATOR_COLUMNS = 0, 6, 8, 10, 16, 18
AT_ONCE = 1e-6
"""Time constant below which a rotor counts as one that follows at once, s: far below what can be seen."""
AT_REST = 0.01
"""Share of its limit below which a motor's trim voltage is no measure of the thrust curve."""
NEARLY_PARALLEL = 1e-2
"""Relative |γ| below which the motors are said to push nearly alike."""
SMALLEST = 1e-100
"""|γ|, (N·m/V)², below which powers of it are no longer floats with all their digits."""
DOUBTFUL_SHARE = 1e-8
"""Share of the largest pole: floats tell the poles as long as rounding cannot have moved them by more."""
RUNS = 3
"""Most experiments: the scenario, and each axis alone."""

Shape = tuple[int, ...]


def block_shapes(size: int, samples: int) -> dict[str, tuple[Shape, str]]:
    """What `update` fills, in the order of its arguments: shapes and kinds (float64, complex128).

    `outcome` is how it ended and the number of runs; K has six columns, of which four states leave the last two 0;
    `closed` are the placed poles in the order of those asked for, `open` those of the rig; `actuators` are both
    motors' τ, dead zone, square of the curve, friction (F_c, F_s) and slope φ′ at the trim; `law`, `whole` and
    `driven` are ∂u/∂ states, A and B of the loop with the states at their places (`layout`), `by_reference` is ∂u/∂r;
    `poles` and, without those of integrals that drive nothing, `connected` are the loop's, slowest first;
    `calm_axes` and `calm_courses` are of the rig without the disturbance.
    """
    n, real, both = size, "float64", "complex128"
    return {
        "outcome": ((2,), real),
        "A": ((4, 4), real),
        "B": ((4, 2), real),
        "trim": ((2,), real),
        "actuators": ((12,), real),
        "K": ((2, 6), real),
        "inverse": ((2, 2), real),
        "closed": ((6,), both),
        "open": ((4,), both),
        "figures": ((FIGURES,), real),
        "proportional": ((2, 2), real),
        "integral": ((2, 2), real),
        "feedforward": ((2, 2), real),
        "by_reference": ((2, 2), real),
        "law": ((2, n), real),
        "whole": ((n, n), real),
        "driven": ((n, 2), real),
        "poles": ((n,), both),
        "connected": ((n,), both),
        "L": ((4, 2), real),
        "estimator_poles": ((4,), both),
        "margins": ((2, MARGINS), real),
        "sensitivity": ((SENSITIVITY,), real),
        "t": ((samples,), real),
        "experiments": ((RUNS, EXPERIMENT), real),
        "linear": ((RUNS, n + 1, samples), real),
        "nonlinear": ((RUNS, n, samples), real),
        "voltages": ((RUNS, 2, 2, samples), real),
        "axes": ((RUNS, 2, 2, AXIS_METRICS), real),
        "motors": ((RUNS, 2, 2, MOTOR_METRICS), real),
        "courses": ((RUNS, 2, COURSE), real),
        "calm_axes": ((RUNS, 2, AXIS_METRICS), real),
        "calm_courses": ((RUNS, COURSE), real),
    }


def scratch_shapes(size: int, samples: int) -> dict[str, tuple[Shape, str]]:
    """What it writes into and nobody reads afterwards, in the order of its arguments, behind the block."""
    n, real, both, whole = size, "float64", "complex128", "int64"
    matrices, ladder, nodes = exact_shapes(size)
    constants, modes = (CONSTANTS, MODES) if n == PLAIN else (MORE_CONSTANTS, MORE_MODES)
    return {
        "w": (WORKSPACE, real),
        "v": (matrices, real),
        "ladder": (ladder, real),
        "nodes": (nodes, real),
        "followed": ((2 * FOLLOWED[0], FOLLOWED[1]), real),
        "c": ((constants,), real),
        "m": ((modes,), whole),
        "plant": ((constants,), real),
        "free": ((modes,), whole),
        "raw": ((samples + 2, n), real),
        "grid": ((samples + 2,), real),
        "sampled": ((samples, n), real),
        "held": ((samples, 2), real),
        "f": (POLYNOMIALS, real),
        "opened": (POLYNOMIALS, real),
        "f_whole": (WHOLE_POLYNOMIALS, real),
        "inner_whole": (WHOLE_POLYNOMIALS, real),
        "rows": (WHOLE_ROWS, real),
        "minors": (WHOLE_MINORS, real),
        "p": (POLYNOMIAL_WORKSPACE, real),
        "lag": (LAG_WORKSPACE, real),
        "frequencies": ((3, FREQUENCIES), real),
        "controller": (CONTROLLER, real),
        "more": ((MORE_CONSTANTS - CONSTANTS,), real),
        "inner": ((2, INNER), real),
        "settings": ((SETTINGS,), real),
        "estimator": ((6, ESTIMATOR_COLUMNS), real),
        "estimated": (ESTIMATED, real),
        "squares": ((4, 14, 14), real),
        "column": ((4, n), real),
        "motor_columns": ((2, n, 2), real),
        "polynomial_law": ((2, 6), real),
        "inputs": ((4, 2), real),
        "nothing": ((2,), real),
        "rig": ((11,), real),
        "gains": ((2, 2), real),
        "vectors": ((3, 7, 6), both),
        "exponential": ((80, 10), real),
        "size_of_exponential": ((10,), real),
        "start": ((n,), real),
        "work": ((18,), real),
    }


FACTORS = 14
"""Of a rig among many: by which its parameters and both rotors' time constants differ from the nominal ones."""


def rigs_shapes(size: int, rigs: int, times: int) -> dict[str, tuple[Shape, str]]:
    """What `run_rigs` takes behind block and scratch, in the order of its arguments; its times are the caller's."""
    n, real, both, whole = size, "float64", "complex128", "int64"
    constants, modes = (CONSTANTS, MODES) if n == PLAIN else (MORE_CONSTANTS, MORE_MODES)
    return {
        "times": ((times,), real),
        "rig_A": ((4, 4), real),
        "rig_B": ((4, 2), real),
        "rig_trim": ((2,), real),
        "rig_actuators": ((12,), real),
        "rig_whole": ((n, n), real),
        "rig_driven": ((n, 2), real),
        "own": ((constants,), real),
        "modes": ((modes,), whole),
        "y": ((n,), real),
        "one": ((NUMBERS,), real),
        "x": ((EXPERIMENT,), real),
        "course_of_rig": ((times, n), real),
        "rig_poles": ((rigs, n), both),
        "angles": ((rigs, 2, times), real),
        "stable": ((rigs,), real),
        "within": ((rigs,), real),
    }


# Of a design among many, a row: how its update ended, and the number of its runs; the shares of its rigs that are
# stable and that stay within their limits (NaN without rigs); the figures, sensitivity and margins of the block; and
# of each run by both models the course, the motors and the axes, where those of the rig's steps are without the
# disturbance; K and Ĝ(0)⁻¹
FOUND_OUTCOME, FOUND_RUNS, SHARE_STABLE, SHARE_WITHIN, FOUND_FIGURES = 0, 1, 2, 3, 4
FOUND_SENSITIVITY = FOUND_FIGURES + FIGURES
FOUND_MARGINS = FOUND_SENSITIVITY + SENSITIVITY
FOUND_COURSES = FOUND_MARGINS + 2 * MARGINS
FOUND_MOTORS = FOUND_COURSES + RUNS * 2 * COURSE
FOUND_AXES = FOUND_MOTORS + RUNS * 2 * 2 * MOTOR_METRICS
FOUND_K = FOUND_AXES + RUNS * 2 * 2 * AXIS_METRICS
FOUND_INVERSE = FOUND_K + 12
FOUND = FOUND_INVERSE + 4


def designs_shapes(size: int, designs: int) -> dict[str, tuple[Shape, str]]:
    """What `run_designs` fills, behind all that `run_rigs` takes: the loops' poles, slowest first, and the rows."""
    return {"found_poles": ((designs, size), "complex128"), "found": ((designs, FOUND), "float64")}


def made(shapes: dict[str, tuple[Shape, str]]) -> list[Any]:
    """Arrays of these shapes and kinds, one after the other in one piece of memory, all zero."""
    kinds = {"float64": np.float64, "complex128": np.complex128, "int64": np.int64}
    sizes = [prod(shape) * np.dtype(kinds[kind]).itemsize for shape, kind in shapes.values()]
    memory, at, arrays = np.zeros(sum(sizes), dtype=np.uint8), 0, []
    for (shape, kind), size in zip(shapes.values(), sizes, strict=True):
        arrays.append(memory[at : at + size].view(kinds[kind]).reshape(shape))
        at += size
    return arrays
