"""What is replied of any system: as it was read, its design, its formulas, its files."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict
from functools import partial
from typing import Any

import numpy as np

from heli2dof_core.errors import Wanted, nobody_leaves
from heli2dof_core.export.any_system import matlab_script, python_script
from heli2dof_core.systems.analysis import Analysis, Pair, analyse
from heli2dof_core.systems.courses import courses
from heli2dof_core.systems.frequency import bode, gain_and_phase
from heli2dof_core.systems.textbook import Example
from heli2dof_core.version import package_version

from .encoding import json_bytes
from .model import Reply, findings_reply, plain, poles_reply, present
from .systems import SystemDesignRequest, SystemFormulasRequest


def read_reply(text: str, wanted: Wanted = nobody_leaves) -> Reply:
    """Reads a text, and looks at the system in it.

    Raises:
        Heli2DofError: it cannot be read, or is no system.
    """
    from heli2dof_core.symbolic.mathml import mathml
    from heli2dof_core.systems.notation import latex_of_rows
    from heli2dof_core.systems.pasted import read_system

    pasted = read_system(text)
    wanted()
    analysis = analyse(pasted.system)
    matrices = {}
    for name, rows in pasted.rows.items():
        latex = latex_of_rows(rows)
        values = getattr(pasted.system, name).tolist()
        matrices[name] = {"rows": rows, "latex": latex, "mathml": mathml(latex), "values": values}
    reply: Reply = {
        "matrices": matrices,
        "letters": pasted.letters,
        "missing": list(pasted.missing),
        "analysis": analysis_reply(analysis),
        "findings": findings_reply((*pasted.findings, *analysis.findings)),
    }
    for name in ("poles", "observer_poles"):
        if (poles := getattr(pasted, name)) is not None:
            reply[name] = poles_reply(poles)
    return reply


def analysis_reply(analysis: Analysis) -> Reply:
    """What can be said of a system."""
    return present(
        {
            "poles": poles_reply(analysis.poles),
            "zeros": poles_reply(analysis.zeros),
            "stable": analysis.stable,
            "inputs": _pair(analysis.inputs),
            "outputs": None if analysis.outputs is None else _pair(analysis.outputs),
            **{
                name: None if (matrix := getattr(analysis, name)) is None else matrix.tolist()
                for name in ("T", "Q", "M", "dc_gain", "rga")
            },
            "niederlinski": analysis.niederlinski,
        }
    )


def _pair(pair: Pair) -> Reply:
    return {
        "indices": list(pair.indices),
        "reached": pair.reached,
        "lost": poles_reply(pair.lost),
        "nearest": plain(pair.nearest),
        "distance": pair.distance,
    }


def design_reply(request: SystemDesignRequest) -> Reply:
    """The closed loop, its responses over time and over frequency.

    Raises:
        Heli2DofError: as `SystemDesignRequest.loop`.
    """
    loop = request.loop()
    over_time = courses(loop, request.x0, request.duration)
    over_frequency = bode(analyse(loop.system), loop)
    control, observer = loop.control, loop.observer
    return present(
        {
            "K": loop.K.tolist(),
            "K_z": loop.K_z.tolist() if loop.K_z.size else None,
            "F": loop.F.tolist(),
            "scaling": loop.scaling,
            "reason": loop.reason,
            "poles": poles_reply(loop.poles),
            "pole_error": control.pole_error,
            "norm": control.norm,
            "eigenvector_condition": control.eigenvector_condition,
            "observer": None
            if observer is None
            else {
                "L": observer.placement.K.T.tolist(),
                "poles": poles_reply(observer.closed_loop_poles),
                "pole_error": observer.pole_error,
                "norm": observer.norm,
            },
            "courses": present({name: _short(value) for name, value in vars(over_time).items()}),
            "bode": present(
                {
                    "frequencies": _short(over_frequency.frequencies),
                    **{name: _bode(getattr(over_frequency, name)) for name in ("plant", "loops", "closed")},
                    "rga": None if over_frequency.rga is None else _short(_along(over_frequency.rga)),
                }
            ),
            "findings": findings_reply(loop.findings),
        }
    )


def _short(values: Any) -> Any:
    """As many digits as a plot needs."""
    return None if values is None else np.ascontiguousarray(values, dtype=np.float32)


def _along(values: Any) -> Any:
    """Frequencies last."""
    return np.moveaxis(values, 0, -1)


def _bode(response: Any) -> Reply:
    gain, phase = gain_and_phase(response)
    return {"gain": _short(_along(gain)), "phase": _short(_along(phase))}


def _script(write: Callable[..., str], request: SystemDesignRequest, link: str) -> bytes:
    loop = request.loop()
    experiment = courses(loop, request.x0, request.duration)
    return write(loop, float(experiment.t[-1]), experiment.x0.tolist(), link).encode()


def _json(request: SystemDesignRequest, link: str) -> bytes:
    asked = request.model_dump(mode="python", exclude_none=True)
    for name in ("poles", "observer_poles"):
        if name in asked:
            asked[name] = poles_reply(asked[name])
    origin = {
        "version": package_version(),
        "call": "POST /api/v1/system/export/json",
        "request": asked,
        "link": link,
    }
    return json_bytes({"origin": origin, **design_reply(request)})


FILES: dict[str, tuple[str, str, Callable[[SystemDesignRequest, str], bytes]]] = {
    "matlab": (".m", "text/plain; charset=utf-8", partial(_script, matlab_script)),
    "python": (".py", "text/x-python; charset=utf-8", partial(_script, python_script)),
    "json": (".json", "application/json", _json),
}
"""Formats of a design's file: suffix, media type, and what makes it."""


