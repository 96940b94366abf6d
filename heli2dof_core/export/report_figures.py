"""The report's figures of merit: the page's own rows, names, units and digits, each axis stepped alone."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from math import degrees, floor, log10

import numpy as np

from ..evaluate import Report, Step
from ..margins import Margins
from ..metrics import NOT_SETTLED, AxisMetrics
from ..scenario import Model
from ..signals import AXES, OUTPUTS, Floats
from .markup import paragraph, table

DASH = "–"


def fixed(value: float | None, decimals: int = 2) -> str:
    """Fixed decimals with a true minus sign, never a negative zero."""
    if value is None:
        return DASH
    text = f"{value:.{decimals}f}"
    return text.lstrip("-") if float(text) == 0 else text.replace("-", "−")


def significant(value: float | None, digits: int = 4) -> str:
    """About `digits` significant digits, with an exponent only from 1e6 on and below 1e-4."""
    if value is None:
        return DASH
    size = abs(value)
    if size and (size >= 1e6 or size < 1e-4):
        mantissa, exponent = f"{value:.{max(0, digits - 2)}e}".split("e")
        return f"{mantissa}e{int(exponent)}".replace("-", "−")
    whole = floor(log10(size)) + 1 if size >= 1 else 1
    return fixed(value, max(0, digits - whole))


def seconds(value: float | None) -> str:
    """Seconds with two decimals; milliseconds below 0.1 s, with one decimal below 10 ms."""
    if value is None:
        return DASH
    return f"{fixed(1e3 * value, 1 if value < 0.01 else 0)} ms" if value < 0.1 else f"{fixed(value)} s"


def angle(value: float | None, decimals: int = 1) -> str:
    """An angle given in rad, in degrees."""
    return DASH if value is None else f"{fixed(degrees(value), decimals)}°"


def percent(share: float) -> str:
    """A share, in percent; below one percent with a decimal."""
    return f"{fixed(100 * share, 1 if share < 0.01 else 0)} %"


def decibel(ratio: float | None) -> str:
    """A ratio in decibels."""
    return DASH if ratio is None or ratio <= 0 else f"{fixed(20 * log10(ratio), 1)} dB"


@dataclass(frozen=True)
class Row:
    """One figure of an axis' step by one model; `text` gets the step, its axis' metrics and the trim voltages."""

    name: str
    text: Callable[[Step, AxisMetrics, Floats], str]


def _angle_time(value: float) -> str:
    return significant(degrees(value), 3)


def _coupling(step: Step) -> str:
    return angle(step.metrics.coupling_peak, 2)


def _peak(motor: int) -> Callable[[Step, AxisMetrics, Floats], str]:
    def told(step: Step, _: AxisMetrics, trim: Floats) -> str:
        name, response = ("V_p", "V_y")[motor], step.response
        if response.model == "linear":
            return f"{fixed(float(np.max(np.abs(response.voltages[motor] + trim[motor]))), 1)} V"
        own = step.metrics.motors[name]
        return f"limit {percent(own.saturated)}" if own.saturated > 0 else f"{fixed(own.peak, 1)} V"

    return told


def _effort(motor: str) -> Callable[[Step, AxisMetrics, Floats], str]:
    return lambda step, _, __: significant(step.metrics.motors[motor].effort, 3)


ROWS = (
    Row("Rise time", lambda _, m, __: seconds(m.rise_time)),
    Row("Settling time", lambda _, m, __: seconds(m.settling_time) if m.settled else NOT_SETTLED),
    Row("Overshoot", lambda _, m, __: f"{fixed(m.overshoot, 1)} %"),
    Row("Undershoot", lambda _, m, __: f"{fixed(m.undershoot, 1)} %"),
    Row("Error at the end", lambda _, m, __: angle(m.steady_state_error, 2)),
    Row("Other axis moves", lambda step, _, __: _coupling(step)),
    Row("IAE, °s", lambda _, m, __: _angle_time(m.iae)),
    Row("ITAE, °s²", lambda _, m, __: _angle_time(m.itae)),
    Row("V_p peak", _peak(0)),
    Row("V_p effort, V²s", _effort("V_p")),
    Row("V_y peak", _peak(1)),
    Row("V_y effort, V²s", _effort("V_y")),
)
"""Rows of the page's table, in its order; the linear model's motors have no limits."""


def merit(report: Report) -> Iterator[str]:
    """The table of both steps, each by the rig and by the linear model, and the margins."""
    trim, columns = report.design.plant.trim, []
    for axis, signal in zip(AXES, OUTPUTS, strict=True):
        both = report.axis_steps.get(signal.name)
        models: tuple[tuple[Model, str], ...] = (("nonlinear", f"{axis} step"), ("linear", "(linear)"))
        for model, label in models:
            step = None if both is None else both[model]
            own = None if step is None else step.metrics.axes.get(signal.name)
            columns.append(
                (label, [DASH if step is None or own is None else row.text(step, own, trim) for row in ROWS])
            )
    rows = [(row.name, *(cells[i] for _, cells in columns)) for i, row in enumerate(ROWS)]
    yield table(("", *(label for label, _ in columns)), rows)
    yield paragraph(
        "Each axis is stepped alone. Settling: within 2 % of the step. Peak voltages include the trim; “limit” is "
        "the share of time at the voltage limit. Effort: ∫ (V − V_trim)² dt.",
        "about",
    )
    yield from _margins(report)


def _margins(report: Report) -> Iterator[str]:
    if report.margins is None or report.sensitivity is None:
        yield paragraph("The whole loop is unstable: it has no margins.")
        return

    def gain_and_phase(m: Margins) -> str:
        if m.gain_margin is None and m.phase_margin is None:
            return DASH
        return f"{'∞' if m.gain_margin is None else decibel(m.gain_margin)} · {angle(m.phase_margin, 0)}"

    rows = [
        ("Gain · phase margin", *(gain_and_phase(m) for m in report.margins)),
        ("Delay margin", *(seconds(m.delay_margin) for m in report.margins)),
    ]
    yield table(("", "pitch motor", "yaw motor"), rows, "Margins at each motor, the other loop closed")
    s = report.sensitivity
    low, high = s.gain_range
    phase = angle(s.phase, 0)
    peak = fixed(s.peak) if s.peak < 1.005 else f"{fixed(s.peak)} at {significant(s.peak_frequency, 3)} rad/s"
    yield paragraph(
        f"Both motors at once. Disk margin: {fixed(s.disk_margin)}: × {fixed(low)} to "
        f"{'∞' if high is None else fixed(high)}, ± {phase}. Sensitivity peak: {peak}."
    )
