"""A flight by a script: what happens by seconds, as a person writes it; flown, it is a log."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import ceil, inf, pi
from typing import Any, cast

from ..checks import checked_number, require_within, shortly
from ..errors import InvalidInputError, Wanted, nobody_leaves, within_field
from ..request import Body, spec_of
from ..signals import Floats
from .events import DESIGN, WORDS
from .log import CHECK_EVERY, MOST_EVENTS, FlightLog
from .rig import LONGEST, Rig
from .tasks.task import ticks_of

EARLY = 1e-6
"""s: what a script asks at a time happens at the first tick that is no earlier than this before it."""
_SECONDS = "seconds"
"""How long a gust blows, as a script says it; a log counts its ticks."""
_NUMBER = re.compile(r"([+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)(.*)", re.DOTALL)
_WORD, _TOKEN = re.compile(r"\S+"), re.compile(r"=|[^\s=]+")
_PATH = re.compile(r"([A-Za-z_]\w*(?:\.[A-Za-z_]\w*)*)=")
_NAME = re.compile(r"[A-Za-z][\w-]*")
_TWINS = re.compile(r"(?<=[\d.])(±|\+-|\+/-)")
_DESIGNS = 'Write it like 3 design poles=-4,-5,-3±2j loops.pitch.kp=8, or {"poles": [-4, -5, -6, -7]}.'
_DEGREE = pi / 180.0
_UNITS: Mapping[str, Mapping[str, float]] = {
    "rad": {"rad": 1.0, "°": _DEGREE, "deg": _DEGREE},
    "rad/s": {"rad/s": 1.0, "°/s": _DEGREE, "deg/s": _DEGREE},
    "s": {"s": 1.0, "ms": 1e-3},
    "N·m": {"N·m": 1.0, "Nm": 1.0, "N*m": 1.0, "mN·m": 1e-3, "mNm": 1e-3},
    "kg": {"kg": 1.0, "g": 1e-3},
    "m": {"m": 1.0, "cm": 1e-2, "mm": 1e-3},
    "V": {"V": 1.0, "mV": 1e-3},
    "": {"%": 0.01},
}
"""Factors of the units that may stand behind a number; without one it is in SI units."""


@dataclass(frozen=True)
class Line:
    """What happens at a time.

    Attributes:
        time: s.
        word: one of `events.WORDS`, or ``design``.
        values: in SI units; a gust's last one in s; of ``design`` what changes of the body.
        at: where it stands, for refusals: line and column of its word, or its index.
    """

    time: float
    word: str
    values: tuple[Any, ...]
    at: str


def read_script(text: str) -> tuple[Line, ...]:
    """What a script says, in order of time.

    A line is a time in s, a word of `events.WORDS` and its values, in their order or by name, in SI units or with a
    unit behind the number: ``1.5 reference theta=10° psi=0``. What is behind # is a remark. A gust's length is in
    ``seconds``. Behind ``design`` stands what changes of the design: ``poles=-4,-5,-3±2j loops.pitch.kp=8``, or JSON.
    A JSON list of ``[time, word, values …]`` says the same.

    Raises:
        InvalidInputError: it names line and column.
    """
    if text.lstrip().startswith("["):
        lines = _listed(text)
    else:
        lines = [found for n, own in enumerate(text.splitlines(), 1) if (found := _line(own, n)) is not None]
    if len(lines) > MOST_EVENTS:
        raise InvalidInputError(
            f"at most {MOST_EVENTS} lines make a flight", field="script", value=len(lines)
        )
    return tuple(sorted(lines, key=lambda line: line.time))


def fly_script(
    body: Body,
    script: Sequence[Line] = (),
    seconds: float | None = None,
    *,
    seed: int = 0,
    take: Callable[[Floats, Floats], None] | None = None,
    wanted: Wanted = nobody_leaves,
) -> FlightLog:
    """Flies a script: the design alone where it says nothing.

    Args:
        body: the design, as a body of the REST calls.
        script: what happens.
        seconds: how long; by default 5 s more than the last line's time.
        seed: of the noise on measured angles.
        take: gets each stretch of the course as it is flown: times (n,), s, and rows (n, FLIGHT_ROW).
        wanted: called before each stretch; what it raises ends the flight.

    Raises:
        Heli2DofError: a design does not exist, or a value is out of its range; it names the line.
    """
    last = max((line.time for line in script), default=0.0)
    length = min(last + 5.0, LONGEST) if seconds is None else seconds
    if not EARLY < length <= LONGEST:
        raise InvalidInputError(
            f"a flight lasts {LONGEST:g} s at most, and a tick at least", field="seconds", value=length
        )
    if script and last > length - EARLY:
        raise InvalidInputError(
            f"the script goes on until {last:g} s, the flight ends at {length:g} s",
            field="seconds",
            value=length,
            hint="Fly longer, or leave lines out.",
        )
    rig, flying, checks, n = Rig(spec_of(body), seed=seed), dict(body), [], 0
    while rig.time < length - EARLY and not rig.ended:
        wanted()
        while n < len(script) and rig.time > script[n].time - EARLY:
            flying = _done(rig, script[n], flying)
            n += 1
        ahead = min(length, script[n].time if n < len(script) else inf) - EARLY - rig.time
        ticks = max(1, ceil(ahead / rig.controller.tick))
        rows, t = rig.fly_ticks(min(ticks, CHECK_EVERY - rig.tick % CHECK_EVERY))
        if take is not None:
            take(t, rows)
        if rig.tick % CHECK_EVERY == 0 and not rig.ended:
            checks.append((rig.tick, *rig.y[:4].tolist()))
    if not rig.ended and (not checks or checks[-1][0] != rig.tick):
        checks.append((rig.tick, *rig.y[:4].tolist()))
    return FlightLog.of(rig, body, checks)


def _done(rig: Rig, line: Line, flying: Body) -> Body:
    """Does it now; the body of the design that flies from then on."""
    if line.word == DESIGN:
        with within_field(line.at):
            flying = _laid_over(flying, line.values[0])
            rig.change(spec_of(flying))
        return flying
    values = list(line.values)
    try:
        if line.word == "gust":
            length = require_within(values[2], _SECONDS, "s", 0.0, LONGEST)
            values[2] = ticks_of(length, rig.controller.tick)
        rig.do(line.word, *values)
    except InvalidInputError as error:  # whose message names the value
        error.name_field(line.at)
        raise
    return flying


def _laid_over(body: Body, changes: Mapping[str, Any]) -> Body:
    """The body with these changes, which reach into its objects; another preset leaves nothing of the old one."""
    if "preset" in changes and changes["preset"] != body.get("preset"):
        body = {}
    own = dict(body)
    for name, value in changes.items():
        before = own.get(name)
        inner = isinstance(before, Mapping) and isinstance(value, Mapping)
        own[name] = _laid_over(cast("Body", before), cast("Body", value)) if inner else value
    return own


def _names(word: str) -> tuple[tuple[str, str], ...]:
    """What a word carries in a script: names and units."""
    return tuple(
        (_SECONDS, "s") if word == "gust" and name == "ticks" else (name, unit)
        for name, unit, *_ in WORDS[word].values
    )


def _require_word(word: object, at: str) -> str:
    if not isinstance(word, str) or word not in (*WORDS, DESIGN):
        raise InvalidInputError(
            f"{shortly(word)} is no word of a script",
            field=at,
            value=word,
            hint=f"Known are {', '.join(WORDS)} and {DESIGN}.",
        )
    return word


def _line(text: str, n: int) -> Line | None:
    """A line, the n-th; None of a remark."""
    words = list(_WORD.finditer(text))
    if not words or words[0][0].startswith("#"):
        return None
    time = _number(words[0][0], "s", _place(n, words[0].start()), "the time")
    begin = words[1].start() if len(words) > 1 else len(text)
    word, at = words[1][0] if len(words) > 1 else "", _place(n, begin)
    if word.startswith("#"):
        word = ""
    _require_word(word, at)
    if word == DESIGN:
        changes = _changes(text, words[1].end(), n)
        return _checked(Line(time, word, (changes,), at))
    return _checked(Line(time, word, tuple(_values(word, text.partition("#")[0], words[1].end(), n)), at))


def _place(n: int, column: int) -> str:
    return f"line {n}, column {column + 1}"


def _changes(text: str, begin: int, n: int) -> dict[str, Any]:
    """What changes of the design's body: an object of JSON, or ``path=value`` with values in JSON or poles."""
    found: dict[str, Any] = {}
    where = _past(text, begin)
    if text.startswith("{", where):
        found, where = _json(text, where, n)
        if _past(text, where) < len(text) and text[_past(text, where)] != "#":
            where = _past(text, where)
            raise InvalidInputError(
                "something stands behind the design", field=_place(n, where), value=text[where:]
            )
        return found
    while where < len(text) and text[where] != "#":
        path = _PATH.match(text, where)
        if path is None:
            raise InvalidInputError(
                "this is no change of a design", field=_place(n, where), value=text[where:], hint=_DESIGNS
            )
        own, (*outer, name) = found, path[1].split(".")
        for each in outer:
            own = own.setdefault(each, {})
            if not isinstance(own, dict):
                raise InvalidInputError(
                    f"{each} is given twice", field=_place(n, where), value=path[1], hint=_DESIGNS
                )
        if name in own:
            raise InvalidInputError(
                f"{name} is given twice", field=_place(n, where), value=path[1], hint=_DESIGNS
            )
        own[name], where = _value(text, path.end(), n)
        where = _past(text, where)
    if not found:
        raise InvalidInputError(
            "behind design stands what changes", field=_place(n, where), value="", hint=_DESIGNS
        )
    return found


