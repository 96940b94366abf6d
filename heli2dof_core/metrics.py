"""Step metrics of a response, with python-control's `step_info` names in snake case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import isnan

import numpy as np

from .engine import engine
from .layout import AXIS_METRICS, MOTOR_METRICS
from .signals import INPUTS, OUTPUTS, Floats
from .simulation.response import Response
from .tables import Shown, Table, number


@dataclass(frozen=True)
class AxisMetrics:
    """How one stepped axis follows its reference; what does not happen within t is None.

    Attributes:
        rise_time: from 10 % to 90 % of the step, s.
        settling_time: after it the axis stays within 2 % of the step around the reference, s.
        overshoot: largest excess beyond the reference, % of the step.
        peak: angle of the largest deviation from the start, rad.
        peak_time: when, s.
        steady_state_error: reference minus the last value, rad.
        iae: integral of the absolute error over t, ∫ |e| dt, rad·s.
        itae: the same weighted with time, ∫ t |e| dt, rad·s² (Graham & Lathrop, Trans. AIEE 72 (1953) 273).
    """

    rise_time: float | None
    settling_time: float | None
    overshoot: float
    peak: float
    peak_time: float
    steady_state_error: float
    iae: float
    itae: float

    @classmethod
    def of(cls, numbers: list[float]) -> AxisMetrics:
        """From the kernel's row, in this order; NaN is what did not happen."""
        rise, settling, *others = numbers
        return cls(None if isnan(rise) else rise, None if isnan(settling) else settling, *others)


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
            f"{name}: settling {number(m.settling_time)} s, overshoot {number(m.overshoot, 3)} %"
            for name, m in self.axes.items()
        )
        motors = (f"|{name}| ≤ {number(m.peak, 3)} V" for name, m in self.motors.items())
        return "; ".join((*axes, ", ".join(motors)))

    def tables(self) -> tuple[Table, ...]:
        """A row per figure of merit, a column per axis; and the motors'."""
        axes = [
            (f"{label} ({unit})", *(number(getattr(m, name)) for m in self.axes.values()))
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


_SYMBOLS = {signal.name: signal.symbol for signal in OUTPUTS}
_AXIS_ROWS = (
    ("rise_time", "rise time", "s"),
    ("settling_time", "settling time", "s"),
    ("overshoot", "overshoot", "%"),
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


def step_metrics(response: Response, trim: Floats) -> StepMetrics:
    """Metrics of a response; axes whose reference equals their start are not stepped.

    Args:
        response: linear or nonlinear.
        trim: the voltages that count as rest, shape (2,), V; zeros where they are deviations already.
    """
    angles, voltages = np.ascontiguousarray(response.angles), np.ascontiguousarray(response.voltages)
    axes, motors = np.empty((2, AXIS_METRICS)), np.empty((2, MOTOR_METRICS))
    ends = response.start, response.reference
    deviations = engine().measure(response.t, angles, voltages, *ends, np.array(trim), axes, motors)
    return measured(response, deviations, axes, motors)


def measured(response: Response, deviations: Sequence[float], axes: Floats, motors: Floats) -> StepMetrics:
    """What the kernel `measure` has found, by name."""
    stepped = [i for i in range(2) if response.reference[i] != response.start[i]]
    return StepMetrics(
        {OUTPUTS[i].name: AxisMetrics.of(axes[i].tolist()) for i in stepped},
        float(deviations[1 - stepped[0]]) if len(stepped) == 1 else None,
        {
            signal.name: MotorMetrics(peak, saturated, effort)
            for signal, saturated, (peak, effort) in zip(
                INPUTS, response.saturated, motors.tolist(), strict=True
            )
        },
    )
