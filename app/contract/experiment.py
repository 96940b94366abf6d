"""An experiment with a design, and the step response that is replied."""

from __future__ import annotations

from pydantic import Field

from heli2dof_core import Loop
from heli2dof_core.errors import within_field
from heli2dof_core.evaluate import Step as CoreStep
from heli2dof_core.export import Beside
from heli2dof_core.figures import AXIS, MOTOR, STEP
from heli2dof_core.figures import LOOP as FIGURES_OF_LOOP
from heli2dof_core.judged import Judged
from heli2dof_core.metrics import StepMetrics
from heli2dof_core.request import (
    DIGITAL,
    DISTURBANCE,
    ENCODERS,
    INITIAL,
    NOISE,
    REFERENCE,
    SCENARIO,
)
from heli2dof_core.scenario import Model as RigModel
from heli2dof_core.signals import INTEGRALS, OUTPUTS, STATES

from .design import DesignRequest, ObserverGains, observer_reply
from .fields import Strict, asked
from .model import (
    Angles,
    Complex,
    Finding,
    Model,
    Reply,
    Voltages,
    findings_reply,
    poles_reply,
    present,
    told_by,
    voltages_reply,
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


class AngleNoise(asked(NOISE)):
    """White noise on the measured angles, rad, one value per sample."""


class ScenarioChanges(asked(SCENARIO)):
    """An experiment: references step at t = 0; without a reference the preset's own is used."""

    model: RigModel = Field(default="nonlinear", description="ignored by evaluate, which computes both")
    reference: Reference | None = None
    initial: Initial = Initial()
    noise: AngleNoise = AngleNoise()
    digital: DigitalController | None = Field(default=None, description="nonlinear model; null is continuous")
    disturbance: InputDisturbance | None = Field(default=None, description="nonlinear model")


class StepRequest(DesignRequest):
    """A design and an experiment."""

    scenario: ScenarioChanges = ScenarioChanges()


THREADS = 2
"""That a map, a track or a search takes of the server."""
MOST_PINS = 6
"""Designs beside the one that is exported: more have no room on a report's two pages."""


class PinnedDesign(StepRequest):
    """A design that a report lists beside its own."""

    name: str = Field(min_length=1, max_length=60, description="what its row is called")


class Required(Strict):
    """What is asked of the rig's steps, each axis alone, and of its loop."""

    settling: float | None = Field(default=None, gt=0, le=1e3, description="settling time, at most, s")
    overshoot: float | None = Field(default=None, ge=0, le=100, description="overshoot, at most, %")
    lag: float | None = Field(default=None, gt=0, le=10, description="lag margin, at least, s")


class ExportRequest(StepRequest):
    """A design, an experiment, and what stands beside them in a report."""

    pins: list[PinnedDesign] = Field(
        default_factory=list,
        max_length=MOST_PINS,
        description="listed in the report with their figures; other formats leave them out",
    )

    required: Required = Field(default_factory=Required, description="judged in the report")
    remarks: bool = Field(default=True, description="whether the report tells the findings")

    def beside(self) -> Beside:
        """What a report has beside the design.

        Raises:
            Heli2DofError: as `to_spec`.
        """
        found = []
        for i, pin in enumerate(self.pins):
            with within_field(f"pins.{i}"):
                found.append((pin.name, pin.to_spec()))
        return Beside(found, present(self.required.model_dump()), self.remarks)


class ResponseRequest(StepRequest):
    """As a step request, and what the reply shall hold besides."""

    states: bool = Field(default=False, description="also reply the rates, and the integrals of the errors")


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
    """What the outputs do not show; the integrals are left out where nothing integrates."""

    theta_dot: list[float] = Field(description="rad/s")
    psi_dot: list[float] = Field(description="rad/s")
    z_p: list[float] | None = Field(None, description="integral of the pitch error, rad·s")
    z_y: list[float] | None = Field(None, description="integral of the yaw error, rad·s")
    w: list[list[float]] | None = Field(
        None,
        description="states of what estimates, a row each, in deviations from the trim: an observer's theta, psi, "
        "theta_dot, psi_dot and, where the rotors are placed, v_p, v_y; or filters' angles and rates by frequency",
    )


class Rotors(Model):
    """The rotors' speeds, as the voltages that would hold them, V; left out where they follow at once.

    Linear: deviations from the trim.
    """

    v_p: list[float] = Field(description="pitch motor's rotor, V")
    v_y: list[float] = Field(description="yaw motor's rotor, V")


class OfLoop(told_by(FIGURES_OF_LOOP)):
    """Figures of the whole loop; s."""


class Step(OfLoop):
    """A step response; s, rad, V. Linear voltages are deviations from the trim.

    `states` are there where they are asked for.
    """

    t: list[float] = Field(description="s")
    theta: list[float] = Field(description="pitch, absolute, rad")
    psi: list[float] = Field(description="yaw, absolute, rad")
    V_p: list[float] = Field(description="pitch motor, V")
    V_y: list[float] = Field(description="yaw motor, V")
    states: States | None = None
    rotors: Rotors | None = None
    reference: Angles
    trim: Voltages
    metrics: Metrics
    loop_poles: list[Complex]
    observer: ObserverGains | None = None
    stable: bool
    findings: list[Finding]


class BothModels(Model):
    """The same experiment by both models."""

    linear: Step
    nonlinear: Step


def loop_reply(loop: Judged) -> Reply:
    """What every response of a loop has in common."""
    reply: Reply = {
        "loop_poles": poles_reply(loop.poles),
        "stable": loop.stable,
        "trim": voltages_reply(loop.trim),
        **observer_reply(loop.L, loop.observer_poles),
    }
    if loop.lag_margin is not None:
        reply["lag_margin"] = loop.lag_margin
    return reply


def step_reply(step: CoreStep, loop: Loop) -> Reply:
    """Trajectories and metrics of one response; the long arrays are NumPy's."""
    response, rotors = step.response, step.response.rotors
    curves = {
        "t": response.t,
        "theta": response.theta,
        "psi": response.psi,
        "V_p": response.V_p,
        "V_y": response.V_y,
        **({} if rotors is None else {"rotors": dict(zip(("v_p", "v_y"), rotors, strict=True))}),
    }
    theta, psi = response.reference
    return {
        **loop_reply(loop.judged),
        **curves,
        "reference": {"theta": theta, "psi": psi},
        "metrics": metrics_reply(step.metrics),
        "findings": findings_reply(step.findings),
    }


def states_reply(step: CoreStep) -> Reply:
    """The states that are no outputs and no rotors' speeds, under ``states``: those that this response has."""
    response = step.response
    rows = {signal.name: row for signal, row in zip(response.signals, response.states, strict=False)}
    hidden = (*STATES[len(OUTPUTS) :], *INTEGRALS)
    found: Reply = {signal.name: rows[signal.name] for signal in hidden if signal.name in rows}
    estimate = [row for name, row in rows.items() if name.startswith("w_")]
    return {"states": found | ({"w": estimate} if estimate else {})}


def metrics_reply(metrics: StepMetrics) -> Reply:
    """Metrics by axis and motor."""
    motors = {name: dict(vars(motor)) for name, motor in metrics.motors.items()}
    axes = {name: present(vars(axis)) for name, axis in metrics.axes.items()}
    other = {} if metrics.coupling_peak is None else {"coupling_peak": metrics.coupling_peak}
    return {**axes, **other, **motors}
