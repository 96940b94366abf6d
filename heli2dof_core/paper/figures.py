"""Figs. 4 and 5 redrawn: our copy has no curves. Unit steps as the paper takes them, and as a rig would."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

from ..design import Design, design
from ..frozen import Frozen
from ..loop import close_loop
from ..plant import plant
from ..poles import PoleSet
from ..presets import Preset, preset
from ..scenario import OuterLoop, PIGains, Scenario
from ..signals import OUTPUTS, Floats
from ..simulation.linear import simulate_linear
from ..simulation.nonlinear import simulate_nonlinear
from .printed import PI, UNIT_STEP, printed_gain, printed_poles


@dataclass(frozen=True)
class Curve(Frozen):
    """One response of one axis: what it shows, in words, and the angle, rad."""

    name: str
    title: str
    angle: Floats


@dataclass(frozen=True)
class Figure(Frozen):
    """One redrawn figure: number, output, times in s and curves."""

    number: int
    output: str
    t: Floats
    curves: tuple[Curve, ...]


@cache
def figures() -> tuple[Figure, Figure]:
    """Responses to a step of 1 rad of each reference, PI 30 (1 + 1/(0.1 s)) on both loops (Fig. 3)."""
    return _figure(4, 0), _figure(5, 1)


def _figure(number: int, axis: int) -> Figure:
    step = UNIT_STEP.value
    references = (step, None) if axis == 0 else (None, step)
    scenario = Scenario(*references, duration=2.0, samples=401)
    computed, manual = preset("paper-as-computed"), preset("quanser-2dof-manual")
    own = printed_gain()
    designs = (
        ("corrected", "K corrected, values as computed", _designed(computed)),
        ("printed", "K as printed, on that plant", _given(computed, own)),
        ("manual", "K as printed, on the rig of the manual (B_y = 0.318)", _given(manual, own)),
    )
    pi = PIGains(PI[0].value, PI[1].value)
    outer = OuterLoop(pitch=pi, yaw=pi)
    responses = [(name, title, simulate_linear(close_loop(d, outer), scenario)) for name, title, d in designs]
    limited = simulate_nonlinear(
        close_loop(_designed(manual), outer), manual.limits, replace(scenario, rtol=1e-6)
    )
    responses.append(("limited", "corrected K, nonlinear rig with its voltage limits and stops", limited))
    curves = tuple(Curve(name, title, r.angles[axis]) for name, title, r in responses)
    return Figure(number, OUTPUTS[axis].name, limited.t, curves)


def _designed(rig: Preset) -> Design:
    return design(plant(rig.parameters), PoleSet(printed_poles()))


def _given(rig: Preset, K: Floats) -> Design:
    model = plant(rig.parameters)
    return Design(model, PoleSet(printed_poles()), "as-printed", None, K, K[:, :2] - model.statics)
