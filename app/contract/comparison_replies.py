"""Replies about several designs or methods, and about systems other than the rig."""

from __future__ import annotations

from importlib.util import find_spec
from typing import get_args

from heli2dof_core.comparison import Comparison, Row, Split
from heli2dof_core.couplings import Coupling, Lead
from heli2dof_core.placement.assess import Assessment
from heli2dof_core.placement.method import Method
from heli2dof_core.placement.registry import METHODS

from . import comparison_models as models
from .problems import problem_of
from .replies import (
    Reply,
    findings_reply,
    gains_reply,
    margins_reply,
    metrics_reply,
    poles_reply,
    reply_of,
    rga_reply,
    sensitivity_reply,
)


def methods_reply() -> list[Reply]:
    """All placement methods; structures apply to full-rank placement alone."""
    return [_method(method) for method in METHODS.values()]


def assessment_reply(result: Assessment) -> Reply:
    """A placement of any system."""
    placement = result.placement
    return reply_of(
        models.Placement,
        result,
        K=placement.K,
        integral=placement.integral,
        pole_error_bound=None if result.pole_error is None else result.pole_error_bound,
        **placement.construction(),
    )


def comparison_reply(comparison: Comparison) -> Reply:
    """One row per method and structure, and what becomes of the paper's claim."""
    return {"rows": [_row(row) for row in comparison.rows], "claim": comparison.claim}


def splits_reply(splits: tuple[Split, ...]) -> list[Reply]:
    """Every way to deal the poles, with its gain and relative gains."""
    return [
        reply_of(
            models.Split,
            split.design,
            split=split.pairs,
            poles=split.design.poles.values,
            rga=split.interaction.rga,
        )
        for split in splits
    ]


def _method(method: Method) -> Reply:
    return reply_of(
        models.Method,
        method,
        available=method.needs is None or find_spec(method.needs) is not None,
        couplings=get_args(Coupling) if method.structured else (),
        leads=get_args(Lead) if method.structured else (),
    )


def _row(row: Row) -> Reply:
    reply: Reply = {"method": row.method, "title": METHODS[row.method].title}
    if row.structure is not None:
        reply |= {"coupling": row.structure.coupling, "lead": row.structure.lead}
    if row.unavailable is not None:
        refused = problem_of(row.unavailable)
        reply["unavailable"] = {key: refused[key] for key in ("code", "detail", "hint") if key in refused}
    report = row.report
    if report is None:
        return reply
    rga = rga_reply(report.design, report.interaction)
    gains = gains_reply(report.design)
    return {
        **reply,
        **{key: value for key, value in gains.items() if key not in ("A", "B", "controllability_indices")},
        **{key: value for key, value in rga.items() if key != "findings"},
        "metrics": metrics_reply(report.step["nonlinear"].metrics),
        "axis_metrics": {
            axis: metrics_reply(steps["nonlinear"].metrics) for axis, steps in report.axis_steps.items()
        },
        "margins": margins_reply(report.margins),
        **sensitivity_reply(report.sensitivity),
        "loop_poles": poles_reply(report.loop.poles),
        "stable": report.loop.stable,
        "findings": findings_reply(report.findings),
    }
