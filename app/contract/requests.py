"""The contract's requests as Pydantic models, and the only way from them to the core.

Every field is optional: what is left out comes from the preset. Unknown fields are refused.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import replace
from typing import Annotated, Any

from pydantic import BaseModel, Field, create_model

from heli2dof_core import OuterLoop, PIGains, PoleSet, Preset, Spec, Structure, preset
from heli2dof_core.checks import require_known
from heli2dof_core.couplings import Coupling, Lead
from heli2dof_core.design import FULL_RANK
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.placement.method import Weights
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.plant import STEEPEST
from heli2dof_core.presets import DEFAULT
from heli2dof_core.scenario import (
    LONGEST,
    MOST_SAMPLES,
    AntiWindup,
    Digital,
    Disturbance,
    Limits,
    Model,
    Outer,
    Pairing,
    Rates,
    Scenario,
)
from heli2dof_core.signals import INPUTS, OUTPUTS, STATES, Signal
from heli2dof_core.weights import bryson_weights

from .fields import (
    Angle,
    Pole,
    PositiveWeight,
    PresetName,
    Seconds,
    Split,
    Strict,
    Weight,
    Whole,
    optional,
    within,
)

ParameterChanges = create_model(
    "ParameterChanges",
    __base__=Strict,
    **{  # pyright: ignore[reportArgumentType, reportCallIssue]
        name: (
            optional(info["low"], info["high"]),
            Field(default=None, description=f"{info['meaning']}, {info['unit']}"),
        )
        for name, info in PARAMETER_INFO.items()
    },
)


class LimitChanges(Strict):
    """Limits that differ from the preset's."""

    V_p: Annotated[float, within(1e-3, 1e6)] | None = Field(default=None, description="limit of |V_p|, V")
    V_y: Annotated[float, within(1e-3, 1e6)] | None = Field(default=None, description="limit of |V_y|, V")
    theta: Annotated[float, within(1e-3, 3.2)] | None = Field(
        default=None, description="pitch travel ±theta, rad; null where it is free"
    )


class OperatingPoint(Strict):
    """Where the rig rests and the model is linearized."""

    theta: Annotated[float, within(-STEEPEST, STEEPEST)] = Field(
        default=0.0, description="pitch angle θ₀, rad"
    )


class LoopChanges(Strict):
    """PI(s) = kp (1 + 1/(ti s)) of one axis."""

    kp: Annotated[float, within(-1e6, 1e6)] | None = Field(default=None, description="V/rad")
    ti: Annotated[float, within(1e-6, 1e6)] | None = Field(default=None, description="s")


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


class DesignRequest(Strict):
    """A design: what differs from the preset."""

    preset: PresetName = Field(default=DEFAULT, description="name of a preset, see GET /api/v1/presets")
    parameters: ParameterChanges = ParameterChanges()  # pyright: ignore[reportInvalidTypeForm]
    limits: LimitChanges = LimitChanges()
    operating_point: OperatingPoint | None = None
    poles: list[Pole] | None = Field(
        default=None, min_length=4, max_length=4, description="p₁, p₂ (pitch's pair), p₃, p₄ (yaw's), rad/s"
    )
    method: str = Field(
        default=FULL_RANK, description="see GET /api/v1/methods", json_schema_extra={"enum": [*METHODS]}
    )
    coupling: Coupling | None = None
    lead: Lead | None = Field(default=None, description="axis that leads where the coupling is triangular")
    split: Split | None = Field(
        default=None,
        min_length=2,
        max_length=2,
        description="which poles, by position from 0, form pitch's pair and which yaw's",
    )
    shift: Annotated[float, within(-1e6, 1e6)] | None = Field(
        default=None,
        description="shift c of Luenberger's basis, q₁ → q₁ + c q₂ (yaw leading: q₂ → q₂ + c q₁)",
    )
    weights: WeightChanges = WeightChanges()
    outer: Outer | None = Field(
        default=None, description="pi: two PI loops (Fig. 3); none: inner loop alone (Fig. 2)"
    )
    pairing: Pairing | None = None
    decoupler: bool | None = Field(
        default=None, description="static decoupler between the PI loops and the motors"
    )
    loops: LoopsChanges = LoopsChanges()

    def to_spec(self) -> Spec:
        """The core's spec.

        Raises:
            Heli2DofError: a value is out of its range or unknown; its field is the JSON path.
        """
        base = preset(self.preset)
        require_known(self.method, METHODS, "method")  # also where another is used
        point = base.theta_0 if self.operating_point is None else self.operating_point.theta
        return Spec(
            parameters=base.parameters.replaced(self.parameters.model_dump(exclude_none=True)),
            limits=self._limits(base.limits),
            theta_0=point,
            poles=self._poles(base),
            structure=Structure(
                self.coupling or base.structure.coupling, self.lead or base.structure.lead, self.shift
            ),
            outer=self._outer(base),
            scenario=self._scenario(base),
            method=self.method,
            weights=self.weights.to_weights(bryson_weights(base.limits)),
        )

    def _scenario(self, base: Preset) -> Scenario:
        return base.scenario

    def _poles(self, base: Preset) -> PoleSet:
        values = base.poles.values if self.poles is None else self.poles
        if self.split is None:
            return base.poles if self.poles is None else PoleSet(values)
        return PoleSet.dealt(values, self.split)

    def _limits(self, base: Limits) -> Limits:
        given = self.limits.model_dump(exclude_unset=True)
        changes = {name: value for name, value in given.items() if value is not None or name == "theta"}
        return replace(base, **changes) if changes else base

    def _outer(self, base: Preset) -> OuterLoop:
        pi = {}
        for axis in ("pitch", "yaw"):
            own: PIGains = getattr(base.outer, axis)
            changes: LoopChanges = getattr(self.loops, axis)
            kp = own.kp if changes.kp is None else changes.kp
            pi[axis] = PIGains(kp, own.ti if changes.ti is None else changes.ti)
        return OuterLoop(
            outer=self.outer or base.outer.outer,
            pairing=self.pairing or base.outer.pairing,
            decoupler=base.outer.decoupler if self.decoupler is None else self.decoupler,
            **pi,
        )


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


