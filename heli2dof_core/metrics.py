"""Step metrics of a response, with python-control's `step_info` names in snake case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .figures import AXIS, MOTOR, NO_AXIS_METRICS, STEP, AxisMetrics, MotorMetrics, axis_figures
from .kernels.layout import DEVIATION
from .signals import INPUTS, OUTPUTS
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
    return metrics_in(metrics_numbers(ends, rows, response.saturated))


Rows = Sequence[Sequence[float]]
Courses = tuple[Rows, Sequence[float], Rows]
"""Of both axes, of the course as a whole, and of both motors, laid out as `kernels.layout` says."""


Numbers = dict[str, Any]
"""The numbers of `StepMetrics`, what does not exist left out: by output, ``coupling_peak``, by input; as replies hold
them and remarks read them."""


def metrics_numbers(ends: Sequence[float], rows: Courses, saturated: Sequence[float]) -> Numbers:
    """Figures of merit of a course.

    Args:
        ends: references θ, ψ and start θ, ψ, rad.
        rows: as the kernels fill them.
        saturated: shares of time at both motors' limits.
    """
    axes, course, ((peak_p, effort_p), (peak_y, effort_y)) = rows
    theta, psi, theta_from, psi_from = ends
    motors = {
        "V_p": {"peak": peak_p, "saturated": saturated[0], "effort": effort_p},
        "V_y": {"peak": peak_y, "saturated": saturated[1], "effort": effort_y},
    }
    if theta == theta_from:
        if psi == psi_from:
            return motors
        return {"psi": axis_figures(axes[1]), "coupling_peak": course[DEVIATION], **motors}
    if psi == psi_from:
        return {"theta": axis_figures(axes[0]), "coupling_peak": course[DEVIATION + 1], **motors}
    return {"theta": axis_figures(axes[0]), "psi": axis_figures(axes[1]), **motors}


def metrics_in(numbers: Numbers) -> StepMetrics:
    """The numbers as objects."""
    axes = {
        signal.name: AxisMetrics(**NO_AXIS_METRICS | numbers[signal.name])
        for signal in OUTPUTS
        if signal.name in numbers
    }
    motors = {signal.name: MotorMetrics(**numbers[signal.name]) for signal in INPUTS}
    return StepMetrics(axes, numbers.get("coupling_peak"), motors)
