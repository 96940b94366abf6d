"""The rigs: what is replied of each."""

from __future__ import annotations

from collections.abc import Mapping

from pydantic import Field

from heli2dof_core import Preset as CorePreset
from heli2dof_core.components import COMPONENT_INFO
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.presets import RigName
from heli2dof_core.quantities import Quantity
from heli2dof_core.request import (
    FRICTION,
    LIMITS,
    OUTER,
    POINT,
    REFERENCE,
    ROTOR,
    ROTORS,
    SCENARIO,
    STRUCTURE,
    WEIGHTS,
)
from heli2dof_core.weights import bryson_weights

from .design import Loops, loops_reply
from .model import Angles, Complex, Model, Reply, proposed, reply_of


class Limits(proposed(LIMITS)):
    """Voltage limits, V, and pitch travel, rad, where it is not free."""


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


class Rotor(proposed(ROTOR["pitch"])):
    """One motor's rotor."""


class RotorPair(Model):
    """Both motors' rotors."""

    pitch: Rotor
    yaw: Rotor


class Friction(proposed(FRICTION["pitch"])):
    """Coulomb friction of one axis, with stiction."""


class FrictionPair(Model):
    """Friction of both axes."""

    pitch: Friction
    yaw: Friction


class ProposedQ(proposed(WEIGHTS["states"])):
    """The diagonal of Q."""


class ProposedR(proposed(WEIGHTS["inputs"])):
    """The diagonal of R."""


class ProposedQz(proposed(WEIGHTS["integrals"])):
    """The diagonal of Q_z."""


class Weights(Model):
    """Weights of the quadratic methods by Bryson's rule for this rig's limits."""

    states: ProposedQ
    inputs: ProposedR
    integrals: ProposedQz


class Preset(proposed(STRUCTURE, OUTER, ROTORS)):
    """A rig with its source and everything that a design may change."""

    name: str
    title: str
    source: str
    rig: RigName
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
    rotors: RotorPair
    friction: FrictionPair
    rotor_poles: list[Complex]
    weights: Weights
    scenario: Scenario


def _ranges(quantities: Mapping[str, Quantity]) -> Reply:
    return {
        name: {"meaning": q.meaning, "unit": q.unit, "minimum": q.low, "maximum": q.high}
        for name, q in quantities.items()
    }


def preset_reply(preset: CorePreset) -> Reply:
    """A preset with everything that a design may change."""
    scenario, weights = preset.scenario, bryson_weights(preset.limits)
    return reply_of(
        Preset,
        preset,
        **STRUCTURE.proposal(preset.structure),
        **OUTER.proposal(preset.outer),
        parameters=preset.parameters.as_dict(),
        parameter_info=_ranges(PARAMETER_INFO),
        components={} if preset.components is None else preset.components.as_dict(),
        component_info={
            name: {"meaning": q.meaning, "unit": q.unit, "printed": q.symbol}
            for name, q in COMPONENT_INFO.items()
        },
        limits=LIMITS.proposal(preset.limits),
        limit_info=_ranges({name: known.quantity for name, known in LIMITS.fields.items()}),
        encoders=dict(zip(("theta", "psi"), preset.encoders, strict=True)),
        operating_point=POINT.proposal(preset),
        poles=preset.poles.values,
        loops=loops_reply(preset.outer),
        **ROTORS.proposal(preset),
        rotors={axis: place.proposal(getattr(preset.rotors, axis)) for axis, place in ROTOR.items()},
        friction={axis: place.proposal(getattr(preset.friction, axis)) for axis, place in FRICTION.items()},
        rotor_poles=tuple(map(complex, preset.rotor_poles)),
        weights={kind: place.proposal(weights) for kind, place in WEIGHTS.items()},
        scenario={"reference": REFERENCE.proposal(scenario), **SCENARIO.proposal(scenario)},
    )
