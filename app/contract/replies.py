"""From the core's values to the contract's replies: plain dicts whose arrays stay NumPy's.

What does not exist is left out; the models that describe these replies are in `models`.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import asdict, is_dataclass
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np
from pydantic import BaseModel

from heli2dof_core import (
    Design,
    Finding,
    Interaction,
    Loop,
    OuterLoop,
    Parameters,
    Preset,
    Report,
    Spec,
    interaction,
    plant,
    rga_over_frequency,
)
from heli2dof_core.components import COMPONENT_INFO
from heli2dof_core.controllability import controllability_indices
from heli2dof_core.evaluate import Step
from heli2dof_core.figures import Margins
from heli2dof_core.findings import merged
from heli2dof_core.interaction import dominance_over_frequency
from heli2dof_core.margins import loop_margins, open_loop_response
from heli2dof_core.metrics import StepMetrics
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.scenario import LIMIT_INFO, Limits
from heli2dof_core.sensitivity import Sensitivity
from heli2dof_core.signals import AXES, INPUTS, INTEGRALS, OUTPUTS, STATES, Floats
from heli2dof_core.tuning import Suggestion
from heli2dof_core.walkthrough import walk_through

from . import models
from .paper_models import Walkthrough

if TYPE_CHECKING:  # it would import SymPy before the first page
    from heli2dof_core.symbolic.render import SymbolicReport

Reply = dict[str, Any]


def reply_of(model: type[BaseModel], source: object, **own: Any) -> Reply:
    """The model's fields: what `source` has by their names, or what is given; what is None is left out."""
    found = {name: own[name] if name in own else getattr(source, name, None) for name in model.model_fields}
    return {name: plain(value) for name, value in found.items() if value is not None}


def plain(value: Any) -> Any:
    """A value of the core in JSON's own kinds; complex numbers as ``{"re", "im"}``."""
    if isinstance(value, np.ndarray):
        numbers = value.tolist()
        return [plain(p) for p in numbers] if value.dtype.kind == "c" else numbers
    if isinstance(value, complex):
        return {"re": value.real, "im": value.imag}
    if isinstance(value, tuple):
        return [plain(item) for item in value]
    return {name: plain(item) for name, item in vars(value).items()} if is_dataclass(value) else value


def poles_reply(poles: Iterable[complex]) -> list[Reply]:
    """Complex numbers as ``{"re", "im"}``."""
    values: Iterable[complex] = poles.tolist() if isinstance(poles, np.ndarray) else poles
    return [{"re": p.real, "im": p.imag} for p in values]


@lru_cache(maxsize=256)
def _indices(parameters: Parameters, theta_0: float) -> tuple[int, ...]:
    """The rig's controllability indices, which no pole changes: scanned once, not at every drag."""
    rig = plant(parameters, theta_0)
    return controllability_indices(rig.A, rig.B)


def findings_reply(findings: Iterable[Finding]) -> list[Reply]:
    """Findings as objects."""
    return [dict(vars(finding)) for finding in findings]


def gains_reply(design: Design) -> Reply:
    """K and what it does to the poles."""
    return reply_of(
        models.Gains,
        design,
        A=design.plant.A,
        B=design.plant.B,
        poles=design.poles.values,
        pole_error_bound=design.pole_error_bound if design.aims else None,
        controllability_indices=_indices(design.plant.parameters, design.plant.theta_0),
    )


