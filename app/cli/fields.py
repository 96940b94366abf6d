"""The options that describe a design, one per field of the REST API, and the request that they make."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import IO, Any, TypeVar, get_args

import click

from .values import Assignment, Choice, Name, Numbers, Poles, Split, Words

F = TypeVar("F", bound=Callable[..., Any])


@dataclass(frozen=True)
class Option:
    """An option that stands for a field.

    Attributes:
        flag: as it is written; of a pair of flags both.
        path: of the field in the request's JSON.
        kind: what its text may be; None where it is a flag, and several where it is an assignment.
        about: unit and meaning.
    """

    flag: str
    path: str
    kind: click.ParamType | None
    about: str

    @property
    def parameter(self) -> str:
        """Its name among a command's arguments."""
        return self.path.replace(".", "__")

    def decorate(self, command: F) -> F:
        """The command with this option."""
        several = isinstance(self.kind, Assignment | Choice)
        default = None if self.kind is None or not several else ()
        return click.option(
            self.flag, self.parameter, type=self.kind, multiple=several, default=default, help=self.about
        )(command)


def _presets() -> Iterable[str]:
    from heli2dof_core import PRESETS

    return PRESETS


def _methods() -> Iterable[str]:
    from heli2dof_core import METHODS

    return METHODS


def _parameters() -> Iterable[str]:
    from heli2dof_core.parameters import PARAMETER_INFO

    return PARAMETER_INFO


def _limits() -> Iterable[str]:
    from heli2dof_core.scenario import LIMIT_INFO

    return LIMIT_INFO


def _words(module: str, name: str) -> Callable[[], Iterable[str]]:
    def words() -> Iterable[str]:
        from importlib import import_module

        return get_args(getattr(import_module(f"heli2dof_core.{module}"), name))

    return words


DESIGN = (
    Option("--preset", "preset", Name(_presets), "The rig, by the name of its preset."),
    Option(
        "--parameter", "parameters", Assignment(_parameters), "A parameter of the rig, SI units; repeatable."
    ),
    Option("--limit", "limits", Assignment(_limits), "V_p, V_y (V) or theta (rad); repeatable."),
    Option("--operating-point", "operating_point.theta", click.FLOAT, "Pitch angle θ₀ of the model, rad."),
    Option("--poles", "poles", Poles(), "Pitch's pair, then yaw's, rad/s: -12,-10,-3±4j."),
    Option("--method", "method", Name(_methods), "Placement method."),
    Option("--coupling", "coupling", Name(_words("couplings", "Coupling")), "Structure of the closed loop."),
    Option("--lead", "lead", Name(_words("couplings", "Lead")), "Axis that leads where it is triangular."),
    Option("--split", "split", Split(), "Poles of pitch's and of yaw's pair: 1,3/2,4."),
    Option("--shift", "shift", click.FLOAT, "Shift c of Luenberger's basis."),
)
LOOPS = (
    Option(
        "--outer", "outer", Name(_words("scenario", "Outer")), "pi: two PI loops; none: the inner loop alone."
    ),
    Option("--pairing", "pairing", Name(_words("scenario", "Pairing")), "Of errors and motors."),
    Option("--decoupler/--no-decoupler", "decoupler", None, "Static decoupler behind the PI loops."),
    Option("--kp-pitch", "loops.pitch.kp", click.FLOAT, "Gain of the pitch error's PI, V/rad."),
    Option("--ti-pitch", "loops.pitch.ti", click.FLOAT, "Its integral time, s."),
    Option("--kp-yaw", "loops.yaw.kp", click.FLOAT, "Gain of the yaw error's PI, V/rad."),
    Option("--ti-yaw", "loops.yaw.ti", click.FLOAT, "Its integral time, s."),
)
SCENARIO = (
    Option("--theta", "scenario.reference.theta", click.FLOAT, "Pitch reference after t = 0, rad, absolute."),
    Option("--psi", "scenario.reference.psi", click.FLOAT, "Yaw reference, rad."),
    Option("--duration", "scenario.duration", click.FLOAT, "s."),
    Option("--samples", "scenario.samples", click.INT, "t = linspace(0, duration, samples)."),
    Option(
        "--anti-windup",
        "scenario.anti_windup",
        Name(_words("scenario", "AntiWindup")),
        "What the integrators do at a limit.",
    ),
    Option("--saturation/--no-saturation", "scenario.saturation", None, "Limit the voltages."),
    Option("--travel-stops/--no-travel-stops", "scenario.travel_stops", None, "Stop the pitch at its limit."),
    Option(
        "--trim-feedforward/--no-trim-feedforward",
        "scenario.trim_feedforward",
        None,
        "Add the trim, so that the rig starts at rest.",
    ),
)
MODEL = Option("--model", "scenario.model", Name(_words("scenario", "Model")), "nonlinear, or linear.")
FREQUENCIES = Option("--frequencies", "frequencies", Numbers(), "Where |RGA(jω)| is wanted, rad/s: 0,1,10.")

