"""What can be said of the poles that were asked for and of the gain that places them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations

import numpy as np

from .findings import Finding
from .plant import Plant
from .signals import Floats

COINCIDENT = 1e-6
"""Poles closer than this share of their size count as one."""
NEARLY_PARALLEL = 1e-2
"""Relative |γ| below which the motors are said to push nearly alike."""
FAR_OUT = 1e3
"""Poles beyond this, rad/s, are remarked on: a lab rig's motors and sensors end far below."""


def design_remarks(
    plant: Plant, K: Floats, poles: Sequence[complex], error: float | None, *, stable: bool, steady: bool
) -> tuple[Finding, ...]:
    """Findings on a design.

    Args:
        plant: the rig.
        K: its state feedback.
        poles: those asked for, or the method's own where it chooses them (error None), rad/s.
        error: distance of the poles as computed from those asked for, rad/s.
        stable: see `Design.stable`.
        steady: whether there is a steady state.
    """
    on_stability = tuple(_on_stability(poles, stable, steady))
    if error is None:
        return (_OWN_POLES, *on_stability, *_on_plant(plant))
    return (
        *on_stability,
        *_on_choice(plant, poles, K),
        *_on_plant(plant),
        *_on_accuracy(poles, error),
    )


_OWN_POLES = Finding(
    "own_poles",
    "info",
    "This method chooses its own poles, from weights: those that you placed are not used.",
)


def _on_stability(poles: Sequence[complex], stable: bool, steady: bool) -> Iterator[Finding]:
    if any(p.real > 0 for p in poles) and not stable:
        yield Finding(
            "right_half_plane",
            "error",
            "A pole lies in the right half plane: without an outer loop the helicopter runs away. "
            "Drag it left of the imaginary axis.",
        )
    elif not stable:
        yield Finding(
            "imaginary_axis",
            "warning",
            "A pole lies on the imaginary axis: its motion neither grows nor dies out.",
        )
    if not steady:
        yield Finding(
            "no_steady_state",
            "warning",
            "A pole lies at 0, so the inner loop has no steady state, and Ĝ(0) and the RGA do not exist.",
        )


def _on_choice(plant: Plant, poles: Sequence[complex], K: Floats) -> Iterator[Finding]:
    largest = max(map(abs, poles))
    repeated = [p for p, q in combinations(poles, 2) if abs(p - q) <= COINCIDENT * max(largest, 1.0)]
    if repeated:
        yield Finding(
            "repeated_poles",
            "info",
            f"Two poles coincide at {_words(repeated[0])} rad/s. That is allowed; but the computed, and the real, "
            "double pole splits with the square root of any small error.",
        )
    own = plant.poles.tolist()
    at_open = [p for p in poles if p != 0 and min(abs(q - p) for q in own) <= COINCIDENT * max(abs(p), 1.0)]
    if at_open:
        yield Finding(
            "open_loop_pole",
            "info",
            f"The pole at {_words(at_open[0])} rad/s is one of the rig's own: feedback leaves it where it is.",
        )
    if largest > FAR_OUT:
        volts = float(np.max(np.abs(K[:, :2]))) * np.pi / 180
        yield Finding(
            "far_out",
            "warning",
            f"A pole lies {largest:.3g} rad/s out: one degree of error then asks for {volts:.3g} V, and noise, dead "
            "time and the motors' own lag, which no model here holds, decide what happens.",
        )


def _on_plant(plant: Plant) -> Iterator[Finding]:
    p = plant.parameters
    share = abs(p.gamma) / (abs(p.K_pp * p.K_yy) + abs(p.K_py * p.K_yp))
    if share < NEARLY_PARALLEL:
        yield Finding(
            "nearly_uncontrollable",
            "warning",
            f"Both motors push nearly alike: K_pp K_yy and K_py K_yp differ by {100 * share:.2g} % of their sum, "
            "and the gains grow as the inverse of that.",
        )


def _on_accuracy(poles: Sequence[complex], error: float) -> Iterator[Finding]:
    if error > 1e-6 * max(1.0, *map(abs, poles)):
        yield Finding(
            "pole_error",
            "warning",
            f"The computed poles miss the wanted ones by up to {error:.2g} rad/s: poles that coincide, "
            "or lie far out, are sensitive to rounding.",
        )


def _words(pole: complex) -> str:
    text = f"{pole.real:.4g}" + (f" ± {abs(pole.imag):.4g}j" if pole.imag else "")
    return text.replace("-", "−")
