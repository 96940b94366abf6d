"""Step metrics of a response, with python-control's `step_info` names in snake case."""

from __future__ import annotations

from dataclasses import dataclass

from .figures import AXIS, MOTOR, STEP, AxisMetrics, MotorMetrics
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
    stepped = [i for i in range(2) if response.reference[i] != response.start[i]]
    return StepMetrics(
        {OUTPUTS[i].name: AxisMetrics.of(steps.axes[i].tolist()) for i in stepped},
        float(steps.course[DEVIATION + 1 - stepped[0]]) if len(stepped) == 1 else None,
        {
            signal.name: MotorMetrics(peak, saturated, effort)
            for signal, saturated, (peak, effort) in zip(
                INPUTS, response.saturated, own.motors.tolist(), strict=True
            )
        },
    )
