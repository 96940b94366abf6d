"""A rig's damping, stiffness and thrust constants from a recording, by output error on the nonlinear model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter
from types import SimpleNamespace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..checks import require_within
from ..errors import InvalidInputError, RecordingError, Wanted, nobody_leaves
from ..findings import Finding
from ..parameters import PARAMETER_INFO, Parameters
from ..signals import Floats
from ..simulation.recorded import longest_step
from .covariance import grouped_covariance, groups_of, plain_covariance, student_quantile
from .identified import Estimate, Identification, Progress
from .model_errors import unmodelled
from .recording import Recording
from .segments import Fitted, bridged, cut, divergence_told, fit_starts, rough_starts, segment_length
from .whiteness import Whiteness, whiteness

IDENTIFIABLE = ("K_pp", "K_py", "K_yp", "K_yy", "B_p", "B_y", "K_s")
"""Parameters that can be found, in the order of the sensitivities; J, m and l only scale them and stay."""
QUANTILE = 1.959964
"""Of the normal distribution, for 95 %."""
MOST_EVALUATIONS = 60
COARSE = 0.5
"""Length of the segments of a first fit, s; from one fit to the next they grow."""
GROWING = 3.0
TOLERANCE, COARSE_TOLERANCE = 1e-6, 1e-2
"""Relative change of the parameters at which a search ends."""
COARSE_ENCODER = 0.45
"""Residuals in encoder steps below which their rounding is no noise (alone it makes 0.29): it moves with the angle
and biases what is found. Then intervals that take it for white held the truth in 43 % of the bench's cases."""
_POOR_CONDITION = 1e6


def default_free(p: Parameters) -> tuple[str, ...]:
    """The parameters that are free unless one says otherwise: stiffness only where the rig has one."""
    return tuple(name for name in IDENTIFIABLE if name != "K_s" or p.K_s)


def identify(
    p: Parameters,
    recording: Recording,
    free: Sequence[str] | None = None,
    *,
    segment: float | None = None,
    travel: float | None = None,
    report: Callable[[Progress], None] = lambda progress: None,
    wanted: Wanted = nobody_leaves,
) -> Identification:
    """The free parameters that bring the simulated angles nearest to the recorded ones.

    Output error (Ljung, System Identification, 1999, sections 7.2 and 10.2): the nonlinear model, driven by the
    recorded voltages in segments whose starting states are unknown too, is fitted by SciPy's trust-region
    Gauss–Newton method, starting states eliminated within each step (Golub & Pereyra, SIAM J. Numer. Anal. 10
    (1973) 413–432). Short segments bring a wrong rig near; then both axes are weighted alike, then by their
    residuals. Intervals are those of `grouped_covariance`, of the kind for correlated residuals unless a test finds
    them white, and never narrower than for white ones.

    Args:
        p: the rig as it is thought to be; what is not free stays.
        recording: at least as long as the rig's slowest motion.
        free: of `IDENTIFIABLE`.
        segment: length, s; by default as long as no error grows much (`segment_length`).
        travel: pitch stops at ±travel, rad; what happens there is left out.
        report: called after each simulation; what it raises ends the search.
        wanted: called more often, within a simulation; what it raises ends the search.

    Raises:
        InvalidInputError: `free` is empty or holds an unknown name; `segment` is out of its range.
        RecordingError: the recording does not say what is asked of it.
    """
    began = perf_counter()
    names = _checked(default_free(p) if free is None else free)
    length = segment_length(p, recording) if segment is None else segment
    require_within(length, "segment", "s", 0.1, 1e4)
    recording = bridged(recording)

    def segmented(length: float, spent: int = 0) -> _Search:
        bounds = cut(recording, length, travel)
        return _Search(p, recording, names, bounds, report=report, wanted=wanted, evaluations=spent)

    with divergence_told():
        search, before, values = _found(segmented, names, length)
        return _concluded(search, before, values, began)


