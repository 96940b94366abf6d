"""Several methods or splits of the poles side by side: what is asked and what is replied."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from heli2dof_core.comparison import Comparison as CoreComparison
from heli2dof_core.comparison import Row, Tuning
from heli2dof_core.comparison import Split as CoreSplit
from heli2dof_core.figures import DESIGN
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.scenario import Outer

from .design import Gains, Loops, gains_reply, loops_reply
from .experiment import Metrics, StepRequest
from .frequency import LoopMargins, Rga, Sensitivity, margins_reply, relative_gains_reply, sensitivity_reply
from .model import Complex, Model, Reply, findings_reply, parts_of, poles_reply, reply_of
from .problems import problem_of


class CompareRequest(StepRequest):
    """A design, an experiment, and the methods to compare."""

    methods: list[Annotated[str, Field(json_schema_extra={"enum": [*METHODS]})]] | None = Field(
        default=None, max_length=len(METHODS), description="all by default"
    )
    tuning: Tuning = Field(
        default="kept",
        description="of the outer loops: kept, the request's own for all; placed, none; tuned, each method's own by "
        "one rule, that of POST /api/v1/suggest",
    )


class Unavailable(Model):
    """Why a method has no result here."""

    code: str
    detail: str
    hint: str | None = None


class AxisMetricsAlone(Model):
    """Metrics of each axis stepped alone."""

    theta: Metrics | None = None
    psi: Metrics | None = None


_LEFT_OUT = ("A", "B", "controllability_indices", "dominance", "frequencies", "rga_magnitude")
"""Of a design's gains and RGA: what does not depend on the method, and what is asked for alone."""


class ComparisonRow(parts_of(Gains, Rga, without=_LEFT_OUT)):
    """One method's result, or why there is none; structures are full-rank's alone."""

    method: str
    title: str
    coupling: str | None = None
    lead: str | None = None
    unavailable: Unavailable | None = None
    metrics: Metrics | None = None
    axis_metrics: AxisMetricsAlone | None = None
    margins: LoopMargins | None = None
    sensitivity: Sensitivity | None = None
    loop_poles: list[Complex] | None = None
    stable: bool | None = None
    outer: Outer | None = Field(None, description="pi, or none")
    loops: Loops | None = Field(None, description="the PI values around this method, where there are any")


class Comparison(Model):
    """All methods side by side, and what becomes of the paper's claim of lower gains."""

    rows: list[ComparisonRow]
    claim: str
    tuning: Tuning
    rule: str = Field(description="under which outer loops the methods are compared, in words")


class Split(Model):
    """One way to deal the poles: positions of pitch's pair and of yaw's, and what it gives."""

    split: list[list[int]] = Field(description="positions from 0 of pitch's pair and of yaw's")
    poles: list[Complex]
    K: list[list[float]] = Field(description="V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y")
    norm: float = Field(description=DESIGN["norm"].described)
    pole_error: float = Field(description=DESIGN["pole_error"].measured)
    rga: list[list[float]] | None = Field(None, description="RGA at s = 0; rows θ, ψ, columns V_p, V_y")


def comparison_reply(comparison: CoreComparison) -> Reply:
    """One row per method and structure, and what becomes of the paper's claim."""
    return {
        "rows": [_row(row) for row in comparison.rows],
        "claim": comparison.claim,
        "tuning": comparison.tuning,
        "rule": comparison.rule,
    }


def _row(row: Row) -> Reply:
    reply: Reply = {"method": row.method, "title": METHODS[row.method].title}
    if row.structure is not None:
        reply |= {"coupling": row.structure.coupling, "lead": row.structure.lead}
    if row.unavailable is not None:
        refused = problem_of(row.unavailable)
        reply["unavailable"] = {key: refused[key] for key in ("code", "detail", "hint") if key in refused}
    report, outer = row.report, row.outer
    if report is None or outer is None:
        return reply
    reply["outer"] = outer.outer
    if outer.outer == "pi" and not METHODS[row.method].integrates:
        reply["loops"] = loops_reply(outer)
    rga = relative_gains_reply(report.placed_findings, report.interaction)
    gains = gains_reply(report.judged, report.size, {}, report.placed_findings)
    scenario, *alone = report.experiments
    return {
        **reply,
        **{key: value for key, value in (gains | rga).items() if key not in _LEFT_OUT},
        "metrics": scenario.rig.metrics,
        "axis_metrics": {axis: each.rig.metrics for axis, each in zip(report.alone, alone, strict=True)},
        "margins": margins_reply(report.motors),
        **sensitivity_reply(report.sensitivity),
        "loop_poles": poles_reply(report.judged.poles),
        "stable": report.judged.stable,
        "findings": findings_reply(report.findings),
    }


def splits_reply(splits: tuple[CoreSplit, ...]) -> list[Reply]:
    """Every way to deal the poles, with its gain and relative gains."""
    return [
        reply_of(
            Split,
            split.design,
            split=split.pairs,
            poles=split.design.poles.values,
            rga=split.interaction.rga,
        )
        for split in splits
    ]
