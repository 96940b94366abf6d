"""Every figure of merit under one name, read from a report: what goals require and questions ask for.

Names are those of the registry (`heli2dof_core.figures`), but for what is unclear by itself there: a motor's peak is
``V_peak``, the sensitivity's ``sensitivity_peak``, the design's relative gain ``lambda_11``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import isfinite, isinf
from types import MappingProxyType
from typing import Any, Literal

from .evaluate import Report
from .figures import AXIS, DESIGN, LOOP, MARGINS, MOTOR, SENSITIVITY, STEP, Figure
from .figures.written import in_shown_unit, percent, rounded, told
from .metrics import NOT_SETTLED
from .scenario import Model

Of = Literal["axis", "step", "motor", "margins", "sensitivity", "loop", "design"]
Axis = Literal["theta", "psi", "both"]
Motor = Literal["V_p", "V_y", "both"]
Steps = Literal["alone", "together"]
_AXES, _MOTORS = ("theta", "psi"), ("V_p", "V_y")
AXIS_WORDS = {"theta": "pitch", "psi": "yaw"}
MOTOR_WORDS = {"V_p": "pitch motor", "V_y": "yaw motor"}


@dataclass(frozen=True)
class Where:
    """Of which response a figure is meant.

    Attributes:
        axis: the axis that is stepped; both: the worse of them.
        motor: the motor; both: the worse of them.
        model: the rig's model of the response.
        steps: alone: each axis by itself; together: the scenario as it is set.
    """

    axis: Axis | None = None
    motor: Motor | None = None
    model: Model = "nonlinear"
    steps: Steps = "alone"


Read = Callable[[Report, Where], Sequence[float | None]]


@dataclass(frozen=True)
class Measured:
    """A figure, and how it is read.

    Attributes:
        name: in files.
        figure: of the registry.
        of: what it belongs to.
        own: its name in the registry of that kind.
        read: its values, several where both axes or motors are meant; None where there is none.
        unlimited: whether no value says that it has no limit.
        none: the words that stand where there is no value.
    """

    name: str
    figure: Figure
    of: Of
    own: str
    read: Read
    unlimited: bool = False
    none: str = "none"

    @property
    def has_axis(self) -> bool:
        """Whether an axis has to be named."""
        return self.of in ("axis", "step")

    @property
    def may_have_axis(self) -> bool:
        """Whether one may be."""
        return self.of in ("axis", "step", "motor")

    @property
    def may_have_motor(self) -> bool:
        """Whether a motor may be."""
        return self.of in ("motor", "margins")

    @property
    def may_have_model(self) -> bool:
        """Whether it is of a response."""
        return self.of in ("axis", "step", "motor")

    def words(self, where: Where) -> str:
        """What is judged: ``Settling time, pitch``."""
        parts = [
            self.figure.title if self.of != "motor" and self.figure.title else _heading(self.figure.term)
        ]
        if where.motor is not None:
            parts.append(MOTOR_WORDS.get(where.motor, "both motors"))
        elif self.may_have_motor:
            parts.append("both motors")
        if self.may_have_axis and where.steps == "together":
            parts.append(
                f"{AXIS_WORDS[where.axis]}, both stepped" if where.axis in AXIS_WORDS else "both stepped"
            )
        elif self.may_have_axis:
            axis = AXIS_WORDS.get(where.axis or "", "either")
            parts.append(f"{axis} step")
        if where.model == "linear":
            parts.append("linear model")
        return ", ".join(parts)

    def written(self, value: float | None) -> str:
        """A value as it is shown; words where there is none (None, NaN) or no limit.

        No limit is what infinity says, and None of a figure that may have none; NaN is no value of any figure.
        """
        if self.unlimited and (value is None or isinf(value)):
            return "unlimited"
        if value is None or not isfinite(value):
            return self.none
        if _is_share(self.figure):
            return percent(value)
        return told(self.figure, value) + (f" {self.figure.shown}" if self.figure.in_head else "")

    def shown(self, value: float) -> float:
        """The value as it is shown, a number in the unit that people read; its size where its sign says nothing."""
        if self.figure.signed:
            value = abs(value)
        if _is_share(self.figure):
            return 0.05 if 0 < value < 0.0005 else round(100 * value, 1 if value < 0.01 else 0)
        return rounded(self.figure, value)

    def limit_text(self, limit: float) -> str:
        """A limit as it was set, with more digits than a value where it has them."""
        shown = in_shown_unit(self.figure, limit)
        if abs(self.shown(limit) - shown) <= 1e-9 * max(1.0, abs(shown)):
            return self.written(limit)
        unit = {"seconds": "s", "decibel": "dB"}.get(
            self.figure.notation, self.figure.shown or self.figure.unit
        )
        return f"{shown:.6g}".replace("-", "−") + (unit if unit == "°" else f" {unit}".rstrip())

    def meets(self, value: float | None, low: float | None, high: float | None) -> bool:
        """Whether a value, as it is shown, lies within limits that are given in the figure's unit."""
        if value is None:
            return self.unlimited and high is None
        shown = self.shown(value)

        def slack(limit: float) -> float:
            return SLACK * max(1.0, abs(limit))

        if high is not None:
            limit = in_shown_unit(self.figure, high)
            if not shown <= limit + slack(limit):
                return False
        if low is not None:
            limit = in_shown_unit(self.figure, low)
            if not shown >= limit - slack(limit):
                return False
        return True


SLACK = 1e-9
"""Relative: on the border is met."""


def _is_share(figure: Figure) -> bool:
    return figure.shown == "%" and not figure.unit