def _past(text: str, where: int) -> int:
    """Behind the white space there."""
    return where + len(text[where:]) - len(text[where:].lstrip())


def _json(text: str, where: int, n: int) -> tuple[Any, int]:
    """A value of JSON and where it ends."""
    try:
        return json.JSONDecoder().raw_decode(text, where)
    except ValueError as error:
        at = error.pos if isinstance(error, json.JSONDecodeError) else where
        raise InvalidInputError(
            "this is no JSON", field=_place(n, at), value=text[where:], hint=_DESIGNS
        ) from error


def _value(text: str, where: int, n: int) -> tuple[Any, int]:
    """What stands behind a path: JSON; poles and numbers with commas between them; or a name; and where it ends."""
    if where < len(text) and text[where] in '[{"':
        return _json(text, where, n)
    end = where + len(text[where:].split(None, 1)[0]) if text[where:].strip() else where
    plain = text[where:end].partition("#")[0]
    end = where + len(plain)
    if not plain or text[where].isspace():
        raise InvalidInputError("a value is missing", field=_place(n, where), value="", hint=_DESIGNS)
    if plain in ("true", "false", "null"):
        return {"true": True, "false": False, "null": None}[plain], end
    if _NAME.fullmatch(plain):
        return plain, end
    values: list[Any] = []
    for part in plain.replace("−", "-").split(","):
        try:
            pole = complex(_TWINS.sub("+", part).replace("i", "j"))
        except ValueError as error:
            raise InvalidInputError(
                f"{shortly(part)} is no number", field=_place(n, where), value=plain, hint=_DESIGNS
            ) from error
        twins = (pole, pole.conjugate()) if _TWINS.search(part) else (pole,)
        values += [{"re": own.real, "im": own.imag} if own.imag else own.real for own in twins]
    return (values[0] if len(values) == 1 else values), end


