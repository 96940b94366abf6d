"""Single-input formulas on a system with several inputs: all of them driven along one direction f.

u = −f k x, so K = f k has rank one. What `ackermann` and `bass_gura` share: when such a K exists,
and which f to take.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..controllability import RANK_TOLERANCE
from ..errors import MethodUnavailableError
from ..signals import Complexes, Floats

DIRECTIONS = 360
"""Directions of f that are tried before the best is refined."""

SingleInput = Callable[[Floats, Floats, Floats], Floats]
"""k, shape (n,), of one input: f(A, b, characteristic polynomial wanted)."""


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
    """
    K_0 = np.zeros(B.T.shape) if first_feedback is None else np.asarray(first_feedback, dtype=float)
    plant = A - B @ K_0
    require_cyclic(plant)
    wanted = np.asarray(np.poly(poles).real, dtype=np.float64)

    def gain(f: Floats) -> Floats:
        return np.outer(f, formula(plant, B @ f, wanted))

    def size(direction: Floats) -> float:
        length = np.linalg.norm(direction)
        try:
            norm = float(np.linalg.norm(gain(direction / length)))
        except np.linalg.LinAlgError:
            return np.inf
        return norm if np.isfinite(norm) else np.inf

    directions = _directions(B.shape[1])
    best = directions[int(np.argmin([size(f) for f in directions]))]
    if len(directions) > 1:
        from scipy.optimize import minimize

        best = minimize(lambda f: np.log(size(f)), best, method="Nelder-Mead", options={"xatol": 1e-10}).x
    return K_0 + gain(best / np.linalg.norm(best))


def require_cyclic(A: Floats) -> None:
    """Raises MethodUnavailableError if an eigenvalue of A has several independent eigenvectors.

    Wonham (IEEE TAC 12:660–665, 1967): a single input can control A only if A is cyclic.
    """
    size = max(float(np.linalg.norm(A)), np.finfo(float).tiny)
    for value in np.linalg.eigvals(A):
        singular = np.linalg.svd(A - value * np.eye(len(A)), compute_uv=False)
        independent = int(np.sum(singular <= RANK_TOLERANCE * size))
        if independent > 1:
            real = abs(value.imag) <= RANK_TOLERANCE * size
            eigenvalue = f"{value.real + 0.0:.4g}" if real else f"{value:.4g}"
            raise MethodUnavailableError(
                f"no single input can control this plant: A has the eigenvalue {eigenvalue} with {independent} "
                f"independent eigenvectors, and one input Bf, whatever the direction f, reaches but one of "
                "them, so (A, Bf) is uncontrollable for every f. Only after a first feedback K₀ that "
                "separates them does such a design exist",
                field="method",
                hint="Take a method for several inputs, or give a first feedback.",
            )


def krylov(A: Floats, b: Floats) -> Floats:
    """Controllability matrix [b, Ab, …, A^(n−1) b] of one input, n×n."""
    columns = [b]
    for _ in range(len(A) - 1):
        columns.append(A @ columns[-1])
    return np.column_stack(columns)


def _directions(p: int) -> Floats:
    """Unit vectors, (m, p): evenly over the half circle for two inputs, seeded at random beyond."""
    if p == 1:
        return np.ones((1, 1))
    if p == 2:
        angles = np.pi * (np.arange(DIRECTIONS) + 0.5) / DIRECTIONS
        return np.column_stack([np.cos(angles), np.sin(angles)])
    vectors = np.random.default_rng(0).normal(size=(DIRECTIONS, p))
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)
