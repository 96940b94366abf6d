"""What is required of a design: limits of figures of merit, and whether values meet them.

>>> settles = Requirement(Measure("settling_time", Where("both")), max=0.8)
>>> settles.words, settles.limit_text, settles.meets(0.804), settles.meets(None)
('Settling time, either step', '≤ 0.80 s', True, False)

Whether a value meets its limits is judged of what is shown of it, as in labs (`measured.Measured.meets`).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import floor, inf, isfinite, isnan
from typing import Any, get_args

import numpy as np

from .checks import checked_number, require_within
from .errors import InvalidInputError, within_field
from .figures.written import percent
from .many import SHARES, Measure
from .measured import MEASURED, Axis, Measured, Motor, Steps, Where
from .scenario import Model
from .signals import Floats

_CHOICES = {"axis": Axis, "motor": Motor, "model": Model, "steps": Steps}
_LIMITS = ("max", "min", "share")
MOST = 32
"""Requirements at once."""


@dataclass(frozen=True)
class Requirement:
    """Limits of one figure.

    Attributes:
        measure: the figure, and of which response.
        max, min: in the figure's unit, SI but for %; one of them at least.
        share: 0 to 1, the least share of uncertain rigs that meet the limits; None: the nominal rig alone has to.
    """

    measure: Measure
    max: float | None = None
    min: float | None = None
    share: float | None = None

    def __post_init__(self) -> None:
        if self.max is None and self.min is None:
            raise InvalidInputError(
                f"{self.measure.name} has no limit", field="max", hint="Give max or min, or both."
            )
        for name in ("max", "min"):
            if (value := getattr(self, name)) is not None:
                object.__setattr__(self, name, checked_number(value, name))
        if self.max is not None and self.min is not None and self.min > self.max:
            raise InvalidInputError("min is above max", field="min", value=self.min, hint="Exchange them.")
        known = self.measured
        if known is not None and known.of == "step" and self.measure.where.steps == "together":
            raise InvalidInputError(
                f"{self.measure.name} is of one axis stepped alone", field="steps", hint="Leave it out."
            )
        if self.share is not None:
            object.__setattr__(self, "share", require_within(self.share, "share", "", 0.0, 1.0))
            if known is None:
                raise InvalidInputError(
                    f"{self.measure.name} is a share of the rigs itself", field="share", hint="Leave it out."
                )

    @property
    def measured(self) -> Measured | None:
        """The figure in the registry; None of a share of uncertain rigs."""
        return MEASURED.get(self.measure.name)

    @property
    def uncertain(self) -> bool:
        """Whether it is judged on uncertain rigs."""
        return self.share is not None or self.measure.name in SHARES

    @property
    def words(self) -> str:
        """What is judged: ``Settling time, pitch step``; and on which share of the rigs."""
        own = self.measure.words
        return own if self.share is None else f"{own}, on {_written(self.share)} of the rigs"

    @property
    def limit_text(self) -> str:
        """The limits: ``≤ 0.80 s``; where a figure's size counts, of both signs."""
        known = self.measured
        write = _written if known is None else known.limit_text
        low, high = (None if limit is None else write(limit) for limit in (self.min, self.max))
        return (
            f"± {high}" if known is not None and known.figure.signed and low is None else between(low, high)
        )

    def written(self, value: float | None) -> str:
        """A value of the figure as it is shown; words where there is none."""
        return self.measure.written(value)

    def meets(self, value: float | None) -> bool:
        """Whether one rig's value does; None, NaN and ±∞ are values that do not exist or have no limit."""
        known = self.measured
        if value is not None and isnan(value) and known is not None and known.unlimited:
            return (
                False  # `Many.values` says NaN where there is nothing, and infinity where there is no limit
            )
        own = None if value is None or not isfinite(value) else value
        if known is not None:
            return known.meets(own, self.min, self.max)
        if own is None:
            return False
        shown = _rounded_down(own)
        return not (
            (self.min is not None and shown < 100 * self.min - 1e-9)
            or (self.max is not None and shown > 100 * self.max + 1e-9)
        )

    def met(self, values: Floats) -> np.ndarray:
        """The same of many values, as `Many.values` gives them: bool, of the same shape."""
        return self.excess(values) == 0.0

    def excess(self, values: Floats) -> Floats:
        """By how much values miss the limits, as a share of the limit, 0 where they meet them; ∞ where none exists.

        A limit of 0 counts by the figure's own step that is worth telling apart.
        """
        value, known = np.asarray(values, dtype=float), self.measured
        unlimited = np.isinf(value) if known is not None else np.zeros(value.shape, dtype=bool)
        size = np.abs(value) if known is not None and known.figure.signed else value
        low, high = self.edges
        with np.errstate(invalid="ignore"):
            out = np.maximum((size - high) / self.scale(self.max), (low - size) / self.scale(self.min))
        # NaN compares as false: what does not exist is missed by more than anything
        out = np.where(np.isnan(value), inf, np.maximum(np.where(np.isnan(out), 0.0, out), 0.0))
        free = known is not None and known.unlimited and self.max is None
        return np.where(unlimited, 0.0 if free else inf, out)

    @cached_property
    def edges(self) -> tuple[float, float]:
        """The least and the largest float that meet the limits: rounding as shown lets a little more than these."""
        low = -inf if self.min is None else _edge(replace(self, max=None, share=None), self.min, -1.0)
        return low, inf if self.max is None else _edge(replace(self, min=None, share=None), self.max, 1.0)

    def scale(self, limit: float | None) -> float:
        """What missing a limit counts by: its size, of one near 0 the figure's own step."""
        known = self.measured
        least = 0.01 if known is None else known.figure.least or 1e-3
        return max(abs(limit or 0.0), least)

    def nearest_limit(self, value: float) -> float:
        """The limit that is nearer to a value."""
        limits = [limit for limit in (self.min, self.max) if limit is not None]
        return min(limits, key=lambda limit: abs(value - limit))

    def admitting(self, value: float) -> float:
        """The limit that a value, as it is shown, just meets; in the figure's unit."""
        known = self.measured
        if known is None:
            return _rounded_down(value) / 100.0
        shown = known.shown(value)
        if known.figure.notation == "decibel":
            return 10.0 ** (shown / 20.0)
        return shown / known.figure.scale

    def apart(self, stepped: Collection[str] = ("theta", "psi")) -> tuple[Requirement, ...]:
        """The same as requirements that the worse value decides: of each axis and motor where the better one does.

        That a rise takes at least 0.2 s on both axes is met where the quicker one takes as long; a figure of both
        tells of the slower one.

        Args:
            stepped: the axes that are stepped; of both, those count.
        """
        known, where = self.measured, self.measure.where
        if known is None:
            return (self,)
        worse = self.min if known.figure.better == "higher" else self.max
        if worse is not None and (self.max is None or self.min is None):
            return (self,)
        axes: Sequence[Axis | None] = (where.axis,)
        if known.may_have_axis and where.axis in (None, "both"):
            axes = [axis for axis in ("theta", "psi") if axis in stepped] or axes
        if known.of == "motor" and where.steps == "together":
            axes = (where.axis,)
        motors: Sequence[Motor | None] = (where.motor,)
        if known.may_have_motor and where.motor in (None, "both"):
            motors = ("V_p", "V_y")
        every = [replace(where, axis=axis, motor=motor) for axis in axes for motor in motors]
        return tuple(replace(self, measure=replace(self.measure, where=own)) for own in every)

    def told(self) -> dict[str, Any]:
        """Its object in a request, flat: what `requirements_of` reads under the figure's name."""
        where, known = self.measure.where, self.measured
        own: dict[str, Any] = {name: v for name in _LIMITS if (v := getattr(self, name)) is not None}
        if known is None:
            return own
        for name, allowed in _allowed(known).items():
            value = getattr(where, name)
            if allowed and value is not None:
                own[name] = value
        return own


