"""Any placement of any system, judged: `place_poles` is the library's generic entry."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..controllability import scan
from ..findings import Finding
from ..frozen import Frozen
from ..signals import Complexes, Floats
from ..tables import Shown, Table, number
from ..tables import poles as pole_words
from .groups import conjugate_units
from .method import Placement, Task, Weights, require_system
from .registry import method as method_named
from .verdict import Verdict, eigenvector_condition, judge

NEARLY_DEPENDENT = 1e-5
"""Weakest column of the scan below which a system is said to be nearly uncontrollable."""
NOTICED = 1e-6
"""Share of the largest pole from which on an error of the poles is remarked on."""


@dataclass(frozen=True, repr=False)
class Assessment(Frozen, Shown):
    """A placement and what it does.

    Attributes:
        placement: K, and with full-rank placement T, Q, indices and groups.
        closed_loop_poles: eigenvalues of A − BK, in the order of the poles asked for.
        pole_error: largest distance between the two; None where the method chose its own.
        pole_error_bound: how far rounding may have moved the poles told, and so their error; where floats do not
            tell them, A − BK is computed exactly (`placement.verdict`).
        norm, spectral_norm: Frobenius norm and largest singular value of K.
        eigenvector_condition: see `eigenvector_condition`.
        findings: remarks.
    """

    placement: Placement
    closed_loop_poles: Complexes
    pole_error: float | None
    pole_error_bound: float
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
    if chosen.places_poles:
        scan(states, inputs)
    n, p = inputs.shape
    outputs = np.zeros((0, n)) if C is None else np.asarray(C, dtype=float)
    weights = weights or Weights((1.0,) * n, (1.0,) * p, (1.0,) * len(outputs))
    placement = chosen.place(Task(states, inputs, wanted, outputs, weights))
    return assess(states, inputs, wanted, placement, aimed=chosen.places_poles)


def assess(
    A: Floats,
    B: Floats,
    wanted: Complexes,
    placement: Placement,
    *,
    aimed: bool = True,
    exactly: bool = True,
) -> Assessment:
    """What a placement does to (A, B); `aimed` says whether it was to place `wanted`, `exactly` is `judge`'s."""
    K = placement.K
    verdict = judge(A, B, K, wanted, condition=True, exactly=exactly)
    return Assessment(
        placement,
        verdict.poles,
        verdict.error if aimed else None,
        verdict.bound,
        norm=float(np.linalg.norm(K)),
        spectral_norm=float(np.linalg.norm(K, 2)),
        eigenvector_condition=verdict.condition if verdict.exact else eigenvector_condition(A - B @ K),
        findings=tuple(_remarks(placement, wanted, verdict, aimed=aimed)),
    )


def _remarks(placement: Placement, wanted: Complexes, verdict: Verdict, *, aimed: bool) -> Iterator[Finding]:
    if placement.weakest is not None and placement.weakest < NEARLY_DEPENDENT:
        yield Finding(
            "nearly_uncontrollable",
            "warning",
            f"The system is nearly uncontrollable: a column of the scan adds only {placement.weakest:.1e} to those "
            "before it, and the gains grow as the inverse of that.",
        )
    size = float(np.max(np.abs(wanted if aimed else verdict.poles), initial=0.0)) or 1.0
    if aimed and verdict.error > NOTICED * size:
        yield Finding(
            "pole_error",
            "warning",
            f"K places the poles with an error of up to {verdict.error:.2g}: poles that coincide, or lie far out, "
            "are sensitive to rounding K.",
        )
    if verdict.exact and verdict.rounding > NOTICED * size:
        yield Finding(
            "rounded_closed_loop",
            "info",
            "The poles told are those of A − BK computed without rounding. Rounding its entries to floating point "
            f"can move them by {_moved(verdict.rounding, size)}: so sensitive are they to errors of the model.",
        )


def _moved(distance: float, size: float) -> str:
    return f"up to {distance:.1g}" if distance < size else "more than the magnitude of the largest one"
