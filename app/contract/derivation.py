"""The derivation as it is replied: in symbols, and in numbers for one design."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING

from pydantic import Field

from heli2dof_core import Design, interaction
from heli2dof_core.walkthrough import walk_through

from .model import Complex, Model, Reply, reply_of, voltages_reply

if TYPE_CHECKING:  # it would import SymPy before the first page
    from heli2dof_core.symbolic.render import SymbolicReport


class Formula(Model):
    """One expression in three notations."""

    sympy: str
    latex: str
    mathml: str


class Symbol(Model):
    """A symbol of the formulas."""

    name: str
    latex: str
    mathml: str
    meaning: str
    unit: str


class Symbolic(Model):
    """All formulas of one structure; definitions say what the short names stand for."""

    A: Formula
    B: Formula
    controllability_matrix: Formula
    T: Formula
    Q: Formula
    A_bar: Formula
    B_bar: Formula
    K_bar: Formula
    K: Formula = Field(description="V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y")
    closed_loop: Formula
    canonical_closed_loop: Formula
    G: Formula
    G_0: Formula
    RGA: Formula
    RGA_s: Formula
    entries: dict[str, dict[str, Formula]]
    definitions: dict[str, Formula]
    controllability_indices: list[int] = Field(description="one per input")
    symbols: list[Symbol]


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


def symbolic_reply(report: SymbolicReport) -> Reply:
    """Formulas as SymPy text, LaTeX and MathML."""
    return {
        **{name: asdict(formula) for name, formula in report.formulas.items()},
        "entries": {
            matrix: {name: asdict(formula) for name, formula in entries.items()}
            for matrix, entries in report.entries.items()
        },
        "definitions": {name: asdict(formula) for name, formula in report.definitions.items()},
        "controllability_indices": list(report.controllability_indices),
        "symbols": [{**asdict(name), "mathml": report.notation[name.name].mathml} for name in report.symbols],
    }


def walkthrough_reply(design: Design) -> Reply:
    """The derivation's steps in numbers; what only full-rank placement has is left out for other methods."""
    return reply_of(
        Walkthrough,
        walk_through(design),
        A=design.plant.A,
        B=design.plant.B,
        trim=voltages_reply(design.trim),
        K=design.K,
        integral=design.integral,
        closed_loop=design.A_closed,
        closed_loop_poles=design.closed_loop_poles,
        pole_error=design.pole_error,
        rga=interaction(design).rga,
    )