def _heading(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}"


def stepped(report: Report) -> tuple[str, ...]:
    """The axes whose references are not where they rest: a step of nothing is none."""
    experiments = zip(report.alone, report.experiments[1:], strict=True)
    return tuple(axis for axis, own in experiments if own.steps[_AXES.index(axis)] != 0.0)


def metrics_of(report: Report, axis: str | None, where: Where) -> Mapping[str, Any] | None:
    """Figures of one course: of an axis stepped alone, or of the scenario; None where that axis is not stepped."""
    if where.steps == "together":
        n = 0
    elif axis in stepped(report):
        n = 1 + report.alone.index(axis)
    else:
        return None
    experiment = report.experiments[n]
    return (experiment.linear if where.model == "linear" else experiment.rig).metrics


def _axes(where: Where) -> tuple[str, ...]:
    return (where.axis,) if where.axis in _AXES else _AXES


def _motors(where: Where) -> tuple[str, ...]:
    return (where.motor,) if where.motor in _MOTORS else _MOTORS


def _of_axis(name: str) -> Read:
    def read(report: Report, where: Where) -> list[float | None]:
        found: list[float | None] = []
        for axis in _axes(where):
            own = (metrics_of(report, axis, where) or {}).get(axis)
            if own is not None or where.axis != "both":  # of both, those that are stepped
                found.append(None if own is None else own.get(name))
        return found

    return read


def _of_step(name: str) -> Read:
    def read(report: Report, where: Where) -> list[float | None]:
        axes = stepped(report) if where.axis == "both" else _axes(where)
        return [(metrics_of(report, axis, where) or {}).get(name) for axis in axes]

    return read


def _of_motor(name: str) -> Read:
    def read(report: Report, where: Where) -> list[float | None]:
        together = where.steps == "together"
        axes: Sequence[str | None] = [None] if together else [a for a in _axes(where) if a in stepped(report)]
        found: list[float | None] = []
        for axis in axes:
            own = metrics_of(report, axis, where)
            found += [None if own is None else own[motor][name] for motor in _motors(where)]
        return found

    return read


def _of_margins(name: str) -> Read:
    def read(report: Report, where: Where) -> list[float | None]:
        both = report.motors
        if both is None:
            return [None]
        return [both[_MOTORS.index(motor)].get(name) for motor in _motors(where)]

    return read


def _of_sensitivity(name: str) -> Read:
    def read(report: Report, _: Where) -> list[float | None]:
        own = report.sensitivity
        if own is None:
            return [None]
        if name in ("gain_low", "gain_high"):
            return [own.gain_range[name == "gain_high"]]
        return [getattr(own, name)]

    return read


def _of_design(name: str) -> Read:
    def read(report: Report, _: Where) -> list[float | None]:
        if name == "relative_gain":
            return [report.interaction.relative_gain]
        if name in ("pole_error", "pole_error_bound"):
            placed = report.placed
            if not placed.aims:
                return [None]
            return [placed.error if name == "pole_error" else placed.bound]
        return [getattr(report.size, name)]

    return read


_NAMES = {
    ("motor", "peak"): "V_peak",
    ("sensitivity", "peak"): "sensitivity_peak",
    ("design", "relative_gain"): "lambda_11",
}
_NAMES |= {("sensitivity", "peak_frequency"): "sensitivity_peak_frequency"}
_NAMES |= {("sensitivity", name): f"disk_{name}" for name in ("gain_low", "gain_high", "phase")}
NOT_REACHED = "not reached"
_NONE = {"settling_time": NOT_SETTLED, "rise_time": NOT_REACHED}


def _registry() -> Mapping[str, Measured]:
    found: dict[str, Measured] = {}
    kinds: Sequence[tuple[Of, Mapping[str, Figure], Callable[[str], Read]]] = (
        ("axis", AXIS, _of_axis),
        ("step", STEP, _of_step),
        ("motor", MOTOR, _of_motor),
        ("margins", MARGINS, _of_margins),
        ("sensitivity", SENSITIVITY, _of_sensitivity),
        ("loop", LOOP, lambda _: lambda report, _: [report.judged.lag_margin]),
        ("design", DESIGN, _of_design),
    )
    for of, figures, read in kinds:
        for own, figure in figures.items():
            if figure.notation == "flag":
                continue
            name = _NAMES.get((of, own), own)
            unlimited = figure.absent.startswith("where unlimited")
            found[name] = Measured(name, figure, of, own, read(own), unlimited, _NONE.get(name, "none"))
    return MappingProxyType(found)


MEASURED = _registry()
"""All that can be required or asked for, by name."""


def worst(
    measured: Measured, values: Sequence[float | None], low: float | None, high: float | None
) -> float | None:
    """Of several values the one that limits are judged by: the first that fails, or else the nearest to a limit."""
    failing = [v for v in values if not measured.meets(v, low, high)]
    if failing:
        return next((v for v in failing if v is None), None) if None in failing else _extreme(failing, high)
    present = [v for v in values if v is not None]
    return _extreme(present, high) if present else None


def worse(measured: Measured, values: Sequence[float | None]) -> float | None:
    """Of several values the least good one; None where there is none, or none that is limited."""
    known = [abs(v) if measured.figure.signed and len(values) > 1 else v for v in values if v is not None]
    if not known or (len(known) < len(values) and not measured.unlimited):
        return None
    return min(known) if measured.figure.better == "higher" else max(known)


def _extreme(values: Sequence[float | None], high: float | None) -> float | None:
    known = [v for v in values if v is not None]
    return max(known) if high is not None else min(known)
