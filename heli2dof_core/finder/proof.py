"""Designs as `evaluate` tells of them: what was searched by numbers is proved by everybody's path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import inf, nan

import numpy as np

from ..evaluate import Report, evaluate
from ..many import SHARES, Measure
from ..measured import MEASURED, stepped, worse
from ..spec import Spec
from .problem import Problem
from .result import Candidate, Judged


def report_of(spec: Spec) -> Report:
    """What `evaluate` tells of a design, each axis stepped alone, too; figures do not depend on samples."""
    return evaluate(replace(spec, scenario=replace(spec.scenario, samples=2)), each_axis=True)


def value_of(report: Report, measure: Measure) -> float:
    """A figure of a report, as `Many` has it: NaN where there is none, ±∞ where it is unlimited."""
    known = MEASURED[measure.name]
    own = worse(known, known.read(report, measure.where))
    if own is not None:
        return own
    if not (known.unlimited and report.judged.stable):
        return nan
    return inf if known.figure.better == "higher" else -inf


def proved(problem: Problem, specs: Sequence[Spec]) -> list[Candidate]:
    """The designs with their figures, judged; those on uncertain rigs on all of them.

    Raises:
        Heli2DofError: a design does not exist.
    """
    shares, told = _on_rigs(problem, specs)
    return [_candidate(problem, *own) for own in zip(specs, shares, told, strict=True)]


def _on_rigs(
    problem: Problem, specs: Sequence[Spec]
) -> tuple[list[dict[int, float]], list[dict[str, float]]]:
    """Of each design the shares of its rigs by requirement, and by name."""
    on_all = problem.on_all
    if on_all is None:
        return [{} for _ in specs], [{} for _ in specs]
    rows = np.array([problem.many.numbers_of(spec, given=True) for spec in specs])
    met, own = on_all.of(lambda i: specs[i], rows, None, problem.check)
    at = [i for i, need in enumerate(problem.ask.require) if need.share is not None]
    names = [measure.name for measure in on_all.shares]
    return (
        [dict(zip(at, row, strict=True)) for row in met.tolist()],
        [dict(zip(names, row, strict=True)) for row in own.tolist()],
    )


def _candidate(problem: Problem, spec: Spec, shares: dict[int, float], told: dict[str, float]) -> Candidate:
    problem.check()
    report = report_of(spec)
    axes, stable = stepped(report), report.judged.stable
    values = tuple(told[own.name] if own.name in SHARES else value_of(report, own) for own in problem.told)
    judged = []
    for i, need in enumerate(problem.ask.require):
        if need.measure.name in SHARES:
            judged.append(Judged(stable and need.meets(told[need.measure.name])))
            continue
        met = stable and all(one.meets(value_of(report, one.measure)) for one in need.apart(axes))
        share = shares.get(i)
        if share is not None and need.share is not None:
            met = met and share >= need.share - 1e-9
        judged.append(Judged(met, share))
    return Candidate(spec, values, tuple(judged), stable)
