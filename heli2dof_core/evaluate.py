"""Spec → Report: everything that a change of the design changes, in one pure function."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, TypeVar

from .behaviour import Experiment, behaviour_remarks
from .couplings import Coupling, Lead, Structure
from .design import FULL_RANK, Design, design
from .errors import InvalidInputError
from .figures import Margins
from .findings import Finding, merged
from .interaction import Interaction, interaction
from .loop import Loop, close_loop
from .margins import loop_margins, margin_table
from .metrics import StepMetrics, step_metrics
from .parameters import Parameters
from .placement.method import Weights
from .plant import plant
from .poles import PoleSet
from .presets import DEFAULT, Preset
from .presets import preset as preset_named
from .sensitivity import Sensitivity, loop_sensitivity
from .simulation.courses import Courses, run_experiments
from .simulation.digital import simulate_digital
from .simulation.linear import simulate_linear
from .simulation.nonlinear import simulate_nonlinear
from .simulation.response import Response
from .spec import Limits, Model, Outer, OuterLoop, Pairing, PIGains, Scenario
from .tables import Shown, Table, number, poles
from .weights import bryson_weights

T = TypeVar("T")


@dataclass(frozen=True, repr=False)
class Spec(Shown):
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
    def from_preset(cls, preset: Preset | str = DEFAULT, **changes: Any) -> Spec:
        """The preset's own design and scenario, with `changes` as `changed` takes them.

        >>> Spec.from_preset("quanser-2dof-manual", poles=[-4, -5, -3 + 4j, -3 - 4j]).poles
        PoleSet([-4, -5, -3+4j, -3-4j])

        Raises:
            InvalidInputError: there is no preset of that name; or as `changed`.
        """
        own = preset_named(preset) if isinstance(preset, str) else preset
        rig = (own.parameters, own.limits, own.theta_0)
        return cls(*rig, own.poles, own.structure, own.outer, own.scenario).changed(**changes)

    def changed(
        self,
        *,
        poles: PoleSet | Iterable[complex] | None = None,
        method: str | None = None,
        coupling: Coupling | None = None,
        lead: Lead | None = None,
        parameters: Mapping[str, float] | None = None,
        theta_0: float | None = None,
        outer: Outer | None = None,
        pitch: PIGains | tuple[float, float] | None = None,
        yaw: PIGains | tuple[float, float] | None = None,
        pairing: Pairing | None = None,
        decoupler: bool | None = None,
        reference: tuple[float | None, float | None] | None = None,
        duration: float | None = None,
    ) -> Spec:
        """The same with some things changed; what is left out stays.

        >>> spec = Spec.from_preset()
        >>> spec.changed(pitch=(10, 0.5), reference=(0.2, None)).outer.pitch
        PIGains(kp=10, ti=0.5)

        Args:
            poles: pitch's pair, then yaw's, rad/s.
            method: name in `METHODS`.
            coupling: of the closed loop; a shift of its own is dropped with it.
            lead: the axis that leads where it is triangular; likewise.
            parameters: by name, SI units, as in `Parameters`.
            theta_0: operating point, rad.
            outer: ``pi`` or ``none``.
            pitch: PI gains, or (kp in V/rad, ti in s).
            yaw: the same of the yaw error.
            pairing: as in `OuterLoop`.
            decoupler: as in `OuterLoop`.
            reference: of θ and ψ, rad, absolute; None leaves that axis at rest.
            duration: s.

        Raises:
            Heli2DofError: a value is out of its range; its field says which.
        """

        def given(**values: Any) -> dict[str, Any]:
            return {name: value for name, value in values.items() if value is not None}

        def gains(pi: PIGains | tuple[float, float] | None, axis: str) -> PIGains | None:
            return pi if pi is None or isinstance(pi, PIGains) else PIGains(*_two(pi, axis, "(kp, ti)"))

        structure = given(coupling=coupling, lead=lead)
        loops = given(
            outer=outer,
            pitch=gains(pitch, "pitch"),
            yaw=gains(yaw, "yaw"),
            pairing=pairing,
            decoupler=decoupler,
        )
        scenario = given(duration=duration)
        if reference is not None:
            scenario |= zip(("theta", "psi"), _two(reference, "reference", "(theta, psi)"), strict=True)
        return replace(
            self,
            **given(
                poles=poles if poles is None or isinstance(poles, PoleSet) else PoleSet(poles),
                method=method,
                structure=replace(self.structure, **structure, shift=None) if structure else None,
                parameters=None if parameters is None else self.parameters.replaced(parameters),
                theta_0=theta_0,
                outer=replace(self.outer, **loops) if loops else None,
                scenario=replace(self.scenario, **scenario) if scenario else None,
            ),
        )

    def summary(self) -> str:
        """Method, poles and outer loop."""
        return f"{self.method}, {self.structure.coupling}; poles {poles(self.poles.values)} rad/s; {self.outer.outer}"


def _two(values: Sequence[T], field: str, what: str) -> Sequence[T]:
    """Both values, or InvalidInputError."""
    if len(values) != 2:
        raise InvalidInputError(
            f"{field} is {tuple(values)!r}", field=field, hint=f"Give two values, {what}."
        )
    return values


@dataclass(frozen=True, repr=False)
class Step(Shown):
    """One response and its metrics."""

    response: Response
    metrics: StepMetrics

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
        return _measured(response)


def place(spec: Spec) -> Design:
    """The design alone."""
    weights = None if spec.method == FULL_RANK else spec.weights or bryson_weights(spec.limits)
    return design(plant(spec.parameters, spec.theta_0), spec.poles, spec.structure, spec.method, weights)


def simulate(loop: Loop, spec: Spec, model: Model, most_steps: int | None = None) -> Step:
    """The scenario's response by one model, with its metrics; `most_steps` as in `simulate_nonlinear`.

    A disturbance does not count into the steps' figures: those are of the same experiment without it.
    """
    if model == "linear":
        return _measured(simulate_linear(loop, spec.scenario, most_steps))
    return _step_of_the_rig(loop, spec, most_steps)


def _step_of_the_rig(loop: Loop, spec: Spec, most_steps: int | None, calm: Response | None = None) -> Step:
    """The nonlinear response; `calm` is the same without the disturbance, if it is known."""
    scenario = spec.scenario
    response = _on_the_rig(loop, spec, scenario, most_steps)
    if scenario.disturbance is None:
        return _measured(response)
    return _measured(
        response, calm or _on_the_rig(loop, spec, replace(scenario, disturbance=None), most_steps)
    )


def _on_the_rig(loop: Loop, spec: Spec, scenario: Scenario, most_steps: int | None) -> Response:
    if scenario.digital is None:
        return simulate_nonlinear(loop, spec.limits, scenario, most_steps)
    return simulate_digital(loop, spec.limits, scenario, scenario.digital)


def _measured(response: Response, calm: Response | None = None) -> Step:
    """With its metrics; those of its steps from the experiment without a disturbance, where it has one."""
    metrics = step_metrics(response, calm)
    if calm is None:
        return Step(response, metrics)
    told = (*response.findings, *([_CALM] if metrics.axes else []))
    return Step(replace(response, findings=told), metrics)


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
        nonlinear = tuple(
            _step_of_the_rig(
                loop,
                replace(spec, scenario=each),
                most_steps,
                courses.response(n, "nonlinear") if scenario.digital is None else None,
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
