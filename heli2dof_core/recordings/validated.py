"""What is found held against both parts of a recording: what was fitted, and what was held out."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..findings import Finding
from ..frozen import Frozen
from ..signals import Floats
from .covariance import grouped_covariance, groups_of
from .search import Search
from .segments import Fitted, fit_starts, rough_starts
from .validation import Agreement, Part, agreement

WORSE = 2.0
"""How many times as large as the fitted part's the residuals of what is held out are that are worth a word."""


@dataclass(frozen=True)
class Validated(Frozen):
    """What came of it.

    Attributes:
        parts: the fitted one, then the one that was held out.
        before, after: simulated angles, (n, 2), rad; NaN elsewhere.
        spread: variance of the estimates from part to part beyond what noise explains, (k,), in the search's units.
        findings: remarks.
    """

    parts: tuple[Part, ...]
    before: Floats
    after: Floats
    spread: Floats
    findings: tuple[Finding, ...]


def validated(
    search: Search, values: Floats, bounds: NDArray[np.int64], covariance: Floats, power: float
) -> Validated:
    """The rig as it was thought to be and as it was found, under all that can be simulated.

    What is held out would move the estimates by δ, one step of Gauss and Newton's. Were the model right, δ would have
    the sum of both parts' covariances; what it is beyond, τ² = (δ² − P − P')/2 ≥ 0, is told by two parts as the
    variance between studies by two studies is (DerSimonian & Laird, Controlled Clinical Trials 7 (1986) 177–188).

    Args:
        search: that found it.
        values: what it found.
        bounds: of all segments; the search's own come first.
        covariance: of the estimates by noise, (k, k), in the search's units.
        power: as `grouped_covariance` takes it.
    """
    own = len(search.bounds)
    after = _fitted(search, values, bounds)
    assert after is not None
    thought = _fitted(search, search.unknowns.before, bounds)
    measured, spread = search.recording.angles, np.zeros(len(values))
    found: list[Finding] = []
    parts = [_part(search, bounds[:own], thought, after)]
    if len(bounds) > own:
        held = bounds[own:]
        parts.append(_part(search, held, thought, after))
        spread = _between(search, after, held, covariance, power)
        found = _told(parts)
    return Validated(
        tuple(parts),
        _angles(measured, thought, bounds),
        _angles(measured, after, bounds),
        spread,
        tuple(found),
    )


def _fitted(search: Search, values: Floats, bounds: NDArray[np.int64]) -> Fitted | None:
    """All segments under these values; None where the rig runs away."""
    try:
        return fit_starts(
            search.unknowns.rig(values),
            search.recording,
            bounds,
            rough_starts(search.recording, bounds),
            weights=search.weights,
            step=search.step,
            acting=search.unknowns.acted(values),
            inertias=search.unknowns.inertias,
            wanted=search.wanted,
        )
    except FloatingPointError:
        return None


def _part(search: Search, bounds: NDArray[np.int64], before: Fitted | None, after: Fitted) -> Part:
    def of(fitted: Fitted) -> Agreement:
        return agreement(search.recording.angles, fitted.residuals, bounds)

    t = search.recording.t
    ends = float(t[bounds[0, 0]]), float(t[bounds[-1, 1] - 1])
    return Part(*ends, len(bounds), None if before is None else of(before), of(after))


def _angles(measured: Floats, fitted: Fitted | None, bounds: NDArray[np.int64]) -> Floats:
    angles = np.full_like(measured, np.nan)
    if fitted is not None:
        for first, end in bounds.tolist():
            angles[first:end] = measured[first:end] - fitted.residuals[first:end]
    return angles


def _between(
    search: Search, after: Fitted, held: NDArray[np.int64], covariance: Floats, power: float
) -> Floats:
    """The variance between both parts; 0 of what the one that is held out says nothing about."""
    rows = np.zeros(len(after.residuals), dtype=bool)
    for first, end in held.tolist():
        rows[first:end] = True
    J = search.slopes(after) * search.weights[:, None] * rows[:, None, None]
    r = after.residuals * search.weights * rows[:, None]
    flat = J.reshape(-1, J.shape[-1])
    if (
        np.linalg.matrix_rank(flat / np.maximum(np.linalg.norm(flat, axis=0), 1e-300), tol=1e-7)
        < flat.shape[1]
    ):
        return np.zeros(flat.shape[1])
    step = np.linalg.lstsq(flat, r.ravel(), rcond=None)[0]
    left = r - J @ step  # what is left there once the estimates have moved
    own = grouped_covariance(J, left, groups_of(held), after.basis, power)
    beyond = step**2 - np.diag(own) - np.diag(covariance)
    return np.asarray(np.maximum(beyond, 0.0) / 2.0)


def _told(parts: list[Part]) -> list[Finding]:
    found = []
    for axis, word in enumerate(("pitch", "yaw")):
        fitted, held = (part.after.rms[axis] for part in parts)
        before = parts[1].before
        if held > WORSE * fitted:
            words = (
                f"On the part that was held out the residuals in {word} are {held / fitted:.1f} times as large as on "
                "the fitted one: something changed between them, or the model does not carry over."
            )
            found.append(Finding(f"{word}_not_validated", "warning", words))
        elif before is not None and held > before.rms[axis]:
            words = f"On the part that was held out the rig as it was fits {word} better than the one that was found."
            found.append(Finding(f"{word}_not_validated", "warning", words))
    return found
