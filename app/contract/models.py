"""The contract's replies as Pydantic models, for the schema at /openapi.json.

Replies are encoded straight from the core's arrays (see `replies`); a test holds every reply
against its model.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, create_model

from heli2dof_core.figures import AXIS, DESIGN, MARGINS, MOTOR, SENSITIVITY, STEP, Figure

from .places import LIMITS, LOOP, OUTER, SCENARIO, STRUCTURE, Place


class Model(BaseModel):
    """A reply's part: all numbers are finite, and nothing is said that is not described here."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False)


def told_by(known: Mapping[str, Figure]) -> type[Model]:
    """A reply of figures, as the registry names and describes them; one that may be absent is left out then."""
    own: dict[str, Any] = {}
    for name, figure in known.items():
        kind = bool if figure.notation == "flag" else float
        words = figure.described
        own[name] = (
            (kind | None, Field(None, description=words))
            if figure.absent
            else (kind, Field(description=words))
        )
    return create_model("Figures", __base__=Model, **own)


def proposed(*places: Place) -> type[Model]:
    """A reply of the quantities that a preset proposes; one that may be absent is left out then."""
    own: dict[str, Any] = {}
    for place in places:
        for name, known in place.fields().items():
            if place.proposed(name):
                about = known.quantity
                own[name] = (
                    (known.kind | None, Field(None, description=about.described))
                    if about.absent
                    else (known.kind, Field(description=about.described))
                )
    return create_model("Quantities", __base__=Model, **own)


class Complex(Model):
    """A complex number."""

    re: float = Field(description="real part")
    im: float = Field(description="imaginary part")


class Finding(Model):
    """A remark on a design or response that is legal but deserves a word."""

    code: str
    severity: str
    message: str


class Voltages(Model):
    """Motor voltages, V."""

    V_p: float = Field(description="pitch motor, V")
    V_y: float = Field(description="yaw motor, V")


class Angles(Model):
    """Angles, rad; left out where there is none."""

    theta: float | None = Field(None, description="pitch, rad")
    psi: float | None = Field(None, description="yaw, rad")


class Gains(Model):
    """K in V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y.

    `integral` is a method's own integral action, V/(rad·s); `pole_error` is left out where the method
    chose its own poles, `eigenvector_condition` where there are too few eigenvectors.
    """

    method: str
    K: list[list[float]] = Field(description="V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y")
    integral: list[list[float]] | None = Field(
        None, description="the method's own integral action, V/(rad·s)"
    )
    A: list[list[float]] = Field(description="4×4, x = [θ, ψ, θ̇, ψ̇], SI")
    B: list[list[float]] = Field(description="4×2, inputs V_p, V_y, SI")
    poles: list[Complex]
    closed_loop_poles: list[Complex]
    pole_error: float | None = Field(None, description=DESIGN["pole_error"].described)
    pole_error_bound: float | None = Field(None, description=DESIGN["pole_error_bound"].described)
    norm: float = Field(description=DESIGN["norm"].described)
    spectral_norm: float = Field(description=DESIGN["spectral_norm"].described)
    eigenvector_condition: float | None = Field(None, description=DESIGN["eigenvector_condition"].described)
    controllability_indices: list[int] = Field(description="one per input")
    findings: list[Finding]


class Dominance(Model):
    """Off-diagonal over diagonal size of Ĝ(jω), by rows and by columns; below 1: dominant."""

    rows: list[list[float]] = Field(description="per frequency, row θ and row ψ")
    columns: list[list[float]] = Field(description="per frequency, column V_p and column V_y")


class Rga(Model):
    """RGA at s = 0, rows θ, ψ, columns V_p, V_y; left out without steady state."""

    rga: list[list[float]] | None = Field(None, description="RGA at s = 0; rows θ, ψ, columns V_p, V_y")
    pairing: list[list[str]] | None = None
    reason: str | None = None
    niederlinski: float | None = Field(None, description="index of the diagonal pairing")
    niederlinski_cross: float | None = Field(None, description="index of the cross pairing")
    dominance: Dominance | None = None
    frequencies: list[float] | None = Field(None, description="rad/s")
    rga_magnitude: list[list[list[float]]] | None = Field(None, description="|RGA(jω)|, 2×2 per frequency")
    findings: list[Finding]


