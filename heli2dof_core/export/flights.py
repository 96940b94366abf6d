"""Flights to take away: their courses as numbers, and as a recording from which the rig can be identified."""

from __future__ import annotations

import io
import json
from collections.abc import Iterator
from itertools import pairwise
from typing import Any

import numpy as np

from ..errors import RecordingError, Wanted, nobody_leaves
from ..flight.events import DESIGN
from ..flight.log import FlightLog
from ..flight.thin import MOST_KEPT, ThinFlight, thin_flight
from ..kernels.flight_layout import ON_STOP, OUTSIDE, SENSED, SPEED, STATE, UNLIMITED, VOLTAGE, WISH
from ..presets import DEFAULT, PRESETS
from ..recordings.files import MOST_ROWS, write_csv
from ..recordings.files.text import SYNTHETIC
from ..recordings.recording import FEWEST_SAMPLES
from ..recordings.time_axis import GAP
from ..version import package_version
from .matlab_data import mat_file

COLUMNS = (
    ("theta", "rad", STATE),
    ("psi", "rad", STATE + 1),
    ("theta_dot", "rad/s", STATE + 2),
    ("psi_dot", "rad/s", STATE + 3),
    ("V_p", "V", VOLTAGE),
    ("V_y", "V", VOLTAGE + 1),
    ("theta_reference", "rad", WISH),
    ("psi_reference", "rad", WISH + 1),
    ("theta_measured", "rad", SENSED),
    ("psi_measured", "rad", SENSED + 1),
    ("theta_dot_measured", "rad/s", SENSED + 2),
    ("psi_dot_measured", "rad/s", SENSED + 3),
    ("V_p_asked", "V", UNLIMITED),
    ("V_y_asked", "V", UNLIMITED + 1),
    ("v_p", "V", SPEED),
    ("v_y", "V", SPEED + 1),
    ("theta_torque", "N*m", OUTSIDE),
    ("psi_torque", "N*m", OUTSIDE + 1),
    ("stop", "", ON_STOP),
)
"""A course's columns in files: name, unit, and where they stand in a row."""
_WORDS = {"thrust": "a rotor had another thrust", "hung": "a mass hung on the body"}
"""What a recording keeps although no design says it, since it is the rig that one may want to identify."""


def flight_csv(flight: ThinFlight) -> str:
    """A course as comma-separated values behind lines that begin with #; units in the header."""
    out = io.StringIO()
    out.writelines(f"# {line}\n" for line in _origin(flight, "csv"))
    names = ["t [s]", *(f"{name} [{unit}]" if unit else name for name, unit, _ in COLUMNS)]
    out.write(",".join(names) + "\n")
    rows = np.column_stack([flight.t, *(flight.rows[:, at] for _, _, at in COLUMNS)])
    np.savetxt(out, rows, fmt="%.12g", delimiter=",")
    return out.getvalue()


def flight_mat(flight: ThinFlight) -> bytes:
    """A course as a MAT-file (level 5): a column per signal, its changes of controller, its log as JSON."""
    changes = flight.flown.takeovers
    content: dict[str, Any] = {
        "about": "\n".join(_origin(flight, "mat")),
        "t": flight.t[:, None],
        **{name: flight.rows[:, at, None] for name, _, at in COLUMNS},
        "changes": {
            "t": np.array([[own.time] for own in changes]).reshape(-1, 1),
            "jump": np.array([own.jump for own in changes]).reshape(-1, 2),
            "jump_without": np.array([own.jump_without for own in changes]).reshape(-1, 2),
            "bumpless": np.array([[float(own.bumpless)] for own in changes]).reshape(-1, 1),
        },
        "log": json.dumps(flight.log.body()),
    }
    return mat_file(content)


