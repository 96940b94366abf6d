"""The same rig and poles through several methods, and through all splits of the poles."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from .checks import require_one_of
from .couplings import STRUCTURES, Structure
from .design import FULL_RANK, Design
from .errors import Heli2DofError, MethodUnavailableError, StructureUnavailableError
from .evaluate import Report, evaluate, place
from .figures import LOOP
from .interaction import Interaction, interaction
from .loop import lag_in_words
from .metrics import settling_words
from .placement.groups import splits
from .placement.registry import METHODS
from .poles import PoleSet
from .scenario import OuterLoop
from .spec import Spec
from .tables import NOTHING, Shown, Table, number
from .tuning import RULE, suggest_pi

DYADIC = ("ackermann", "bass-gura")

Tuning = Literal["kept", "placed", "tuned"]
"""The outer loops under which methods are compared: the spec's own, none, or each method's own by one rule."""
RULES: dict[Tuning, str] = {
    "placed": "Each method as placed: the inner loop alone, behind the static prefilter v = Ĝ(0)⁻¹ r; no PI loops.",
    "tuned": f"PI loops tuned for each method by one rule, with the same target. {RULE}",
    "kept": "All methods under the present PI values. These were chosen for other poles than some methods have, so "
    "that a method may look worse or better than it is.",
}
OWN_LOOPS = "A method with integral action keeps its own integrators in place of PI loops."


@dataclass(frozen=True, repr=False)
class Row(Shown):
    """One method's result.

    Attributes:
        method: its name.
        structure: of the closed loop; None where the method is not full-rank's.
        report: everything; None where the method is not available.
        unavailable: why not.
        outer: the loops around it; None where it is not available.
    """

    method: str
    structure: Structure | None
    report: Report | None
    unavailable: Heli2DofError | None
    outer: OuterLoop | None = None

    @property
    def name(self) -> str:
        """The method, with its structure where it has one."""
        if self.structure is None:
            return self.method
        return f"{self.method} {self.structure.title}"

    def summary(self) -> str:
        """The method and what came of it."""
        return f"{self.name}; {'not available' if self.report is None else self.report.summary()}"


@dataclass(frozen=True, repr=False)
class Comparison(Shown):
    """Rows in the order of the registry, and what they say of the paper's claim of lower gains.

    Attributes:
        rows: one per method and structure.
        claim: in words; empty where nothing is to be said.
        tuning: under which outer loops.
        rule: these in words.
    """

    rows: tuple[Row, ...]
    claim: str
    tuning: Tuning = "kept"
    rule: str = ""

    def summary(self) -> str:
        """How many methods have a result."""
        return f"{sum(row.report is not None for row in self.rows)} of {len(self.rows)} available"

    def tables(self) -> tuple[Table, ...]:
        """A row per method; and why some have no result."""
        refused = [(row.name, f"{row.unavailable}") for row in self.rows if row.unavailable is not None]
        heads = ("", "‖K‖", "κ(V)", "λ₁₁", "θ settles (s)", "ψ settles (s)", LOOP["lag_margin"].head, "loop")
        return (
            Table.of("methods", heads, (_cells(row.name, row.report) for row in self.rows if row.report)),
            *((Table.of("not available", ("", "why"), refused),) if refused else ()),
        )


def _cells(name: str, report: Report) -> tuple[str, ...]:
    axes = report.step["nonlinear"].metrics.axes
    settling = (settling_words(axes[axis]) if axis in axes else NOTHING for axis in ("theta", "psi"))
    return (
        name,
        number(report.design.norm),
        number(report.design.eigenvector_condition),
        number(report.interaction.relative_gain),
        *settling,
        lag_in_words(report.loop),
        "stable" if report.loop.stable else "unstable",
    )


@dataclass(frozen=True, repr=False)
class Split(Shown):
    """One way to deal the four poles into pitch's and yaw's pair: positions from 0, and the design."""

    pairs: tuple[tuple[int, ...], ...]
    design: Design
    interaction: Interaction

    def summary(self) -> str:
        """The pairs and the gain."""
        pairs = " | ".join(", ".join(str(i + 1) for i in pair) for pair in self.pairs)
        return f"poles {pairs}; {self.design.summary()}"


def compare(spec: Spec, methods: Sequence[str] | None = None, tuning: Tuning = "kept") -> Comparison:
    """Evaluates the spec by each method; full-rank's by each structure.

    PI values suit the poles that they were tuned for. So that no method is judged by another's, all are compared
    without outer loops (`placed`), or each with its own by one rule (`tuned`: `suggest_pi`).

    Args:
        spec: rig, poles and scenario, the same for all; its outer loop only where it is kept.
        methods: names in `placement.registry`; all by default.
        tuning: of the outer loops; `kept` takes the spec's own for all.

    Raises:
        InvalidInputError: there is no such method or tuning.
    """
    require_one_of(tuning, Tuning, "tuning")
    names = list(METHODS) if methods is None else methods
    entries: list[tuple[str, Structure | None]] = []
    for name in names:
        entries += [(name, s) for s in STRUCTURES] if name == FULL_RANK else [(name, None)]
    rows = tuple(_row(spec, name, structure, tuning) for name, structure in entries)
    own = any(METHODS[row.method].integrates and row.report for row in rows)
    # without PI loops to keep, they are as placed
    told: Tuning = "placed" if tuning == "kept" and spec.outer.outer == "none" else tuning
    rule = f"{RULES[told]} {OWN_LOOPS}" if own else RULES[told]
    return Comparison(rows, _claim(rows), tuning, rule)


def compare_splits(spec: Spec) -> tuple[Split, ...]:
    """All ways to deal the poles into two conjugate-closed pairs; six for four distinct real poles."""
    found = []
    for pairs in splits(spec.poles.array, (2, 2)):
        poles = PoleSet.dealt(spec.poles.values, pairs)
        design = place(replace(spec, method=FULL_RANK, poles=poles))
        found.append(Split(pairs, design, interaction(design)))
    return tuple(found)


def _row(spec: Spec, name: str, structure: Structure | None, tuning: Tuning) -> Row:
    changed = replace(spec, method=name, structure=structure or spec.structure)
    outer = spec.outer if tuning == "kept" else replace(spec.outer, outer="none")
    try:
        if tuning == "tuned" and not METHODS[name].integrates:
            placed = place(changed)
            try:
                outer = suggest_pi(placed, spec.outer).outer
            except Heli2DofError as error:  # the rule finds no loops for it
                return Row(name, structure, None, error)
        report = evaluate(replace(changed, outer=outer), each_axis=True)
    except (MethodUnavailableError, StructureUnavailableError) as error:
        return Row(name, structure, None, error)
    return Row(name, structure, report, None, outer)


def _claim(rows: Sequence[Row]) -> str:
    """Section III says that full-rank gains are lower than Ackermann's or Bass and Gura's."""
    norms = {(row.method, row.structure): row.report.design.norm for row in rows if row.report}
    own = [norm for (name, _), norm in norms.items() if name == FULL_RANK]
    dyadic = [norm for (name, _), norm in norms.items() if name in DYADIC]
    if dyadic and own:
        ratio = min(dyadic) / np.median(own)
        return (
            f"The paper says that full-rank gains are lower than Ackermann's or Bass and Gura's. Here ‖K‖ is "
            f"{min(own):.4g} to {max(own):.4g} against {min(dyadic):.4g}, even with the input direction that makes "
            f"theirs smallest: {ratio:.3g} times the median."
        )
    refused = [row.unavailable for row in rows if row.method in DYADIC and row.unavailable]
    if refused:
        return (
            "The paper says that full-rank gains are lower than Ackermann's or Bass and Gura's. On this rig there "
            f"is nothing to compare: {refused[0]}."
        )
    return ""