class AxisMetrics(told_by(AXIS)):
    """Step metrics of one axis; s, %, rad, rad·s, rad·s². They belong to the response, not to its samples."""


class MotorMetrics(told_by(MOTOR)):
    """Largest |voltage|, V, share of time at the limit, and effort ∫ (V − V_trim)² dt, V²·s."""


class Metrics(Model):
    """Metrics of each stepped axis, of the axis that is not, and of the motors."""

    theta: AxisMetrics | None = None
    psi: AxisMetrics | None = None
    coupling_peak: float | None = Field(None, description=STEP["coupling_peak"].described)
    V_p: MotorMetrics
    V_y: MotorMetrics


class States(Model):
    """What the outputs do not show, rad/s and rad·s; the integrals are left out where nothing integrates."""

    theta_dot: list[float] = Field(description="rad/s")
    psi_dot: list[float] = Field(description="rad/s")
    z_p: list[float] | None = Field(None, description="integral of the pitch error, rad·s")
    z_y: list[float] | None = Field(None, description="integral of the yaw error, rad·s")


class Step(Model):
    """A step response; s, rad, V. Linear voltages are deviations from the trim.

    `states` are there where they are asked for.
    """

    t: list[float] = Field(description="s")
    theta: list[float] = Field(description="pitch, absolute, rad")
    psi: list[float] = Field(description="yaw, absolute, rad")
    V_p: list[float] = Field(description="pitch motor, V")
    V_y: list[float] = Field(description="yaw motor, V")
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


class Margins(told_by(MARGINS)):
    """Margins at one motor's input: factors, rad, s; left out where unlimited."""


class LoopMargins(Model):
    """Margins at each motor; left out where the loop is unstable."""

    pitch: Margins | None = None
    yaw: Margins | None = None


class FrequencyResponse(Model):
    """L(jω) of the loop opened at one motor's input, the rest closed; the phase without jumps, rad."""

    gain: list[float] = Field(description="|L(jω)|")
    phase: list[float] = Field(description="without jumps, rad")


class OpenLoops(Model):
    """The loops opened at each motor, over frequency, rad/s; −1 is critical."""

    frequencies: list[float] = Field(description="rad/s")
    pitch: FrequencyResponse
    yaw: FrequencyResponse
    margins: LoopMargins
    stable: bool


class Sensitivity(told_by(SENSITIVITY)):
    """Sensitivity peak and disk margin at both motors at once, rad/s; what the disk margin guarantees."""


class AxisSteps(Model):
    """Each axis of the reference stepped alone."""

    theta: BothModels | None = None
    psi: BothModels | None = None


class Limits(proposed(LIMITS)):
    """Voltage limits, V, and pitch travel, rad, where it is not free."""


class Evaluation(Model):
    """Gains, RGA, responses and margins at once."""

    seq: int | None = Field(None, description="the live request's number")
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


class PI(proposed(LOOP["pitch"])):
    """PI(s) = kp (1 + 1/(ti s)) of one axis."""


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
    minimum: float = Field(description="lowest value allowed, in `unit`")
    maximum: float = Field(description="highest value allowed, in `unit`")


class ComponentInfo(Model):
    """What a component's value means, and the paper's symbol for it."""

    meaning: str
    unit: str
    printed: str


class Scenario(proposed(SCENARIO)):
    """A preset's own experiment."""

    reference: Angles


class Preset(proposed(STRUCTURE, OUTER)):
    """A rig with its source and everything that a design may change."""

    name: str
    title: str
    source: str
    rig: str
    parameters: dict[str, float] = Field(description="SI units, see `parameter_info`")
    parameter_info: dict[str, ParameterInfo]
    components: dict[str, float] = Field(description="in the units of `component_info`")
    component_info: dict[str, ComponentInfo]
    limits: Limits
    limit_info: dict[str, ParameterInfo]
    encoders: dict[str, int] = Field(description="counts per revolution")
    operating_point: dict[str, float] = Field(description="theta, rad")
    poles: list[Complex]
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


def described(model: Any, summary: str) -> dict[str, Any]:
    """Route options that put a reply's model into the schema; its errors are put there for all routes at once."""
    return {"summary": summary, "responses": {200: {"model": model, "description": summary}}}
