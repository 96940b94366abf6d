"""The derivation as it is replied: in symbols, and in numbers for one design."""

from __future__ import annotations

from dataclasses import asdict, replace
from typing import TYPE_CHECKING

from pydantic import Field

from heli2dof_core import MethodUnavailableError, Spec, interaction, place
from heli2dof_core.walkthrough import walk_through
from heli2dof_core.walkthrough_beyond import observer_steps, rotor_steps

from .model import Complex, Model, Reply, poles_reply, reply_of, voltages_reply

if TYPE_CHECKING:  # it would import SymPy before the first page
    from heli2dof_core.symbolic.render import SymbolicReport


Matrix = list[list[float]]


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


class Derived(Model):
    """What is derived of a gain in any model; definitions say what the short names stand for."""

    A: Formula
    T: Formula = Field(description="of the canonical form; of (Aᵀ, Cᵀ) for L")
    Q: Formula
    entries: dict[str, dict[str, Formula]]
    definitions: dict[str, Formula] = Field(description="in an order in which each stands on those before it")
    controllability_indices: list[int] = Field(description="one per input; of (Aᵀ, Cᵀ) for L")
    symbols: list[Symbol]


class Symbolic(Derived):
    """All formulas of one structure of the paper's four states."""

    B: Formula
    controllability_matrix: Formula
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


class SymbolicRotors(Derived):
    """model=rotors: six states, with both rotors' speeds, and the K that places all of them."""

    lag_pitch: Formula = Field(description="τ_p v̇_p = V_p − v_p")
    lag_yaw: Formula
    thrust: Formula = Field(description="φ(v_j) of a quadratic curve with a dead zone")
    slope: Formula = Field(description="φ′(v_j) beyond the dead zone")
    B: Formula
    K: Formula = Field(description="V/rad, V·s/rad and V/V, columns θ, ψ, θ̇, ψ̇, v_p, v_y; rows V_p, V_y")


class SymbolicObserver(Derived):
    """what=L: the observer, whose gain is placed by duality; it is the same in both models."""

    observer: Formula = Field(description="the estimate's rate")
    separation: Formula = Field(description="matrix of the loop in [x, x − x̂]")
    C: Formula
    L: Formula = Field(description="1/s, and 1/s² below, columns θ, ψ; rows θ, ψ, θ̇, ψ̇")


class RotorSteps(Model):
    """Six states in numbers, as model=rotors names them; without K where there is none."""

    placed: bool = Field(description="whether the design itself places the rotors")
    assumed: list[str] = Field(
        description="axes whose rotor has no lag in the design, and the usual one here"
    )
    names: dict[str, float] = Field(description="letters and groups of the formulas, SI")
    rotor_poles: list[float] = Field(description="p₅ and p₆, rad/s")
    A: Matrix | None = Field(None, description="6×6, SI")
    B: Matrix | None = Field(None, description="6×2, SI")
    K: Matrix | None = Field(None, description="2×6, by the design's method")
    poles: list[Complex] | None = Field(None, description="of A − BK, rad/s")
    refused: str | None = Field(None, description="why there is no K")


class ObserverSteps(Model):
    """The observer in numbers: the design's, or the usual one."""

    used: bool = Field(description="whether the design's feedback acts on its estimate")
    L: Matrix = Field(description="4×2, 1/s and 1/s²")
    asked: list[Complex] | None = Field(None, description="q₁ … q₄; left out of a Kalman filter")
    poles: list[Complex] = Field(description="of A − LC, rad/s")


class Walkthrough(Model):
    """The derivation in numbers for one design: the paper's four states, then what follows.

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
    rotors: RotorSteps
    observer: ObserverSteps | None = Field(None, description="left out where there is none")


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


def walkthrough_reply(spec: Spec) -> Reply:
    """The derivation's steps in numbers; what only full-rank placement has is left out for other methods."""
    design = place(replace(spec, place_rotors=False))
    return reply_of(
        Walkthrough,
        walk_through(design),
        A=design.plant.A,
        B=design.plant.B,
        trim=voltages_reply(design.trim.tolist()),
        K=design.K,
        integral=design.integral,
        closed_loop=design.A_closed,
        closed_loop_poles=design.closed_loop_poles,
        pole_error=design.pole_error,
        rga=interaction(design).rga,
        rotors=reply_of(RotorSteps, rotor_steps(spec)),
        **_observer_reply(spec),
    )


def _observer_reply(spec: Spec) -> Reply:
    """The observer's numbers, unless its equation has no solution in floats."""
    try:
        steps = observer_steps(spec)
    except MethodUnavailableError:
        return {}
    asked = None if steps.asked is None else poles_reply(steps.asked.values)
    return {"observer": reply_of(ObserverSteps, steps, asked=asked)}
