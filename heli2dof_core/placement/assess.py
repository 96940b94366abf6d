"""Any placement of any system, judged: `place_poles` is the library's generic entry."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..eigenvalues import eigenvectors
from ..findings import Finding
from ..poles import match_poles
from ..signals import Complexes, Floats
from ..tables import Shown, Table, number
from ..tables import poles as pole_words
from .full_rank import FullRankPlacement
from .groups import conjugate_units
from .method import Placement, Task, Weights, require_system
from .registry import method as method_named

NEARLY_DEPENDENT = 1e-5
"""Weakest column of the scan below which a system is said to be nearly uncontrollable."""


@dataclass(frozen=True, repr=False)
class Assessment(Shown):
    """A placement and what it does.

    Attributes:
        placement: K, and with full-rank placement T, Q, indices and groups.
        closed_loop_poles: eigenvalues of A − BK as computed, in the order of the poles asked for.
        pole_error: largest distance between the two; None where the method chose its own.
        norm, spectral_norm: Frobenius norm and largest singular value of K.
        eigenvector_condition: see `eigenvector_condition`.
        findings: remarks.
    """

    placement: Placement
    closed_loop_poles: Complexes
    pole_error: float | None
    norm: float
    spectral_norm: float
    eigenvector_condition: float | None
    findings: tuple[Finding, ...]

    def summary(self) -> str:
        """Size of K, poles and their error."""
        rows, columns = self.placement.K.shape
        found = pole_words(self.closed_loop_poles.tolist())
        error = number(self.pole_error, 2)
        return f"K {rows}×{columns}, ‖K‖ = {number(self.norm)}; poles {found}; pole error {error}"

    def tables(self) -> tuple[Table, ...]:
        """K; rows are inputs, columns states."""
        K = self.placement.K
        names = [[f"{letter}{i + 1}" for i in range(n)] for letter, n in zip("ux", K.shape, strict=True)]
        return (Table.matrix("K, u = −Kx", K, *names),)


def place_poles(
    A: ArrayLike,
    B: ArrayLike,
    poles: ArrayLike,
    method: str = "full-rank",
    *,
    C: ArrayLike | None = None,
    weights: Weights | None = None,
) -> Assessment:
    """Places the poles of any controllable (A, B) by any method of the registry.

    Args:
        A: n×n.
        B: n×p.
        poles: n, closed under conjugation; the quadratic methods do not look at them.
        method: name in `registry.METHODS`.
        C: q×n, the outputs that integral action regulates.
        weights: of the quadratic methods; ones if not given.

    Raises:
        InvalidInputError: a shape, a number or the method's name is wrong.
        UnpairedPolesError: a complex pole lacks its conjugate.
        UncontrollableError: (A, B) is not controllable.
        MethodUnavailableError: the method cannot solve this task.
    """
    chosen = method_named(method)
    states, inputs, wanted = require_system(A, B, poles)
    conjugate_units(wanted)
    n, p = inputs.shape
    outputs = np.zeros((0, n)) if C is None else np.asarray(C, dtype=float)
    weights = weights or Weights((1.0,) * n, (1.0,) * p, (1.0,) * len(outputs))
    placement = chosen.place(Task(states, inputs, wanted, outputs, weights))
    return assess(states, inputs, wanted, placement, aimed=chosen.places_poles)


def assess(
    A: Floats, B: Floats, wanted: Complexes, placement: Placement, *, aimed: bool = True
) -> Assessment:
    """What a placement does to (A, B); `aimed` says whether it was to place `wanted`."""
    K = placement.K
    closed = A - B @ K
    found = np.linalg.eigvals(closed).astype(complex)
    found = found[match_poles(wanted, found)]
    error = float(np.max(np.abs(found - wanted))) if aimed else None
    return Assessment(
        placement,
        found,
        error,
        norm=float(np.linalg.norm(K)),
        spectral_norm=float(np.linalg.norm(K, 2)),
        eigenvector_condition=eigenvector_condition(closed),
        findings=tuple(_remarks(placement, wanted, error)),
    )


def eigenvector_condition(A_closed: Floats) -> float | None:
    """κ₂ of the eigenvectors of length 1; None where there are too few of them, as at double poles.

    It bounds the factor by which a perturbation of A − BK is amplified in its poles (Bauer and Fike,
    Numer. Math. 2 (1960) 137).
    """
    sizes = np.linalg.svd(eigenvectors(A_closed), compute_uv=False)
    condition = float(sizes[0] / sizes[-1]) if sizes[-1] > 0 else np.inf
    return condition if condition < 1 / np.finfo(float).eps else None


def _remarks(placement: Placement, wanted: Complexes, error: float | None) -> Iterator[Finding]:
    if isinstance(placement, FullRankPlacement) and placement.weakest < NEARLY_DEPENDENT:
        yield Finding(
            "nearly_uncontrollable",
            "warning",
            f"The system is nearly uncontrollable: a column of the scan adds only {placement.weakest:.1e} to those "
            "before it, and the gains grow as the inverse of that.",
        )
    if error is not None and error > 1e-6 * max(float(np.max(np.abs(wanted))), 1.0):
        yield Finding(
            "pole_error",
            "warning",
            f"The computed poles miss the wanted ones by up to {error:.2g}: poles that coincide, or lie far "
            "out, are sensitive to rounding.",
        )