def flight_recording(log: FlightLog, *, whole: bool = False, wanted: Wanted = nobody_leaves) -> bytes:
    """What a laboratory would have recorded of a flight: a row per sample of the controller, as CSV.

    Angles are those of the encoders, voltages those of the motors from a sample to the next. What no recording tells
    is left out, so that it is not taken for the rig: samples in which something pushed the body, or an encoder stuck.
    They leave gaps, across which nothing is identified.

    Args:
        log: of the flight.
        whole: whether these samples stay.
        wanted: as in `fly_log`.

    Raises:
        RecordingError: too few samples are left, or there are too many.
        Heli2DofError: as `fly_log`.
    """
    if log.ticks > MOST_KEPT:
        raise _too_long(log, f"{log.ticks} ticks, more than the {MOST_KEPT} of which a recording is made")
    flight = thin_flight(log, last=False, wanted=wanted)
    ticks = len(flight.t)
    edges = [*flight.flown.samples, (ticks, 1)]
    parts = [np.arange(first, min(until, ticks), n) for (first, n), (until, _) in pairwise(edges)]
    at = np.concatenate(parts)
    if len(at) > MOST_ROWS:
        raise _too_long(log, f"{len(at)} samples, more than the {MOST_ROWS} of a recording")
    kept, comments = np.ones(len(at), dtype=bool), _recorded(log)
    if not whole and len(at):
        hidden = np.any(flight.rows[:, OUTSIDE : OUTSIDE + 2] != 0.0, axis=1)
        for first, until in _stuck(log):
            hidden[first:until] = True
        kept = ~_widened(np.logical_or.reduceat(hidden, at))
        if not np.all(kept):
            share = 100.0 * (1.0 - float(np.mean(kept)))
            comments.append(
                f"Left out, since something pushed or an encoder stuck: {share:.3g} % of the time"
            )
    at = at[kept]
    if len(at) < FEWEST_SAMPLES:
        raise RecordingError(
            f"too few samples are left, {len(at)} of {FEWEST_SAMPLES} at least",
            field="events",
            value=len(at),
            hint="Fly for some seconds without pushes, gusts and faults.",
        )
    rows = flight.rows[at]
    names = ("theta", "psi", "theta_ref", "psi_ref", "V_p", "V_y")
    places = (SENSED, SENSED + 1, WISH, WISH + 1, VOLTAGE, VOLTAGE + 1)
    columns = {name: rows[:, place] for name, place in zip(names, places, strict=True)}
    return write_csv({"time": flight.t[at], **columns}, tuple(comments))


def _too_long(log: FlightLog, words: str) -> RecordingError:
    return RecordingError(
        f"the flight has {words}",
        field="ticks",
        value=log.ticks,
        hint="Fly for a shorter time, or with a longer sample time.",
    )


def _widened(hidden: Any) -> Any:
    """Hidden stretches so long that nobody takes them for a few rows that went missing."""
    least = int(np.ceil(GAP))
    return np.convolve(hidden, np.ones(least))[: len(hidden)] > 0.0


def _stuck(log: FlightLog) -> Iterator[tuple[int, int]]:
    """From which tick to which an encoder stuck."""
    since: int | None = None
    for tick, word, *values in log.events:
        if word == "stuck":
            if since is not None:
                yield since, tick
            since = tick if any(values) else None
    if since is not None:
        yield since, log.ticks


def _recorded(log: FlightLog) -> list[str]:
    words = [
        f"{SYNTHETIC}, flown: angles in rad, voltages in V",
        f"Preset {log.design.get('preset') or DEFAULT}",
    ]
    done = {event[1] for event in log.events}
    words += [f"In it {told}: no design says so" for word, told in _WORDS.items() if word in done]
    if DESIGN in done:
        words.append("In it the design changed: its rig, too, if that was changed")
    return words


def _origin(flight: ThinFlight, name: str) -> list[str]:
    """Where a file comes from, in lines of ASCII."""
    log, own = flight.log, flight.flown
    preset = PRESETS[log.design.get("preset") or DEFAULT]
    return [
        f"heli2dof {package_version()}",
        f"Rig: {preset.title}, preset {preset.name}",
        f"Flight of {own.duration:.6g} s, {own.ticks} ticks, of which one in {flight.every} is told"
        if flight.every > 1
        else f"Flight of {own.duration:.6g} s, {own.ticks} ticks",
        f"SHA-256 of all its rows: {flight.digest}",
        *([f"Ended: {own.ended}"] if own.ended else []),
        f"Made again by POST /api/v1/flights/{name} of its log, checksum {log.body()['checksum']}",
        "Design: " + json.dumps(log.design),
    ]
