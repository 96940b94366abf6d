"""The formats of exports, by name: the core's own, and the whole evaluate reply as JSON."""

from __future__ import annotations

from heli2dof_core import Spec, evaluate
from heli2dof_core.body import body_of
from heli2dof_core.checks import by_name
from heli2dof_core.export import FORMATS as CORE_FORMATS
from heli2dof_core.export import Format
from heli2dof_core.presets import PRESETS
from heli2dof_core.version import package_version

from .encoding import json_bytes
from .evaluation import report_reply
from .experiment import states_reply
from .model import present
from .presets import preset_reply


def _json(spec: Spec, link: str = "") -> bytes:
    """What `evaluate` replies, with all states, and before it where it comes from."""
    report, request = evaluate(spec, each_axis=True), body_of(spec)
    reply = report_reply(report, spec)
    for model, step in report.step.items():
        reply["step"][model] |= states_reply(step)
    origin = {
        "version": package_version(),
        "preset": preset_reply(PRESETS[request["preset"]]),
        "parameters": spec.parameters.as_dict(),
        "call": "POST /api/v1/export/json",
        "request": request,
        "link": link or None,
    }
    return json_bytes({"origin": present(origin), **reply})


JSON = Format("json", "Everything as JSON", ".json", "application/json", _json)

FORMATS = by_name((*CORE_FORMATS.values(), JSON))
"""Formats by name."""