def requirements_of(given: Mapping[str, Any]) -> tuple[Requirement, ...]:
    """The requirements of a request: by a figure's name an object, or several in a list.

    >>> [own.words for own in requirements_of({"overshoot": {"max": 5, "axis": "theta", "model": "linear"}})]
    ['Overshoot, pitch step, linear model']

    Args:
        given: per figure ``{"max", "min", "share", "axis", "motor", "model", "steps"}``; the axis is both, the motor
            both, the model nonlinear and the steps alone where they are left out.

    Raises:
        InvalidInputError: a figure or a limit is unknown or unusable; its field says which.
    """
    found: list[Requirement] = []
    for name, own in given.items():
        several = isinstance(own, Sequence) and not isinstance(own, str)
        for i, one in enumerate(own if several else (own,)):
            with within_field(f"{name}.{i}" if several else name):
                found.append(_requirement(name, one))
    if len(found) > MOST:
        raise InvalidInputError(f"these are more than {MOST} requirements", hint="Leave some out.")
    return tuple(found)


def told_requirements(requirements: Iterable[Requirement]) -> dict[str, Any]:
    """The object from which `requirements_of` makes them again."""
    found: dict[str, list[dict[str, Any]]] = {}
    for own in requirements:
        found.setdefault(own.measure.name, []).append(own.told())
    return {name: own[0] if len(own) == 1 else own for name, own in found.items()}


