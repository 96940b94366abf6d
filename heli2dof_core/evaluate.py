"""Spec → Report: everything that a change of the design changes, in one pure function."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from .behaviour import Experiment, behaviour_remarks, loop_misses
from .block import Block, Task, fill_block
from .design import Design, design
from .estimators import Estimator, estimator
from .figures import Margins
from .findings import Finding, merged
from .frozen import frozen
from .interaction import Interaction
from .judged import Judged, Placed, Size, loop_findings, placed_findings
from .kernels.update_layout import DONE, DOUBTFUL, RELATIVE_GAIN
from .lazily import computed
from .loop import Loop, close_loop
from .margins import margin_figures, margin_table, margins_in
from .metrics import StepMetrics, metrics_in, step_metrics
from .placement.method import Weights
from .placement.registry import method
from .plant import plant
from .read_block import CALM, design_of, exists, experiments_in, judged_in, loop_in, placed_in, size_in
from .scenario import Model, Scenario
from .sensitivity import Sensitivity, sensitivity_of
from .signals import Floats
from .simulation.digital import sampling_findings, simulate_digital
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
        task: what the user chose, as the kernel has taken it.
        block: all numbers, as the kernel `update` has filled them (`kernels.update_layout.block_shapes`).
    """

    task: Task
    block: Block
    _placed: Design | None
    _estimator: Estimator | None

    @property
    def spec(self) -> Spec:
        """What the user chose."""
        return self.task.spec

    @property
    def given(self) -> tuple[Design | None, Floats | None]:
        """Design and L where these have come from outside the kernel."""
        return self._placed, self._estimator and self._estimator.L

    @computed
    def placed(self) -> Placed:
        """The design's numbers."""
        told = self._placed is None and not self.block["figures"][DOUBTFUL]
        return placed_in(self.task, self.block, None if told else self.design)

    @computed
    def size(self) -> Size:
        """Figures of K."""
        return size_in(self.block)

    @computed
    def judged(self) -> Judged:
        """The whole loop's numbers."""
        return judged_in(self.task, self.block, self.placed, lambda: self.loop)

    @computed
    def design(self) -> Design:
        """K and the placed poles."""
        return design_of(self.task, self._views, self._placed)

    @computed
    def interaction(self) -> Interaction:
        """RGA and pairing."""
        return Interaction(exists(self.block["figures"][RELATIVE_GAIN]), self.spec.outer.pairing)

    @computed
    def loop(self) -> Loop:
        """The whole loop and its poles."""
        return loop_in(self.spec, self._views, self.design, self._estimator)

    @computed
    def motors(self) -> tuple[dict[str, float], dict[str, float]] | None:
        """Margins at the pitch and the yaw motor, those that exist by name; None if the loop is unstable."""
        if not self.judged.stable:
            return None
        pitch, yaw = self.block["margins"].tolist()
        return margin_figures(pitch), margin_figures(yaw)

    @property
    def margins(self) -> tuple[Margins, Margins] | None:
        """At the pitch and the yaw motor; None if the loop is unstable."""
        return self.motors and margins_in(self.motors)

    @computed
    def sensitivity(self) -> Sensitivity | None:
        """At both motors at once; None if the loop is unstable."""
        return sensitivity_of(self.block["sensitivity"]) if self.judged.stable else None

    @computed
    def experiments(self) -> list[Experiment]:
        """The scenario, and each axis alone where it is asked for: what both models have made of it."""
        return experiments_in(self.task, self.block, self._sampling)

    @property
    def given_up(self) -> bool:
        """Whether a response was, after the most steps that it may take."""
        return any(f.code == "integration_stopped" for f in self.findings)

    @property
    def alone(self) -> tuple[str, ...]:
        """The axes that are stepped alone, in the order of their experiments behind the scenario."""
        return self.task.rest.alone

    @computed
    def step(self) -> dict[Model, Step]:
        """The scenario's response, by model."""
        return self._both(0)

    @computed
    def axis_steps(self) -> dict[str, dict[Model, Step]]:
        """By output name and model, each axis stepped alone; empty unless asked for."""
        return {name: self._both(n) for n, name in enumerate(self.alone, 1)}

    @computed
    def known(self) -> tuple[Finding, ...]:
        """Remarks on the design and on the whole loop."""
        return merged(self.placed_findings, loop_findings(self.judged))

    @computed
    def placed_findings(self) -> tuple[Finding, ...]:
        """Remarks on the design alone."""
        return placed_findings(self.placed)

    @computed
    def findings(self) -> tuple[Finding, ...]:
        """All remarks, the gravest first."""
        behaviour: tuple[Finding, ...] = ()
        if self.motors is not None:
            delays = [own.get("delay_margin") for own in self.motors]
            behaviour = behaviour_remarks(
                self.judged,
                self.spec.limits,
                self.spec.scenario,
                delays=delays,
                experiments=self.experiments,
                misses=lambda: loop_misses(self.loop),
            )
        courses = (course.findings for each in self.experiments for course in (each.linear, each.rig))
        return merged(self.known, self.interaction.findings, *courses, behaviour)

    def summary(self) -> str:
        """Stability, size of K and the rig's step."""
        stability = "stable" if self.judged.stable else "unstable"
        rig = self.step["nonlinear"].metrics.summary()
        return f"{stability}; ‖K‖ = {number(self.size.norm)}; {len(self.findings)} findings; {rig}"

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

    @computed
    def _views(self) -> Block:
        """The block's arrays, which may be made read-only, though the kernel will fill them again."""
        return {name: array.view() for name, array in self.block.items()}

    def _sampling(self) -> tuple[Finding, ...]:
        scenario = self.spec.scenario
        digital = scenario.controller
        return () if digital is None else tuple(sampling_findings(self.loop, scenario, digital))

    def _both(self, n: int) -> dict[Model, Step]:
        return {"linear": self._step(n, "linear", 0), "nonlinear": self._step(n, "nonlinear", 1)}

    def _step(self, n: int, model: Model, m: int) -> Step:
        block, course = self._views, self.experiments[n][2 + m]
        found = Measured(block["axes"][n, m], block["motors"][n, m], block["courses"][n, m])
        curves = (block[model][n], block["voltages"][n, m])
        task = (self.loop, block["experiments"][n], block["t"], curves, found)
        response = (limited_response if m else linear_response)(*task, findings=course.findings)
        own = merged(self.known, course.findings) if course.findings else self.known
        return Step(response, metrics_in(course.metrics), own)


