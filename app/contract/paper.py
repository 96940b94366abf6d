"""The paper as it is replied; `paper_reply` computes it, and imports SymPy."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from .model import Complex, Model


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
