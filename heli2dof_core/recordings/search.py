"""The fit of a rig to a recording: least squares over its unknowns, starting states eliminated."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import Wanted, nobody_leaves
from ..signals import Floats
from ..simulation.recorded import longest_step
from .identified import Progress
from .recording import Recording
from .segments import Fitted, fit_starts, rough_starts
from .unknowns import FREE, INERTIAS, Unknowns

MOST_EVALUATIONS = 60
TOLERANCE = 1e-6
"""Relative change of the unknowns at which a search ends."""


class Search:
    """The fit as a function of the free parameters' deviations, each in units of its own scale."""

    def __init__(
        self,
        unknowns: Unknowns,
        recording: Recording,
        bounds: NDArray[np.int64],
        *,
        report: Callable[[Progress], None],
        wanted: Wanted = nobody_leaves,
        evaluations: int = 0,
    ) -> None:
        self.wanted = wanted
        self.unknowns, self.recording, self.bounds, self.report = unknowns, recording, bounds, report
        self.names, self.scales = unknowns.names, unknowns.scales
        self.weights, self.evaluations, self.ended = np.ones(2), evaluations, True
        self._starts = rough_starts(recording, bounds)
        self._last: tuple[Floats, float, Any] = np.full(len(self.names), np.nan), 0.0, None
        self.step = longest_step(unknowns.p) / 2
        inside = np.zeros(len(recording.t), dtype=bool)
        for first, end in bounds.tolist():
            inside[first:end] = True
        self.inside = inside

    @property
    def last(self) -> Fitted:
        """The last answer."""
        return self._last[2]

    @property
    def deviations(self) -> Floats:
        """Those that it is for."""
        return self._last[0]

    def begin(self) -> None:
        """Forgets the starting states: those of another rig lead astray."""
        self._starts = rough_starts(self.recording, self.bounds)

    def fitted(self, deviations: Floats) -> Fitted:
        """The segments under these parameters; the last answer is kept, for derivatives are asked for apart."""
        known, weight, answer = self._last
        key = float(self.weights[0] / self.weights[1])
        if answer is not None and weight == key and np.array_equal(known, deviations):
            return answer
        answer = fit_starts(
            self.unknowns.rig(deviations),
            self.recording,
            self.bounds,
            self._starts,
            weights=self.weights,
            step=self.step,
            acting=self.unknowns.acted(deviations),
            inertias=self.unknowns.inertias,
            wanted=self.wanted,
        )
        self._starts, self._last = answer.starts, (deviations.copy(), key, answer)
        self.evaluations += 1
        self.report(Progress(self.evaluations, pair(self.rms(answer))))
        return answer

    def rms(self, fitted: Fitted) -> Floats:
        """Root mean square of the residuals of θ and ψ, rad."""
        return np.sqrt(np.mean(fitted.residuals[self.inside] ** 2, axis=0))

    def slopes(self, fitted: Fitted) -> Floats:
        """Derivatives of the simulated angles by the free parameters in their scales, (n, 2, free)."""
        known = fitted.slopes.shape[2] - len(self.unknowns.inertias)
        columns = [
            FREE.index(name) if name not in INERTIAS else known + self.unknowns.inertias.index(name)
            for name in self.names
        ]
        return fitted.slopes[:, :, columns] * self.scales

    def minimum(self, start: Floats, tolerance: float = TOLERANCE) -> Floats:
        """Deviations at the least sum of weighted squares."""
        from scipy.optimize import least_squares

        def residuals(deviations: Floats) -> Floats:
            try:
                return (self.fitted(deviations).residuals * self.weights).ravel()
            except FloatingPointError:
                return np.full(self.recording.angles.size, np.inf)  # a step too far; the next one is shorter

        def derivatives(deviations: Floats) -> Floats:
            return -(self.slopes(self.fitted(deviations)) * self.weights[:, None]).reshape(
                -1, len(self.names)
            )

        search: Any = least_squares  # its stubs know neither callable derivatives nor the absence of gtol
        within = {"bounds": (self.unknowns.lowest, np.inf)} if self.unknowns.bounded else {}
        result = search(
            residuals,
            start,
            derivatives,
            **within,
            xtol=tolerance,
            ftol=tolerance**2,
            gtol=None,
            max_nfev=MOST_EVALUATIONS,
        )
        self.ended = result.status > 0
        return result.x


def pair(values: Floats) -> tuple[float, float]:
    """Pitch's and yaw's."""
    return float(values[0]), float(values[1])
