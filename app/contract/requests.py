"""The contract's requests as Pydantic models, and the only way from them to the core.

Every field is optional: what is left out comes from the preset. Unknown fields are refused.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any

from pydantic import BaseModel, Field, create_model

from heli2dof_core import PoleSet, Preset, Spec, preset
from heli2dof_core.checks import require_known
from heli2dof_core.design import FULL_RANK
from heli2dof_core.placement.method import Weights
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.presets import DEFAULT
from heli2dof_core.scenario import Digital, Disturbance, Model, Scenario
from heli2dof_core.signals import INPUTS, OUTPUTS, STATES, Signal
from heli2dof_core.weights import bryson_weights

from .fields import Pole, PositiveWeight, PresetName, Split, Strict, Weight, Whole, asked
from .places import (
    DIGITAL,
    DISTURBANCE,
    ENCODERS,
    INITIAL,
    LIMITS,
    LOOP,
    OUTER,
    PARAMETERS,
    POINT,
    REFERENCE,
    SCENARIO,
    STRUCTURE,
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


def _weights_of(name: str, signals: Iterable[Signal], kind: Any, meaning: str) -> type[Strict]:
    fields: dict[str, Any] = {
        s.name: (kind | None, Field(default=None, description=meaning)) for s in signals
    }
    return create_model(name, __base__=Strict, **fields)


StateWeights = _weights_of("StateWeights", STATES, Weight, "on Q's diagonal")
InputWeights = _weights_of("InputWeights", INPUTS, PositiveWeight, "on R's diagonal")
IntegralWeights = _weights_of("IntegralWeights", OUTPUTS, PositiveWeight, "on the integral of this error")


class WeightChanges(Strict):
    """Weights of the quadratic methods that differ from Bryson's rule for the preset's limits."""

    states: StateWeights = StateWeights()  # pyright: ignore[reportInvalidTypeForm]
    inputs: InputWeights = InputWeights()  # pyright: ignore[reportInvalidTypeForm]
    integrals: IntegralWeights = IntegralWeights()  # pyright: ignore[reportInvalidTypeForm]

    def to_weights(self, base: Weights) -> Weights:
        """The core's weights; what is left out comes from `base`."""

        def merge(changes: BaseModel, own: tuple[float, ...]) -> tuple[float, ...]:
            given = changes.model_dump().values()
            return tuple(b if g is None else g for g, b in zip(given, own, strict=True))

        if not self.model_fields_set:
            return base
        return Weights(
            merge(self.states, base.states),
            merge(self.inputs, base.inputs),
            merge(self.integrals, base.integrals),
        )


class DesignRequest(asked(STRUCTURE, OUTER)):
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

    def to_spec(self) -> Spec:
        """The core's spec.

        Raises:
            Heli2DofError: a value is out of its range or unknown; its field is the JSON path.
        """
        base = preset(self.preset)
        require_known(self.method, METHODS, "method")  # also where another is used
        loops = {
            axis: place.changed(getattr(base.outer, axis), getattr(self.loops, axis))
            for axis, place in LOOP.items()
        }
        return Spec(
            parameters=PARAMETERS.changed(base.parameters, self.parameters),
            limits=LIMITS.changed(base.limits, self.limits),
            theta_0=self._theta_0(base),
            poles=self._poles(base),
            structure=STRUCTURE.changed(base.structure, self),
            outer=OUTER.changed(base.outer, self, **loops),
            scenario=self._scenario(base),
            method=self.method,
            weights=self.weights.to_weights(bryson_weights(base.limits)),
        )

    def _scenario(self, base: Preset) -> Scenario:
        return base.scenario

    def _theta_0(self, base: Preset) -> float:
        given = {} if self.operating_point is None else POINT.given(self.operating_point)
        return given.get("theta_0", base.theta_0)

    def _poles(self, base: Preset) -> PoleSet:
        values = base.poles.values if self.poles is None else self.poles
        if self.split is None:
            return base.poles if self.poles is None else PoleSet(values)
        return PoleSet.dealt(values, self.split)


class RgaRequest(DesignRequest):
    """A design, and frequencies at which |RGA(jω)| is wanted."""

    frequencies: list[Annotated[float, Field(ge=0, le=1e6)]] = Field(
        default=[], max_length=2000, description="rad/s"
    )


class LoopsRequest(DesignRequest):
    """A design with its outer loop, and frequencies at which L(jω) is wanted."""

    frequencies: list[Annotated[float, Field(ge=1e-9, le=1e6)]] = Field(
        min_length=1, max_length=2000, description="rad/s"
    )


class Reference(asked(REFERENCE)):
    """Reference angles after t = 0, absolute."""


class Initial(asked(INITIAL)):
    """State at t = 0; angles are absolute."""


class EncoderCounts(asked(ENCODERS)):
    """Counts per revolution; 0 measures exactly."""


class DigitalController(asked(DIGITAL)):
    """The rig's own controller: sampled, quantized, filtered, late, noisy."""

    encoders: EncoderCounts | None = Field(default=None, description="the preset's where left out")


class InputDisturbance(asked(DISTURBANCE)):
    """Volts that act on the motors besides the controller's, from `time` on."""


class ScenarioChanges(asked(SCENARIO)):
    """An experiment: references step at t = 0; without a reference the preset's own is used."""

    model: Model = Field(default="nonlinear", description="ignored by evaluate, which computes both")
    reference: Reference | None = None
    initial: Initial = Initial()
    digital: DigitalController | None = Field(default=None, description="nonlinear model; null is continuous")
    disturbance: InputDisturbance | None = Field(default=None, description="nonlinear model")

    def to_scenario(self, base: Scenario, encoders: tuple[int, int]) -> Scenario:
        """The core's scenario; `base` and `encoders` are the preset's.

        Raises:
            Heli2DofError: a value is out of its range.
        """
        others = INITIAL.given(self.initial)
        if self.reference is not None:
            others |= {"theta": None, "psi": None, **REFERENCE.given(self.reference)}
        if self.digital is not None:
            counts = {} if self.digital.encoders is None else ENCODERS.given(self.digital.encoders)
            others["digital"] = DIGITAL.changed(Digital(encoders=encoders), self.digital, **counts)
        if self.disturbance is not None:
            others["disturbance"] = DISTURBANCE.changed(Disturbance(), self.disturbance)
        return SCENARIO.changed(base, self, **others)


class StepRequest(DesignRequest):
    """A design and an experiment."""

    scenario: ScenarioChanges = ScenarioChanges()

    def _scenario(self, base: Preset) -> Scenario:
        return self.scenario.to_scenario(base.scenario, base.encoders)


class ResponseRequest(StepRequest):
    """As a step request, and what the reply shall hold besides."""

    states: bool = Field(default=False, description="also reply the rates, and the integrals of the errors")


class EvaluateRequest(StepRequest):
    """As a step request; both models are computed."""

    each_axis: bool = Field(default=False, description="also step each axis of the reference alone")


class CompareRequest(StepRequest):
    """A design, an experiment, and the methods to compare."""

    methods: list[Annotated[str, Field(json_schema_extra={"enum": [*METHODS]})]] | None = Field(
        default=None, max_length=len(METHODS), description="all by default"
    )


class LiveRequest(EvaluateRequest):
    """An evaluate request with the number that its answer will carry."""

    seq: Whole = Field(ge=0, le=2**53)
