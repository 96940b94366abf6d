"""A system and its closed loop over frequency: Bode plots, relative gains."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, floor, log10

import numpy as np

from ..eigenvalues import resolvent
from ..frozen import Frozen, frozen
from ..signals import Complexes, Floats
from .analysis import Analysis, rga_or_none
from .loop import ClosedLoop
from .model import System

PER_DECADE = 30
MOST_DECADES = 7
NEGLIGIBLE = 1e-6
"""Poles and zeros smaller than this share of the largest pole count as 0, and have no corner frequency."""


@dataclass(frozen=True)
class Bode(Frozen):
    """Over frequency ω, rad/s.

    Attributes:
        frequencies: evenly spaced decades.
        plant: Ĝ(jω), (n, q, p).
        loops: of each input the loop opened there, the other inputs' loops closed, (n, p); −1 is critical. With an
            observer, the observer is part of it.
        closed: from each reference to each output, (n, q, m).
        rga: |RGA(jω)| of the plant, (n, q, p); None where it does not exist.
    """

    frequencies: Floats
    plant: Complexes
    loops: Complexes
    closed: Complexes
    rga: Floats | None


def bode(analysis: Analysis, loop: ClosedLoop) -> Bode:
    """All frequency responses of a design, at frequencies that its poles and zeros ask for."""
    system = loop.system
    corners = [analysis.poles, analysis.zeros, loop.poles]
    if loop.observer is not None:
        corners.append(loop.observer.closed_loop_poles)
    w = frequencies(np.concatenate(corners))
    states, plant, sizes = _plant(system, tuple(w.tolist()))
    A, B, C, D = loop.matrices()
    q = len(system.C)
    closed = C[:q] @ resolvent(A, B, w) + D[:q]
    return Bode(w, plant, _each(_at_inputs(loop, w, states, plant)), closed, sizes)


@lru_cache(maxsize=32)  # from one move of a pole to the next these stay
def _plant(system: System, w: tuple[float, ...]) -> tuple[Complexes, Complexes, Floats | None]:
    """(jωI − A)⁻¹B, Ĝ(jω), and |RGA(jω)|, which takes longest of all."""
    states = resolvent(system.A, system.B, np.array(w))
    plant = system.C @ states + system.D
    rga = rga_or_none(plant)
    return frozen((states, plant, None if rga is None else np.abs(rga)))


def frequencies(corners: Complexes) -> Floats:
    """A decade around all corner frequencies."""
    sizes = np.abs(corners)
    sizes = sizes[sizes > NEGLIGIBLE * max(float(np.max(sizes, initial=0.0)), 1e-300)]
    low, high = (float(np.min(sizes)), float(np.max(sizes))) if len(sizes) else (1.0, 1.0)
    first, last = floor(log10(low)) - 1, ceil(log10(high)) + 1
    first = max(first, last - MOST_DECADES)
    return np.logspace(first, last, PER_DECADE * (last - first) + 1)


def _at_inputs(loop: ClosedLoop, w: Floats, states: Complexes, plant: Complexes) -> Complexes:
    """L(jω), p×p, of the loop opened at all inputs: what comes back there, with its sign turned."""
    own, K, K_z, L = loop.system, loop.K, loop.K_z, loop.L
    n, k = len(own.A), K_z.shape[1]
    s = 1j * w[:, None, None]
    if L is None:
        integral = K_z @ plant / s if k else 0.0
        return K @ states + integral
    steer = own.B - L @ own.D
    inner = np.block([[own.A - L @ own.C - steer @ K, steer @ K_z], [np.zeros((k, n + k))]])
    enter = np.vstack([L, -np.eye(k, len(own.C))])
    return -np.hstack([-K, K_z]) @ resolvent(inner, enter, w) @ plant


def _each(L: Complexes) -> Complexes:
    """Per input the loop there with the others closed: ℓ_i = L_ii − L_ij (I + L_jj)⁻¹ L_ji, j all inputs but i.

    So 1 + ℓ_i = 1 / S_ii with S = (I + L)⁻¹, without the difference that would cost its digits where ℓ_i is small
    (Skogestad & Postlethwaite, Multivariable Feedback Control, 2005, 3.2).
    """
    p = L.shape[-1]
    found = np.empty(L.shape[:2], dtype=np.complex128)
    for i in range(p):
        others = [j for j in range(p) if j != i]
        found[:, i] = L[:, i, i]
        if others:
            inner = np.eye(p - 1) + L[:, others][:, :, others]
            found[:, i] -= (L[:, [i]][:, :, others] @ np.linalg.solve(inner, L[:, others][:, :, [i]]))[
                :, 0, 0
            ]
    return found


def gain_and_phase(response: Complexes) -> tuple[Floats, Floats]:
    """|G| and its phase without jumps, rad, along the first axis; between −2π and 0 at the lowest frequency."""
    phase = np.unwrap(np.angle(response), axis=0)
    return np.abs(response), phase - 2 * np.pi * np.ceil(np.round(phase[:1] / (2 * np.pi), 9))
