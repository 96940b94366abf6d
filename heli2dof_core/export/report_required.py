"""The report's table of requirements: the page's verdict, on the rig's steps, each axis alone, and on the loop."""

from __future__ import annotations

from collections.abc import Mapping

from ..evaluate import Report
from ..figures import AXIS, LOOP, Figure
from ..figures.written import told
from ..metrics import NOT_SETTLED
from ..signals import OUTPUTS

REQUIRED = {figure.key or name: name for name, figure in {**AXIS, **LOOP}.items()}
"""What can be required: a figure's short name → its name."""
_SLACK = 1 + 1e-9
"""The page's: on the border is met."""


def required(report: Report, asked: Mapping[str, float]) -> list[tuple[str, ...]]:
    """A row for each figure that is asked for: title, limit, verdict on both steps, verdict on the loop."""
    rows = []
    for key, limit in asked.items():
        name = REQUIRED[key]
        of_loop = name in LOOP
        figure = LOOP[name] if of_loop else AXIS[name]
        sign = "≤" if figure.better == "lower" else "≥"
        verdicts = ("", "", _loop(report, name, limit)) if of_loop else (*_steps(report, name, limit), "")
        rows.append((figure.title, f"{sign} {told(figure, limit)}", *verdicts))
    return rows


def _loop(report: Report, name: str, limit: float) -> str:
    if not report.judged.stable:
        return "✕ unstable"
    value = getattr(report.judged, name)
    return f"{_mark(LOOP[name], value, limit)} {'unlimited' if value is None else told(LOOP[name], value)}"


def _steps(report: Report, name: str, limit: float) -> list[str]:
    figure, found = AXIS[name], []
    for signal in OUTPUTS:
        step = report.axis_steps.get(signal.name)
        own = None if step is None else step["nonlinear"].metrics.axes.get(signal.name)
        if own is None:
            found.append("not stepped")
            continue
        value = getattr(own, name)
        text = NOT_SETTLED if value is None else told(figure, value)
        found.append(f"{'✕' if value is None else _mark(figure, value, limit)} {text}")
    return found


def _mark(figure: Figure, value: float | None, limit: float) -> str:
    """Whether it is met; what is unlimited is."""
    if value is None:
        return "✓"
    return "✓" if (value <= limit * _SLACK if figure.better == "lower" else value >= limit / _SLACK) else "✕"
