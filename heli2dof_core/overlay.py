"""A recording over the simulation: how near the model comes, axis by axis."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .errors import RecordingError
from .loop import Loop
from .parameters import Parameters
from .recordings import Recording
from .segments import SHORTEST, cut, fit_of, rough_starts, segment_length
from .signals import Floats
from .simulation.recorded import exact, run_held, run_recorder
from .spec import MOST_SAMPLE_TIMES, Digital, Limits

USUAL_SAMPLE_TIME = 0.002
"""Of the controller where none is given, s; a recording that is finer decides."""


@dataclass(frozen=True)
class Overlay:
    """What the model does under what was recorded.

    Attributes:
        angles: simulated θ, ψ at the recording's times, (n, 2), rad; NaN where nothing was simulated.
        voltages: V_p, V_y that drove the model, (n, 2), V.
        fit: per axis, %: 100 (1 − ‖y − ŷ‖/‖y − ȳ‖), as `nrmse_fit` says.
        rms: of the residuals per axis, rad.
        segments: (count, 2), first sample and last + 1 of what was simulated at a stretch.
    """

    angles: Floats
    voltages: Floats
    fit: tuple[float | None, float | None]
    rms: tuple[float, float]
    segments: NDArray[np.int64]


def nrmse_fit(measured: Floats, simulated: Floats) -> float | None:
    """100 (1 − ‖y − ŷ‖/‖y − ȳ‖), % (as MATLAB's compare and goodnessOfFit); None where y never changes.

    100 is perfect, 0 as good as the mean, and there is no lowest value.
    """
    spread = float(np.linalg.norm(measured - np.mean(measured)))
    return 100.0 * (1.0 - float(np.linalg.norm(measured - simulated)) / spread) if spread > 0 else None


def driven_by_voltages(p: Parameters, recording: Recording, travel: float | None = None) -> Overlay:
    """The rig under the recorded voltages from the recorded initial state, in one run."""
    whole = np.array([[0, len(recording.t)]])
    start = rough_starts(recording, whole)[0]
    states = run_held(p, start, recording.t, recording.voltages, travel)
    return _overlay(recording, states[:, :2], recording.voltages, whole)


def driven_in_segments(
    p: Parameters, recording: Recording, length: float | None = None, travel: float | None = None
) -> Overlay:
    """As `driven_by_voltages`, but begun anew every `length` s from the state that fits the recording best.

    By default a segment lasts a second, or the whole recording where no error grows; stops are left out.
    """
    if length is None:
        longest = segment_length(p, recording)
        length = longest if longest >= recording.t[-1] else SHORTEST
    bounds = cut(recording, length, travel)
    fitted = fit_of(p, recording, bounds)
    angles = np.full_like(recording.angles, np.nan)
    for first, end in bounds.tolist():
        angles[first:end] = recording.angles[first:end] - fitted.residuals[first:end]
    return _overlay(recording, angles, recording.voltages, bounds)


def driven_by_references(
    loop: Loop, limits: Limits, recording: Recording, digital: Digital | None = None
) -> Overlay:
    """The design's loop under the recorded references, from the recorded initial state.

    The controller is `digital`, or one that knows its state exactly every 2 ms or as often as was recorded. Its
    integrals start so that it asks for the first recorded voltages; what is between samples is interpolated.

    Raises:
        RecordingError: no references were recorded, or more samples of the controller fit in than are simulated.
    """
    if recording.references is None:
        raise RecordingError(
            "no references were recorded",
            field="columns.theta_ref",
            hint="Choose the columns of both references.",
        )
    finest = min(USUAL_SAMPLE_TIME, recording.sample_time)
    controller = digital or exact(Digital(sample_time=max(finest, 1e-4)))
    count = int(np.ceil(recording.t[-1] / controller.sample_time - 1e-9)) + 1
    if count > MOST_SAMPLE_TIMES:
        raise RecordingError(
            f"{count} samples of the controller are too many",
            field="scenario.digital.sample_time",
            value=controller.sample_time,
            hint=f"At most {MOST_SAMPLE_TIMES} are simulated: record a shorter time.",
        )
    times = controller.sample_time * np.arange(count)
    held = np.clip(np.searchsorted(recording.t, times + 1e-9, side="right") - 1, 0, None)
    start = rough_starts(recording, np.array([[0, len(recording.t)]]))[0]
    run = run_recorder(
        loop, limits, controller, recording.references[held], start=start, voltages=recording.voltages[0]
    )
    angles = np.column_stack([np.interp(recording.t, times, run.states[:, axis]) for axis in (0, 1)])
    latest = np.clip(np.searchsorted(times, recording.t + 1e-9, side="right") - 1, 0, count - 1)
    return _overlay(recording, angles, run.voltages[latest], np.array([[0, len(recording.t)]]))


def _overlay(recording: Recording, angles: Floats, voltages: Floats, bounds: NDArray[np.int64]) -> Overlay:
    shown = np.all(np.isfinite(angles), axis=1)
    measured, simulated = recording.angles[shown], angles[shown]
    fit = [nrmse_fit(measured[:, axis], simulated[:, axis]) for axis in (0, 1)]
    rms = np.sqrt(np.mean((measured - simulated) ** 2, axis=0)) if len(measured) else np.zeros(2)
    return Overlay(angles, voltages, (fit[0], fit[1]), (float(rms[0]), float(rms[1])), bounds)