def formulas_reply(request: SystemFormulasRequest, wanted: Wanted = nobody_leaves) -> Reply:
    """K and L in closed form, rendered within the time that one input may take.

    Raises:
        Heli2DofError: an entry is no expression, there are more than six states, or it takes too long.
    """
    from heli2dof_core.symbolic.budget import within_budget
    from heli2dof_core.symbolic.render import formula_of_letters
    from heli2dof_core.systems.formulas import closed_forms

    found = closed_forms(request.A, request.B, request.C, wanted=wanted)

    def formula(expression: Any, letters: Mapping[str, Any]) -> Reply:
        return asdict(formula_of_letters(expression, letters))

    def formulas(expressions: Sequence[Any], letters: Mapping[str, Any]) -> list[Reply]:
        return [formula(each, letters) for each in expressions]

    def entries(gain: Any, name: str, letters: Mapping[str, Any]) -> Reply:
        places = [(i, j) for i in range(gain.rows) for j in range(gain.cols)]
        return {f"{name}_{i + 1}{j + 1}": formula(gain[i, j], letters) for i, j in places}

    control, observer = found.control, found.observer
    with within_budget(wanted=wanted):
        reply: Reply = {
            name: formula(getattr(control, name), control.letters) for name in ("K", "T", "Q", "closed_loop")
        }
        reply["K_entries"] = entries(control.K, "k", control.letters)
        reply["controllability_indices"] = list(control.controllability_indices)
        reply["holds_unless"] = formulas(control.holds_unless, control.letters)
        if observer is not None:
            reply["L"] = formula(observer.K.T, observer.letters)
            reply["L_entries"] = entries(observer.K.T, "l", observer.letters)
            reply["observability_indices"] = list(observer.controllability_indices)
            reply["observer_holds_unless"] = formulas(observer.holds_unless, observer.letters)
    if found.reason:
        reply["reason"] = found.reason
    return reply


def example_reply(example: Example) -> Reply:
    """A system of a textbook."""
    own = None
    if example.weights is not None:
        own = {name: list(values) for name, values in vars(example.weights).items()}
    return present({**vars(example), "weights": own})
