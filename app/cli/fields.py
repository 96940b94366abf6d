"""The options that describe a design, one per field of the REST API, and the request that they make."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import IO, Any, TypeVar, get_args

import click

from heli2dof_core.errors import InvalidInputError
from heli2dof_core.quantities import Field
from heli2dof_core.recordings.recording import ANGLES, ROLES
from heli2dof_core.request import (
    FRICTION,
    LIMITS,
    LOOP,
    NOISE,
    OBSERVER,
    OUTER,
    PARAMETERS,
    POINT,
    REFERENCE,
    ROTOR,
    ROTORS,
    STRUCTURE,
    WEIGHTS,
    Place,
)
from heli2dof_core.request import SCENARIO as SCENARIO_PLACE
from heli2dof_core.scenario import Model

from ..contract.places import COLUMNS as COLUMNS_PLACE
from .values import Assignment, Choice, Name, Numbers, Poles, Ranges, Size, Split, Words

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


def _words(module: str, name: str) -> Callable[[], Iterable[str]]:
    def words() -> Iterable[str]:
        from importlib import import_module

        return get_args(getattr(import_module(f"heli2dof_core.{module}"), name))

    return words


def _of(place: Place, flags: Mapping[str, str] = MappingProxyType({}), whose: str = "") -> Iterator[Option]:
    """An option per quantity that stands at this place; `whose` they are goes before their description."""
    for name, known in place.fields.items():
        flag = flags.get(name, f"--{name.replace('_', '-')}")
        about = f"{whose}{known.quantity.described}."
        yield Option(
            f"{flag}/--no-{flag.removeprefix('--')}" if known.kind is bool else flag,
            f"{place.path}.{name}".removeprefix("."),
            _kind(known),
            f"{about[:1].upper()}{about[1:]}",
        )


def _kind(known: Field) -> click.ParamType | None:
    if known.choices:
        return Name(lambda: known.choices)
    return {bool: None, int: click.INT, float: click.FLOAT}[known.kind]


def _weights() -> Iterator[Option]:
    """The weights of the quadratic methods, one option per matrix."""
    for kind, about in (("states", "state, Q"), ("inputs", "motor, R"), ("integrals", "integral, Q_z")):
        known = WEIGHTS[kind].fields
        yield Option(
            f"--weight-{kind}",
            f"weights.{kind}",
            Assignment(lambda known=known: known),
            f"LQR: weight of a {about}, SI: {next(iter(known))}=40; repeatable. Bryson's rule by default.",
        )


def _by_axis(places: Mapping[str, Place], what: str) -> Iterator[Option]:
    """The options of a motor or an axis: --rotor-tau-pitch."""
    for axis, place in places.items():
        flags = {name: f"--{what}-{name.replace('_', '-')}-{axis}" for name in place.fields}
        yield from _of(place, flags, f"{axis} rotor: " if what == "rotor" else f"{axis} axis' friction: ")


DESIGN = (
    Option("--preset", "preset", Name(_presets), "The rig, by the name of its preset."),
    Option(
        "--parameter",
        "parameters",
        Assignment(lambda: PARAMETERS.fields),
        "A parameter of the rig, SI units; repeatable.",
    ),
    Option(
        "--limit", "limits", Assignment(lambda: LIMITS.fields), "V_p, V_y (V) or theta (rad); repeatable."
    ),
    *_of(POINT, {"theta": "--operating-point"}),
    Option("--poles", "poles", Poles(), "Pitch's pair, then yaw's, rad/s: -12,-10,-3±4j."),
    Option("--method", "method", Name(_methods), "Placement method."),
    *_of(STRUCTURE),
    *_weights(),
    Option("--split", "split", Split(), "Poles of pitch's and of yaw's pair: 1,3/2,4."),
    *_by_axis(ROTOR, "rotor"),
    *_by_axis(FRICTION, "friction"),
    *_of(ROTORS),
    Option(
        "--rotor-poles", "rotor_poles", Numbers(), "Of pitch's and yaw's rotor where they are placed, rad/s."
    ),
    *_of(OBSERVER, {name: f"--observer-{name.replace('_', '-')}" for name in OBSERVER.fields}, "observer: "),
    Option(
        "--observer-poles", "observer.poles", Poles(), "Of the observer: pitch's pair, then yaw's, rad/s."
    ),
)
LOOPS = (
    *_of(OUTER),
    *(
        option
        for axis, place in LOOP.items()
        for option in _of(place, {name: f"--{name}-{axis}" for name in place.fields}, f"{axis} loop's ")
    ),
)
SCENARIO = (
    *_of(REFERENCE),
    *_of(SCENARIO_PLACE),
    *_of(NOISE, {name: f"--noise-{name}" for name in NOISE.fields}),
)
MODEL = Option("--model", "scenario.model", Name(lambda: get_args(Model)), "nonlinear, or linear.")
FREQUENCIES = Option("--frequencies", "frequencies", Numbers(), "Where |RGA(jω)| is wanted, rad/s: 0,1,10.")

_MOVED = "pitch-pair or yaw-pair, x ± jy; pitch-pi or yaw-pi, k_p and T_i."


def _figures() -> Iterable[str]:
    from heli2dof_core.many import SHARES
    from heli2dof_core.measured import MEASURED

    return (*MEASURED, *SHARES)


MAP = (
    Option("--move", "map.move", Name(_words("maps", "Move")), _MOVED),
    Option("--measure", "map.measure", Name(_figures), "The figure, settling_time by default."),
    Option(
        "--axis",
        "map.axis",
        Name(_words("measured", "Axis")),
        "That is stepped; both, the worse, by default.",
    ),
    Option("--motor", "map.motor", Name(_words("measured", "Motor")), "Likewise."),
    Option("--model", "map.model", Name(lambda: get_args(Model)), "nonlinear, or linear."),
    Option(
        "--steps", "map.steps", Name(_words("measured", "Steps")), "alone, each axis by itself, or together."
    ),
    Option(
        "--over",
        "map.over",
        Ranges(),
        "From where to where: --over=-15:0,0:12; around the design by default.",
    ),
    Option("--size", "map.size", Size(), "Places along x and y, 64x48 by default."),
    Option("--real/--no-real", "map.real", None, "Both poles of the pair are real, x and y."),
    Option("--scale", "map.scale", Name(_words("maps", "Scale")), "Of gains: log, or linear."),
    Option(
        "--uncertainty",
        "map.uncertainty.spread",
        Assignment(lambda: PARAMETERS.fields),
        "For shares of rigs: relative, of a parameter: J_p=0.2; repeatable. By default 0.1 of all but g.",
    ),
    Option("--rigs", "map.uncertainty.samples", click.INT, "For shares: how many rigs, 200 by default."),
    Option("--seed", "map.uncertainty.seed", click.INT, "Of these."),
)

COLUMNS = (
    Option(
        "--column",
        "columns",
        Choice(lambda: ROLES),
        "Which column is what: theta=Pitch; by the names by default; repeatable.",
    ),
    *_of(COLUMNS_PLACE),
    Option("--unit-of", "columns.units", Choice(lambda: ANGLES), "Of one angle: psi=deg; repeatable."),
    Option("--sign", "columns.signs", Assignment(lambda: ANGLES[:2]), "Of an encoder: theta=-1; repeatable."),
    Option(
        "--offset",
        "columns.offsets",
        Assignment(lambda: ANGLES[:2]),
        "Added to an angle, in its unit: theta=-40.5.",
    ),
)
SEPARATOR = Option(
    "--separator",
    "separator",
    Name(_words("recordings.files.text", "Separator")),
    "Of text; judged by default.",
)
DECIMAL = Option(
    "--decimal", "decimal", Name(_words("recordings.files.text", "Decimal")), "Of text: point or comma."
)
DRIVER = Option(
    "--driver", "driver", Name(lambda: ("segments", "voltages", "references")), "What drives the model."
)
SEGMENT = Option("--segment", "segment", click.FLOAT, "Length of a segment, s; by the rig by default.")
FREE = Option("--free", "free", Words(), "What is to be found, with commas: K_pp,B_p,rotors.pitch.tau.")
HELD_OUT = Option(
    "--held-out",
    "held_out",
    click.FLOAT,
    "Share of the time, its end, that is left for validation; 0: nothing.",
)
RECORDED = (*COLUMNS, SEPARATOR, DECIMAL, DRIVER, SEGMENT, FREE, HELD_OUT)
ALL = (*DESIGN, *LOOPS, *SCENARIO, MODEL, FREQUENCIES, *RECORDED, *MAP)


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


def require_asked(request: Mapping[str, Any], path: str, example: str, or_else: str = "") -> None:
    """Raises InvalidInputError where neither of two parts of a question is given, by its option and with an example.

    Args:
        request: the JSON, as `body` gives it.
        path: of the part, group and name: nearest.require; its option is called as its name.
        example: a whole command line that gives it.
        or_else: another part that is enough.
    """
    group = request.get(path.partition(".")[0], {})
    names = [own.rpartition(".")[2] for own in (path, or_else) if own]
    if not isinstance(group, Mapping) or any(group.get(name) is not None for name in names):
        return  # what is there is for the request's model to judge
    flags = " or ".join(f"--{name}" for name in names)
    raise InvalidInputError("nothing is asked for", field=path, hint=f"Give {flags}, in quotes: {example}")


def flag_of(path: str) -> str:
    """The option of a field, or of the field that holds it; empty where there is none."""
    flags = {option.path: option.flag.partition("/")[0] for option in ALL}
    parts = path.split(".")
    return next(
        (flags[".".join(parts[:n])] for n in range(len(parts), 0, -1) if ".".join(parts[:n]) in flags), ""
    )
