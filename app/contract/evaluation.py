"""Everything that a design changes, at once: what the page asks for after a drag."""

from __future__ import annotations

from functools import lru_cache
from typing import Any, NamedTuple

import orjson
from pydantic import Field

from heli2dof_core import Report, Spec
from heli2dof_core.block import Rest, Task
from heli2dof_core.findings import merged
from heli2dof_core.request import LIMITS, poles_of

from .curves import Curves, curves_of, placed_curves
from .design import Gains, ObserverGains, gains_reply, model_reply, own_observer
from .encoding import framed
from .experiment import BothModels, OfLoop, StepRequest, loop_reply
from .fields import Whole, complex_number
from .frequency import LoopMargins, Rga, Sensitivity, margins_reply, relative_gains_reply, sensitivity_reply
from .model import (
    Complex,
    Finding,
    Model,
    Reply,
    Voltages,
    findings_reply,
    fixed,
    poles_reply,
    voltages_reply,
)
from .presets import Limits

LARGEST_SEQ = 2**53
POLES = 4


class EvaluateRequest(StepRequest):
    """As a step request; both models are computed."""

    each_axis: bool = Field(default=False, description="also step each axis of the reference alone")


class LiveRequest(EvaluateRequest):
    """An evaluate request with the number that its answer will carry."""

    seq: Whole = Field(ge=0, le=LARGEST_SEQ)


class Asked(NamedTuple):
    """What a live request asks for: its number, and an update."""

    seq: int
    task: Task


class LiveReader:
    """Reads one socket's requests.

    From one to the next of a drag the poles alone change: what else is said is judged again only where it differs
    from the request before.
    """

    def __init__(self) -> None:
        self._rest = b""
        self._split: Any = None
        self._task: Task | None = None

    def read(self, text: str | bytes) -> Asked:
        """What a message asks for.

        Raises:
            orjson.JSONDecodeError, pydantic.ValidationError, Heli2DofError: it is no request, or not a valid one.
        """
        data = orjson.loads(text)
        rest = b""
        if isinstance(data, dict):
            others = data.copy()
            seq, poles = others.pop("seq", None), others.pop("poles", None)
            rest = orjson.dumps(others)  # which tells true from 1 and 1 from 1.0
            if self._task is not None and rest == self._rest and type(seq) is int and 0 <= seq <= LARGEST_SEQ:
                values = _four_poles(poles)
                if values is not None:
                    return Asked(seq, self._task.with_poles(poles_of(values, self._split)))
        request = LiveRequest.model_validate(data)
        task = Task.of(request.to_spec(), each_axis=request.each_axis)
        self._rest, self._split, self._task = rest, request.split, task
        return Asked(request.seq, task)


def _four_poles(given: Any) -> list[complex] | None:
    """Poles as a request gives them; None where they are none, so that its schema says why."""
    if type(given) is not list or len(given) != POLES:
        return None
    try:
        return [complex_number(pole) for pole in given]
    except ValueError:
        return None


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


class _Fixed(NamedTuple):
    """What no pole changes of a reply."""

    model: Reply
    open_loop_poles: Any
    limits: Any
    trim: Any


@lru_cache(maxsize=64)
def _fixed(rest: Rest) -> _Fixed:
    spec = rest.spec
    own = spec.actuators if spec.place_rotors else None
    model = {name: fixed(value) for name, value in model_reply(rest.plant, own).items()}
    limits, trim = LIMITS.proposal(spec.limits), (spec.actuators or rest.plant).trim
    return _Fixed(
        model, fixed(poles_reply(rest.plant.poles)), fixed(limits), fixed(voltages_reply(trim.tolist()))
    )


def report_reply(report: Report, spec: Spec, curves: Curves | None = None) -> Reply:
    """Everything at once: what the page needs after a drag; `curves` are the block's arrays where left out."""
    loop, known, same = report.judged, report.known, _fixed(report.task.rest)
    common = loop_reply(loop)
    common["loop_poles"], common["trim"] = fixed(common["loop_poles"]), same.trim
    observer, unsolved = own_observer(spec, loop, lambda: report.design)
    known_reply = fixed(findings_reply(known))
    both = []
    for experiment, (of_linear, of_rig) in zip(report.experiments, curves or curves_of(report), strict=True):
        theta, psi = experiment.reference
        replies = []
        for course, drawn in ((experiment.linear, of_linear), (experiment.rig, of_rig)):
            found = course.findings
            replies.append(
                {
                    **common,
                    **drawn,
                    "reference": {"theta": theta, "psi": psi},
                    "metrics": course.metrics,
                    "findings": findings_reply(merged(known, found)) if found else known_reply,
                }
            )
        both.append({"linear": replies[0], "nonlinear": replies[1]})
    findings = merged(report.findings, unsolved) if unsolved else report.findings
    return {
        **common,
        "gains": gains_reply(loop, report.size, observer, report.placed_findings, same.model),
        "open_loop_poles": same.open_loop_poles,
        "rga": relative_gains_reply(report.placed_findings, report.interaction),
        "step": both[0],
        "axis_steps": dict(zip(report.alone, both[1:], strict=True)),
        "margins": margins_reply(report.motors),
        **sensitivity_reply(report.sensitivity),
        "limits": same.limits,
        "findings": findings_reply(findings),
    }


def report_frame(report: Report, spec: Spec, **own: Any) -> bytes:
    """The same as a binary frame, with what else is to stand in its header."""
    places, data = placed_curves(report)
    return framed(orjson.dumps({**own, **report_reply(report, spec, places)}), data)