def measure_of(given: Mapping[str, Any] | str) -> Measure:
    """A measure of a request, flat, or by its name: ``{"measure": "settling_time", "axis": "theta"}``.

    Raises:
        InvalidInputError: it does not exist, or has no axis, motor or model where one is named.
    """
    own = {"measure": given} if isinstance(given, str) else given
    name = own.get("measure")
    if not isinstance(name, str):
        raise InvalidInputError(
            "no figure is named", field="measure", value=name, hint="Give its name: settling_time."
        )
    return _measure(name, {key: value for key, value in own.items() if key != "measure"}, "measure")


def told_measure(measure: Measure) -> dict[str, Any]:
    """The object from which `measure_of` makes it again."""
    known, where = MEASURED.get(measure.name), measure.where
    said = _allowed(known) if known is not None else {}
    own = {name: getattr(where, name) for name, allowed in said.items() if allowed}
    return {"measure": measure.name, **{name: value for name, value in own.items() if value is not None}}


def between(low: str | None, high: str | None) -> str:
    """Limits in words: ``≤ 0.80 s``, ``≥ 45°``, ``0.20 s to 0.40 s``."""
    if low is not None and high is not None:
        return f"{low} to {high}"
    return f"≤ {high}" if high is not None else f"≥ {low}"


def _requirement(name: str, given: Any) -> Requirement:
    if not isinstance(given, Mapping):
        raise InvalidInputError(
            f"the requirement is {given!r}, no object", value=given, hint='Write {"max": 0.8}.'
        )
    limits = {key: given[key] for key in _LIMITS if given.get(key) is not None}
    where = {key: value for key, value in given.items() if key not in _LIMITS}
    return Requirement(_measure(name, where, ""), **limits)


def _measure(name: str, where: Mapping[str, Any], field: str) -> Measure:
    known = MEASURED.get(name)
    if known is None and name not in SHARES:
        raise InvalidInputError(
            f"there is no figure {name!r}",
            field=field,
            value=name,
            hint="Known are " + ", ".join((*MEASURED, *SHARES)) + ".",
        )
    allowed = dict.fromkeys(_CHOICES, False) if known is None else _allowed(known)
    said: dict[str, Any] = {}
    for key, value in where.items():
        if value is None:
            continue
        if key not in allowed:
            raise InvalidInputError(
                f"there is no field {key}",
                field=key,
                value=value,
                hint="Known are " + ", ".join((*_CHOICES, *_LIMITS)) + ".",
            )
        if not allowed[key]:
            raise InvalidInputError(f"{name} has no {key}", field=key, value=value, hint="Leave it out.")
        if value not in (choices := get_args(_CHOICES[key])):
            raise InvalidInputError(
                f"{key} is {value!r}, which does not exist",
                field=key,
                value=value,
                hint="Known are " + ", ".join(choices) + ".",
            )
        said[key] = value
    if known is not None and known.has_axis:
        said.setdefault("axis", "both")
    return Measure(name, Where(**said))


def _allowed(known: Measured) -> dict[str, bool]:
    """What may be said of a figure's response."""
    return {
        "axis": known.may_have_axis,
        "motor": known.may_have_motor,
        "model": known.may_have_model,
        "steps": known.may_have_model,
    }


def _edge(limit: Requirement, at: float, way: float) -> float:
    """The last float in one direction that still meets a limit: what is shown rises with the value."""
    known = limit.measured
    step = 0.01 if known is None else 10.0 * max(abs(at), known.figure.least, 1e-3)
    # the limit itself may be shown as more than it is
    inner, outer = at - way * step, at + way * step
    if known is not None and known.figure.signed:
        inner, outer = max(inner, 0.0), max(outer, 0.0)
    if not limit.meets(inner) or limit.meets(outer):
        return at
    while (middle := 0.5 * (inner + outer)) not in (inner, outer):
        if limit.meets(middle):
            inner = middle
        else:
            outer = middle
    return inner


def _written(share: float) -> str:
    return percent(share) if 100 * share == round(100 * share) else f"{100 * share:.6g} %"


def _rounded_down(share: float) -> float:
    """In percent: 99.96 % are not all."""
    return floor(1000 * share + 1e-9) / 10
