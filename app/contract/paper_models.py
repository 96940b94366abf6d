"""Models of the replies about the paper and about the derivation's steps."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

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
    recomputed: float | None = Field(None, description="by the printed formula, in `unit`")
    corrected: float | None = Field(None, description="by the right formula, in `unit`")
    on_rig: float | None = Field(None, description="on the default rig, in `unit`")
    digits: int | None = Field(None, description="significant digits that agree")
    digits_printed: int = Field(description="significant digits printed")
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
    """One mistake with its proof: an erratum where the paper's own numbers confirm it, else unclear in our copy."""

    name: str
    where: str
    printed: Typeset
    correct: Typeset
    why: str
    effect: str
    standing: Literal["confirmed", "unclear"] = Field(
        description="confirmed by the paper's own printed numbers, or unclear in our copy of it"
    )
    evidence: str | None = Field(None, description="the printed numbers that confirm it")
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
    angle: list[float] = Field(description="rad")


class Figure(Model):
    """A redrawn figure; t in s."""

    number: int = Field(description="of the paper")
    output: str
    t: list[float] = Field(description="s")
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

    constants: dict[str, float] = Field(description="α, β₀, γ, a; SI")
    A: Matrix = Field(description="4×4, SI")
    B: Matrix = Field(description="4×2, SI")
    trim: dict[str, float] = Field(description="V")
    controllability_matrix: Matrix = Field(description="[B, AB, …], 4×8")
    controllability_indices: list[int] = Field(description="one per input")
    coefficients: dict[str, float] | None = Field(None, description="d₁₀, d₂₀ in 1/s², d₁₁, d₂₁ in 1/s")
    T: Matrix | None = Field(None, description="4×4, x̄ = Tx")
    Q: Matrix | None = Field(None, description="2×2")
    A_bar: Matrix | None = Field(None, description="T A T⁻¹")
    B_bar: Matrix | None = Field(None, description="T B")
    K_bar: Matrix | None = Field(None, description="Q K T⁻¹")
    K: Matrix = Field(description="V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y")
    integral: Matrix | None = Field(None, description="the method's own integral action, V/(rad·s)")
    closed_loop: Matrix = Field(description="A − BK")
    closed_loop_bar: Matrix | None = Field(None, description="T (A − BK) T⁻¹")
    closed_loop_poles: list[Complex]
    pole_error: float | None = Field(
        None, description="largest distance of a pole from the one asked for, rad/s"
    )
    G_0: Matrix | None = Field(None, description="Ĝ(0), rad/V")
    rga: Matrix | None = Field(None, description="RGA at s = 0; rows θ, ψ, columns V_p, V_y")