class Reference(Strict):
    """Reference angles after t = 0, absolute."""

    theta: Angle | None = Field(default=None, description="rad")
    psi: Angle | None = Field(default=None, description="rad")


class Initial(Strict):
    """State at t = 0; angles are absolute, and at rest where left out."""

    theta: Angle | None = Field(default=None, description="rad")
    psi: Angle | None = Field(default=None, description="rad")
    theta_dot: Angle = Field(default=0.0, description="rad/s")
    psi_dot: Angle = Field(default=0.0, description="rad/s")


class EncoderCounts(Strict):
    """Counts per revolution; 0 measures exactly."""

    theta: Whole = Field(default=4096, ge=0, le=10**7, description="of pitch")
    psi: Whole = Field(default=8192, ge=0, le=10**7, description="of yaw")


class DigitalController(Strict):
    """The rig's own controller: sampled, quantized, filtered, late, noisy."""

    sample_time: Annotated[float, within(1e-4, 1.0)] = Field(
        default=0.002, description="s; voltages are held between samples"
    )
    delay: bool = Field(
        default=False, description="voltages reach the motors one sample late, after the trim"
    )
    encoders: EncoderCounts | None = Field(default=None, description="the preset's where left out")
    rates: Rates = Field(default="filtered", description="filtered: from the angles, 20 Hz, damping 0.85")
    noise: Annotated[float, within(0.0, 1.0)] = Field(
        default=0.0, description="standard deviation on the measured angles, rad"
    )
    seed: Whole = Field(default=0, ge=0, le=2**32 - 1, description="of the noise")


class InputDisturbance(Strict):
    """Volts that act on the motors besides the controller's, from `time` on."""

    V_p: Annotated[float, within(-1e3, 1e3)] = Field(0.0, description="pitch motor, V")
    V_y: Annotated[float, within(-1e3, 1e3)] = Field(0.0, description="yaw motor, V")
    time: Annotated[float, within(0.0, LONGEST)] = Field(default=0.0, description="s")


class ScenarioChanges(Strict):
    """An experiment: references step at t = 0; without a reference the preset's own is used."""

    model: Model = Field(default="nonlinear", description="ignored by evaluate, which computes both")
    reference: Reference | None = None
    duration: Seconds | None = Field(default=None, description="s")
    samples: Annotated[Whole, within(2, MOST_SAMPLES)] | None = Field(
        default=None, description="t = linspace(0, duration, samples)"
    )
    initial: Initial = Initial()
    saturation: bool = True
    anti_windup: AntiWindup = "clamping"
    tracking_time: Annotated[float, within(1e-4, 1e4)] | None = Field(
        default=None,
        description="of back-calculation, s, 1e-4 to 1e4; each loop's integral time where left out",
    )
    travel_stops: bool = True
    trim_feedforward: bool = True
    rtol: Annotated[float, within(1e-12, 1e-2)] = Field(
        default=1e-8, description="tolerance of the nonlinear integration"
    )
    digital: DigitalController | None = Field(default=None, description="nonlinear model; null is continuous")
    disturbance: InputDisturbance | None = Field(default=None, description="nonlinear model")

    def to_scenario(self, base: Scenario, encoders: tuple[int, int]) -> Scenario:
        """The core's scenario; `base` and `encoders` are the preset's.

        Raises:
            Heli2DofError: a value is out of its range.
        """
        theta, psi = base.theta, base.psi
        if self.reference is not None:
            theta, psi = self.reference.theta, self.reference.psi
        return Scenario(
            theta=theta,
            psi=psi,
            duration=base.duration if self.duration is None else self.duration,
            samples=base.samples if self.samples is None else self.samples,
            initial=(self.initial.theta, self.initial.psi, self.initial.theta_dot, self.initial.psi_dot),
            saturation=self.saturation,
            anti_windup=self.anti_windup,
            tracking_time=self.tracking_time,
            travel_stops=self.travel_stops,
            trim_feedforward=self.trim_feedforward,
            rtol=self.rtol,
            digital=self._digital(encoders),
            disturbance=self.disturbance and Disturbance(**self.disturbance.model_dump()),
        )

    def _digital(self, encoders: tuple[int, int]) -> Digital | None:
        if self.digital is None:
            return None
        given = self.digital
        counts = encoders if given.encoders is None else (given.encoders.theta, given.encoders.psi)
        return Digital(given.sample_time, given.delay, counts, given.rates, given.noise, given.seed)


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
