"""Random designs with all that decides about stability at its edges: what the laws of the linear loop are held to."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

import mpmath
import numpy as np

from heli2dof_core import (
    PRESETS,
    Heli2DofError,
    OuterLoop,
    PIGains,
    PoleSet,
    Rotors,
    Spec,
    Structure,
    close_loop,
    place,
)

STRUCTURES = (
    Structure("triangular", "pitch"),
    Structure("triangular", "yaw"),
    Structure("input-diagonal"),
    Structure("axis-decoupled"),
)
REMOVABLE = ("K_py", "K_yp", "B_p", "B_y", "m", "l", "K_s", "g")


def random_spec(rng, *, edges: bool = True) -> Spec:
    """A design on any preset; with `edges` parameters are 0, poles on the axis or at 0, and loops are off.

    Rotors follow at once; `whole_loops` has those that lag.
    """
    own = Spec.from_preset([*PRESETS][rng.integers(len(PRESETS))], rotors=Rotors())
    changes = {
        name: value * rng.uniform(0.5, 1.5) for name, value in own.parameters.as_dict().items() if value != 0
    }
    if rng.random() < 0.3:
        changes["K_s"] = rng.uniform(0.0, 0.5)
    if edges and rng.random() < 0.5:
        changes |= dict.fromkeys(rng.choice(REMOVABLE, rng.integers(1, 4), replace=False).tolist(), 0.0)
    structure = STRUCTURES[rng.integers(4)]
    if structure.coupling != "axis-decoupled" and rng.random() < 0.1:
        structure = replace(structure, shift=float(rng.choice([0.0, 0.5, -2.0])))
    scale = 10 ** rng.uniform(-1, 2) if rng.random() < 0.5 else 1.0
    poles = [p * scale for p in (*_pair(rng, edges), *_pair(rng, edges))]
    if edges and rng.random() < 0.15:
        poles[2:] = poles[:2]
    return replace(
        own,
        parameters=own.parameters.replaced(changes),
        theta_0=rng.uniform(-1.2, 1.2) if rng.random() < 0.7 else 0.0,
        poles=PoleSet(poles),
        structure=structure,
        outer=_outer(rng, own.outer, edges),
    )


def random_stable_loops(count, seed, *, edges=False):
    """Loops that are stable: unstable plants among them, with and without integrators."""
    rng = np.random.default_rng(seed)
    while count:
        spec = random_spec(rng, edges=edges)
        try:
            loop = close_loop(place(spec), spec.outer)
        except Heli2DofError:
            continue
        if loop.stable:
            count -= 1
            yield loop


def _pair(rng, edges):
    kind = rng.random()
    if edges and kind < 0.15:
        return rng.choice([0.0, -1.0, -4.0], 2).tolist()
    if edges and kind < 0.25:
        im = float(rng.choice([0.0, 1.0, 2.5]))
        return 1j * im, -1j * im
    re = -(10 ** rng.uniform(-1, 1.2))
    if kind < 0.6:
        im = 10 ** rng.uniform(-1, 1)
        return complex(re, im), complex(re, -im)
    return re, -(10 ** rng.uniform(-1, 1.2))


def _outer(rng, own, edges):
    def gains(pi):
        off = edges and rng.random() < 0.15
        return PIGains(
            0.0 if off else pi.kp * 10 ** rng.uniform(-1.5, 0.3), pi.ti * 10 ** rng.uniform(-0.3, 1)
        )

    kind = "none" if rng.random() < 0.4 else "pi"
    crossed, decoupled = rng.random() < 0.15, rng.random() < 0.2
    return OuterLoop(kind, gains(own.pitch), gains(own.yaw), "cross" if crossed else "diagonal", decoupled)


def opened(loop, motor):
    """A, b, c of the loop with one motor's input opened; c holds that motor's law."""
    connected = list(loop.connected)
    b = np.zeros(len(loop.A))
    b[:4] = loop.design.plant.B[:, motor]
    law = loop.voltage_from_state[motor]
    A = (loop.A - np.outer(b, law))[np.ix_(connected, connected)]
    return A, b[connected], law[connected]


def exact_poles(loop, law=None, digits=60):
    """The connected poles of A + B law, the floats taken as they stand, by mpmath."""
    law = loop.voltage_from_state if law is None else law
    plant, n = loop.design.plant, len(loop.A)
    rows = [[Fraction(0)] * n for _ in range(n)]
    for i in range(4):
        for j in range(n):
            rows[i][j] = Fraction(plant.A[i, j]) if j < 4 else Fraction(0)
            for k in range(2):
                rows[i][j] += Fraction(plant.B[i, k]) * Fraction(law[k, j])
    for i in range(4, n):
        rows[i][i - 4] = Fraction(-1)
    with mpmath.workdps(digits):
        kept = loop.connected
        entries = [[mpmath.mpf(rows[i][j].numerator) / rows[i][j].denominator for j in kept] for i in kept]
        return mpmath.eig(mpmath.matrix(entries), left=False, right=False)