_ANGLES = ("theta", "psi", "theta_ref", "psi_ref")
COLUMNS = (
    Option(
        "--column",
        "columns",
        Choice(lambda: ("time", "theta", "psi", "V_p", "V_y", "theta_ref", "psi_ref")),
        "Which column is what: theta=Pitch; by the names by default; repeatable.",
    ),
    Option(
        "--time-unit",
        "columns.time_unit",
        Name(_words("recording_units", "TimeUnit")),
        "Of the time: s, ms, us …",
    ),
    Option(
        "--unit", "columns.unit", Name(_words("recording_units", "AngleUnit")), "Of the angles: rad or deg."
    ),
    Option("--unit-of", "columns.units", Choice(lambda: _ANGLES), "Of one angle: psi=deg; repeatable."),
    Option(
        "--voltage-unit", "columns.voltage_unit", Name(_words("recording_units", "VoltageUnit")), "V or mV."
    ),
    Option(
        "--sign", "columns.signs", Assignment(lambda: _ANGLES[:2]), "Of an encoder: theta=-1; repeatable."
    ),
    Option(
        "--offset",
        "columns.offsets",
        Assignment(lambda: _ANGLES[:2]),
        "Added to an angle, in its unit: theta=-40.5.",
    ),
    Option("--sample-time", "columns.sample_time", click.FLOAT, "s, where no column is the time."),
    Option("--decimate", "columns.decimate", click.INT, "Keep one of so many rows, voltages averaged."),
)
SEPARATOR = Option(
    "--separator",
    "separator",
    Name(_words("recording_files.text", "Separator")),
    "Of text; judged by default.",
)
DECIMAL = Option(
    "--decimal", "decimal", Name(_words("recording_files.text", "Decimal")), "Of text: point or comma."
)
DRIVER = Option(
    "--driver", "driver", Name(lambda: ("segments", "voltages", "references")), "What drives the model."
)
SEGMENT = Option("--segment", "segment", click.FLOAT, "Length of a segment, s; by the rig by default.")
FREE = Option("--free", "free", Words(), "Parameters to be found, with commas: K_pp,B_p.")
ALL = (*DESIGN, *LOOPS, *SCENARIO, MODEL, FREQUENCIES, *COLUMNS, SEPARATOR, DECIMAL, DRIVER, SEGMENT, FREE)


def takes(*options: Option) -> Callable[[F], F]:
    """A command with these options, with --design and with --json."""

    def decorate(command: F) -> F:
        command = click.option("--json", "as_json", is_flag=True, help="Print the REST API's reply.")(command)
        command = click.option(
            "--design",
            "base",
            type=click.File(encoding="utf-8"),
            help="A REST body as a JSON file (-: standard input) that the options change.",
        )(command)
        for option in reversed(options):
            command = option.decorate(command)
        return command

    return decorate


def body(base: IO[str] | None, values: Mapping[str, Any]) -> dict[str, Any]:
    """The JSON of a request: that of the file, changed by what the options gave.

    Raises:
        click.UsageError: the file holds no JSON object.
    """
    try:
        request = {} if base is None else json.load(base)
    except ValueError as error:
        raise click.UsageError(f"--design: not JSON: {error}") from error
    if not isinstance(request, dict):
        raise click.UsageError("--design: not a JSON object")
    for name, value in values.items():
        if value is not None and value != ():
            *parents, last = name.split("__")
            place = request
            for parent in parents:
                place = place.setdefault(parent, {})
            place[last] = {**place.get(last, {}), **dict(value)} if isinstance(value, tuple) else value
    return request


def flag_of(path: str) -> str:
    """The option of a field, or of the field that holds it; empty where there is none."""
    flags = {option.path: option.flag.partition("/")[0] for option in ALL}
    parts = path.split(".")
    return next(
        (flags[".".join(parts[:n])] for n in range(len(parts), 0, -1) if ".".join(parts[:n]) in flags), ""
    )