def _concluded(
    search: _Search, before: tuple[float, float] | None, values: Floats, began: float
) -> Identification:
    """The estimates with their intervals, and what is to be said of them."""
    p, recording, names = search.p, search.recording, search.names
    after = search.fitted(values)
    J, r = search.slopes(after) * search.weights[:, None], after.residuals * search.weights
    inside = search.inside
    unknowns = len(names) + 4 * len(search.bounds)
    groups = groups_of(search.bounds)
    tested = whiteness(search.bounds, r, after.basis)
    power = 0.5 if all(axis.white for axis in tested) else 1.0
    covariance = grouped_covariance(J, r, groups, after.basis, power)
    own = student_quantile(len(groups) - len(names)) * np.sqrt(np.diag(covariance))
    plain = QUANTILE * search.scales * np.sqrt(np.diag(plain_covariance(J[inside], r[inside], unknowns)))
    widths = np.maximum(
        search.scales * own, plain
    )  # few groups may underrate what white noise does by itself
    missed = unmodelled(
        search.rig(values),
        recording,
        search.bounds,
        after.starts,
        J=J,
        r=r,
        widths=widths / search.scales,
        names=names,
        weights=search.weights,
        step=search.step,
        wanted=search.wanted,
    )
    estimates = []
    for i, name in enumerate(names):
        own, value = getattr(p, name), search.value(i, values)
        unit, width = PARAMETER_INFO[name].unit, float(widths[i])
        estimates.append(Estimate(name, unit, own, value, value - width, value + width, float(plain[i])))
    return Identification(
        estimates=tuple(estimates),
        parameters=p.replaced({e.name: e.allowed for e in estimates}),
        rms_before=before,
        rms=_pair(search.rms(after)),
        residuals=after.residuals,
        segments=search.bounds,
        lags=float(np.median(np.diff(groups, axis=1))),
        evaluations=search.evaluations,
        seconds=perf_counter() - began,
        findings=(
            *recording.findings,
            *missed,
            *_correlated(tested, recording.sample_time),
            *_remarks(estimates, J[inside], names, search),
        ),
    )


def _found(
    segmented: Callable[..., _Search], names: tuple[str, ...], length: float
) -> tuple[_Search, tuple[float, float] | None, Floats]:
    """The search in segments of `length`, the residuals before it and what it found.

    A wrong rig soon falls out of reach of the right one, so that short segments bring it near first.
    """
    values, short = np.zeros(len(names)), min(COARSE, length)
    search = segmented(short)
    _require_excited(search.slopes(search.fitted(values)).reshape(-1, len(names)), names)
    while short < length:
        values = search.minimum(values, COARSE_TOLERANCE)
        short = min(GROWING * short, length)
        search = segmented(short, search.evaluations)
    try:
        before = _pair(search.rms(search.fitted(np.zeros(len(names)))))
    except FloatingPointError:
        before = None
    search.begin()
    for _ in range(2):
        search.weights = 1.0 / np.maximum(search.rms(search.fitted(values)), 1e-9)
        values = search.minimum(values)
    return search, before, values


class _Search:
    """The fit as a function of the free parameters' deviations, each in units of its own scale."""

    def __init__(
        self,
        p: Parameters,
        recording: Recording,
        names: tuple[str, ...],
        bounds: NDArray[np.int64],
        *,
        report: Callable[[Progress], None],
        wanted: Wanted = nobody_leaves,
        evaluations: int = 0,
    ) -> None:
        self.wanted = wanted
        self.p, self.recording, self.names, self.bounds, self.report = p, recording, names, bounds, report
        self.scales = np.array([_scale(p, name) for name in names])
        self.weights, self.evaluations, self.ended = np.ones(2), evaluations, True
        self._columns = [IDENTIFIABLE.index(name) for name in names]
        self._starts = rough_starts(recording, bounds)
        self._last: tuple[Floats, float, Any] = np.full(len(names), np.nan), 0.0, None
        self.step = longest_step(p) / 2
        inside = np.zeros(len(recording.t), dtype=bool)
        for first, end in bounds.tolist():
            inside[first:end] = True
        self.inside = inside

    @property
    def last(self) -> Fitted:
        """The last answer."""
        return self._last[2]

    def begin(self) -> None:
        """Forgets the starting states: those of another rig lead astray."""
        self._starts = rough_starts(self.recording, self.bounds)

    def value(self, i: int, deviations: Floats) -> float:
        """The i-th free parameter."""
        return float(getattr(self.p, self.names[i]) + deviations[i] * self.scales[i])

    def rig(self, deviations: Floats) -> Any:
        """The rig with these parameters, which may have any value."""
        values = SimpleNamespace(**self.p.as_dict(), alpha=self.p.alpha)
        for i, name in enumerate(self.names):
            setattr(values, name, self.value(i, deviations))
        return values

    def fitted(self, deviations: Floats) -> Fitted:
        """The segments under these parameters; the last answer is kept, for derivatives are asked for apart."""
        known, weight, answer = self._last
        key = float(self.weights[0] / self.weights[1])
        if answer is not None and weight == key and np.array_equal(known, deviations):
            return answer
        answer = fit_starts(
            self.rig(deviations),
            self.recording,
            self.bounds,
            self._starts,
            weights=self.weights,
            step=self.step,
            wanted=self.wanted,
        )
        self._starts, self._last = answer.starts, (deviations.copy(), key, answer)
        self.evaluations += 1
        self.report(Progress(self.evaluations, _pair(self.rms(answer))))
        return answer

    def rms(self, fitted: Fitted) -> Floats:
        """Root mean square of the residuals of θ and ψ, rad."""
        return np.sqrt(np.mean(fitted.residuals[self.inside] ** 2, axis=0))

    def slopes(self, fitted: Fitted) -> Floats:
        """Derivatives of the simulated angles by the free parameters in their scales, (n, 2, free)."""
        return fitted.slopes[:, :, self._columns] * self.scales

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
        result = search(
            residuals,
            start,
            derivatives,
            xtol=tolerance,
            ftol=tolerance**2,
            gtol=None,
            max_nfev=MOST_EVALUATIONS,
        )
        self.ended = result.status > 0
        return result.x


