"""Models of the replies about the paper and about the derivation's steps."""

from __future__ import annotations

from .models import Complex, Model


class Typeset(Model):
    """A formula in two notations."""

    latex: str
    mathml: str


class Equation(Model):
    """A step of the derivation: one plain sentence, as printed, as derived, and what became of it.

    `formulas` names what of GET symbolic stands here for another structure than the paper's.
    """

    number: str
    title: str
    chapter: str
    plain: str
    status: str
    note: str
    errata: list[str]
    formulas: list[str]
    printed: Typeset | None = None
    derived: Typeset | None = None


class Term(Model):
    """A symbol of the formulas; `chapters` are those where it means this, none: all."""

    name: str
    latex: str
    mathml: str
    meaning: str
    unit: str
    chapters: list[str]


class PrintedNumber(Model):
    """A printed number: from the printed formula, corrected, on the default rig; digits that agree."""

    where: str
    name: str
    printed: str
    unit: str
    printed_unit: str | None = None
    formula: str
    recomputed: float | None = None
    corrected: float | None = None
    on_rig: float | None = None
    digits: int | None = None
    digits_printed: int
    verdict: str
    note: str


class Evidence(Model):
    """A residual or a figure; as a formula where it is one."""

    text: str
    latex: str | None = None
    mathml: str | None = None


class Proof(Model):
    """What is computed, what the right and the printed form give, what the two are called, whether it holds."""

    statement: str
    correct: Evidence
    printed: Evidence
    holds: bool
    labels: list[str]


class Erratum(Model):
    """One mistake with its proof."""

    name: str
    where: str
    printed: Typeset
    correct: Typeset
    why: str
    effect: str
    proof: Proof


class Outcome(Model):
    """Where the printed K puts the poles of one plant, rad/s."""

    plant: str
    poles: list[Complex]
    unrounded: list[Complex]


class Curve(Model):
    """One response, rad."""

    name: str
    title: str
    angle: list[float]


class Figure(Model):
    """A redrawn figure; t in s."""

    number: int
    output: str
    t: list[float]
    curves: list[Curve]


class Paper(Model):
    """The paper, reproduced."""

    title: str
    authors: str
    equations: list[Equation]
    symbols: list[Term]
    numbers: list[PrintedNumber]
    errata: list[Erratum]
    consequence: list[Outcome]
    figures: list[Figure]


Matrix = list[list[float]]


class Walkthrough(Model):
    """The derivation in numbers for one design.

    Another method than full-rank's has no coefficients, T, Q, A_bar, B_bar, K_bar and closed_loop_bar.
    G_0 and rga are left out where a pole is 0.
    """

    constants: dict[str, float]
    A: Matrix
    B: Matrix
    trim: dict[str, float]
    controllability_matrix: Matrix
    controllability_indices: list[int]
    coefficients: dict[str, float] | None = None
    T: Matrix | None = None
    Q: Matrix | None = None
    A_bar: Matrix | None = None
    B_bar: Matrix | None = None
    K_bar: Matrix | None = None
    K: Matrix
    integral: Matrix | None = None
    closed_loop: Matrix
    closed_loop_bar: Matrix | None = None
    closed_loop_poles: list[Complex]
    pole_error: float | None = None
    G_0: Matrix | None = None
    rga: Matrix | None = None