def rga_reply(design: Design, gains: Interaction, frequencies: Sequence[float] = ()) -> Reply:
    """RGA, pairing and Niederlinski index; without steady state only the findings."""
    no_steady_state = [f for f in design.findings if f.code == "no_steady_state"]
    reply: Reply = {"findings": findings_reply([*no_steady_state, *gains.findings])}
    if gains.rga is not None:
        reply["rga"] = gains.rga.tolist()
        reply["pairing"] = [list(pair) for pair in gains.pairing]
        reply["reason"] = gains.reason
    if gains.niederlinski is not None:
        reply["niederlinski"] = gains.niederlinski
    if gains.niederlinski_cross is not None:
        reply["niederlinski_cross"] = gains.niederlinski_cross
    if frequencies and gains.rga is not None:
        at = np.array(frequencies)
        rows, columns = dominance_over_frequency(design, at)
        reply["frequencies"] = list(frequencies)
        reply["rga_magnitude"] = np.abs(rga_over_frequency(design, at)).tolist()
        if np.all(np.isfinite(rows)) and np.all(np.isfinite(columns)):
            reply["dominance"] = {"rows": rows.tolist(), "columns": columns.tolist()}
    return reply


def loop_reply(loop: Loop) -> Reply:
    """What every response of a loop has in common."""
    return {
        "loop_poles": poles_reply(loop.poles),
        "stable": loop.stable,
        "trim": _voltages(loop.design.plant.trim),
    }


def step_reply(step: Step, loop: Loop, common: Reply | None = None) -> Reply:
    """Trajectories and metrics of one response; the long arrays are NumPy's. `common` is `loop_reply`'s, if known."""
    response = step.response
    return {
        **(common or loop_reply(loop)),
        "t": response.t,
        **{signal.name: response.angles[i] for i, signal in enumerate(OUTPUTS)},
        **{signal.name: response.voltages[i] for i, signal in enumerate(INPUTS)},
        "reference": dict(zip(("theta", "psi"), response.reference, strict=True)),
        "metrics": metrics_reply(step.metrics),
        "findings": findings_reply(merged(loop.design.findings, loop.findings, response.findings)),
    }


def states_reply(step: Step) -> Reply:
    """The states that are no outputs, under ``states``; the integrals where anything integrates."""
    states = step.response.states
    if states is None:
        return {}
    hidden = (*STATES[len(OUTPUTS) :], *INTEGRALS)
    rows = states[len(OUTPUTS) :]
    return {"states": {signal.name: row for signal, row in zip(hidden, rows, strict=False)}}


def metrics_reply(metrics: StepMetrics) -> Reply:
    """Metrics by axis and motor."""
    motors = {name: dict(vars(motor)) for name, motor in metrics.motors.items()}
    axes = {name: present(vars(axis)) for name, axis in metrics.axes.items()}
    other = {} if metrics.coupling_peak is None else {"coupling_peak": metrics.coupling_peak}
    return {**axes, **other, **motors}


def walkthrough_reply(design: Design) -> Reply:
    """The derivation's steps in numbers; what only full-rank placement has is left out for other methods."""
    return reply_of(
        Walkthrough,
        walk_through(design),
        A=design.plant.A,
        B=design.plant.B,
        trim=_voltages(design.plant.trim),
        K=design.K,
        integral=design.integral,
        closed_loop=design.A_closed,
        closed_loop_poles=design.closed_loop_poles,
        pole_error=design.pole_error,
        rga=interaction(design).rga,
    )


def report_reply(report: Report, spec: Spec) -> Reply:
    """Everything at once: what the page needs after a drag."""
    loop, common = report.loop, loop_reply(report.loop)
    return {
        **common,
        "gains": gains_reply(report.design),
        "open_loop_poles": poles_reply(report.design.plant.poles),
        "rga": rga_reply(report.design, report.interaction),
        "step": {model: step_reply(step, loop, common) for model, step in report.step.items()},
        "axis_steps": {
            axis: {model: step_reply(step, loop, common) for model, step in steps.items()}
            for axis, steps in report.axis_steps.items()
        },
        "margins": margins_reply(report.margins),
        **sensitivity_reply(report.sensitivity),
        "limits": _limits(spec.limits),
        "findings": findings_reply(report.findings),
    }


