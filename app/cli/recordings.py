"""`heli2dof read`, `overlay` and `identify`: recordings of a rig, one file or one per signal."""

from __future__ import annotations

from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import click

from .fields import (
    COLUMNS,
    DECIMAL,
    DESIGN,
    DRIVER,
    FREE,
    HELD_OUT,
    LOOPS,
    SCENARIO,
    SEGMENT,
    SEPARATOR,
    body,
    takes,
)
from .output import load_kernels, print_json, refusals, show

if TYPE_CHECKING:
    from heli2dof_core import Columns, Identification, Overlay, Recording
    from heli2dof_core.recordings.recording import Table

_TEXT = (SEPARATOR, DECIMAL)
_FILES = click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path))


@click.command()
@_FILES
@takes(*COLUMNS, *_TEXT)
def read(files: tuple[Path, ...], as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Print what FILES hold: columns and what they probably are, units, sample time, what is odd.

    Several files of one run, a signal each, become one recording.
    """
    from heli2dof_core.recordings.recording import recording_of
    from heli2dof_core.tables import Table as Shown
    from heli2dof_core.tables import number

    from ..contract.recordings import preview_reply

    with refusals(as_json):
        table, columns, _ = _opened(files, base, values)
        if as_json:
            return print_json(preview_reply("", ", ".join(path.name for path in files), table))
        roles = {name: role for role, name in columns.names.items()}
        rows = [
            (
                name,
                roles.get(name, "–"),
                _unit(columns, roles.get(name, "")),
                *map(number, table.values[:3, j]),
            )
            for j, name in enumerate(table.names)
        ]
        shown = Shown.of("columns", ("column", "is", "unit", "first", "second", "third"), rows)
        show([shown], findings=table.findings)
        recording = recording_of(table, columns)
        odd = [f for f in recording.findings if f not in table.findings]
        show((), _about(recording), findings=odd)
    return None


@click.command()
@_FILES
@takes(*DESIGN, *LOOPS, *SCENARIO, *COLUMNS, *_TEXT, DRIVER, SEGMENT)
def overlay(files: tuple[Path, ...], as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Simulate what FILES recorded and print how near the model comes, axis by axis."""
    from heli2dof_core.recordings.recording import recording_of
    from heli2dof_core.tables import Table as Shown
    from heli2dof_core.tables import number

    from ..contract.recordings import OverlayRequest, overlaid, overlay_reply

    with refusals(as_json):
        table, columns, request = _opened(files, base, values)
        asked = OverlayRequest.model_validate(request)
        recording = recording_of(table, columns)
        load_kernels()
        result: Overlay = overlaid(asked, recording)
        if as_json:
            return print_json(overlay_reply(asked.driver, recording, result))
        pairs = zip(("pitch", "yaw"), result.fit, result.rms, strict=True)
        rows = [(axis, "–" if fit is None else number(fit), number(rms)) for axis, fit, rms in pairs]
        shown = Shown.of("model over recording", ("axis", "fit (%)", "rms (rad)"), rows)
        show([shown], _about(recording), findings=(*recording.findings, *result.findings))
    return None


@click.command("identify")
@_FILES
@takes(*DESIGN, *COLUMNS, *_TEXT, SEGMENT, FREE, HELD_OUT)
def identify(files: tuple[Path, ...], as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Find the rig's damping, stiffness and thrust constants from FILES, with 95 % intervals.

    And, where they are among those to be found, time constants of its rotors, friction of its axes and its moments of
    inertia. The last third of the time is not fitted, but held against what was found.
    """
    from heli2dof_core.recordings.recording import recording_of

    from ..contract.identification import IdentifyRequest, identification_reply, identified

    with refusals(as_json):
        table, columns, request = _opened(files, base, values)
        asked = IdentifyRequest.model_validate({**request, "recording": "file"})
        spec, recording = asked.to_spec(), recording_of(table, columns)
        load_kernels()
        found = identified(asked, spec, recording)
        if as_json:
            return print_json(identification_reply(found, recording))
        show([_estimates(found), _parts(found)], _about(recording), findings=found.findings)
    return None


def _opened(
    files: tuple[Path, ...], base: IO[str] | None, values: dict[str, Any]
) -> tuple[Table, Columns, dict[str, Any]]:
    """The files' table, the columns as guessed and then as asked for, and the request that they belong to."""
    from heli2dof_core.recordings.files import Dialect, read_files
    from heli2dof_core.recordings.guess import guess_columns

    from ..contract.recordings import Mapping

    request = body(base, values)
    dialect = Dialect(request.pop("separator", None), request.pop("decimal", None))
    table = read_files(files, dialect)
    guess = guess_columns(table)
    guessed: dict[str, Any] = {
        **guess.names,
        **{"unit": guess.unit, "units": dict(guess.units), "voltage_unit": guess.voltage_unit},
        **({"time_unit": guess.time_unit} if guess.time_unit else {}),
    }
    asked = request.get("columns", {})
    if "unit" in asked:
        guessed["units"] = {}
    if asked.get("sample_time") and "time" not in asked:
        guessed.pop("time", None)
    request["columns"] = {**guessed, **asked}
    return table, Mapping.model_validate(request["columns"]).to_columns(), request


def _unit(columns: Columns, role: str) -> str:
    if role == "time":
        return columns.time_unit or "s"
    if role in ("V_p", "V_y"):
        return columns.voltage_unit
    return columns.unit_of(role) if role else ""


def _about(recording: Recording) -> str:
    rate = f"{1e3 * recording.sample_time:.4g} ms apart"
    return f"{len(recording.t)} rows, {rate}, {recording.t[-1]:.4g} s."


def _parts(found: Identification) -> Any:
    from heli2dof_core.tables import Table as Shown
    from heli2dof_core.tables import number

    def cells(values: tuple[float | None, float | None]) -> tuple[str, ...]:
        return tuple("–" if v is None else number(v) for v in values)

    rows = [
        (
            f"{('fitted', 'held out')[i]}, {number(part.first)} to {number(part.end)} s",
            *(cells(part.before.fit) if part.before else ("–", "–")),
            *cells(part.after.fit),
        )
        for i, part in enumerate(found.parts)
    ]
    head = ("part", "pitch before (%)", "yaw before (%)", "pitch found (%)", "yaw found (%)")
    return Shown.of("fit 100 (1 − ‖y − ŷ‖/‖y − ȳ‖)", head, rows)


def _estimates(found: Identification) -> Any:
    from heli2dof_core.tables import Table as Shown
    from heli2dof_core.tables import number

    rows = [
        (e.name, e.unit, number(e.before), number(e.value), number(e.low), number(e.high))
        for e in found.estimates
    ]
    return Shown.of("estimates", ("parameter", "unit", "before", "found", "low (95 %)", "high"), rows)
