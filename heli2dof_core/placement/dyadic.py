"""Single-input formulas on a system with several inputs: all of them driven along one direction f.

u = −f k x, so K = f k has rank one. What `ackermann` and `bass_gura` share: when such a K exists,
and which f to take.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..controllability import RANK_TOLERANCE, in_own_units, scan
from ..errors import MethodUnavailableError, UncontrollableError
from ..signals import Complexes, Floats
from .method import Method, Placement, Task

DIRECTIONS = 360
"""Directions of f that are tried before the best is refined."""
TRIED = 5
"""Of these, so many decide whether one input can control the plant at all."""
SCATTER = 1e-4
"""Eigenvalues closer than this, in units of A's size, count as one that rounding has scattered."""

SingleInput = Callable[[Floats, Floats, Floats], Floats]
"""k, shape (n,), of one input: f(A, b, characteristic polynomial wanted)."""


class Dyadic(Method):
    """A single-input formula, applied along the input direction with the smallest gain.

    Attributes:
        formula: Ackermann's or Bass and Gura's.
    """

    formula: SingleInput

    def place(self, task: Task) -> Placement:
        """K = f k of rank one.

        Raises:
            MethodUnavailableError: A is not cyclic.
        """
        return Placement(place_dyadic(type(self).formula, task.A, task.B, task.poles))


def place_dyadic(
    formula: SingleInput, A: Floats, B: Floats, poles: Complexes, first_feedback: Floats | None = None
) -> Floats:
    """K = K₀ + f k with the unit vector f that makes ‖f k‖ smallest, p×n.

    Args:
        formula: Ackermann's or Bass and Gura's.
        A: n×n.
        B: n×p.
        poles: n desired poles, closed under conjugation, rad/s.
        first_feedback: K₀, p×n; the dyad is designed for A − BK₀. Zero if not given.

    Raises:
        MethodUnavailableError: no f makes the pair controllable, with the reason.
        UncontrollableError: nor does the only input that there is.
    """
    K_0 = np.zeros(B.T.shape) if first_feedback is None else np.asarray(first_feedback, dtype=float)
    plant = A - B @ K_0
    directions = _directions(B.shape[1])
    require_single_input(plant, B, directions)
    scaled, inputs, units, speed = in_own_units(plant, B)
    wanted = np.asarray(np.poly(poles / speed).real, dtype=np.float64)

    def gain(f: Floats) -> Floats:
        return np.outer(f, formula(scaled, inputs @ f, wanted) / units)

    def size(direction: Floats) -> float:
        length = np.linalg.norm(direction)
        try:
            norm = float(np.linalg.norm(gain(direction / length)))
        except np.linalg.LinAlgError:
            return np.inf
        return norm if np.isfinite(norm) else np.inf

    sizes = [size(f) for f in directions]
    best = directions[int(np.argmin(sizes))]
    if not np.isfinite(min(sizes)):
        raise MethodUnavailableError(
            "no gain could be computed: the controllability matrix of one input is singular in floating point",
            field="method",
            hint="Choose full-rank placement, which computes with fractions.",
        )
    if len(directions) > 1:
        from scipy.optimize import minimize

        best = minimize(lambda f: np.log(size(f)), best, method="Nelder-Mead", options={"xatol": 1e-10}).x
    return K_0 + gain(best / np.linalg.norm(best))


def require_single_input(A: Floats, B: Floats, directions: Floats) -> None:
    """Raises MethodUnavailableError if no single input Bf can control A, whatever the direction f.

    Wonham (IEEE TAC 12:660–665, 1967): of a controllable pair almost every f is controllable if A is cyclic, that is,
    if no eigenvalue has several independent eigenvectors, and none else. So a few directions decide; the scan judges
    them, which units do not mislead, nor eigenvalues that rounding has scattered.

    Raises:
        UncontrollableError: there is one input, and it does not reach all states.
    """
    if len(directions) == 1:
        scan(A, B)
        return
    for f in directions[:: max(1, len(directions) // TRIED)]:
        try:
            scan(A, (B @ f)[:, None])
        except UncontrollableError:
            continue
        return
    value, independent = _repeated(A, B)
    raise MethodUnavailableError(
        "this formula needs one input that reaches every state. Here no mix of the inputs does: A has the eigenvalue "
        f"{value} with {independent} independent eigenvectors, and one input reaches only one of them",
        field="method",
        hint="Choose a method for several inputs.",
    )


def _repeated(A: Floats, B: Floats) -> tuple[str, int]:
    """The eigenvalue of A that has most independent eigenvectors, in words, and how many."""
    scaled, _, _, speed = in_own_units(A, B)
    values = np.linalg.eigvals(scaled)
    counts = []
    for value in values:
        near = values[np.abs(values - value) <= SCATTER * max(1.0, abs(value))]
        centre = np.mean(near)  # rounding scatters a multiple eigenvalue evenly around itself
        small = np.linalg.svd(scaled - centre * np.eye(len(A)), compute_uv=False) <= np.sqrt(RANK_TOLERANCE)
        counts.append((int(np.sum(small)), centre))
    independent, centre = max(counts, key=lambda pair: pair[0])
    value = complex(centre) * speed
    tiny = RANK_TOLERANCE * speed
    real = 0.0 if abs(value.real) <= tiny else value.real
    return f"{real:.4g}" if abs(value.imag) <= tiny else f"{complex(real, value.imag):.4g}", max(
        2, independent
    )


def _directions(p: int) -> Floats:
    """Unit vectors, (m, p): evenly over the half circle for two inputs, seeded at random beyond."""
    if p == 1:
        return np.ones((1, 1))
    if p == 2:
        angles = np.pi * (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
        return np.column_stack([np.cos(angles), np.sin(angles)])
    vectors = np.random.default_rng(0).normal(size=(DIRECTIONS, p))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
