"""The design and its responses as a MAT-file (level 5), which MATLAB, Octave and SciPy read."""

from __future__ import annotations

from collections.abc import Mapping
from io import BytesIO
from typing import Any

import numpy as np

from ..evaluate import evaluate
from ..loop import Loop
from ..signals import C
from ..spec import Spec
from ..version import package_version
from .format import Format
from .machine import with_lag
from .origin import origin

_TEXT = 116
"""Bytes of free text at the head of a MAT-file."""


def render(spec: Spec, link: str = "") -> bytes:
    """One variable per matrix, structs for parameters and responses; equal designs give equal bytes."""
    report = evaluate(spec)
    design, loop = report.design, report.loop
    content: dict[str, Any] = {
        "about": "\n".join(origin(spec, FORMAT.name, link)),
        "parameters": spec.parameters.as_dict(),
        "theta_0": spec.theta_0,
        "A": design.plant.A,
        "B": design.plant.B,
        "C": C,
        "D": np.zeros((2, 2)),
        "trim": design.trim[:, None],
        "K": design.K,
        "poles": design.wanted[:, None],
        "placed": design.closed_loop_poles[:, None],
        "P": loop.proportional,
        "F": loop.feedforward,
        **({} if loop.integral is None else {"I_z": loop.integral}),
        "A_loop": loop.A,
        "B_loop": loop.B,
        "law": loop.voltage_from_state,
        "law_of_reference": loop.voltage_from_reference,
        "loop_poles": loop.poles[:, None],
        **_machine(loop),
        **_estimator(loop),
        "t": report.step["linear"].response.t[:, None],
        "reference": np.array(report.step["linear"].response.reference)[:, None],
        **{
            model: {signal.name: values[:, None] for signal, values in step.response.by_signal()}
            for model, step in report.step.items()
        },
    }
    return mat_file(content)


def mat_file(content: Mapping[str, Any]) -> bytes:
    """Variables as a MAT-file; equal ones give equal bytes, since the head has no date."""
    from scipy.io import savemat

    file = BytesIO()
    savemat(file, content, oned_as="column")
    head = f"MATLAB 5.0 MAT-file, heli2dof {package_version()}".encode().ljust(
        _TEXT
    )  # SciPy's holds the date
    return head + file.getvalue()[_TEXT:]


def _machine(loop: Loop) -> dict[str, Any]:
    """Rotors and friction of the rig, by the motor or the axis, and what it is with the rotors that lag."""
    actuators = loop.actuators
    if actuators is None:
        return {}
    names = ("tau", "dead_zone", "square", "slope", "coulomb", "breakaway")
    found = {name: getattr(actuators, name)[:, None] for name in names}
    if actuators.lags:
        found["A_plus"], found["B_plus"] = with_lag(loop.design)
    return found


def _estimator(loop: Loop) -> dict[str, Any]:
    """What estimates x, w' = F_w w + G_w y + H_w u, x = x_from_w w + x_from_y y, in deviations."""
    estimator = loop.estimator
    if estimator is None:
        return {}
    found = {"F_w": estimator.F, "G_w": estimator.G, "H_w": estimator.H}
    found |= {"x_from_w": estimator.from_state, "x_from_y": estimator.from_angles}
    if estimator.L is not None:
        found |= {"L": estimator.L, "observer_poles": estimator.poles[:, None]}
    return found


FORMAT = Format(
    "mat", "Data for MATLAB and Octave", ".mat", "application/x-matlab-data", render, "heli2dof_data"
)
