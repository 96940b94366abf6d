"""Labs as the core judges them, for the page's tests: `python -m tests.labs.page_examples` writes the file.

Its replies are the server's, with two samples: no figure depends on them.
"""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

from app.contract.encoding import json_text
from app.contract.evaluation import report_reply
from heli2dof_core.evaluate import evaluate
from heli2dof_core.labs import mark, read_lab, start_body, student_rig, student_view
from heli2dof_core.measured import MEASURED
from heli2dof_core.request import spec_of

HERE = Path(__file__).parent
FILE = HERE.parent / "page" / "fixtures" / "lab_goals.json"
SEED = 5
GOALS = """
  - {figure: settling_time, axis: theta, max: 0.8 s}
  - {figure: settling_time, axis: both, max: 2 s, name: both}
  - {figure: overshoot, axis: psi, max: 5 %}
  - {figure: overshoot, axis: theta, model: linear, min: 1 %, max: 60 %}
  - {figure: rise_time, axis: theta, steps: together, max: 0.5 s}
  - {figure: peak, axis: theta, min: 5 °}
  - {figure: steady_state_error, axis: both, max: 0.5 °}
  - {figure: iae, axis: psi, max: 10}
  - {figure: coupling_peak, axis: theta, max: 2 °}
  - {figure: V_peak, max: 20 V}
  - {figure: V_peak, motor: V_p, axis: theta, max: 15 V, name: own}
  - {figure: saturated, motor: V_y, max: 1 %}
  - {figure: effort, motor: both, steps: together, max: 300}
  - {figure: gain_margin, motor: V_p, min: 6 dB}
  - {figure: gain_margin, motor: both, max: 60 dB, name: bounded}
  - {figure: phase_margin, min: 45 °}
  - {figure: delay_margin, motor: V_y, min: 50 ms}
  - {figure: disk_margin, min: 0.5}
  - {figure: sensitivity_peak, max: 1.7}
  - {figure: disk_gain_high, min: 1.5}
  - {figure: lag_margin, min: 0.1 s}
  - {figure: lag_margin, min: 0.1 s, unstable: allowed, name: any}
  - {figure: norm, max: 120}
  - {figure: pole_error, max: 1e-9}
  - {figure: eigenvector_condition, max: 30}
  - {figure: lambda_11, min: 0.9, unstable: allowed}
  - {kind: cloud, share: stable, min: 90 %, spread: 10 %, rigs: 10}
"""
BODIES: tuple[dict[str, Any], ...] = (
    {},
    {"outer": "none"},
    {"outer": "none", "poles": [-2, -2.5, -9.25, -8.76]},
    {"poles": [{"re": -6, "im": 6}, {"re": -6, "im": -6}, -4, -5], "outer": "none"},
    {"poles": [-30, -31, -32, -33], "rotors": {"pitch": {"tau": 0.16}, "yaw": {"tau": 0.16}}},
    {"poles": [-3, -2, -3.5, -2.5], "outer": "pi"},
    {"outer": "none", "scenario": {"reference": {"theta": 0.2}, "duration": 8}},
)
SIZES = (
    1e-7,
    4e-4,
    0.00049,
    0.0034,
    0.0099,
    0.0101,
    0.0449,
    0.0999,
    0.1,
    0.501,
    0.8051,
    0.996,
    1.0049,
    3.14159,
)
SIZES = (*SIZES, 9.996, 12.345678, 99.951, 123.456, 1234.56, 98765.4, 1.5e6)


def examples() -> dict[str, Any]:
    """All of it."""
    small = read_lab((HERE / "small.yaml").read_text("utf-8"), "small")
    rig = student_rig(small, SEED)
    before = {"poles": [-7, -8, -9, -10], "loops": {"pitch": {"kp": 99}}}
    head = "lab: 1\nname: goals\ntitle: Goals\npreset: quanser-2dof-manual\nsteps:\n"
    free = "[poles, loops, scenario, preset]"
    text = f"{head}- name: all\n  title: All\n  unlocked: {free}\n  goals: {GOALS.replace(chr(10), chr(10) + '  ')}"
    lab = read_lab(text, "goals")
    return {
        "small": {
            "lab": student_view(small),
            "rig": rig,
            "starts": {step.name: start_body(small, step.name, rig) for step in small.steps},
            "before": before,
            "continued": start_body(small, "loop", rig, {**start_body(small, "settle", rig), **before}),
        },
        "goals": student_view(lab)["steps"][0]["goals"],
        "attempts": [_attempt(lab, body) for body in BODIES],
        "values": {name: _values(name) for name in MEASURED},
    }


def _attempt(lab: Any, body: dict[str, Any]) -> dict[str, Any]:
    marked = mark(lab, "all", student_rig(lab, 0), body, {})
    spec = spec_of(marked.body)
    spec = replace(spec, scenario=replace(spec.scenario, samples=2))
    reply = json.loads(json_text(report_reply(evaluate(spec, each_axis=True), spec)))
    told = [{"name": each.name, "met": each.met, "text": each.value_text} for each in marked.goals]
    return {"body": marked.body, "reply": reply, "told": told}


def _values(name: str) -> dict[str, Any]:
    measured = MEASURED[name]
    values = []
    for size in SIZES:
        for limit in (size, 1.004 * size):
            pair = [measured.meets(size, None, limit), measured.meets(limit, size, None)]
            values.append([size, limit, *pair, measured.shown(size), measured.written(size)])
    absent = [measured.meets(None, None, 1.0), measured.meets(None, 1.0, None), measured.written(None)]
    return {"of": measured.of, "values": values, "absent": absent}


def text() -> str:
    """The file."""
    return json.dumps(examples(), ensure_ascii=False, separators=(",", ":")) + "\n"


if __name__ == "__main__":
    FILE.write_text(text(), "utf-8")
