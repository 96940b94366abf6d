"""The symmetric root locus: where the poles of the optimal loop go as effort gets cheaper or dearer."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .design import Design
from .eigenvalues import courses, eigenvalues
from .errors import InvalidInputError
from .frozen import Frozen
from .judged import Placed
from .placement.method import Weights
from .placement.registry import METHODS
from .placement.riccati import Regulator
from .placement.with_rotors import with_rotors
from .rotors import Actuators
from .signals import Complexes, Floats, fixed

DEAREST = 1e4
"""The largest factor on R; the smallest is its inverse."""
STEPS = 192


@dataclass(frozen=True)
class RootLocus(Frozen):
    """The poles of A − BK over a factor ρ on R: K minimizes ∫ (xᵀQx + ρ uᵀRu) dt.

    Attributes:
        rho: (steps + 1,), from `DEAREST` down to its inverse on a logarithmic grid; 1 is the middle.
        poles: rad/s, (steps + 1, n), each column the course of one pole.
    """

    rho: Floats
    poles: Complexes


def optimal_poles(placed: Placed, rotors: Actuators | None = None) -> list[complex]:
    """The poles of the optimal loop, rad/s, slowest first: of A − BK, or with its integrators ż = r − y.

    Args:
        placed: a quadratic method's design.
        rotors: of the rig, where they are states of the model.
    """
    A, B, K = placed.plant.A, placed.plant.B, np.array(placed.K)
    if placed.rotor_poles is not None and rotors is not None:
        A, B = with_rotors(A, B * rotors.slope, rotors.tau)
    closed = A - B @ K
    if placed.integral is not None:
        closed = np.block([[closed, B @ np.array(placed.integral)], [-np.eye(2, len(A)), np.zeros((2, 2))]])
    return sorted(eigenvalues(closed), key=lambda p: (-p.real, -p.imag))


def symmetric_root_locus(design: Design, weights: Weights, steps: int = STEPS) -> RootLocus:
    """The locus of a quadratic method's poles, with its integrators where it has them.

    They are the stable eigenvalues of the Hamiltonian matrix [[A, −B R⁻¹ Bᵀ/ρ], [−Q, −Aᵀ]], which lie symmetric to
    the imaginary axis (Kailath, Linear Systems, 1980, section 3.4; Kwakernaak and Sivan, 1972, section 3.8).

    Args:
        design: by a quadratic method; only its model counts.
        weights: of the rig; ρ = 1 is the design with these.
        steps: even.

    Raises:
        InvalidInputError: the method has no weights.
    """
    chosen = METHODS[design.method]
    if not chosen.weighted:
        raise InvalidInputError(
            f"{chosen.short} has no weights, and so no symmetric root locus",
            field="method",
            value=design.method,
            hint="Choose " + " or ".join(name for name, own in METHODS.items() if own.weighted) + ".",
        )
    task, *_ = _regulator(design, weights, integrates=chosen.integrates).in_own_units()
    n = len(task.A)
    rho = np.geomspace(DEAREST, 1.0 / DEAREST, steps + 1)
    rho[steps // 2] = 1.0
    hamiltonian = np.empty((steps + 1, 2 * n, 2 * n))
    hamiltonian[:, :n, :n], hamiltonian[:, n:, n:] = task.A, -task.A.T
    share = 1.0 / np.sqrt(rho)[:, None, None]  # costates in units in which both halves are of one size
    hamiltonian[:, :n, n:] = -share * (task.B / task.inputs) @ task.B.T
    hamiltonian[:, n:, :n] = -share * np.diag(task.states)
    both = np.linalg.eigvals(hamiltonian).astype(np.complex128)
    order = np.argsort(both.real, axis=1, kind="stable")
    stable = np.take_along_axis(both, order, axis=1)[:, :n] * task.speed
    return RootLocus(fixed(rho), courses(stable))


def _regulator(design: Design, weights: Weights, *, integrates: bool) -> Regulator:
    """What the method minimizes: the rotors' speeds, where they are states of the model, have no weight."""
    A, B = design.model
    n = len(A)
    states = [*weights.states, *(0.0,) * (n - len(weights.states))]
    if integrates:
        A = np.block([[A, np.zeros((n, 2))], [np.eye(2, n), np.zeros((2, 2))]])
        B = np.vstack((B, np.zeros((2, 2))))
        states += weights.integrals
    return Regulator(A, B, np.array(states), np.array(weights.inputs), 2 if integrates else 0)
