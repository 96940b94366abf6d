"""The contract's replies as Pydantic models, for the schema at /openapi.json.

Replies are encoded straight from the core's arrays (see `replies`); a test holds every reply
against its model.
"""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict

from .problems import Problem


class Model(BaseModel):
    """A reply's part: all numbers are finite, and nothing is said that is not described here."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


class Complex(Model):
    """A complex number."""

    re: float
    im: float


class Finding(Model):
    """A remark on a design or response that is legal but deserves a word."""

    code: str
    severity: str
    message: str


class Voltages(Model):
    """Motor voltages, V."""

    V_p: float
    V_y: float


class Angles(Model):
    """Angles, rad; left out where there is none."""

    theta: float | None = None
    psi: float | None = None


class Gains(Model):
    """K in V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y.

    `integral` is a method's own integral action, V/(rad·s); `pole_error` is left out where the method
    chose its own poles, `eigenvector_condition` where there are too few eigenvectors.
    """

    method: str
    K: list[list[float]]
    integral: list[list[float]] | None = None
    A: list[list[float]]
    B: list[list[float]]
    poles: list[Complex]
    closed_loop_poles: list[Complex]
    pole_error: float | None = None
    norm: float
    spectral_norm: float
    eigenvector_condition: float | None = None
    controllability_indices: list[int]
    findings: list[Finding]


class Dominance(Model):
    """Off-diagonal over diagonal size of Ĝ(jω), by rows and by columns; below 1: dominant."""

    rows: list[list[float]]
    columns: list[list[float]]


class Rga(Model):
    """RGA at s = 0, rows θ, ψ, columns V_p, V_y; left out without steady state."""

    rga: list[list[float]] | None = None
    pairing: list[list[str]] | None = None
    reason: str | None = None
    niederlinski: float | None = None
    niederlinski_cross: float | None = None
    dominance: Dominance | None = None
    frequencies: list[float] | None = None
    rga_magnitude: list[list[list[float]]] | None = None
    findings: list[Finding]


class AxisMetrics(Model):
    """Step metrics of one axis; s, %, rad, rad·s, rad·s²."""

    rise_time: float | None = None
    settling_time: float | None = None
    overshoot: float
    peak: float
    peak_time: float
    steady_state_error: float
    iae: float
    itae: float


class MotorMetrics(Model):
    """Largest |voltage|, V, share of time at the limit, and effort ∫ (V − V_trim)² dt, V²·s."""

    peak: float
    saturated: float
    effort: float


class Metrics(Model):
    """Metrics of each stepped axis, of the axis that is not, and of the motors."""

    theta: AxisMetrics | None = None
    psi: AxisMetrics | None = None
    coupling_peak: float | None = None
    V_p: MotorMetrics
    V_y: MotorMetrics


class States(Model):
    """What the outputs do not show, rad/s and rad·s; the integrals are left out where nothing integrates."""

    theta_dot: list[float]
    psi_dot: list[float]
    z_p: list[float] | None = None
    z_y: list[float] | None = None


class Step(Model):
    """A step response; s, rad, V. Linear voltages are deviations from the trim.

    `states` are there where they are asked for.
    """

    t: list[float]
    theta: list[float]
    psi: list[float]
    V_p: list[float]
    V_y: list[float]
    states: States | None = None
    reference: Angles
    trim: Voltages
    metrics: Metrics
    loop_poles: list[Complex]
    stable: bool
    findings: list[Finding]


class BothModels(Model):
    """The same experiment by both models."""

    linear: Step
    nonlinear: Step


class Margins(Model):
    """Margins at one motor's input: factors, rad, s; left out where unlimited."""

    gain_margin: float | None = None
    gain_reduction_margin: float | None = None
    phase_margin: float | None = None
    delay_margin: float | None = None


class LoopMargins(Model):
    """Margins at each motor; left out where the loop is unstable."""

    pitch: Margins | None = None
    yaw: Margins | None = None


class FrequencyResponse(Model):
    """L(jω) of the loop opened at one motor's input, the rest closed; the phase without jumps, rad."""

    gain: list[float]
    phase: list[float]


class OpenLoops(Model):
    """The loops opened at each motor, over frequency, rad/s; −1 is critical."""

    frequencies: list[float]
    pitch: FrequencyResponse
    yaw: FrequencyResponse
    margins: LoopMargins
    stable: bool


class Sensitivity(Model):
    """Sensitivity peak and disk margin at both motors at once, rad/s; what the disk margin guarantees."""

    peak: float
    peak_frequency: float
    disk_margin: float
    disk_frequency: float
    gain_low: float
    gain_high: float | None = None
    phase: float


class AxisSteps(Model):
    """Each axis of the reference stepped alone."""

    theta: BothModels | None = None
    psi: BothModels | None = None


class Limits(Model):
    """Voltage limits, V, and pitch travel, rad, where it is not free."""

    V_p: float
    V_y: float
    theta: float | None = None


class Evaluation(Model):
    """Gains, RGA, responses and margins at once."""

    seq: int | None = None
    gains: Gains
    open_loop_poles: list[Complex]
    rga: Rga
    step: BothModels
    axis_steps: AxisSteps
    margins: LoopMargins
    sensitivity: Sensitivity | None = None
    loop_poles: list[Complex]
    stable: bool
    trim: Voltages
    limits: Limits
    findings: list[Finding]


class PI(Model):
    """kp in V/rad, ti in s."""

    kp: float
    ti: float


class Loops(Model):
    """PI values of both axes."""

    pitch: PI
    yaw: PI


class Suggestion(Model):
    """PI values and the whole loop's poles with them."""

    loops: Loops
    loop_poles: list[Complex]
    stable: bool
    rule: str


class ParameterInfo(Model):
    """What a parameter or a limit means, and its range."""

    meaning: str
    unit: str
    minimum: float
    maximum: float


class ComponentInfo(Model):
    """What a component's value means, and the paper's symbol for it."""

    meaning: str
    unit: str
    printed: str


class Scenario(Model):
    """A preset's own experiment."""

    reference: Angles
    duration: float
    samples: int


class Preset(Model):
    """A rig with its source and everything that a design may change."""

    name: str
    title: str
    source: str
    rig: str
    parameters: dict[str, float]
    parameter_info: dict[str, ParameterInfo]
    components: dict[str, float]
    component_info: dict[str, ComponentInfo]
    limits: Limits
    limit_info: dict[str, ParameterInfo]
    encoders: dict[str, int]
    operating_point: dict[str, float]
    poles: list[Complex]
    coupling: str
    lead: str
    outer: str
    pairing: str
    decoupler: bool
    loops: Loops
    scenario: Scenario


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
    K: Formula
    closed_loop: Formula
    canonical_closed_loop: Formula
    G: Formula
    G_0: Formula
    RGA: Formula
    RGA_s: Formula
    entries: dict[str, dict[str, Formula]]
    definitions: dict[str, Formula]
    controllability_indices: list[int]
    symbols: list[Symbol]


def described(model: Any, summary: str) -> dict[str, Any]:
    """Route options that put a reply's model, and that of its errors, into the schema."""
    problem = {"model": Problem, "description": "Invalid input", "content": {"application/problem+json": {}}}
    return {
        "summary": summary,
        "responses": {200: {"model": model, "description": summary}, 422: problem},
    }
