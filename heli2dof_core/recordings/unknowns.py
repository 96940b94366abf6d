"""What of a rig is unknown: names, where the search begins, and the rig that some values make."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import Any

import numpy as np

from ..errors import InvalidInputError
from ..frozen import Frozen
from ..parameters import PARAMETER_INFO, Parameters
from ..quantities import Quantity, quantities_of
from ..rotors import AxisFriction, Friction, Rotor, Rotors
from ..signals import Floats, fixed
from .acting import COULOMB, matched

IDENTIFIABLE = ("K_pp", "K_py", "K_yp", "K_yy", "B_p", "B_y", "K_s")
"""Parameters that can be found, in the order of the sensitivities; m and l stay: gravity's torque sets the scale."""
ACTUATORS = ("rotors.pitch.tau", "rotors.yaw.tau", "friction.pitch.coulomb", "friction.yaw.coulomb")
"""What can be found of rotors and friction, likewise, by its place in a design."""
INERTIAS = ("J_p", "J_y")
"""Moments of inertia, which scale with thrust, damping and stiffness of their axis as far as only motion is seen."""
SCALED = {
    "J_p": ("K_pp", "K_py", "B_p", "K_s", "friction.pitch.coulomb"),
    "J_y": ("K_yp", "K_yy", "B_y", "friction.yaw.coulomb"),
}
"""What scales with each."""
FREE = (*IDENTIFIABLE, *ACTUATORS, *INERTIAS)
_AT = {"rotors.pitch.tau": 0, "rotors.yaw.tau": 1}
_AT |= {"friction.pitch.coulomb": COULOMB, "friction.yaw.coulomb": COULOMB + 1}
"""Where in `rotors.Actuators.constants`."""
LEAST_SHARE = 0.1
"""Of an inertia as it is thought to be, below which the search does not go."""
LIKELY_TAU, LEAST_TAU = 0.05, 1e-3
"""Time constants with which the search begins where rotors were thought to follow at once, and the least, s."""


def default_free(p: Parameters) -> tuple[str, ...]:
    """The parameters that are free unless one says otherwise: stiffness only where the rig has one."""
    return tuple(name for name in IDENTIFIABLE if name != "K_s" or p.K_s)


def checked(free: Sequence[str]) -> tuple[str, ...]:
    """The names in the order of the sensitivities.

    Raises:
        InvalidInputError: there is none, or one is unknown.
    """
    for name in free:
        if name not in FREE:
            raise InvalidInputError(
                f"{name!r} cannot be identified",
                field="free",
                value=name,
                hint="Choose of " + ", ".join(FREE),
            )
    if not free:
        raise InvalidInputError("no parameter is free", field="free", hint="Choose at least one.")
    return tuple(name for name in FREE if name in free)


def info(name: str) -> Quantity:
    """What is known of a quantity that can be free."""
    if name in PARAMETER_INFO:
        return PARAMETER_INFO[name]
    own = Rotor if name.startswith("rotors.") else Friction
    return quantities_of(own)[name.rpartition(".")[2]].quantity


