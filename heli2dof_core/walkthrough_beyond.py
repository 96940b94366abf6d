"""The derivation in numbers where the paper's model ends: rotors, six states and observer, for one design."""

from __future__ import annotations

from dataclasses import dataclass, replace

from .compiled import names_with_rotors
from .couplings import Structure
from .errors import Heli2DofError
from .estimators import Observer, observe
from .evaluate import place
from .frozen import Frozen
from .placement.with_rotors import cubic
from .plant import plant
from .poles import PoleSet
from .rotors import USUAL_LAG, Actuators, Rotor, Rotors
from .signals import AXES, Complexes, Floats
from .spec import Spec


@dataclass(frozen=True)
class RotorSteps(Frozen):
    """Numbers of the rig with its rotors, as `symbolic.beyond.rotor_formulas` names them.

    Attributes:
        placed: whether the design itself places the rotors; else this is what it would be if it did.
        assumed: axes whose rotor does not lag in the design, and is given `rotors.USUAL_LAG` here.
        names: tau_p, phi_p, b_11, d_10, h_1 … by name, SI; without the groups where the method is not full-rank's.
        rotor_poles: p₅ and p₆, rad/s.
        A, B: 6×6 and 6×2.
        K: 2×6, by the design's method; None where there is none, and `refused` says why.
        poles: eigenvalues of A − BK, rad/s, in the order p₁ … p₆; None likewise.
        refused: why; None where there is a K.
    """

    placed: bool
    assumed: tuple[str, ...]
    names: dict[str, float]
    rotor_poles: tuple[float, float]
    A: Floats | None = None
    B: Floats | None = None
    K: Floats | None = None
    poles: Complexes | None = None
    refused: str | None = None


@dataclass(frozen=True)
class ObserverSteps(Frozen):
    """Numbers of the observer.

    Attributes:
        used: whether the design's feedback acts on what an observer tells.
        L: 4×2, 1/s and 1/s².
        asked: q₁ … q₄, rad/s; None of a Kalman filter, which chooses its own.
        poles: eigenvalues of A − LC, rad/s.
    """

    used: bool
    L: Floats
    asked: PoleSet | None
    poles: Complexes


def rotor_steps(spec: Spec) -> RotorSteps:
    """Six states of the spec's rig, placed by its method; where it has no lag, with the usual one."""
    assumed = tuple(axis for axis in AXES if getattr(spec.rotors, axis).tau == 0)
    lagging = replace(spec, rotors=Rotors(*map(_lagging, spec.rotors.both)), place_rotors=True)
    rig = plant(spec.parameters, spec.theta_0)
    act = lagging.actuators or Actuators.none(rig)
    pairs = {"tau": act.tau, "phi": act.slope, "v_d": act.dead_zone, "s": act.square}
    names = {
        f"{name}_{axis[0]}": float(x)
        for name, both in pairs.items()
        for axis, x in zip(AXES, both, strict=True)
    }
    steps = RotorSteps(spec.place_rotors and not assumed, assumed, names, spec.rotor_poles)
    try:
        placed = place(lagging)
        if placed.structure is not None:
            names |= _groups(placed.structure, spec, rig.numbers, act.tau, act.slope)
    except (Heli2DofError, ArithmeticError) as error:
        return replace(steps, refused=str(error))
    A, B = placed.model
    return replace(steps, names=names, A=A, B=B, K=placed.K, poles=placed.closed_loop_poles)


def observer_steps(spec: Spec) -> ObserverSteps:
    """The spec's observer, or the usual one."""
    observer = spec.observer or Observer()
    found = observe(place(replace(spec, place_rotors=False)), observer)
    asked = observer.poles if observer.method == "full-rank" else None
    return ObserverSteps(spec.scenario.measured == "observer", found.G, asked, found.poles)


def _lagging(rotor: Rotor) -> Rotor:
    return replace(rotor, tau=rotor.tau or USUAL_LAG)


def _groups(
    structure: Structure, spec: Spec, numbers: tuple[float, ...], tau: Floats, slope: Floats
) -> dict[str, float]:
    """Letters and groups of K's formulas, and the cubics' coefficients."""
    d, thirds = spec.poles.coefficients, spec.rotor_poles
    coefficients = [*cubic(d[:2], thirds[0]), *cubic(d[2:], thirds[1])]
    known = zip(("d_10", "d_11", "d_12", "d_20", "d_21", "d_22"), coefficients, strict=True)
    own = () if structure.shift is None else (structure.shift,)
    names, function = names_with_rotors(structure.family, shifted=bool(own))
    values = function(*coefficients, *numbers, *tau.tolist(), *slope.tolist(), *own)
    return {**dict(known), **dict(zip(names, map(float, values), strict=True))}
