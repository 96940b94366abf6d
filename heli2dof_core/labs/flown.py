"""A controller that was designed for one rig, on another: what a student's numbers are worth on the rig itself.

K, Ĝ(0)⁻¹ and the PI loops are the design's; poles, margins and responses are those of the rig that it flies. The
voltages at rest are the rig's own, as somebody would find them who trims it by hand before the step.
"""

from __future__ import annotations

from dataclasses import replace

from ..block import Task, fill_block
from ..errors import InvalidInputError
from ..evaluate import Report, evaluate, place
from ..frozen import frozen
from ..plant import plant
from ..spec import Spec


def fly(spec: Spec, rig: Spec, *, each_axis: bool = True) -> Report:
    """What `evaluate` tells, of the design of `spec` on the rig of `rig`.

    Args:
        spec: the design, on the rig as its designer knows it, and the experiment.
        rig: parameters, limits, rotors and friction of this are the true ones.
        each_axis: as in `evaluate`.

    Raises:
        InvalidInputError: an observer estimates the states, which knows the rig by another model than the one that
            it flies.
        Heli2DofError: the design does not exist.
    """
    if spec.scenario.measured == "observer":
        raise InvalidInputError(
            "an observer cannot be flown on a rig that it does not know",
            field="scenario.measured",
            value="observer",
            hint="Take the states or filtered rates.",
        )
    true = replace(
        spec, parameters=rig.parameters, limits=rig.limits, rotors=rig.rotors, friction=rig.friction
    )
    if true == spec:
        return evaluate(spec, each_axis=each_axis)
    flown = replace(
        place(spec),
        plant=plant(true.parameters, true.theta_0),
        actuators=true.actuators,
        structure=None,
        aims=False,  # at these poles it aimed on the rig that it was designed for
    )
    task = Task.of(true, each_axis=each_axis)
    block = fill_block(task, placed=flown, L=None, most_steps=None, passing=False)
    return Report(task, frozen(block), flown, None)
