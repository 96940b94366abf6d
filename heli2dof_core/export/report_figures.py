"""The report's figures of merit: the page's own rows, names, units and digits, each axis stepped alone."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..evaluate import Report, Step
from ..figures import AXIS, MARGINS, MOTOR, RESPONSE, SENSITIVITY, STEP, AxisMetrics, Margins
from ..figures.written import DASH, percent, told
from ..metrics import NOT_SETTLED
from ..scenario import Model
from ..signals import AXES, INPUTS, OUTPUTS


@dataclass(frozen=True)
class Row:
    """One figure of an axis' step by one model; `text` gets the step and its axis' metrics."""

    name: str
    text: Callable[[Step, AxisMetrics], str]


def _response(name: str) -> Row:
    """The row of an axis' figure, or of its step's."""
    if name in STEP:
        return Row(STEP[name].titled, lambda step, _: told(STEP[name], getattr(step.metrics, name)))

    def text(_: Step, own: AxisMetrics) -> str:
        if name == "settling_time" and not own.settled:
            return NOT_SETTLED
        return told(AXIS[name], getattr(own, name))

    return Row(AXIS[name].titled, text)


def _motor(motor: int, name: str) -> Row:
    """The row of a motor's figure."""
    symbol, figure = INPUTS[motor].name, MOTOR[name]

    def text(step: Step, _: AxisMetrics) -> str:
        own = step.metrics.motors[symbol]
        if name != "peak":
            return told(figure, getattr(own, name))
        return f"limit {percent(own.saturated)}" if own.saturated > 0 else told(figure, own.peak)

    return Row(f"{symbol} {figure.titled}", text)


ROWS = (
    *map(_response, RESPONSE),
    *(_motor(motor, name) for motor in range(2) for name, figure in MOTOR.items() if figure.title),
)
"""Rows of the page's table, in its order; the linear model's motors have no limits."""


def merit(report: Report) -> tuple[list[str], list[tuple[str, ...]]]:
    """Head and rows of the table of both steps, each by the rig and by the linear model."""
    columns = []
    for axis, signal in zip(AXES, OUTPUTS, strict=True):
        both = report.axis_steps.get(signal.name)
        models: tuple[tuple[Model, str], ...] = (("nonlinear", f"{axis} step"), ("linear", "(linear)"))
        for model, label in models:
            step = None if both is None else both[model]
            own = None if step is None else step.metrics.axes.get(signal.name)
            columns.append(
                (label, [DASH if step is None or own is None else row.text(step, own) for row in ROWS])
            )
    rows = [(row.name, *(cells[i] for _, cells in columns)) for i, row in enumerate(ROWS)]
    return ["", *(label for label, _ in columns)], rows


def margins(report: Report) -> dict[str, Any] | None:
    """Rows of the margins' table, and the words on both motors at once; None where the loop has no margins."""
    if report.margins is None or report.sensitivity is None:
        return None

    def gain_and_phase(m: Margins) -> str:
        if m.gain_margin is None and m.phase_margin is None:
            return DASH
        gain = "∞" if m.gain_margin is None else told(MARGINS["gain_margin"], m.gain_margin)
        return f"{gain} · {told(MARGINS['phase_margin'], m.phase_margin)}"

    delay = MARGINS["delay_margin"]
    rows = [
        ("Gain · phase margin", *(gain_and_phase(m) for m in report.margins)),
        (delay.title, *(told(delay, m.delay_margin) for m in report.margins)),
    ]
    s = report.sensitivity
    low, high = s.gain_range
    of = SENSITIVITY
    peak = told(of["peak"], s.peak)
    if s.peak >= 1.005:
        peak = f"{peak} at {told(of['peak_frequency'], s.peak_frequency)}"
    both = (
        f"Both motors at once. {of['disk_margin'].title}: {told(of['disk_margin'], s.disk_margin)}: "
        f"× {told(of['gain_low'], low)} to {'∞' if high is None else told(of['gain_high'], high)}, "
        f"± {told(of['phase'], s.phase)}. {of['peak'].title}: {peak}."
    )
    return {"rows": rows, "both": both}
