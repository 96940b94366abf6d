"""From the core's values to the contract's replies: plain dicts whose arrays stay NumPy's.

What does not exist is left out; the models that describe these replies are in `models`.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from functools import lru_cache
from typing import TYPE_CHECKING, Any

import numpy as np

from heli2dof_core import (
    Design,
    Finding,
    Interaction,
    Loop,
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
from heli2dof_core.quantities import Quantity
from heli2dof_core.scenario import OuterLoop
from heli2dof_core.sensitivity import Sensitivity
from heli2dof_core.signals import AXES, INPUTS, INTEGRALS, OUTPUTS, STATES, Floats
from heli2dof_core.tuning import Suggestion
from heli2dof_core.walkthrough import walk_through

from .places import LIMITS, LOOP, OUTER, REFERENCE, SCENARIO, STRUCTURE

if TYPE_CHECKING:  # it would import SymPy before the first page
    from heli2dof_core.symbolic.render import SymbolicReport

Reply = dict[str, Any]


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
    return present(
        {
            "method": design.method,
            "K": design.K.tolist(),
            "integral": None if design.integral is None else design.integral.tolist(),
            "A": design.plant.A.tolist(),
            "B": design.plant.B.tolist(),
            "poles": poles_reply(design.poles.values),
            "closed_loop_poles": poles_reply(design.closed_loop_poles),
            "pole_error": design.pole_error,
            "pole_error_bound": design.pole_error_bound if design.aims else None,
            "norm": design.norm,
            "spectral_norm": design.spectral_norm,
            "eigenvector_condition": design.eigenvector_condition,
            "controllability_indices": list(_indices(design.plant.parameters, design.plant.theta_0)),
            "findings": findings_reply(design.findings),
        }
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
    steps = asdict(walk_through(design))
    rga = interaction(design).rga
    return present(
        {
            **{name: v.tolist() if isinstance(v, np.ndarray) else v for name, v in steps.items()},
            "A": design.plant.A.tolist(),
            "B": design.plant.B.tolist(),
            "trim": _voltages(design.plant.trim),
            "K": design.K.tolist(),
            "integral": None if design.integral is None else design.integral.tolist(),
            "closed_loop": design.A_closed.tolist(),
            "closed_loop_poles": poles_reply(design.closed_loop_poles),
            "pole_error": design.pole_error,
            "rga": None if rga is None else rga.tolist(),
        }
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
        "limits": LIMITS.proposal(spec.limits),
        "findings": findings_reply(report.findings),
    }


def suggestion_reply(suggestion: Suggestion) -> Reply:
    """PI values, the whole loop's poles with them, and the rule in words."""
    outer = suggestion.outer
    return {
        "loops": _loops(outer),
        "loop_poles": poles_reply(suggestion.loop.poles),
        "stable": suggestion.loop.stable,
        "rule": suggestion.rule,
    }


def _ranges(quantities: Mapping[str, Quantity]) -> Reply:
    return {
        name: {"meaning": q.meaning, "unit": q.unit, "minimum": q.low, "maximum": q.high}
        for name, q in quantities.items()
    }


def preset_reply(preset: Preset) -> Reply:
    """A preset with everything that a design may change."""
    scenario = preset.scenario
    return {
        "name": preset.name,
        "title": preset.title,
        "source": preset.source,
        "rig": preset.rig,
        "parameters": preset.parameters.as_dict(),
        "parameter_info": _ranges(PARAMETER_INFO),
        "components": {} if preset.components is None else preset.components.as_dict(),
        "component_info": {
            name: {"meaning": q.meaning, "unit": q.unit, "printed": q.symbol}
            for name, q in COMPONENT_INFO.items()
        },
        "limits": LIMITS.proposal(preset.limits),
        "limit_info": _ranges({name: known.quantity for name, known in LIMITS.fields().items()}),
        "encoders": {"theta": preset.encoders[0], "psi": preset.encoders[1]},
        "operating_point": {"theta": preset.theta_0},
        "poles": poles_reply(preset.poles.values),
        **STRUCTURE.proposal(preset.structure),
        **OUTER.proposal(preset.outer),
        "loops": _loops(preset.outer),
        "scenario": {"reference": REFERENCE.proposal(scenario), **SCENARIO.proposal(scenario)},
    }


def _loops(outer: OuterLoop) -> Reply:
    return {axis: place.proposal(getattr(outer, axis)) for axis, place in LOOP.items()}


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


def _voltages(values: Floats) -> Reply:
    return {signal.name: float(value) for signal, value in zip(INPUTS, values, strict=True)}


def present(values: Reply) -> Reply:
    """What exists: None is left out."""
    return {name: value for name, value in values.items() if value is not None}
