"""A design: what a request may change of a preset, the gains that are replied, and PI values that suit.

Every field is optional: what is left out comes from the preset. Unknown fields are refused.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache

from pydantic import Field

from heli2dof_core import (
    Design,
    Heli2DofError,
    Parameters,
    Spec,
    loop_of,
    place,
    plant,
)
from heli2dof_core import Finding as CoreFinding
from heli2dof_core.controllability import controllability_indices
from heli2dof_core.design import FULL_RANK
from heli2dof_core.estimators import observe
from heli2dof_core.figures import LOOP as FIGURES_OF_LOOP
from heli2dof_core.findings import merged
from heli2dof_core.judged import Judged, Rows, Size
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.placement.with_rotors import with_rotors
from heli2dof_core.plant import Plant
from heli2dof_core.presets import DEFAULT
from heli2dof_core.request import (
    FRICTION,
    LIMITS,
    LOOP,
    NAMES,
    OBSERVER,
    OUTER,
    PARAMETERS,
    POINT,
    ROTOR,
    ROTORS,
    STRUCTURE,
    WEIGHTS,
    judged_spec,
)
from heli2dof_core.root_locus import optimal_poles
from heli2dof_core.rotors import Actuators
from heli2dof_core.scenario import OuterLoop
from heli2dof_core.tuning import Suggestion as CoreSuggestion

from .fields import Pole, PresetName, Split, Strict, asked
from .model import (
    OF_GAINS,
    Complex,
    Finding,
    Model,
    Reply,
    findings_reply,
    poles_reply,
    proposed,
    reply_of,
    told_by,
)


class ParameterChanges(asked(PARAMETERS)):
    """Parameters that differ from the preset's."""


class LimitChanges(asked(LIMITS)):
    """Limits that differ from the preset's."""


class OperatingPoint(asked(POINT)):
    """Where the rig rests and the model is linearized."""


class LoopChanges(asked(LOOP["pitch"])):
    """PI(s) = kp (1 + 1/(ti s)) of one axis."""


class LoopsChanges(Strict):
    """The PI controllers of the pitch and the yaw error."""

    pitch: LoopChanges = LoopChanges()
    yaw: LoopChanges = LoopChanges()


class RotorChanges(asked(ROTOR["pitch"])):
    """One motor's rotor: how long it takes, and how thrust follows its speed."""


class RotorsChanges(Strict):
    """The rotors of the pitch and the yaw motor."""

    pitch: RotorChanges = RotorChanges()
    yaw: RotorChanges = RotorChanges()


class FrictionChanges(asked(FRICTION["pitch"])):
    """Coulomb friction of one axis, with stiction."""


class AxisFrictionChanges(Strict):
    """Friction of both axes."""

    pitch: FrictionChanges = FrictionChanges()
    yaw: FrictionChanges = FrictionChanges()


class ObserverChanges(asked(OBSERVER)):
    """What estimates the states from the angles and the voltages."""

    poles: list[Pole] | None = Field(
        default=None,
        min_length=4,
        max_length=4,
        description="of the estimate's errors: q₁, q₂ (pitch's pair), q₃, q₄ (yaw's), rad/s",
    )


class StateWeights(asked(WEIGHTS["states"])):
    """The diagonal of Q."""


class InputWeights(asked(WEIGHTS["inputs"])):
    """The diagonal of R."""


class IntegralWeights(asked(WEIGHTS["integrals"])):
    """The diagonal of Q_z, where the method brings integral action."""


class WeightChanges(Strict):
    """Weights of the quadratic methods that differ from Bryson's rule for the preset's limits."""

    states: StateWeights = StateWeights()
    inputs: InputWeights = InputWeights()
    integrals: IntegralWeights = IntegralWeights()


class DesignRequest(asked(STRUCTURE, OUTER, ROTORS)):
    """A design: what differs from the preset."""

    preset: PresetName = Field(default=DEFAULT, description="name of a preset, see GET /api/v1/presets")
    parameters: ParameterChanges = ParameterChanges()
    limits: LimitChanges = LimitChanges()
    operating_point: OperatingPoint | None = None
    poles: list[Pole] | None = Field(
        default=None, min_length=4, max_length=4, description="p₁, p₂ (pitch's pair), p₃, p₄ (yaw's), rad/s"
    )
    method: str = Field(
        default=FULL_RANK, description="see GET /api/v1/methods", json_schema_extra={"enum": [*METHODS]}
    )
    split: Split | None = Field(
        default=None,
        min_length=2,
        max_length=2,
        description="which poles, by position from 0, form pitch's pair and which yaw's",
    )
    weights: WeightChanges = WeightChanges()
    loops: LoopsChanges = LoopsChanges()
    rotors: RotorsChanges = RotorsChanges()
    friction: AxisFrictionChanges = AxisFrictionChanges()
    rotor_poles: list[Pole] | None = Field(
        default=None,
        min_length=2,
        max_length=2,
        description="of pitch's and of yaw's rotor where they are placed, real, rad/s",
    )
    observer: ObserverChanges | None = Field(
        default=None, description="estimates the states where `scenario.measured` says so"
    )

    def to_spec(self) -> Spec:
        """The core's spec.

        Raises:
            Heli2DofError: a value is out of its range or unknown; its field is the JSON path.
        """
        return judged_spec(self.model_dump(exclude_unset=True, include=NAMES))


class ObserverGains(Model):
    """What estimates the states: x̂' = A x̂ + B u + L (y − C x̂)."""

    L: list[list[float]] = Field(description="4×2, rows θ, ψ, θ̇, ψ̇, columns θ, ψ; 1/s, and 1/s² below")
    poles: list[Complex] = Field(description="eigenvalues of A − LC, rad/s, slowest first")


