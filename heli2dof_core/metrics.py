"""Step metrics of a response, with python-control's `step_info` names in snake case."""

from __future__ import annotations

from dataclasses import dataclass
from math import isnan

from .kernels.layout import DEVIATION
from .signals import INPUTS, OUTPUTS
from .simulation.response import Response
from .tables import Shown, Table, number

NOT_SETTLED = "not settled"
"""What stands in place of a settling time where there is none within the window."""


@dataclass(frozen=True)
class AxisMetrics:
    """How one stepped axis follows its reference; what does not happen within the window is None.

    Attributes:
        rise_time: from 10 % to 90 % of the step, s.
        settling_time: after it the axis stays within 2 % of the step around the reference, s; None unless `settled`.
        settled: the axis is within that band at the end of the window and stays there. A crossing shortly before
            the end does not count: the course is followed beyond it, for ten periods or six time constants of every
            pole where it is linear, for one period of the slowest pole, at most the window's length, where it is not.
        overshoot: largest excess beyond the reference, % of the step.
        undershoot: largest excursion from the start away from the reference, % of the step.
        peak: angle of the largest deviation from the start, rad.
        peak_time: when, s; None where nothing overshoots, or the window ends on the peak: the axis still moves
            outwards then, or creeps towards a value beyond the reference.
        steady_state_error: reference minus the last value, rad.
        iae: integral of the absolute error over the window, ∫ |e| dt, rad·s.
        itae: the same weighted with time, ∫ t |e| dt, rad·s² (Graham & Lathrop, Trans. AIEE 72 (1953) 273).
    """

    rise_time: float | None
    settling_time: float | None
    settled: bool
    overshoot: float
    undershoot: float
    peak: float
    peak_time: float | None
    steady_state_error: float
    iae: float
    itae: float

    @classmethod
    def of(cls, numbers: list[float]) -> AxisMetrics:
        """From the kernels' row, laid out as `layout` says; NaN is what did not happen."""
        rise, settling, over, under, peak, at, error, iae, itae, settled = (
            None if isnan(number) else number for number in numbers
        )
        return cls(rise, settling, bool(settled), over, under, peak, at, error, iae, itae)  # type: ignore[arg-type]


@dataclass(frozen=True)
class MotorMetrics:
    """What one motor has to do.

    Attributes:
        peak: its largest |voltage|, V.
        saturated: share of time at its limit.
        effort: ∫ (V − V_trim)² dt, V²·s: what the control costs beyond holding still.
    """

    peak: float
    saturated: float
    effort: float


@dataclass(frozen=True, repr=False)
class StepMetrics(Shown):
    """All metrics of one response.

    Attributes:
        axes: by output name, the axes that are stepped.
        coupling_peak: largest deviation of the other axis where one alone is stepped, rad.
        motors: by input name.
    """

    axes: dict[str, AxisMetrics]
    coupling_peak: float | None
    motors: dict[str, MotorMetrics]

    def summary(self) -> str:
        """Settling and overshoot per axis, and the largest voltages."""
        axes = (
            f"{name}: {_settling(m)}, overshoot {number(m.overshoot, 3)} %" for name, m in self.axes.items()
        )
        motors = (f"|{name}| ≤ {number(m.peak, 3)} V" for name, m in self.motors.items())
        return "; ".join((*axes, ", ".join(motors)))

    def tables(self) -> tuple[Table, ...]:
        """A row per figure of merit, a column per axis; and the motors'."""
        axes = [
            (f"{label} ({unit})", *(_cell(m, name) for m in self.axes.values()))
            for name, label, unit in _AXIS_ROWS
        ]
        if self.coupling_peak is not None:
            axes.append(("peak of the other axis (rad)", number(self.coupling_peak)))
        motors = (
            (
                f"{label} ({unit})" if unit else label,
                *(number(getattr(m, name)) for m in self.motors.values()),
            )
            for name, label, unit in _MOTOR_ROWS
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
_AXIS_ROWS = (
    ("rise_time", "rise time", "s"),
    ("settling_time", "settling time", "s"),
    ("overshoot", "overshoot", "%"),
    ("undershoot", "undershoot", "%"),
    ("peak", "peak", "rad"),
    ("peak_time", "peak time", "s"),
    ("steady_state_error", "steady-state error", "rad"),
    ("iae", "IAE", "rad·s"),
    ("itae", "ITAE", "rad·s²"),
)
_MOTOR_ROWS = (
    ("peak", "largest |voltage|", "V"),
    ("saturated", "share of time at the limit", ""),
    ("effort", "effort", "V²·s"),
)


def step_metrics(response: Response, calm: Response | None = None) -> StepMetrics:
    """Figures of merit of a response; axes whose reference equals their start are not stepped.

    They belong to the response: extrema and crossings are those of the exact solution or of the integrator's
    continuous output, whatever samples are drawn.

    Args:
        response: linear or nonlinear.
        calm: the same experiment without its disturbance, whose steps' figures are taken in place of its own.
    """
    steps, own = (calm or response).measured, response.measured
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