@dataclass(frozen=True)
class Unknowns(Frozen):
    """The free quantities of a rig, as deviations from where the search begins, each in units of its own scale.

    Attributes:
        p: the rig as it is thought to be.
        acting: its rotors and friction (`rotors.Actuators.constants`); None where there are none, and none is free.
        names: of what is free.
        first: values at which the search begins, (k,).
        before: deviations of the values as they were thought to be, (k,).
        lowest: deviations below which there is none, (k,); −∞ for the rig's own parameters.
        scales: (k,).
    """

    p: Parameters
    acting: Floats | None
    names: tuple[str, ...]
    first: Floats
    before: Floats
    lowest: Floats
    scales: Floats

    @classmethod
    def of(cls, p: Parameters, acting: Floats | None, names: tuple[str, ...]) -> Unknowns:
        """Those of these names."""
        free = [name for name in names if name in _AT]
        known = np.zeros(10) if acting is None else acting
        given, first, lowest, scales = [], [], [], []
        for name in names:
            own = float(known[_AT[name]]) if name in free else float(getattr(p, name))
            scale, least, begin = _scale(p, name), -np.inf, own
            if name.endswith(".tau"):
                begin, least = own if own > LEAST_TAU else LIKELY_TAU, LEAST_TAU
                scale = max(begin, LIKELY_TAU)
            elif name in free:
                scale, least = max(own, scale), 0.0
            elif name in INERTIAS:
                least = LEAST_SHARE * own
            given.append(own)
            first.append(begin)
            scales.append(scale)
            lowest.append((least - begin) / scale)
        values = [fixed(each) for each in (given, first, lowest, scales)]
        before = fixed((values[0] - values[1]) / values[3])
        return cls(p, fixed(known) if free else acting, names, values[1], before, values[2], values[3])

    @property
    def inertias(self) -> tuple[str, ...]:
        """Those that are free."""
        return tuple(name for name in self.names if name in INERTIAS)

    @property
    def bounded(self) -> bool:
        """Whether any must not be negative."""
        return bool(np.any(np.isfinite(self.lowest)))

    def value(self, i: int, deviations: Floats) -> float:
        """The i-th free quantity."""
        return float(self.first[i] + deviations[i] * self.scales[i])

    def rig(self, deviations: Floats) -> Any:
        """The rig with these parameters, which may have any value."""
        values = SimpleNamespace(**self.p.as_dict(), alpha=self.p.alpha)
        for i, name in enumerate(self.names):
            if name not in _AT:
                setattr(values, name, self.value(i, deviations))
        values.alpha = values.J_p + values.m * values.l**2
        return values

    def acted(self, deviations: Floats) -> Floats | None:
        """Rotors and friction with these values; stiction where none is given, and at least, is Coulomb friction."""
        if self.acting is None:
            return None
        found = self.acting.copy()
        for i, name in enumerate(self.names):
            if name in _AT:
                at = _AT[name]
                found[at] = self.value(i, deviations)
                if at >= COULOMB:
                    more = self.acting[at + 2] > self.acting[at]
                    found[at + 2] = max(self.acting[at + 2], found[at]) if more else found[at]
        return found

    def run_up(self, deviations: Floats) -> float:
        """The longer of the rotors' time constants, s."""
        found = self.acted(deviations)
        return 0.0 if found is None else float(np.max(found[:2]))

    def adopted(
        self, values: dict[str, float], rotors: Rotors, friction: AxisFriction
    ) -> tuple[Parameters, Rotors, AxisFriction]:
        """The rig with some values, each within its range."""
        p = self.p.replaced({name: v for name, v in values.items() if name not in _AT})
        turned = rotors if self.acting is None else matched(rotors, self.acting)
        rubbed = friction
        for axis in ("pitch", "yaw"):
            tau, coulomb = values.get(f"rotors.{axis}.tau"), values.get(f"friction.{axis}.coulomb")
            if tau is not None:
                turned = replace(turned, **{axis: replace(getattr(turned, axis), tau=tau)})
            if coulomb is not None:
                own: Friction = getattr(rubbed, axis)
                static = None if own.static is None else max(own.static, coulomb)
                rubbed = replace(rubbed, **{axis: Friction(coulomb, static)})
        return p, turned, rubbed


def _scale(p: Parameters, name: str) -> float:
    """What one unit of the search means: the parameter's own size, or a fraction of its like."""
    like = {"K": max(abs(p.K_pp), abs(p.K_py), abs(p.K_yp), abs(p.K_yy)), "B": max(p.B_p, p.B_y)}
    if name in _AT:
        return max(0.5 * like["K"], 1e-9)  # half a volt's thrust
    own = abs(getattr(p, name))
    if name in INERTIAS:
        return own
    return max(own, 0.1 * p.alpha if name == "K_s" else 0.05 * like[name[0]], 1e-9)
