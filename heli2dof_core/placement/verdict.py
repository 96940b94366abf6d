"""Where the poles of A − BK are, as exactly as K places them: in floats where these tell it, else exactly."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..eigenvalues import balanced, eigenvectors, spectrum
from ..frozen import Frozen
from ..kernels.update_layout import DOUBTFUL_SHARE
from ..poles import match_poles
from ..signals import Complexes, Floats
from .exact import exact_closed_loop, exact_eigenvalues, exact_eigenvectors

EPS = float(np.finfo(np.float64).eps)


@dataclass(frozen=True)
class Verdict(Frozen):
    """The poles of A − BK, and how far they are from those asked for.

    Attributes:
        poles: in the order of those asked for.
        error: largest distance between the two, matched one to one.
        bound: how far rounding may have moved each of `poles`, and so `error`.
        rounding: how far rounding A − BK in floats moves them, at most; the same as `bound` unless `exact`.
        exact: A − BK and its eigenvalues were computed without rounding.
        condition: κ₂ of the eigenvectors of length 1, where `exact` and all poles are simple.
    """

    poles: Complexes
    error: float
    bound: float
    rounding: float
    exact: bool
    condition: float | None = None


def judge(
    A: Floats, B: Floats, K: Floats, wanted: Complexes, *, condition: bool = False, exactly: bool = True
) -> Verdict:
    """The poles of A − BK beside those asked for.

    Rounding moves eigenvalues by κ(V) ‖E‖ at most (Bauer and Fike, Numer. Math. 2 (1960) 137), where E is what
    rounding the products and LAPACK's backward error make. Where that is more than
    `DOUBTFUL_SHARE`, as at poles that coincide or in systems that are nearly uncontrollable, the characteristic
    polynomial is computed exactly.

    Args:
        A: n×n.
        B: n×p.
        K: p×n.
        wanted: n poles.
        condition: also the eigenvectors' condition, where it cannot be had from floats either.
        exactly: whether exact arithmetic, which takes a tenth of a second and more, is used where floats do not tell.
    """
    found, rounding = _in_floats(A, B, K)
    size = float(np.max(np.abs(wanted), initial=0.0)) or float(np.max(np.abs(found), initial=0.0))
    if exactly and not rounding <= DOUBTFUL_SHARE * size:
        matrices = tuple((matrix.shape, np.asarray(matrix, np.float64).tobytes()) for matrix in (A, B, K))
        exact = _exactly(
            matrices, tuple(wanted.tolist()), tuple(found.tolist()), rounding, condition=condition
        )
        if exact is not None:
            return exact
    found = found[match_poles(wanted, found)]
    return Verdict(found, float(np.max(np.abs(found - wanted))), rounding, rounding, exact=False)


def _in_floats(A: Floats, B: Floats, K: Floats) -> tuple[Complexes, float]:
    """Eigenvalues of A − BK in floats, and how far rounding moved them at most; infinite where nothing is known."""
    n, p = B.shape
    closed = A - B @ K
    terms = np.abs(A) + np.abs(B) @ np.abs(K)
    matrix, units = balanced(closed)
    values, vectors = spectrum(matrix)
    found = np.array(values)
    error = (p + 2) * EPS * _size(terms * units / units[:, None]) + 2 * n * EPS * _size(matrix)
    try:
        with np.errstate(over="ignore"):
            condition = _size(vectors) * _size(np.linalg.inv(vectors))
    except np.linalg.LinAlgError:
        return found, np.inf
    return found, float(condition * error)


def _size(matrix: NDArray[Any]) -> float:
    """Frobenius norm; for few rows NumPy's takes three times as long."""
    return sqrt(np.vdot(matrix, matrix).real)


@lru_cache(
    maxsize=256
)  # a design is asked for more than once: as a drag ends, for files, by the others of a class
def _exactly(
    matrices: tuple[tuple[tuple[int, ...], bytes], ...],
    wanted: tuple[complex, ...],
    near: tuple[complex, ...],
    rounding: float,
    *,
    condition: bool,
) -> Verdict | None:
    """Of A, B and K, each its shape and its floats; None where the poles lie too close together to be told apart."""
    from mpmath import mpc

    A, B, K = (np.frombuffer(data).reshape(shape) for shape, data in matrices)
    matrix = exact_closed_loop(A, B, K)
    try:
        values = exact_eigenvalues(matrix, np.array(near))
    except ArithmeticError:
        return None
    order = match_poles(wanted, [complex(v) for v in values])
    values = [values[i] for i in order]
    found = np.array([complex(v) for v in values])
    error = max(float(abs(v - mpc(complex(w)))) for v, w in zip(values, wanted, strict=True))
    bound = EPS * float(np.max(np.abs(found)))
    vectors = exact_eigenvectors(matrix, values) if condition else None
    return Verdict(found, error, bound, rounding, True, None if vectors is None else conditioned(vectors))


def conditioned(vectors: Floats | Complexes) -> float | None:
    """κ₂ of eigenvectors of length 1; None where there are too few of them.

    It bounds the factor by which a perturbation of A − BK is amplified in its poles (Bauer and Fike,
    Numer. Math. 2 (1960) 137).
    """
    sizes = np.linalg.svd(vectors, compute_uv=False)
    condition = float(sizes[0] / sizes[-1]) if sizes[-1] > 0 else np.inf
    return condition if condition < 1 / EPS else None


def eigenvector_condition(A_closed: Floats) -> float | None:
    """κ₂ of the eigenvectors of A − BK as floats tell them; None where there are too few, as at double poles."""
    return conditioned(eigenvectors(A_closed))
