"""How well a rig fits a recording that it was, and one that it was not, found on."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from ..errors import RecordingError
from ..frozen import Frozen
from ..signals import Floats
from .recording import Recording
from .segments import FEWEST

HELD_OUT = 1.0 / 3.0
"""Share of a recording's time, its end, that page, REST and command line leave for validation."""
MOST_HELD_OUT = 0.8


@dataclass(frozen=True)
class Agreement(Frozen):
    """How near a rig comes, per axis.

    Attributes:
        fit: as `nrmse_fit` says, %.
        variance: accounted for, as `variance_accounted` says, %.
        rms: of the residuals, rad.
    """

    fit: tuple[float | None, float | None]
    variance: tuple[float | None, float | None]
    rms: tuple[float, float]


@dataclass(frozen=True)
class Part(Frozen):
    """A part of the recording, fitted or held out.

    Attributes:
        first, end: its times, s.
        segments: that were simulated in it, each from the state that fits it best.
        before: of the rig as it was thought to be; None where it runs away.
        after: of the rig as it was found.
    """

    first: float
    end: float
    segments: int
    before: Agreement | None
    after: Agreement


def split_at(recording: Recording, held_out: float) -> int | None:
    """The first row of what is held out; None: nothing is, or too little to be simulated.

    Raises:
        RecordingError: nothing is left to fit.
    """
    if held_out <= 0.0:
        return None
    row = int(np.searchsorted(recording.t, (1.0 - held_out) * recording.t[-1]))
    if len(recording.t) - row < FEWEST:
        return None
    if row < FEWEST:
        raise RecordingError(
            "what is not held out is too short to be fitted",
            field="held_out",
            value=held_out,
            hint="Hold less out, or record longer.",
        )
    return row


def until(recording: Recording, row: int | None) -> Recording:
    """The recording before that row: what is held out must not choose the segments either."""
    if row is None:
        return recording
    return replace(
        recording,
        **{name: getattr(recording, name)[:row] for name in ("t", "angles", "voltages")},
        references=None if recording.references is None else recording.references[:row],
    )


def fitted_part(bounds: NDArray[np.int64], row: int | None) -> NDArray[np.int64]:
    """The segments before that row.

    Raises:
        RecordingError: there is none.
    """
    if row is None:
        return bounds
    own = bounds[bounds[:, 1] <= row]
    if not len(own):
        raise RecordingError(
            "nothing before what is held out can be simulated",
            field="held_out",
            hint="Hold nothing out, or record longer.",
        )
    return own


def nrmse_fit(measured: Floats, simulated: Floats) -> float | None:
    """100 (1 − ‖y − ŷ‖/‖y − ȳ‖), % (as MATLAB's compare and goodnessOfFit); None where y never changes.

    100 is perfect, 0 as good as the mean, and there is no lowest value.
    """
    spread = float(np.linalg.norm(measured - np.mean(measured)))
    return 100.0 * (1.0 - float(np.linalg.norm(measured - simulated)) / spread) if spread > 0 else None


def variance_accounted(measured: Floats, simulated: Floats) -> float | None:
    """100 (1 − var(y − ŷ)/var y), %; None where y never changes. An offset does not count."""
    own = float(np.var(measured))
    return 100.0 * (1.0 - float(np.var(measured - simulated)) / own) if own > 0 else None


def agreement(measured: Floats, residuals: Floats, bounds: NDArray[np.int64]) -> Agreement:
    """Of measured angles and what is left of them, (n, 2), within segments."""
    rows = np.concatenate([np.arange(first, end) for first, end in bounds.tolist()])
    y, left = measured[rows], residuals[rows]
    pairs = [(y[:, axis], y[:, axis] - left[:, axis]) for axis in (0, 1)]
    fits, shares = [nrmse_fit(*pair) for pair in pairs], [variance_accounted(*pair) for pair in pairs]
    rms = np.sqrt(np.mean(left**2, axis=0))
    return Agreement((fits[0], fits[1]), (shares[0], shares[1]), (float(rms[0]), float(rms[1])))
