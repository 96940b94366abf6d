"""A recording over the simulation: how near the model comes, axis by axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..errors import RecordingError, Wanted, nobody_leaves
from ..findings import Finding
from ..frozen import Frozen
from ..loop import Loop
from ..parameters import Parameters
from ..rotors import AxisFriction, Rotors
from ..scenario import MOST_SAMPLE_TIMES, Digital, Limits
from ..signals import Floats
from ..simulation.recorded import exact, run_held, run_recorder, turning
from .acting import acting_of
from .beginnings import beginnings
from .recording import Recording
from .segments import SHORTEST, bridged, cut, divergence_told, fit_of, segment_length
from .time_axis import stretches
from .validation import nrmse_fit

USUAL_SAMPLE_TIME = 0.002
"""Of the controller where none is given, s; a recording that is finer decides."""
FARTHEST = 1e4
"""Angle beyond which a simulated rig has run away, rad."""


@dataclass(frozen=True)
class Overlay(Frozen):
    """What the model does under what was recorded.

    Attributes:
        angles: simulated θ, ψ at the recording's times, (n, 2), rad; NaN where nothing was simulated.
        voltages: V_p, V_y that drove the model, (n, 2), V.
        fit: per axis, %: 100 (1 − ‖y − ŷ‖/‖y − ȳ‖), as `nrmse_fit` says.
        rms: of the residuals per axis, rad.
        segments: (count, 2), first sample and last + 1 of what was simulated at a stretch.
        findings: remarks on the simulation.
    """

    angles: Floats
    voltages: Floats
    fit: tuple[float | None, float | None]
    rms: tuple[float, float]
    segments: NDArray[np.int64]
    findings: tuple[Finding, ...] = ()


def driven_by_voltages(
    p: Parameters,
    recording: Recording,
    travel: float | None = None,
    wanted: Wanted = nobody_leaves,
    *,
    rotors: Rotors = Rotors(),
    friction: AxisFriction = AxisFriction(),
    theta_0: float = 0.0,
    limits: tuple[float, float] | None = None,
) -> Overlay:
    """The rig under the recorded voltages from the recorded initial state, in one run; after a gap it begins anew.

    Where rotors take time, they and the axes begin as fits the recording best, there and after a gap
    (`beginnings`); `theta_0` (rad) and `limits` (V) match thrust curves that do not say it themselves.
    """
    recording, bounds = bridged(recording), stretches(recording.t)
    acting = acting_of(p, rotors, friction, theta_0, limits)
    angles = np.full_like(recording.angles, np.nan)
    with divergence_told():
        starts, away = beginnings(p, recording, bounds, acting, travel=travel, wanted=wanted)
        turned = None if acting is None else turning(acting, bounds, recording.t, recording.voltages, away)
        for start, (first, end) in zip(starts, bounds.tolist(), strict=True):
            own = slice(first, end)
            t, volts, part = recording.t[own], recording.voltages[own], turned and turned.part(own)
            states = run_held(p, start, t, volts, travel, rotors=part, wanted=wanted)
            angles[own] = states[:, :2]
        return _overlay(recording, angles, recording.voltages, bounds)


def driven_in_segments(
    p: Parameters,
    recording: Recording,
    length: float | None = None,
    travel: float | None = None,
    wanted: Wanted = nobody_leaves,
    *,
    rotors: Rotors = Rotors(),
    friction: AxisFriction = AxisFriction(),
    theta_0: float = 0.0,
    limits: tuple[float, float] | None = None,
) -> Overlay:
    """As `driven_by_voltages`, but begun anew every `length` s from the state that fits the recording best.

    By default a segment lasts a second, or the whole recording where no error grows; gaps and stops are left out.

    Raises:
        RecordingError: nothing is left to simulate, or the rig runs away.
    """
    recording = bridged(recording)
    if length is None:
        longest = segment_length(p, recording)
        length = longest if longest >= recording.t[-1] else SHORTEST
    acting = acting_of(p, rotors, friction, theta_0, limits)
    bounds = cut(recording, length, travel)
    with divergence_told():
        _, away = beginnings(p, recording, stretches(recording.t), acting, travel=travel, wanted=wanted)
    fitted = fit_of(p, recording, bounds, wanted, acting=acting, away=away)
    angles = np.full_like(recording.angles, np.nan)
    for first, end in bounds.tolist():
        angles[first:end] = recording.angles[first:end] - fitted.residuals[first:end]
    with divergence_told():
        return _overlay(recording, angles, recording.voltages, bounds)


def driven_by_references(
    loop: Loop,
    limits: Limits,
    recording: Recording,
    digital: Digital | None = None,
    wanted: Wanted = nobody_leaves,
) -> Overlay:
    """The design's loop under the recorded references, from the recorded initial state.

    The controller is `digital`, or one that knows its state exactly every 2 ms or as often as was recorded. Its
    integrals start so that it asks for the first recorded voltages; what is between samples is interpolated. Rotors,
    friction and what estimates are the loop's.

    Raises:
        RecordingError: no references were recorded, or more samples of the controller fit in than are simulated.
    """
    if recording.references is None:
        raise RecordingError(
            "no references were recorded",
            field="columns.theta_ref",
            hint="Choose the columns of both references, or let the recorded voltages drive the rig.",
        )
    finest = min(USUAL_SAMPLE_TIME, recording.sample_time)
    controller = digital or exact(Digital(sample_time=max(finest, 1e-4)))
    count = int(np.ceil(recording.t[-1] / controller.sample_time - 1e-9)) + 1
    if count > MOST_SAMPLE_TIMES:
        raise RecordingError(
            f"{count} samples of the controller are too many",
            field="scenario.digital.sample_time",
            value=controller.sample_time,
            hint=f"At most {MOST_SAMPLE_TIMES} are simulated: record less, or let the controller run slower.",
        )
    bounds, p = stretches(recording.t), loop.design.plant.parameters
    acting = None if loop.actuators is None else loop.actuators.constants
    angles, voltages = np.full_like(recording.angles, np.nan), np.full_like(recording.voltages, np.nan)
    with divergence_told():
        starts, away = beginnings(p, recording, bounds, acting, travel=limits.theta, wanted=wanted)
        for start, more, (first, end) in zip(starts, away, bounds.tolist(), strict=True):
            wanted()
            t, wish = recording.t[first:end] - recording.t[first], recording.references[first:end]
            times = controller.sample_time * np.arange(
                int(np.ceil(t[-1] / controller.sample_time - 1e-9)) + 1
            )
            held = np.clip(np.searchsorted(t, times + 1e-9, side="right") - 1, 0, None)
            own = {"start": start, "voltages": recording.voltages[first], "away": more}
            run = run_recorder(loop, limits, controller, wish[held], **own, wanted=wanted)
            for axis in (0, 1):
                angles[first:end, axis] = np.interp(t, times, run.states[:, axis])
            latest = np.clip(np.searchsorted(times, t + 1e-9, side="right") - 1, 0, len(times) - 1)
            voltages[first:end] = run.voltages[latest]
        return _overlay(recording, angles, voltages, bounds)


def _overlay(recording: Recording, angles: Floats, voltages: Floats, bounds: NDArray[np.int64]) -> Overlay:
    """The figures of what was simulated; where the model has run away it is cut off, and said so.

    Raises:
        FloatingPointError: nothing is left.
    """
    due = np.zeros(len(angles) + 1, dtype=int)
    np.add.at(due, bounds[:, 0], 1)
    np.add.at(due, bounds[:, 1], -1)
    near = np.all(np.abs(angles) < FARTHEST, axis=1)  # false where NaN, too
    angles[~near] = np.nan
    if not np.any(near):
        raise FloatingPointError("the simulation diverges")
    lost = np.flatnonzero((np.cumsum(due[:-1]) > 0) & ~near)
    findings = ()
    if len(lost):
        words = f"The model runs away and is shown until {recording.t[lost[0]]:.3g} s: the fit counts what is shown."
        findings = (Finding("runs_away", "warning", words),)
    measured, simulated = recording.angles[near], angles[near]
    fit = [nrmse_fit(measured[:, axis], simulated[:, axis]) for axis in (0, 1)]
    rms = np.sqrt(np.mean((measured - simulated) ** 2, axis=0))
    return Overlay(angles, voltages, (fit[0], fit[1]), (float(rms[0]), float(rms[1])), bounds, findings)


__all__ = ["Overlay", "driven_by_references", "driven_by_voltages", "driven_in_segments", "nrmse_fit"]
