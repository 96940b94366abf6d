"""The report's table of pinned designs, each by the figures that tell it from the others."""

from __future__ import annotations

from collections.abc import Sequence

from ..errors import Heli2DofError
from ..evaluate import Report, evaluate
from ..figures import AXIS
from ..figures.written import DASH, fixed, told
from ..metrics import NOT_SETTLED
from ..placement.registry import METHODS
from ..signals import INPUTS, OUTPUTS
from ..spec import Spec
from .format import Pins
from .machine import poles_in_words

__all__ = ["Pins", "pinned"]

_HEAD = (
    "",
    "method",
    "poles, rad/s",
    "settling, pitch · yaw",
    "overshoot, pitch · yaw",
    "largest V_p · V_y",
    "‖K‖",
)


def pinned(pins: Pins) -> tuple[Sequence[str], list[tuple[str, ...]]] | None:
    """Head and rows; None without pins."""
    return (_HEAD, [_row(name, spec) for name, spec in pins]) if pins else None


def _row(name: str, spec: Spec) -> tuple[str, ...]:
    try:
        report = evaluate(spec, each_axis=True)
    except Heli2DofError as error:
        return (name, METHODS[spec.method].title, str(error), *[DASH] * 4)
    design = report.design
    poles = poles_in_words(design.closed_loop_poles.tolist()).replace("-", "−")
    loops = "" if spec.outer.outer == "none" else ", PI loops"
    return (
        name,
        METHODS[spec.method].title + loops,
        poles,
        *(["unstable", DASH, DASH] if not report.loop.stable else _response(report)),
        told_norm(design.norm),
    )


def told_norm(norm: float) -> str:
    """The gain's norm, as short as a table wants it."""
    return fixed(norm, 1)


def _response(report: Report) -> list[str]:
    settling, overshoot = [], []
    for signal in OUTPUTS:
        step = report.axis_steps.get(signal.name)
        own = None if step is None else step["nonlinear"].metrics.axes.get(signal.name)
        settled = own is None or own.settled
        settling.append(
            told(AXIS["settling_time"], None if own is None else own.settling_time)
            if settled
            else NOT_SETTLED
        )
        overshoot.append(told(AXIS["overshoot"], None if own is None else own.overshoot))
    peaks = [
        max(
            (step["nonlinear"].metrics.motors[signal.name].peak for step in report.axis_steps.values()),
            default=None,
        )
        for signal in INPUTS
    ]
    volts = [DASH if peak is None else f"{fixed(peak, 1)} V" for peak in peaks]
    return [" · ".join(settling), " · ".join(overshoot), " · ".join(volts)]
