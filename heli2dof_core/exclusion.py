"""Whether requirements fit together before any design is looked at: none said twice, no bounds that exclude another.

>>> from .requirements import requirements_of
>>> first, second = requirements_of({"overshoot": [{"max": 1, "axis": "theta"}, {"min": 2}]})
>>> excluding((first, second))
((0, 1),)
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import combinations, product

from .errors import InvalidInputError
from .many import Measure
from .measured import MEASURED, Where
from .requirements import Requirement

_AXES, _MOTORS = ("theta", "psi"), ("V_p", "V_y")


def meant(measure: Measure) -> Measure:
    """The measure with all said that is meant where it is left out, so that equal ones compare as equal."""
    known, where = MEASURED.get(measure.name), measure.where
    if known is None:
        return Measure(measure.name)
    own = Where()
    if known.may_have_model:
        own = replace(own, model=where.model, steps=where.steps)
    if known.may_have_motor:
        own = replace(own, motor=where.motor or "both")
    if known.may_have_axis:
        # of the scenario as it is set there is one course of the motors, whatever the axis
        whole = known.of == "motor" and where.steps == "together"
        own = replace(own, axis="both" if whole else where.axis or "both")
    return Measure(measure.name, own)


def require_distinct(requirements: Sequence[Requirement], field: str = "require") -> None:
    """Raises InvalidInputError where a requirement is the same as one before it; its field says which."""
    seen: set[Requirement] = set()
    places: dict[str, int] = {}
    for own in requirements:
        name = own.measure.name
        place = places[name] = places.get(name, -1) + 1
        key = replace(own, measure=meant(own.measure))
        if key in seen:
            raise InvalidInputError(
                f"{own.words} {own.limit_text} is required twice",
                field=f"{field}.{name}.{place}",
                value=name,
                hint="Leave one of them out.",
            )
        seen.add(key)


def excluding(
    requirements: Sequence[Requirement], stepped: Collection[str] = _AXES
) -> tuple[tuple[int, int], ...]:
    """Pairs of requirements that no value of their figure meets together, whatever the design, by their positions.

    Limits of the worse of both axes or motors are limits of each, so that ``overshoot ≤ 1 %`` of either step
    excludes ``overshoot ≥ 2 %`` of pitch's. Values that limits let through as they are shown count as met.

    Args:
        requirements: in the order of the positions.
        stepped: the axes that are stepped; of both, those count.
    """
    found = []
    for i, j in combinations(range(len(requirements)), 2):
        a, b = requirements[i], requirements[j]
        if a.measure.name != b.measure.name or not _responses(a, stepped) & _responses(b, stepped):
            continue
        (low, high), (least, most) = a.edges, b.edges
        if low > most or least > high:
            found.append((i, j))
    return tuple(found)


def exclusion_text(requirements: Sequence[Requirement], pairs: Sequence[tuple[int, int]]) -> str:
    """Which requirements exclude one another, in words: a sentence per pair, and what to do."""
    own = [tuple(f"{requirements[i].words} {requirements[i].limit_text}" for i in pair) for pair in pairs]
    told = " ".join(f"{a} and {b} exclude one another: no value lies within both limits." for a, b in own)
    return f"{told} Change or leave out one of them."


def _responses(need: Requirement, stepped: Collection[str]) -> set[tuple[str | None, ...]]:
    """Each single response that is limited: axis, motor, model, steps."""
    where = meant(need.measure).where
    axes = [axis for axis in _AXES if axis in stepped] or _AXES if where.axis == "both" else (where.axis,)
    motors = _MOTORS if where.motor == "both" else (where.motor,)
    return {(axis, motor, where.model, where.steps) for axis, motor in product(axes, motors)}