def _values(word: str, text: str, begin: int, n: int) -> list[float]:
    """Values of a line, in their order or by their names."""
    names, found, words = _names(word), {}, [*_TOKEN.finditer(text, begin)]
    units, k = dict(names), 0
    while k < len(words):
        at = _place(n, words[k].start())
        if k + 2 < len(words) and words[k + 1][0] == "=":
            name, own = words[k][0], words[k + 2]
            k += 3
        else:
            name, own = names[len(found)][0] if len(found) < len(names) else "", words[k]
            k += 1
        if name not in units or name in found:
            raise InvalidInputError(
                f"{word} takes {', '.join(units)}, each once",
                field=at,
                value=name or own[0],
                hint=_example(word),
            )
        found[name] = _number(own[0], units[name], _place(n, own.start()), name)
    missing = [name for name in units if name not in found]
    if missing:
        raise InvalidInputError(
            f"{word} needs {', '.join(missing)}",
            field=_place(n, len(text.rstrip())),
            value=text[begin:].strip(),
            hint=_example(word),
        )
    return [found[name] for name in units]


def _example(word: str) -> str:
    return f"Write it like 1.5 {word} {' '.join(f'{name}=1' for name, _ in _names(word))}."


def _number(text: str, unit: str, at: str, name: str) -> float:
    """A number with or without its unit, in SI units."""
    parts = _NUMBER.fullmatch(text.replace("−", "-"))
    known = _UNITS[unit]
    if parts is None or (parts[2] and parts[2] not in known):
        hint = f"Units are {', '.join(known)}."
        raise InvalidInputError(f"{name} is {shortly(text)}, not a number", field=at, value=text, hint=hint)
    return float(parts[1]) * (known[parts[2]] if parts[2] else 1.0)


def _listed(text: str) -> list[Line]:
    """Lines of a script in JSON."""
    try:
        rows = json.loads(text)
    except ValueError as error:
        raise InvalidInputError(f"the script is no JSON: {error}", field="script") from error
    found = []
    for n, row in enumerate(rows):
        at = f"script[{n}]"
        if not isinstance(row, list) or len(row) < 3:
            raise InvalidInputError("an event is a time, a word and its values", field=at, value=row)
        time, word, *values = cast("list[Any]", row)
        time, word = checked_number(time, at), _require_word(word, at)
        if word != DESIGN:
            if len(values) != len(_names(word)):
                names = ", ".join(name for name, _ in _names(word))
                raise InvalidInputError(f"{word} takes {names}", field=at, value=len(values))
            values = [checked_number(value, at) for value in values]
        elif len(values) != 1:
            raise InvalidInputError("a design is one object", field=at, value=len(values))
        found.append(_checked(Line(time, word, tuple(values), at)))
    return found


def _checked(line: Line) -> Line:
    if not 0.0 <= line.time <= LONGEST:
        raise InvalidInputError(f"a time is from 0 to {LONGEST:g} s", field=line.at, value=line.time)
    if line.word == DESIGN and not isinstance(line.values[0], Mapping):
        raise InvalidInputError("a design is an object of JSON", field=line.at, value=line.values[0])
    return line
