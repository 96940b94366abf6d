"""A study's file, TOML, and what is wrong with it."""

from __future__ import annotations

import tomllib
from collections.abc import Collection, Iterator, Mapping, Sequence
from contextlib import contextmanager
from difflib import get_close_matches
from typing import Any

from ..checks import checked_number, require_known
from ..errors import Heli2DofError, InvalidInputError, within_field
from ..many import SHARES, Measure
from ..measured import MEASURED, Where
from ..on_rigs import require_continuous
from ..request import Body, path_of, spec_of
from ..requirements import Requirement, measure_of, requirements_of
from ..robustness import Uncertainty, require_lags
from .designs import Designs, Grid, Listed, Random, changed, merged, require_path, spaced
from .problems import StudyError
from .rigs import Rigs
from .study import FORMAT, Study, column_of

MOST_DESIGNS = 10**7
MOST_PAIRS = 10**10
LONGEST_AXIS = 100_000
_FIELDS = ("study", "title", "design", "designs", "rigs", "measures", "require", "unstable")
_RIGS = ("count", "seed", "distribution", "spread")
_SCALES = {"linear": False, "log": True}
_RANGE = ("from", "to", "count", "scale")
USUAL = ("settling_time", "overshoot", "V_peak", "saturated")
"""What is measured where a file names no figure."""


def read_study(text: str) -> Study:
    """The study that a file's text describes (docs/study.md).

    Raises:
        StudyError: it is no TOML.
        InvalidInputError: a field is unknown or unusable; its path says which.
    """
    try:
        data = tomllib.loads(text.removeprefix("\ufeff"))
    except tomllib.TOMLDecodeError as error:
        raise StudyError(
            f"the file is no TOML: {error}", hint="docs/study.md has a file to begin with."
        ) from None
    return study_of(data)


def study_of(data: Mapping[str, Any]) -> Study:
    """The study that a file's fields describe; refuses as `read_study`."""
    _require_fields(data, _FIELDS, "")
    if data.get("study") != FORMAT:
        raise InvalidInputError(
            "the file does not say that it is a study", field="study", hint=f"Begin it with study = {FORMAT}."
        )
    title = data.get("title", "")
    if not isinstance(title, str):
        raise InvalidInputError("the title is no text", field="title", value=title)
    base = _table(data.get("design", {}), "design")
    with _in_file("design"):
        spec = spec_of(base)
    with within_field("rigs"):
        rigs = None if "rigs" not in data else _rigs(_table(data["rigs"], ""))
    if rigs is not None:
        with _in_file("design"):
            require_continuous(spec.scenario)
        with within_field("rigs"):
            require_lags(spec.actuators, rigs.uncertainty)
    with within_field("designs"):
        designs = _designs(_table(data.get("designs", {}), ""), base)
    with within_field("require"):
        requirements = requirements_of(_table(data.get("require", {}), ""))
    unstable = data.get("unstable", False)
    if not isinstance(unstable, bool):
        raise InvalidInputError("it is neither true nor false", field="unstable", value=unstable)
    study = Study(
        title,
        base,
        designs,
        rigs,
        tuple(_measures(data.get("measures"), requirements)),
        requirements,
        unstable,
    )
    _require_judged(study)
    return study


@contextmanager
def _in_file(path: str) -> Iterator[None]:
    """As `within_field`, of what a request calls otherwise than the core does."""
    with within_field(path):
        try:
            yield
        except Heli2DofError as error:
            error.name_field(path_of(error.field))
            raise


def _require_judged(study: Study) -> None:
    for own in study.requirements:
        if own.share is not None and study.rigs is None:
            raise InvalidInputError(
                "a share of the rigs is required, and none are described",
                field=f"require.{own.measure.name}.share",
                hint="Add [rigs] with a count, or leave the share out.",
            )
    if study.pairs > MOST_PAIRS:
        raise InvalidInputError(
            f"these are {study.pairs:,} pairs of a design and a rig, more than {MOST_PAIRS:,}",
            field="designs",
            hint="Make it several studies.",
        )


def _rigs(given: Body) -> Rigs:
    _require_fields(given, _RIGS, "")
    if "count" not in given:
        raise InvalidInputError("how many rigs is not said", field="count", hint="Write count = 1000.")
    spread = _table(given.get("spread", dict(Uncertainty().spread)), "spread")
    own = {name: given[name] for name in ("seed", "distribution") if name in given}
    return Rigs(Uncertainty(spread=spread, samples=1, **own), given["count"])


def _designs(given: Body, base: Body) -> Designs:
    _require_fields(given, ("list", "grid", "random"), "")
    if len(given) > 1:
        raise InvalidInputError(
            f"designs are told in {len(given)} ways", hint="Keep one of list, grid and random."
        )
    if "list" in given:
        return _listed(given["list"], base)
    if "grid" in given:
        with within_field("grid"):
            return _grid(_table(given["grid"], ""), base)
    if "random" in given:
        with within_field("random"):
            return _random(_table(given["random"], ""), base)
    return Listed()


def _listed(given: Any, base: Body) -> Listed:
    if not isinstance(given, list) or not given:
        raise InvalidInputError(
            "the list has no designs", field="list", hint="Begin each with [[designs.list]]."
        )
    for i, own in enumerate(given):
        with _in_file(f"list.{i}"):
            spec_of(merged(base, _table(own, "")))
    return Listed(tuple(given))


