"""`heli2dof fly`: a flight by a script, a task, or one made again from its log."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import click

from .fields import DESIGN, LOOPS, SCENARIO, body, takes
from .output import load_kernels, print_json, refusals, show, written

if TYPE_CHECKING:
    from heli2dof_core.flight import FlightLog, ThinFlight
    from heli2dof_core.tables import Table

_TEXT, _PATH = click.File(encoding="utf-8"), click.Path(path_type=Path)
_NOT_FLOWN = ("scenario.duration", "scenario.samples", "scenario.rtol")
_OPTIONS = (*DESIGN, *LOOPS, *(option for option in SCENARIO if option.path not in _NOT_FLOWN))


@click.command()
@click.option(
    "--script", type=_TEXT, help="What happens, by seconds (-: standard input); docs/flights-tools.md."
)
@click.option("--task", help="A task in the air, which the design flies alone: hold, path, land …")
@click.option(
    "--again", type=_TEXT, help="A flight's log (.flight.json), which is flown again; it is proved, too."
)
@click.option("--seconds", type=click.FLOAT, help="Length; by default 5 s more than the script.")
@click.option(
    "--seed", type=click.INT, default=0, help="Of the noise on measured angles and of a task's gusts."
)
@click.option("--log", "log", type=_PATH, help="Keep the log in this file, which the page replays.")
@click.option("--csv", "csv", is_flag=True, help="Write the course, a row per tick.")
@click.option("--every", type=click.IntRange(1), help="Of a long flight: of which tick --csv has a row.")
@click.option("-o", "--output", type=_PATH, help="File for --csv.")
@click.option("--force", is_flag=True, help="Write over files that are there.")
@takes(*_OPTIONS)
def fly(
    *,
    script: IO[str] | None,
    task: str | None,
    again: IO[str] | None,
    seconds: float | None,
    seed: int,
    log: Path | None,
    csv: bool,
    every: int | None,
    output: Path | None,
    force: bool,
    as_json: bool,
    base: IO[str] | None,
    **values: Any,
) -> None:
    """Fly a design in the nonlinear rig, by a script of set points, sticks, pushes, gusts and faults.

    It prints how well set points were followed and how the controller was changed in the air; of a task, its score.
    """
    given = base is not None or any(value not in (None, ()) for value in values.values())
    _require_one_flight(script, task, again, seconds, own=bool(seed) or given)
    if not csv and (output is not None or every is not None):
        raise click.UsageError("-o and --every are of --csv")
    with refusals(as_json):
        from heli2dof_core.flight import fly_script, read_script

        events = () if script is None else read_script(script.read())
        load_kernels()
        if again is not None:
            found = _read(again)
        elif task is not None:
            from heli2dof_core.flight.task_flights import flown_by_design

            found = flown_by_design(task, body(base, values), seed)
        else:
            found = fly_script(body(base, values), events, seconds, seed=seed)
        tell = _told(found, as_json=as_json, csv=csv, every=every)  # which proves it
        if log is not None:
            text = json.dumps(found.body(), ensure_ascii=False) + "\n"
            written(text, log, force=force, err=True)
        if log != Path("-"):
            tell(output, force)


def _require_one_flight(script: object, task: object, again: object, seconds: object, *, own: bool) -> None:
    """Refuses options that contradict one another; `own`: a design or a seed was given.

    Raises:
        click.UsageError: they do.
    """
    if sum(each is not None for each in (script, task, again)) > 1:
        raise click.UsageError("a flight is one of --script, --task and --again")
    if seconds is not None and (task is not None or again is not None):
        raise click.UsageError("a task and a log have a length of their own; leave --seconds out")
    if again is not None and own:
        raise click.UsageError("a log has a design and a seed of its own; leave their options out")


def _told(
    log: FlightLog, *, as_json: bool, csv: bool, every: int | None
) -> Callable[[Path | None, bool], None]:
    """Flies a log once more; what then tells of it, to a file and whether over one that is there."""
    from heli2dof_core.flight import thin_flight
    from heli2dof_core.flight.thin import MOST_KEPT

    if csv:
        from heli2dof_core.export.flights import flight_csv

        text = flight_csv(thin_flight(log, every or 1))
        return lambda output, force: written(text, output, force=force)
    if as_json:
        from ..contract.flights import SAMPLES, log_reply

        reply = log_reply(log, SAMPLES)
        return lambda _output, _force: print_json(reply)
    flight = thin_flight(log, -(-log.ticks // MOST_KEPT))
    return lambda _output, _force: show(_tables(flight), _summary(flight))


def _read(file: IO[str]) -> FlightLog:
    """The log in a file.

    Raises:
        click.UsageError: it is no JSON.
        InvalidInputError: it is no log, or it was changed.
    """
    from heli2dof_core.flight import FlightLog

    try:
        return FlightLog.read(json.load(file))
    except ValueError as error:
        from heli2dof_core import Heli2DofError

        if isinstance(error, Heli2DofError):
            raise
        raise click.UsageError(f"--again: not JSON: {error}") from error


def _summary(flight: ThinFlight) -> str:
    own = flight.flown
    ended = f" {own.ended}" if own.ended else ""
    some = f" Figures are of one tick in {flight.every}." if flight.every > 1 else ""
    return f"{own.duration:g} s, {own.ticks} ticks, {len(flight.log.events)} events.{ended}{some}"


def _tables(flight: ThinFlight) -> tuple[Table, ...]:
    """How well set points were followed, what it took, and changes in the air."""
    import numpy as np

    from heli2dof_core.kernels.flight_layout import STATE, UNLIMITED, VOLTAGE, WISH
    from heli2dof_core.tables import Table, number

    rows = flight.rows if flight.flown.last is None else flight.rows[:-1]
    lengths = np.diff(flight.t, append=flight.flown.duration)[: len(rows), None]
    whole = float(lengths.sum())
    errors = np.degrees(rows[:, STATE : STATE + 2] - rows[:, WISH : WISH + 2])
    volts, asked = rows[:, VOLTAGE : VOLTAGE + 2], rows[:, UNLIMITED : UNLIMITED + 2]
    rms = np.sqrt((errors**2 * lengths).sum(axis=0) / whole)
    effort = (volts**2 * lengths).sum(axis=0)
    limited = 100 * ((np.abs(asked) > flight.flown.limits) * lengths).sum(axis=0) / whole
    angles = np.degrees(flight.rows[-1, STATE : STATE + 2])
    axes = [
        ("θ", number(rms[0]), number(np.abs(errors[:, 0]).max()), number(angles[0])),
        ("ψ", number(rms[1]), number(np.abs(errors[:, 1]).max()), number(angles[1])),
    ]
    motors = [
        (name, number(np.abs(volts[:, i]).max()), number(effort[i]), number(limited[i]))
        for i, name in enumerate(("V_p", "V_y"))
    ]
    changes = [
        (
            number(each.time),
            *(number(round(volts, 9)) for volts in (*each.jump, *each.jump_without)),
            "yes" if each.bumpless else "no",
        )
        for each in flight.flown.takeovers
    ]
    heads = ("at (s)", "jump V_p (V)", "V_y (V)", "without: V_p (V)", "V_y (V)", "bumpless")
    return (
        *_score(flight),
        Table.of("angles", ("", "error RMS (°)", "largest (°)", "at the end (°)"), axes),
        Table.of("motors", ("", "largest (V)", "∫V² dt (V²s)", "beyond the limit (%)"), motors),
        *((Table.of("the controller was changed", heads, changes),) if changes else ()),
    )


def _score(flight: ThinFlight) -> tuple[Table, ...]:
    """What a task's flight is worth; nothing of others."""
    if not flight.log.task or flight.every > 1:
        return ()
    from heli2dof_core.figures import FLIGHT
    from heli2dof_core.figures.written import told
    from heli2dof_core.tables import Table

    from ..contract.flights import score_reply

    found = score_reply(flight.course())
    rows = []
    for name, value in found["values"].items():
        figure = FLIGHT[name]
        own = [told(figure, each) for each in (value.values() if isinstance(value, dict) else (value,))]
        rows.append((figure.title, ", ".join(own)))
    rows.append(("Stars", f"{found['stars']} of 3"))
    return (Table.of(f"task {flight.log.task}", ("", "θ, ψ where both"), rows),)
