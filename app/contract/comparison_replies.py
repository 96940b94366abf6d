"""Replies about several designs or methods, and about systems other than the rig."""

from __future__ import annotations

from importlib.util import find_spec

from heli2dof_core.comparison import Comparison, Row, Split
from heli2dof_core.couplings import STRUCTURES
from heli2dof_core.placement.assess import Assessment
from heli2dof_core.placement.method import Method
from heli2dof_core.placement.registry import METHODS

from .problems import problem_of
from .replies import (
    Reply,
    findings_reply,
    gains_reply,
    margins_reply,
    metrics_reply,
    poles_reply,
    rga_reply,
    sensitivity_reply,
)


def methods_reply() -> list[Reply]:
    """All placement methods; structures apply to full-rank placement alone."""
    return [_method(method) for method in METHODS.values()]


def assessment_reply(result: Assessment) -> Reply:
    """A placement of any system."""
    placement = result.placement
    reply: Reply = {
        "K": placement.K.tolist(),
        "closed_loop_poles": poles_reply(result.closed_loop_poles),
        "norm": result.norm,
        "spectral_norm": result.spectral_norm,
        "findings": findings_reply(result.findings),
    }
    if result.pole_error is not None:
        reply["pole_error"] = result.pole_error
        reply["pole_error_bound"] = result.pole_error_bound
    if result.eigenvector_condition is not None:
        reply["eigenvector_condition"] = result.eigenvector_condition
    if placement.integral is not None:
        reply["integral"] = placement.integral.tolist()
    return reply | placement.construction()


def comparison_reply(comparison: Comparison) -> Reply:
    """One row per method and structure, and what becomes of the paper's claim."""
    return {"rows": [_row(row) for row in comparison.rows], "claim": comparison.claim}


def splits_reply(splits: tuple[Split, ...]) -> list[Reply]:
    """Every way to deal the poles, with its gain and relative gains."""
    return [
        {
            "split": [list(pair) for pair in split.pairs],
            "poles": poles_reply(split.design.poles.values),
            "K": split.design.K.tolist(),
            "norm": split.design.norm,
            "pole_error": split.design.pole_error,
            **({} if split.interaction.rga is None else {"rga": split.interaction.rga.tolist()}),
        }
        for split in splits
    ]


def _method(method: Method) -> Reply:
    needs = {} if method.needs is None else {"needs": method.needs}
    return {
        "name": method.name,
        "title": method.title,
        "source": method.source,
        "places_poles": method.places_poles,
        "integrates": method.integrates,
        "available": method.needs is None or find_spec(method.needs) is not None,
        "couplings": list(dict.fromkeys(s.coupling for s in STRUCTURES)) if method.structured else [],
        "leads": ["pitch", "yaw"] if method.structured else [],
        **needs,
    }


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
