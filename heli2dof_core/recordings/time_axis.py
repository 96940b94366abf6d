"""A recording's times: whether they can be a rig's, where they have gaps, and what is odd about them."""

from __future__ import annotations

from math import log
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..errors import RecordingError
from ..findings import Finding
from ..signals import Floats
from .units import SECONDS

LONGEST = 3600.0
"""Longest recording, s."""
FASTEST, SLOWEST = 1e-5, 1.0
"""Shortest and longest usual time between two rows, s."""
GAP = 4.5
"""Usual sample times between two rows beyond which nothing is known of the time between them."""
JITTER = 0.2
"""Deviation from the usual sample time, as a share of it, beyond which the samples count as irregular."""
COARSE = 0.0105
"""Sample time above which a controller may well have run faster than was recorded, s."""
_TYPICAL = 5e-3
_REPEATED = 0.2
"""Share of repeated times beyond which they were not written finely enough."""
_COUNTERS = (2.0**16, 2.0**32)
_DATENUMS = (6.9e5, 7.7e5), (3.6e4, 6e4)
"""MATLAB's and spreadsheets' days of the years 1889 to 2108 and 1998 to 2064."""


class Refused(Protocol):
    """Makes the error of a row, see `Table.refused`."""

    def __call__(self, row: int, name: str, role: str, words: str, hint: str = "") -> RecordingError:
        """The error."""
        ...


def judged_time(
    raw: Floats, name: str, unit: str, refused: Refused
) -> tuple[Floats, NDArray[Any], list[Finding]]:
    """Times in s from 0, the rows that are kept, and what was odd: repeated times are dropped, counters unwrapped.

    Raises:
        RecordingError: the times go back, are too coarse, or, in this unit, last too long or lie too far apart.
    """
    findings: list[Finding] = []
    raw = _unwrapped(raw, findings)
    steps = np.diff(raw)
    same = np.flatnonzero(steps == 0)
    if len(same) > _REPEATED * len(steps):
        raise RecordingError(
            f"column {name!r} repeats the time before in {len(same)} of {len(raw)} rows",
            field="columns.time",
            value=len(same),
            hint="Write it with more digits, or choose no column of time and give the sample time.",
        )
    back = np.flatnonzero(steps < 0)
    if len(back):
        row, by = int(back[0]) + 1, float(-steps[back[0]]) * SECONDS[unit]
        raise refused(
            row,
            name,
            "time",
            f"lies {by:.3g} s before the row above it",
            "Delete the rows of the other run or before the clock was set back, or choose no column of time and "
            "give the sample time.",
        )
    kept = np.concatenate([[0], np.flatnonzero(steps > 0) + 1])
    if len(same):
        words = f"{len(same)} rows that repeat the time before were left out, first row {same[0] + 2} of the data."
        findings.append(Finding("repeated_times", "warning", words))
    t = (raw[kept] - raw[0]) * SECONDS[unit]
    _require_plausible(t, kept, name, unit, refused)
    return t, kept, findings


def _require_plausible(t: Floats, kept: NDArray[Any], name: str, unit: str, refused: Refused) -> None:
    steps = np.diff(t)
    usual, widest = float(np.median(steps)), int(np.argmax(steps))
    if FASTEST <= usual <= SLOWEST:
        if t[-1] <= LONGEST:
            return
        if t[-1] - steps[widest] <= LONGEST:
            row, by = int(kept[widest + 1]), float(steps[widest])
            raise refused(
                row,
                name,
                "time",
                f"lies {by:.3g} s after the row above it (unit of time: {unit})",
                "The clock was set in between: delete the rows before or after it, or choose no column of time and "
                "give the sample time.",
            )
    likely = likely_unit(t / SECONDS[unit])
    if usual > SLOWEST or usual < FASTEST:
        words = f"rows lie {usual:.3g} s apart"
    else:
        words = f"the recording lasts {t[-1]:.3g} s, more than {LONGEST:g} s"
    hint = "Record a shorter time." if FASTEST <= usual <= SLOWEST else "Give the sample time instead."
    if likely != unit:
        hint = f"Choose its unit: in {likely} rows lie {usual / SECONDS[unit] * SECONDS[likely]:.3g} s apart."
    raise RecordingError(
        f"by column {name!r} with the unit {unit}, {words}", field="columns.time_unit", value=unit, hint=hint
    )


