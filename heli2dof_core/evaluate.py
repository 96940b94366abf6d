"""Spec → Report: everything that a change of the design changes, in one pure function."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from .behaviour import Experiment, behaviour_remarks
from .block import Block, fill_block, has_closed_form
from .design import Design, design
from .estimators import Estimator, Observer, estimator
from .figures import Margins
from .findings import Finding, merged
from .interaction import Interaction
from .kernels.update_layout import DONE, RELATIVE_GAIN
from .loop import Loop, close_loop
from .margins import margin_table
from .metrics import StepMetrics, step_metrics
from .placement.registry import method
from .plant import plant
from .read_block import design_of, exists, loop_in
from .scenario import Model, Scenario
from .sensitivity import Sensitivity, sensitivity_of
from .signals import Floats
from .simulation.digital import simulate_digital, with_sampling_remarks
from .simulation.linear import linear_response, simulate_linear
from .simulation.nonlinear import limited_response, simulate_nonlinear
from .simulation.response import Measured, Response
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
    """What `evaluate` has computed of a spec; objects, words and tables are made of its numbers where they are read.

    Attributes:
        spec: what the user chose.
        block: all numbers, as the kernel `update` has filled them (`kernels.update_layout.block_shapes`).
    """

    spec: Spec
    block: Block
    _placed: Design | None
    _estimator: Estimator | None
    _alone: tuple[str, ...]

    @property
    def given(self) -> tuple[Design | None, Floats | None]:
        """Design and L where these have come from outside the kernel."""
        return self._placed, self._estimator and self._estimator.L

    @cached_property
    def design(self) -> Design:
        """K and the placed poles."""
        return design_of(self.spec, self.block, self._placed)

    @cached_property
    def interaction(self) -> Interaction:
        """RGA and pairing."""
        return Interaction(exists(self.block["figures"][RELATIVE_GAIN]), self.spec.outer.pairing)

    @cached_property
    def loop(self) -> Loop:
        """The whole loop and its poles."""
        return loop_in(self.spec, self.block, self.design, self._estimator)

    @cached_property
    def margins(self) -> tuple[Margins, Margins] | None:
        """At the pitch and the yaw motor; None if the loop is unstable."""
        if not self.loop.stable:
            return None
        pitch, yaw = (map(exists, row) for row in self.block["margins"].tolist())
        return Margins(*pitch), Margins(*yaw)

    @cached_property
    def sensitivity(self) -> Sensitivity | None:
        """At both motors at once; None if the loop is unstable."""
        return sensitivity_of(self.block["sensitivity"]) if self.loop.stable else None

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
        return behaviour_remarks(self.loop, self.spec.limits, self.spec.scenario, self.margins, pairs)

    def _both(self, n: int) -> dict[Model, Step]:
        return {"linear": self._linear(n), "nonlinear": self._nonlinear(n)}

    def _linear(self, n: int) -> Step:
        block, found = self.block, self._measured(n, 0)
        course = (block["linear"][n], block["voltages"][n, 0])
        return _measured(
            self.loop, linear_response(self.loop, block["experiments"][n], block["t"], course, found)
        )

    def _nonlinear(self, n: int) -> Step:
        block, scenario = self.block, self.spec.scenario
        course = (block["nonlinear"][n], block["voltages"][n, 1])
        task = (self.loop, block["experiments"][n], block["t"], course, self._measured(n, 1))
        response = limited_response(*task)
        if scenario.controller is not None:
            response = with_sampling_remarks(response, self.loop, scenario, scenario.controller)
        if scenario.disturbance is None:
            return _measured(self.loop, response)
        calm = Measured(block["calm_axes"][n], block["motors"][n, 1], block["calm_courses"][n])
        return _measured(self.loop, response, calm)

    def _measured(self, n: int, model: int) -> Measured:
        block = self.block
        return Measured(block["axes"][n, model], block["motors"][n, model], block["courses"][n, model])


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


def _step_of_the_rig(loop: Loop, spec: Spec, most_steps: int | None) -> Step:
    """The nonlinear response."""
    scenario = spec.scenario
    response = _on_the_rig(loop, spec, scenario, most_steps)
    if scenario.disturbance is None:
        return _measured(loop, response)
    calm = _on_the_rig(loop, spec, replace(scenario, disturbance=None), most_steps)
    return _measured(loop, response, calm.measured)


def _on_the_rig(loop: Loop, spec: Spec, scenario: Scenario, most_steps: int | None) -> Response:
    digital = scenario.controller
    if digital is None:
        return simulate_nonlinear(loop, spec.limits, scenario, most_steps)
    return simulate_digital(loop, spec.limits, scenario, digital)


def _measured(loop: Loop, response: Response, calm: Measured | None = None) -> Step:
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


def evaluate(spec: Spec, *, each_axis: bool = False, most_steps: int | None = None) -> Report:
    """Design, interaction, whole loop, margins and responses of a spec.

    Args:
        spec: what the user chose.
        each_axis: also step each axis of the scenario's reference alone, as the paper's Figs. 4, 5.
        most_steps: after which a nonlinear response is given up, with the finding `integration_stopped`.

    Raises:
        Heli2DofError: see `errors`.
    """
    scenario, observer = spec.scenario, spec.observer or Observer()
    kalman = scenario.measured == "observer" and observer.method == "kalman"
    placed = place(spec) if kalman or not has_closed_form(spec) else None
    estimated = estimator(placed, scenario.measured, observer) if placed and kalman else None
    task = {"L": estimated and estimated.L, "each_axis": each_axis, "most_steps": most_steps}
    block = fill_block(spec, placed=placed, **task)
    if block["outcome"][0] != DONE and placed is None:
        placed = place(spec)  # which takes exact numbers, or says why there is none
        block = fill_block(spec, placed=placed, **task)
    if block["outcome"][0] != DONE:
        raise np.linalg.LinAlgError("the eigenvalues of the loop were not found")
    axes = [name for name in ("theta", "psi") if each_axis and getattr(scenario, name) is not None]
    return Report(spec, block, placed, estimated, tuple(axes))
