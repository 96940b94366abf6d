"""Spec → Report: everything that a change of the design changes, in one pure function."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from .behaviour import Experiment, behaviour_remarks
from .design import Design, design
from .estimators import estimator
from .figures import Margins
from .findings import Finding, merged
from .interaction import Interaction, interaction
from .loop import Loop, close_loop
from .margins import loop_margins, margin_table
from .metrics import StepMetrics, step_metrics
from .placement.registry import method
from .plant import plant
from .scenario import Model, Scenario
from .sensitivity import Sensitivity, loop_sensitivity
from .simulation.courses import Courses, run_experiments
from .simulation.digital import simulate_digital
from .simulation.linear import simulate_linear
from .simulation.nonlinear import simulate_nonlinear
from .simulation.response import Response
from .spec import Spec
from .tables import Shown, Table, number
from .weights import bryson_weights


@dataclass(frozen=True, repr=False)
class Step(Shown):
    """One response, its metrics, and all remarks on it: on its design, its loop and itself, each once."""

    response: Response
    metrics: StepMetrics
    findings: tuple[Finding, ...]

    def summary(self) -> str:
        """The model and its metrics."""
        return f"{self.response.model}; {self.metrics.summary()}"

    def tables(self) -> tuple[Table, ...]:
        """Those of the metrics."""
        return self.metrics.tables()


@dataclass(frozen=True, repr=False)
class Report(Shown):
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
    _spec: Spec
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
        experiments = (self.step, *self.axis_steps.values())
        steps = [step for both in experiments for step in both.values()]
        return merged(*own, *(step.response.findings for step in steps), self._behaviour(experiments))

    def summary(self) -> str:
        """Stability, size of K and the rig's step."""
        stability = "stable" if self.loop.stable else "unstable"
        rig = self.step["nonlinear"].metrics.summary()
        return f"{stability}; ‖K‖ = {number(self.design.norm)}; {len(self.findings)} findings; {rig}"

    def tables(self) -> tuple[Table, ...]:
        """K and its poles, RGA, the whole loop, margins, the rig's step and what is to be said of it all."""
        findings = ((finding.severity, finding.message) for finding in self.findings)
        return (
            *self.design.tables(),
            *self.interaction.tables(),
            *self.loop.tables(),
            *(() if self.margins is None else (margin_table(self.margins),)),
            *self.step["nonlinear"].tables(),
            *((Table.of("findings", ("", "what"), findings),) if self.findings else ()),
        )

    def _behaviour(self, experiments: Iterable[Mapping[Model, Step]]) -> tuple[Finding, ...]:
        pairs = [
            Experiment(*((each[model].response, each[model].metrics) for model in ("linear", "nonlinear")))
            for each in experiments
        ]
        return behaviour_remarks(self.loop, self._spec.limits, self._spec.scenario, self.margins, pairs)

    def _both(self, n: int) -> dict[Model, Step]:
        nonlinear = self._nonlinear[n] if self._nonlinear else self._step(n, "nonlinear")
        return {"linear": self._step(n, "linear"), "nonlinear": nonlinear}

    def _step(self, n: int, model: Model) -> Step:
        response = self._courses.response(n, model)
        return _measured(self.loop, response)


def place(spec: Spec) -> Design:
    """The design alone."""
    weights = spec.weights or bryson_weights(spec.limits) if method(spec.method).weighted else None
    rig, rotors = plant(spec.parameters, spec.theta_0), spec.rotor_poles if spec.place_rotors else None
    task = (rig, spec.poles, spec.structure, spec.method, weights)
    return design(*task, actuators=spec.actuators, rotor_poles=rotors)


def loop_of(spec: Spec, placed: Design | None = None) -> Loop:
    """The whole loop; `placed` is the spec's design, if it is known."""
    found = placed or place(spec)
    return close_loop(found, spec.outer, estimator(found, spec.scenario.measured, spec.observer))


def simulate(loop: Loop, spec: Spec, model: Model, most_steps: int | None = None) -> Step:
    """The scenario's response by one model, with its metrics; `most_steps` as in `simulate_nonlinear`.

    A disturbance does not count into the steps' figures: those are of the same experiment without it.
    """
    if model == "linear":
        return _measured(loop, simulate_linear(loop, spec.scenario, most_steps))
    return _step_of_the_rig(loop, spec, most_steps)


def _step_of_the_rig(loop: Loop, spec: Spec, most_steps: int | None, calm: Response | None = None) -> Step:
    """The nonlinear response; `calm` is the same without the disturbance, if it is known."""
    scenario = spec.scenario
    response = _on_the_rig(loop, spec, scenario, most_steps)
    if scenario.disturbance is None:
        return _measured(loop, response)
    return _measured(
        loop, response, calm or _on_the_rig(loop, spec, replace(scenario, disturbance=None), most_steps)
    )


def _on_the_rig(loop: Loop, spec: Spec, scenario: Scenario, most_steps: int | None) -> Response:
    digital = scenario.controller
    if digital is None:
        return simulate_nonlinear(loop, spec.limits, scenario, most_steps)
    return simulate_digital(loop, spec.limits, scenario, digital)


def _measured(loop: Loop, response: Response, calm: Response | None = None) -> Step:
    """With its metrics; those of its steps from the experiment without a disturbance, where it has one."""
    metrics = step_metrics(response, calm)
    if calm is not None and metrics.axes:
        response = replace(response, findings=(*response.findings, _CALM))
    known = loop.all_findings
    return Step(response, metrics, merged(known, response.findings) if response.findings else known)


_CALM = Finding(
    "disturbance_left_out",
    "info",
    "The steps' figures (rise, settling, overshoot, errors) are those without the disturbance; the motors' "
    "include it.",
)


def _without(scenario: Scenario, axis: str) -> Scenario:
    """The scenario without the reference of an axis: all else was checked when it was made."""
    own = object.__new__(Scenario)
    vars(own).update(vars(scenario) | {axis: None})
    return own


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
    loop = loop_of(spec, placed)
    scenarios = {"": scenario}
    if each_axis:
        scenarios |= {
            name: _without(scenario, other)
            for name, other in (("theta", "psi"), ("psi", "theta"))
            if getattr(scenario, name) is not None
        }
    courses = run_experiments(loop, spec.limits, [*scenarios.values()], most_steps)
    nonlinear: tuple[Step, ...] = ()
    if scenario.controller is not None or scenario.disturbance is not None:
        nonlinear = tuple(
            _step_of_the_rig(
                loop,
                replace(spec, scenario=each),
                most_steps,
                courses.response(n, "nonlinear") if scenario.controller is None else None,
            )
            for n, each in enumerate(scenarios.values())
        )
    return Report(
        placed,
        interaction(placed, spec.outer.pairing),
        loop,
        loop_margins(loop),
        loop_sensitivity(loop),
        spec,
        courses,
        tuple(scenarios)[1:],
        nonlinear,
    )