def likely_unit(raw: Floats) -> str:
    """The unit of a column of time by its numbers: seconds where they can be, else what is nearest to 5 ms."""
    steps = np.abs(np.diff(raw[np.isfinite(raw)]))
    steps = steps[steps > 0]
    if not len(steps):
        return "s"
    usual = float(np.median(steps))
    if usual < 1e-4 and any(low < abs(float(raw[0])) < high for low, high in _DATENUMS):
        return "d"
    if FASTEST <= usual < SLOWEST:
        return "s"
    return min(("ms", "us", "ns"), key=lambda unit: abs(log(usual * SECONDS[unit] / _TYPICAL)))


def stretches(t: Floats) -> NDArray[np.int64]:
    """First row and last + 1 of each stretch without a gap, (stretches, 2)."""
    steps = np.diff(t)
    usual = float(np.median(steps)) if len(steps) else 0.0
    ends = np.flatnonzero(steps > GAP * usual) + 1
    edges = np.concatenate([[0], ends, [len(t)]]).astype(np.int64)
    return np.column_stack([edges[:-1], edges[1:]])


def missing_rows(t: Floats) -> NDArray[np.int64]:
    """How many rows are missing behind each but the last, where times are whole multiples of the usual; else 0."""
    steps = np.diff(t)
    count = np.round(steps / np.median(steps))
    regular = np.all(np.abs(steps / np.median(steps) - count) <= JITTER)
    between = (count > 1) & (steps <= GAP * np.median(steps))
    return np.where(between & regular, count - 1, 0).astype(np.int64)


def timing_remarks(t: Floats, *, averaged: bool = False) -> list[Finding]:
    """Gaps, missing rows, irregular samples, and coarse ones unless voltages were averaged between them."""
    found, steps = [], np.diff(t)
    usual = float(np.median(steps))
    gaps, missing = len(stretches(t)) - 1, int(np.sum(missing_rows(t)))
    if gaps:
        longest = float(np.max(steps))
        count = f"A gap of {longest:.3g} s" if gaps == 1 else f"{gaps} gaps, the longest of {longest:.3g} s"
        found.append(Finding("gaps", "warning", f"{count}: nothing is simulated across."))
    if missing:
        words = (
            f"{missing} rows are missing ({100 * missing / (len(t) + missing):.2g} %): the voltages there are taken "
            "from the rows around them."
        )
        found.append(Finding("missing_rows", "warning", words))
    within = steps[steps <= GAP * usual]
    odd = int(np.sum(np.abs(within - usual) > JITTER * usual))
    if odd and not missing:
        words = f"{odd} of {len(steps)} sample times differ from the usual {1e3 * usual:.3g} ms by more than 20 %."
        found.append(Finding("irregular_samples", "warning", words))
    if usual > COARSE and not averaged:
        words = (
            f"Rows lie {1e3 * usual:.3g} ms apart. If the controller ran faster, its voltages in between are unknown "
            "and results are biased: record every sample; where rows are dropped, average the voltages (decimate)."
        )
        found.append(Finding("coarse_samples", "info", words))
    return found


def _unwrapped(raw: Floats, findings: list[Finding]) -> Floats:
    """A counter of 16 or 32 bits, such as Arduino's micros(), that began anew at 0."""
    steps = np.diff(raw)
    back = steps < 0
    if not np.any(back) or not np.array_equal(raw, np.round(raw)):
        return raw
    for size in _COUNTERS:
        if np.max(raw) < size and np.all(steps[back] < -0.9 * size):
            words = f"The clock is a counter that began anew at {size:.0f}, which was taken out."
            findings.append(Finding("clock_unwrapped", "info", words))
            return raw + size * np.concatenate([[0.0], np.cumsum(back)])
    return raw