def observer_reply(L: Rows | None, poles: Iterable[complex] | None) -> Reply:
    """An observer's gain and poles, under ``observer``; nothing of other estimators."""
    return {} if L is None or poles is None else {"observer": {"L": L, "poles": poles_reply(poles)}}


class Gains(told_by({**OF_GAINS, **FIGURES_OF_LOOP})):
    """K in V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇, with rotors placed v_p, v_y in V/V; rows V_p, V_y.

    `integral` is a method's own integral action, V/(rad·s); `pole_error` is left out where the method
    chose its own poles, `eigenvector_condition` where there are too few eigenvectors.
    """

    method: str
    K: list[list[float]] = Field(
        description="V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇, then V/V, columns v_p, v_y; rows V_p, V_y"
    )
    integral: list[list[float]] | None = Field(
        None, description="the method's own integral action, V/(rad·s)"
    )
    A: list[list[float]] = Field(description="of the model, 4×4, x = [θ, ψ, θ̇, ψ̇], or 6×6, [x, v_p, v_y], SI")
    B: list[list[float]] = Field(description="4×2 or 6×2, inputs V_p, V_y, SI")
    poles: list[Complex]
    rotor_poles: list[Complex] | None = Field(
        None, description="asked for where the rotors are placed, rad/s"
    )
    closed_loop_poles: list[Complex]
    optimal_poles: list[Complex] | None = Field(
        None, description="of a quadratic method: its own, those of its integrators among them, rad/s"
    )
    controllability_indices: list[int] = Field(description="one per input")
    observer: ObserverGains | None = Field(None, description="where the request has one, or measures by it")
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


@lru_cache(maxsize=256)
def _indices(parameters: Parameters, theta_0: float) -> tuple[int, ...]:
    """The rig's controllability indices, which no pole changes: scanned once, not at every drag."""
    rig = plant(parameters, theta_0)
    return controllability_indices(rig.A, rig.B)


def model_reply(rig: Plant, placed_rotors: Actuators | None) -> Reply:
    """What no pole changes of the model that K is designed for; each rotor lengthens its motor's chain by one."""
    A, B, indices = rig.A, rig.B, _indices(rig.parameters, rig.theta_0)
    if placed_rotors is not None:
        A, B = with_rotors(A, B * placed_rotors.slope, placed_rotors.tau)
        indices = tuple(i + 1 for i in indices)
    return {"A": A.tolist(), "B": B.tolist(), "controllability_indices": [*indices]}


def gains_of(spec: Spec) -> Reply:
    """The reply to a design alone: its observer is told where it has one."""
    placed = place(spec)
    loop = loop_of(spec, placed)
    observer, unsolved = own_observer(spec, loop.judged, lambda: placed)
    findings = merged(placed.findings, unsolved)
    return gains_reply(loop.judged, placed.size, observer, findings)


def own_observer(
    spec: Spec, loop: Judged, design: Callable[[], Design]
) -> tuple[Reply, tuple[CoreFinding, ...]]:
    """The observer that a request describes, and what is to be said where there is none like that.

    Where the loop acts on it, it is the loop's; elsewhere it is told for its own sake and refuses nothing else.
    """
    if spec.observer is None:
        return {}, ()
    if spec.scenario.measured == "observer":
        return observer_reply(loop.L, loop.observer_poles), ()
    try:
        own = observe(design(), spec.observer)
    except Heli2DofError as error:
        words = f"There is no observer: {error}. {error.hint}".rstrip()
        return {}, (CoreFinding("observer_unavailable", "warning", words),)
    return observer_reply(None if own.L is None else own.L.tolist(), own.poles), ()


def gains_reply(
    loop: Judged, size: Size, observer: Reply, findings: Iterable[CoreFinding], model: Reply | None = None
) -> Reply:
    """K and what it does to the poles, with the whole loop's lag margin, an observer, and what is to be said.

    `model` is `model_reply`'s, if it is known.
    """
    placed, rotors = loop.placed, loop.placed.rotor_poles
    if model is None:
        model = model_reply(placed.plant, None if rotors is None else loop.actuators)
    reply: Reply = {
        "norm": size.norm,
        "spectral_norm": size.spectral_norm,
        "method": placed.method,
        "K": placed.K,
        **model,
        "poles": poles_reply(placed.wanted[:4]),
        "closed_loop_poles": poles_reply(placed.poles),
        **observer,
        "findings": findings_reply(findings),
    }
    if placed.aims:
        reply["pole_error"], reply["pole_error_bound"] = placed.error, placed.bound
    if not placed.aims:
        reply["optimal_poles"] = poles_reply(optimal_poles(placed, loop.actuators))
    if placed.integral is not None:
        reply["integral"] = placed.integral
    if rotors is not None:
        reply["rotor_poles"] = poles_reply(placed.wanted[4:])
    if size.eigenvector_condition is not None:
        reply["eigenvector_condition"] = size.eigenvector_condition
    if loop.lag_margin is not None:
        reply["lag_margin"] = loop.lag_margin
    return reply


def loops_reply(outer: OuterLoop) -> Reply:
    """PI values of both axes."""
    return {axis: place.proposal(getattr(outer, axis)) for axis, place in LOOP.items()}


def suggestion_reply(suggestion: CoreSuggestion) -> Reply:
    """PI values, the whole loop's poles with them, and the rule in words."""
    loop = suggestion.loop
    return reply_of(
        Suggestion, suggestion, loops=loops_reply(suggestion.outer), loop_poles=loop.poles, stable=loop.stable
    )