def _grid(given: Body, base: Body) -> Grid:
    values = {}
    for path, own in given.items():
        require_path(path)
        with within_field(path):
            values[path] = _values(own)
    if not values:
        raise InvalidInputError("the grid has no numbers", hint='Write "loops.pitch.kp" = [10, 20].')
    grid = Grid(values)
    if grid.count > MOST_DESIGNS:
        raise InvalidInputError(f"these are {grid.count:,} designs, more than {MOST_DESIGNS:,}")
    _require_ends({path: (own[0], own[-1]) for path, own in values.items()}, base)
    return grid


def _random(given: Body, base: Body) -> Random:
    _require_fields(given, ("count", "seed", "over"), "")
    count, seed = _whole(given, "count", 1, MOST_DESIGNS), _whole(given, "seed", 0, 2**32 - 1, 0)
    ranges = {}
    with within_field("over"):
        for path, own in _table(given.get("over", {}), "").items():
            require_path(path)
            with within_field(path):
                low, high, _, logarithmic = _range(own)
                ranges[path] = (low, high, logarithmic)
    if not ranges:
        raise InvalidInputError(
            "it is not said what is random",
            field="over",
            hint='Write "loops.pitch.kp" = { from = 5, to = 20 }.',
        )
    _require_ends({path: own[:2] for path, own in ranges.items()}, base)
    return Random(ranges, count, seed)


def _require_ends(ends: Mapping[str, tuple[Any, Any]], base: Body) -> None:
    """Refuses what no design can have; which combinations do not exist is found when they are computed."""
    for path, both in ends.items():
        for value in both:
            try:
                spec_of(changed(base, {path: value}))
            except Heli2DofError as error:
                error.name_field(path)
                raise


def _values(given: Any) -> tuple[Any, ...]:
    if isinstance(given, list):
        if not given:
            raise InvalidInputError("there are no values", hint="Give one at least.")
        return tuple(given)
    low, high, count, logarithmic = _range(given, counted=True)
    return spaced(low, high, count, logarithmic=logarithmic)


def _range(given: Any, *, counted: bool = False) -> tuple[float, float, int, bool]:
    own = _table(given, "")
    _require_fields(own, _RANGE if counted else tuple(n for n in _RANGE if n != "count"), "")
    for name in ("from", "to"):
        if name not in own:
            raise InvalidInputError(f"{name} is missing", field=name, hint="Write { from = 5, to = 20 }.")
    low, high = checked_number(own["from"], "from"), checked_number(own["to"], "to")
    scale = own.get("scale", "linear")
    logarithmic = require_known(scale, _SCALES, "scale")
    if scale == "log" and not low * high > 0.0:
        raise InvalidInputError(
            "a logarithmic range passes 0", field="scale", hint="Make both ends positive."
        )
    return low, high, _whole(own, "count", 1, LONGEST_AXIS) if counted else 0, logarithmic


def _whole(given: Mapping[str, Any], name: str, low: int, high: int, usual: int | None = None) -> int:
    value = given.get(name, usual)
    if not isinstance(value, int) or isinstance(value, bool) or not low <= value <= high:
        raise InvalidInputError(
            f"{name} is no whole number from {low:,} to {high:,}", field=name, value=value
        )
    return value


def _measures(given: Any, requirements: Sequence[Requirement]) -> Iterator[Measure]:
    """The figures that are named, then those that are required; each once."""
    if given is not None and (not isinstance(given, list) or not given):
        raise InvalidInputError(
            "measures is no list of figures", field="measures", hint='Write measures = ["settling_time"].'
        )
    named = given if given is not None else [] if requirements else [*USUAL]
    seen = set()
    for i, own in enumerate(named):
        with within_field(f"measures.{i}"):
            measure = _usual(measure_of(own))
        if (column := _column(measure, f"measures.{i}")) not in seen:
            seen.add(column)
            yield measure
    for own in requirements:
        if (column := _column(own.measure, f"require.{own.measure.name}")) not in seen:
            seen.add(column)
            yield own.measure


def _column(measure: Measure, field: str) -> str:
    if measure.name in SHARES:
        raise InvalidInputError(
            f"{measure.name} is of all rigs together, not of each",
            field=field,
            hint="Whether a rig is stable is kept anyway; of limits ask saturated.",
        )
    return column_of(measure)


def _usual(measure: Measure) -> Measure:
    """Of both axes where none is named, as requirements have it."""
    known, where = MEASURED.get(measure.name), measure.where
    if known is not None and known.has_axis and where.axis is None:
        return Measure(measure.name, Where("both", where.motor, where.model, where.steps))
    return measure


def _table(given: Any, field: str) -> Body:
    if not isinstance(given, Mapping):
        raise InvalidInputError("this is no table of fields", field=field, value=given)
    return dict(given)


def _require_fields(given: Mapping[str, Any], known: Collection[str], above: str) -> None:
    for name in given:
        if name not in known:
            alike = get_close_matches(name, known, 1)
            raise InvalidInputError(
                f"there is no field {above}{name}",
                field=f"{above}{name}",
                hint=f"Did you mean {alike[0]}?" if alike else "Known are " + ", ".join(known) + ".",
            )
