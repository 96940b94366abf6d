"""Step metrics of a response, with python-control's `step_info` names in snake case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

from .figures import AXIS, MOTOR, NO_AXIS_METRICS, STEP, AxisMetrics, MotorMetrics, axis_figures
from .kernels.layout import DEVIATION
from .signals import OUTPUTS
from .simulation.response import Measured, Response
from .tables import Shown, Table, number

NOT_SETTLED = "not settled"
"""What stands in place of a settling time where there is none within the window."""


@dataclass(frozen=True, repr=False)
class StepMetrics(Shown):
    """All metrics of one response.

    Attributes:
        axes: by output name, the axes that are stepped.
        coupling_peak: see `figures.STEP`; None unless one axis alone is stepped.
        motors: by input name.
    """

    axes: dict[str, AxisMetrics]
    coupling_peak: float | None
    motors: dict[str, MotorMetrics]

    def summary(self) -> str:
        """Settling and overshoot per axis, and the largest voltages."""
        axes = (
            f"{name}: {_settling(m)}, {AXIS['overshoot'].term} {number(m.overshoot, 3)} %"
            for name, m in self.axes.items()
        )
        motors = (f"|{name}| ≤ {number(m.peak, 3)} V" for name, m in self.motors.items())
        return "; ".join((*axes, ", ".join(motors)))

    def tables(self) -> tuple[Table, ...]:
        """A row per figure of merit, a column per axis; and the motors'."""
        axes = [
            (figure.head, *(_cell(m, name) for m in self.axes.values()))
            for name, figure in AXIS.items()
            if figure.notation != "flag"
        ]
        if self.coupling_peak is not None:
            axes.append((STEP["coupling_peak"].head, number(self.coupling_peak)))
        motors = (
            (figure.head, *(number(getattr(m, name)) for m in self.motors.values()))
            for name, figure in MOTOR.items()
        )
        return (
            *([Table.of("step", ("", *(_SYMBOLS[name] for name in self.axes)), axes)] if self.axes else []),
            Table.of("motors", ("", *self.motors), motors),
        )


def settling_words(axis: AxisMetrics) -> str:
    """The settling time, s, or that there is none."""
    return number(axis.settling_time) if axis.settled else NOT_SETTLED


def _settling(axis: AxisMetrics) -> str:
    return f"settling {number(axis.settling_time)} s" if axis.settled else NOT_SETTLED


def _cell(axis: AxisMetrics, name: str) -> str:
    return settling_words(axis) if name == "settling_time" else number(getattr(axis, name))


_SYMBOLS = {signal.name: signal.symbol for signal in OUTPUTS}


def step_metrics(response: Response, calm: Measured | None = None) -> StepMetrics:
    """Figures of merit of a response; axes whose reference equals their start are not stepped.

    They belong to the response: extrema and crossings are those of the exact solution or of the integrator's
    continuous output, whatever samples are drawn.

    Args:
        response: linear or nonlinear.
        calm: figures of the same experiment without its disturbance, whose steps' are taken in place of its own.
    """
    own = response.measured
    steps = calm or own
    ends = (*response.reference, *response.start)
    rows = (steps.axes.tolist(), steps.course.tolist(), own.motors.tolist())
    return metrics_in(metrics_numbers(ends, *rows, response.saturated))


class Numbers(NamedTuple):
    """The numbers of `StepMetrics`, what does not exist left out: as replies hold them and remarks read them."""

    axes: dict[str, dict[str, Any]]
    coupling_peak: float | None
    motors: dict[str, dict[str, float]]


def metrics_numbers(
    ends: Sequence[float],
    axes: Sequence[Sequence[float]],
    course: Sequence[float],
    motors: Sequence[Sequence[float]],
    saturated: Sequence[float],
) -> Numbers:
    """Figures of merit of a course as the kernels fill them (`kernels.layout`).

    Args:
        ends: references θ, ψ and start θ, ψ, rad.
        axes: of both axes.
        course: what else is known.
        motors: of both motors.
        saturated: shares of time at their limits.
    """
    pitch, yaw = ends[0] != ends[2], ends[1] != ends[3]
    own, coupling = {}, None
    if pitch:
        own["theta"] = axis_figures(axes[0])
    if yaw:
        own["psi"] = axis_figures(axes[1])
    if pitch is not yaw:
        coupling = course[DEVIATION + 1 if pitch else DEVIATION]
    (peak_p, effort_p), (peak_y, effort_y) = motors
    return Numbers(
        own,
        coupling,
        {
            "V_p": {"peak": peak_p, "saturated": saturated[0], "effort": effort_p},
            "V_y": {"peak": peak_y, "saturated": saturated[1], "effort": effort_y},
        },
    )


def metrics_in(numbers: Numbers) -> StepMetrics:
    """The numbers as objects."""
    axes = {name: AxisMetrics(**NO_AXIS_METRICS | own) for name, own in numbers.axes.items()}
    motors = {name: MotorMetrics(**own) for name, own in numbers.motors.items()}
    return StepMetrics(axes, numbers.coupling_peak, motors)
