"""Spec → Report: everything that a change of the design changes, in one pure function."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .couplings import Structure
from .design import FULL_RANK, Design, design
from .findings import Finding, merged
from .interaction import Interaction, interaction
from .loop import Loop, close_loop
from .margins import Margins, loop_margins
from .metrics import StepMetrics, measured, step_metrics
from .parameters import Parameters
from .placement.method import Weights
from .plant import plant
from .poles import PoleSet
from .presets import Preset
from .sensitivity import Sensitivity, loop_sensitivity
from .simulation.courses import Courses, run_experiments
from .simulation.digital import simulate_digital
from .simulation.linear import simulate_linear
from .simulation.nonlinear import simulate_nonlinear
from .simulation.response import Response
from .spec import Limits, Model, OuterLoop, Scenario
from .weights import bryson_weights


@dataclass(frozen=True)
class Spec:
    """All that a user chooses.

    Attributes:
        parameters, limits, theta_0: the rig and its operating point (rad).
        poles, structure: what full-rank placement shall do.
        method, weights: another placement method, and the weights of a quadratic one.
        outer: the loop around it.
        scenario: the experiment.
    """

    parameters: Parameters
    limits: Limits
    theta_0: float
    poles: PoleSet
    structure: Structure
    outer: OuterLoop
    scenario: Scenario
    method: str = FULL_RANK
    weights: Weights | None = None

    @classmethod
    def from_preset(cls, preset: Preset) -> Spec:
        """The preset's own design and scenario."""
        return cls(
            preset.parameters,
            preset.limits,
            preset.theta_0,
            preset.poles,
            preset.structure,
            preset.outer,
            preset.scenario,
        )


@dataclass(frozen=True)
class Step:
    """One response and its metrics."""

    response: Response
    metrics: StepMetrics


@dataclass(frozen=True)
class Report:
    """What `evaluate` has computed of a spec; its words and tables are made where they are read.

    Attributes:
        design: K and the placed poles.
        interaction: RGA and pairing.
        loop: the whole loop and its poles.
        margins: at the pitch and the yaw motor; None if the loop is unstable.
        sensitivity: at both motors at once; None if the loop is unstable.
    """

    design: Design
    interaction: Interaction
    loop: Loop
    margins: tuple[Margins, Margins] | None
    sensitivity: Sensitivity | None
    _courses: Courses
    _alone: tuple[str, ...]
    _nonlinear: tuple[Step, ...]

    @cached_property
    def step(self) -> dict[Model, Step]:
        """The scenario's response, by model."""
        return self._both(0)

    @cached_property
    def axis_steps(self) -> dict[str, dict[Model, Step]]:
        """By output name and model, each axis stepped alone; empty unless asked for."""
        return {name: self._both(n) for n, name in enumerate(self._alone, 1)}

    @cached_property
    def findings(self) -> tuple[Finding, ...]:
        """All remarks, the gravest first."""
        own = (self.design.findings, self.loop.findings, self.interaction.findings)
        steps = [step for steps in (self.step, *self.axis_steps.values()) for step in steps.values()]
        return merged(*own, *(step.response.findings for step in steps))

    def _both(self, n: int) -> dict[Model, Step]:
        nonlinear = self._nonlinear[n] if self._nonlinear else self._step(n, "nonlinear")
        return {"linear": self._step(n, "linear"), "nonlinear": nonlinear}

    def _step(self, n: int, model: Model) -> Step:
        response = self._courses.response(n, model)
        return Step(response, measured(response, *self._courses.measures(n, model)))


def place(spec: Spec) -> Design:
    """The design alone."""
    weights = None if spec.method == FULL_RANK else spec.weights or bryson_weights(spec.limits)
    return design(plant(spec.parameters, spec.theta_0), spec.poles, spec.structure, spec.method, weights)


def simulate(loop: Loop, spec: Spec, model: Model, most_steps: int | None = None) -> Step:
    """The scenario's response by one model, with its metrics; `most_steps` as in `simulate_nonlinear`."""
    if model == "linear":
        response = simulate_linear(loop, spec.scenario)
    elif spec.scenario.digital is None:
        response = simulate_nonlinear(loop, spec.limits, spec.scenario, most_steps)
    else:
        response = simulate_digital(loop, spec.limits, spec.scenario, spec.scenario.digital)
    trim = loop.design.plant.trim if model == "nonlinear" else np.zeros(2)
    return Step(response, step_metrics(response, trim))


def evaluate(spec: Spec, *, each_axis: bool = False, most_steps: int | None = None) -> Report:
    """Design, interaction, whole loop, margins and responses of a spec.

    Args:
        spec: what the user chose.
        each_axis: also step each axis of the scenario's reference alone, as the paper's Figs. 4, 5.
        most_steps: after which a nonlinear response is given up, with the finding `integration_stopped`.

    Raises:
        Heli2DofError: see `errors`.
    """
    placed, scenario = place(spec), spec.scenario
    loop = close_loop(placed, spec.outer)
    scenarios = {"": scenario}
    if each_axis:
        scenarios |= {
            name: replace(scenario, **{other: None})
            for name, other in (("theta", "psi"), ("psi", "theta"))
            if getattr(scenario, name) is not None
        }
    courses = run_experiments(loop, spec.limits, [*scenarios.values()], most_steps)
    nonlinear: tuple[Step, ...] = ()
    if scenario.digital is not None or scenario.disturbance is not None:
        specs = (replace(spec, scenario=each) for each in scenarios.values())
        nonlinear = tuple(simulate(loop, each, "nonlinear", most_steps) for each in specs)
    return Report(
        placed,
        interaction(placed, spec.outer.pairing),
        loop,
        loop_margins(loop),
        loop_sensitivity(loop),
        courses,
        tuple(scenarios)[1:],
        nonlinear,
    )