def place(spec: Spec) -> Design:
    """The design alone."""
    weights = weights_of(spec) if method(spec.method).weighted else None
    rig, rotors = plant(spec.parameters, spec.theta_0), spec.rotor_poles if spec.place_rotors else None
    task = (rig, spec.poles, spec.structure, spec.method, weights)
    return design(*task, actuators=spec.actuators, rotor_poles=rotors)


def quadratic(spec: Spec) -> Spec:
    """The spec by a quadratic method: its own, or LQR in place of one that has no weights."""
    return spec if method(spec.method).weighted else replace(spec, method="lqr")


def weights_of(spec: Spec) -> Weights:
    """Those of a quadratic method: the spec's own, or Bryson's rule for its limits."""
    return spec.weights or bryson_weights(spec.limits)


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
        response = replace(response, findings=(*response.findings, CALM))
    known = loop.all_findings
    return Step(response, metrics, merged(known, response.findings) if response.findings else known)


def evaluate(spec: Spec, *, each_axis: bool = False, most_steps: int | None = None) -> Report:
    """Design, interaction, whole loop, margins and responses of a spec.

    Args:
        spec: what the user chose.
        each_axis: also step each axis of the scenario's reference alone, as the paper's Figs. 4, 5.
        most_steps: after which a nonlinear response is given up, with the finding `integration_stopped`.

    Raises:
        Heli2DofError: see `errors`.
    """
    return report_of(Task.of(spec, each_axis=each_axis), most_steps)


def report_of(task: Task, most_steps: int | None = None, *, passing: bool = False) -> Report:
    """As `evaluate`, of a task; `passing`: this thread's next passing report may overwrite this one's numbers."""
    spec, rest = task.spec, task.rest
    placed = None if rest.has_closed_form and not rest.has_kalman_filter else place(spec)
    estimated = None
    if placed is not None and rest.has_kalman_filter:
        estimated = estimator(placed, spec.scenario.measured, spec.observer)
    how = {"L": estimated and estimated.L, "most_steps": most_steps, "passing": passing}
    block = fill_block(task, placed=placed, **how)
    if block["outcome"][0] != DONE and placed is None:
        placed = place(spec)  # which takes exact numbers, or says why there is none
        block = fill_block(task, placed=placed, **how)
    if block["outcome"][0] != DONE:
        raise np.linalg.LinAlgError("the eigenvalues of the loop were not found")
    return Report(task, block if passing else frozen(block), placed, estimated)