def suggestion_reply(suggestion: Suggestion) -> Reply:
    """PI values, the whole loop's poles with them, and the rule in words."""
    loop = suggestion.loop
    return reply_of(
        models.Suggestion,
        suggestion,
        loops=_loops(suggestion.outer),
        loop_poles=loop.poles,
        stable=loop.stable,
    )


def _loops(outer: OuterLoop) -> Reply:
    return {axis: asdict(getattr(outer, axis)) for axis in AXES}


def _ranges(infos: dict[str, dict[str, Any]]) -> Reply:
    return {
        name: {
            "meaning": info["meaning"],
            "unit": info["unit"],
            "minimum": info["low"],
            "maximum": info["high"],
        }
        for name, info in infos.items()
    }


def preset_reply(preset: Preset) -> Reply:
    """A preset with everything that a design may change."""
    scenario = preset.scenario
    return reply_of(
        models.Preset,
        preset,
        **vars(preset.structure),
        **vars(preset.outer),
        parameters=preset.parameters.as_dict(),
        parameter_info=_ranges(PARAMETER_INFO),
        components={} if preset.components is None else preset.components.as_dict(),
        component_info=COMPONENT_INFO,
        limits=_limits(preset.limits),
        limit_info=_ranges(LIMIT_INFO),
        encoders=dict(zip(("theta", "psi"), preset.encoders, strict=True)),
        operating_point={"theta": preset.theta_0},
        poles=preset.poles.values,
        loops=_loops(preset.outer),
        scenario={
            "reference": present({"theta": scenario.theta, "psi": scenario.psi}),
            "duration": scenario.duration,
            "samples": scenario.samples,
        },
    )


def symbolic_reply(report: SymbolicReport) -> Reply:
    """Formulas as SymPy text, LaTeX and MathML."""
    return {
        **{name: asdict(formula) for name, formula in report.formulas.items()},
        "entries": {
            matrix: {name: asdict(formula) for name, formula in entries.items()}
            for matrix, entries in report.entries.items()
        },
        "definitions": {name: asdict(formula) for name, formula in report.definitions.items()},
        "controllability_indices": list(report.controllability_indices),
        "symbols": [{**asdict(name), "mathml": report.notation[name.name].mathml} for name in report.symbols],
    }


def open_loops_reply(loop: Loop, frequencies: Sequence[float]) -> Reply:
    """L(jω) at each motor and its margins; the phase starts between −2π and 0 and has no jumps."""
    responses = open_loop_response(loop, np.array(frequencies))
    reply: Reply = {"frequencies": list(frequencies), "stable": loop.stable}
    for axis, response in zip(AXES, responses, strict=True):
        phase = np.unwrap(np.angle(response))
        phase -= 2 * np.pi * np.ceil(phase[0] / (2 * np.pi))
        reply[axis] = {"gain": np.abs(response).tolist(), "phase": phase.tolist()}
    return reply | {"margins": margins_reply(loop_margins(loop))}


def margins_reply(margins: tuple[Margins, Margins] | None) -> Reply:
    """Margins at each motor; empty where the loop is unstable."""
    if margins is None:
        return {}
    return {axis: present(vars(own)) for axis, own in zip(AXES, margins, strict=True)}


def sensitivity_reply(sensitivity: Sensitivity | None) -> Reply:
    """Disk margin and sensitivity peak under ``sensitivity``; nothing where the loop is unstable."""
    if sensitivity is None:
        return {}
    low, high = sensitivity.gain_range
    return {
        "sensitivity": present(
            {**vars(sensitivity), "gain_low": low, "gain_high": high, "phase": sensitivity.phase}
        )
    }


def _limits(limits: Limits) -> Reply:
    return present(vars(limits))


def _voltages(values: Floats) -> Reply:
    return {signal.name: float(value) for signal, value in zip(INPUTS, values, strict=True)}


def present(values: Reply) -> Reply:
    """What exists: None is left out."""
    return {name: value for name, value in values.items() if value is not None}