def _checked(free: Sequence[str]) -> tuple[str, ...]:
    for name in free:
        if name not in IDENTIFIABLE:
            raise InvalidInputError(
                f"{name!r} cannot be identified",
                field="free",
                value=name,
                hint="Choose of " + ", ".join(IDENTIFIABLE),
            )
    if not free:
        raise InvalidInputError("no parameter is free", field="free", hint="Choose at least one.")
    return tuple(name for name in IDENTIFIABLE if name in free)


def _scale(p: Parameters, name: str) -> float:
    """What one unit of the search means: the parameter's own size, or a fraction of its like."""
    own = abs(getattr(p, name))
    like = {"K": max(abs(p.K_pp), abs(p.K_py), abs(p.K_yp), abs(p.K_yy)), "B": max(p.B_p, p.B_y)}
    return max(own, 0.1 * p.alpha if name == "K_s" else 0.05 * like[name[0]], 1e-9)


def _require_excited(J: Floats, names: tuple[str, ...]) -> None:
    sizes = np.linalg.norm(J, axis=0)
    silent = [name for name, size in zip(names, sizes, strict=True) if size < 1e-9 * (1e-300 + np.max(sizes))]
    rank = np.linalg.matrix_rank(J / np.where(sizes > 0, sizes, 1.0), tol=1e-7)
    if silent or rank < len(names):
        which = (
            "nothing about " + ", ".join(silent) if silent else "too little to tell these parameters apart"
        )
        raise RecordingError(
            f"the recording says {which}",
            field="free",
            value=list(silent or names),
            hint="Leave some out, or record steps of both references, one after the other.",
        )


def _correlated(tested: list[Whiteness], sample_time: float) -> list[Finding]:
    axes = [i for i, axis in enumerate(tested) if not axis.white]
    if not axes:
        return []
    worst = max(axes, key=lambda i: tested[i].span)
    words = (
        f"The residuals in {' and '.join(('pitch', 'yaw')[i] for i in axes)} are not white: over some "
        f"{1e3 * sample_time * tested[worst].span:.2g} ms they are correlated, successive ones by "
        f"{max(tested[i].correlations[0] for i in axes):.2f}. The intervals allow for that, but from few segments: "
        "they may be too narrow. Record longer, or look for what the model leaves out."
    )
    return [Finding("correlated_residuals", "warning", words)]


def _pair(values: Floats) -> tuple[float, float]:
    return float(values[0]), float(values[1])


def _remarks(estimates: list[Estimate], J: Floats, names: tuple[str, ...], search: _Search) -> list[Finding]:
    found = []
    if not search.ended:
        words = (
            f"The search was given up after {MOST_EVALUATIONS} steps: the values are no least squares yet."
        )
        found.append(Finding("search_stopped", "warning", words))
    for e in estimates:
        if e.allowed != e.value:
            words = (
                f"{e.name} was found at {e.value:.3g} {e.unit}, where it cannot be; adopted is {e.allowed:g}."
            )
            found.append(Finding("out_of_range", "warning", words.replace("-", "−")))
        if e.low < 0 < e.high and e.before:
            words = f"The interval of {e.name} contains 0: the recording hardly shows it."
            found.append(Finding("undetermined", "warning", words))
    rms = search.rms(search.last)
    for axis, word in enumerate(("pitch", "yaw")):
        steps = np.abs(np.diff(search.recording.angles[:, axis]))
        if rms[axis] < COARSE_ENCODER * np.min(steps[steps > 0], initial=np.inf) < np.inf:
            words = f"Rounding by the {word} encoder outweighs its noise: the intervals may be too narrow."
            found.append(Finding(f"coarse_{word}_encoder", "warning", words))
    columns = J.reshape(-1, len(names))
    condition = float(np.linalg.cond(columns / np.linalg.norm(columns, axis=0)))
    if condition > _POOR_CONDITION:
        words = "The recording hardly tells these parameters apart: their values depend on one another."
        found.append(Finding("poorly_excited", "warning", words))
    return found


__all__ = ["IDENTIFIABLE", "Estimate", "Identification", "Progress", "default_free", "identify"]
