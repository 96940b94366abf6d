"""Everything that a design changes, at once: what the page asks for after a drag."""

from __future__ import annotations

from pydantic import Field

from heli2dof_core import Report, Spec
from heli2dof_core.findings import merged
from heli2dof_core.request import (
    LIMITS,
)

from .design import Gains, ObserverGains, gains_reply, own_observer
from .experiment import BothModels, OfLoop, StepRequest, loop_reply, step_reply
from .fields import Whole
from .frequency import LoopMargins, Rga, Sensitivity, margins_reply, rga_reply, sensitivity_reply
from .model import Complex, Finding, Model, Reply, Voltages, findings_reply, poles_reply
from .presets import Limits


class EvaluateRequest(StepRequest):
    """As a step request; both models are computed."""

    each_axis: bool = Field(default=False, description="also step each axis of the reference alone")


class LiveRequest(EvaluateRequest):
    """An evaluate request with the number that its answer will carry."""

    seq: Whole = Field(ge=0, le=2**53)


class AxisSteps(Model):
    """Each axis of the reference stepped alone."""

    theta: BothModels | None = None
    psi: BothModels | None = None


class Evaluation(OfLoop):
    """Gains, RGA, responses and margins at once."""

    seq: int | None = Field(None, description="the live request's number")
    gains: Gains
    open_loop_poles: list[Complex]
    rga: Rga
    step: BothModels
    axis_steps: AxisSteps
    margins: LoopMargins
    sensitivity: Sensitivity | None = None
    loop_poles: list[Complex]
    observer: ObserverGains | None = None
    stable: bool
    trim: Voltages
    limits: Limits
    findings: list[Finding]


def report_reply(report: Report, spec: Spec) -> Reply:
    """Everything at once: what the page needs after a drag."""
    loop, common = report.loop, loop_reply(report.loop)
    observer, unsolved = own_observer(spec, report.design, loop)
    return {
        **common,
        "gains": gains_reply(
            report.design,
            loop.lag_margin,
            observer,
        ),
        "open_loop_poles": poles_reply(report.design.plant.poles),
        "rga": rga_reply(report.design, report.interaction),
        "step": {model: step_reply(step, loop, common) for model, step in report.step.items()},
        "axis_steps": {
            axis: {model: step_reply(step, loop, common) for model, step in steps.items()}
            for axis, steps in report.axis_steps.items()
        },
        "margins": margins_reply(report.margins),
        **sensitivity_reply(report.sensitivity),
        "limits": LIMITS.proposal(spec.limits),
        "findings": findings_reply(merged(report.findings, unsolved)),
    }
