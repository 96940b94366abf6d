"""Models of the replies about the paper and about the derivation's steps."""

from __future__ import annotations

from .models import Complex, Model


class Typeset(Model):
    """A formula in two notations."""

    latex: str
    mathml: str


class Equation(Model):
    """A numbered equation, table or figure: as printed, as derived, and what became of it."""

    number: str
    title: str
    chapter: str
    status: str
    note: str
    errata: list[str]
    printed: Typeset | None = None
    derived: Typeset | None = None


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
    numbers: list[PrintedNumber]
    errata: list[Erratum]
    consequence: list[Outcome]
    figures: list[Figure]


Matrix = list[list[float]]


class Walkthrough(Model):
    """The derivation in numbers for one full-rank design; G_0 is left out where a pole is 0."""

    constants: dict[str, float]
    coefficients: dict[str, float]
    A: Matrix
    B: Matrix
    trim: dict[str, float]
    controllability_matrix: Matrix
    T: Matrix
    Q: Matrix
    A_bar: Matrix
    B_bar: Matrix
    K: Matrix
    closed_loop_bar: Matrix
    G_0: Matrix | None = None
    rga: Matrix | None = None
