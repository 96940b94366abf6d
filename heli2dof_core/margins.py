"""Classical margins of each motor's loop, from eigenvalues instead of a frequency grid."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigvals

from .loop import Loop
from .signals import Floats

ON_AXIS = 1e-6
"""Relative distance from the imaginary axis within which an eigenvalue counts as a crossing."""


@dataclass(frozen=True)
class Margins:
    """Margins of the loop opened at one motor's input, the rest closed; None where unlimited.

    Attributes:
        gain_margin: smallest factor above 1 on the motor's gain that makes the loop unstable.
        gain_reduction_margin: largest factor below 1 that does.
        phase_margin: smallest phase lag or lead at a gain crossover that does, rad.
        delay_margin: smallest delay that does, s.
    """

    gain_margin: float | None
    gain_reduction_margin: float | None
    phase_margin: float | None
    delay_margin: float | None


def loop_margins(loop: Loop) -> tuple[Margins, Margins] | None:
    """Margins at the pitch and the yaw motor; None if the whole loop is unstable.

    L(s) = c (sI − A)⁻¹ b. Its gain crossovers are the imaginary eigenvalues of the Hamiltonian
    [[A, bbᵀ], [−cᵀc, −Aᵀ]] (Boyd, Balakrishnan & Kabamba 1989, with level 1); its phase crossovers
    are the imaginary zeros of L(s) − L(−s). Neither needs a grid, so neither can miss one, and the
    integrators at ω = 0, where `control.margin` reports a gain margin of 0, are no crossing.
    """
    if not loop.stable:
        return None
    return _margins(loop, 0), _margins(loop, 1)


def _margins(loop: Loop, motor: int) -> Margins:
    n = len(loop.A)
    b = np.zeros(n)
    b[:4] = loop.design.plant.B[:, motor]
    c = -loop.voltage_from_state[motor]
    A = loop.A + b[:, None] * c

    def response(omega: float) -> complex:
        return complex(c @ np.linalg.solve(1j * omega * np.eye(n) - A, b))

    gains = [-1.0 / value.real for w in _phase_crossovers(A, b, c) if (value := response(w)).real < 0.0]
    phases, delays = [], []
    for omega in _gain_crossovers(A, b, c):
        lag = float(np.angle(-response(omega))) % (2 * np.pi)  # phase above −180°, as a lag that closes it
        phases.append(min(lag, 2 * np.pi - lag))
        delays.append(lag / omega)
    return Margins(
        gain_margin=min((g for g in gains if g > 1.0), default=None),
        gain_reduction_margin=max((g for g in gains if g < 1.0), default=None),
        phase_margin=min(phases, default=None),
        delay_margin=min(delays, default=None),
    )


def _gain_crossovers(A: Floats, b: Floats, c: Floats) -> list[float]:
    hamiltonian = np.block([[A, np.outer(b, b)], [-np.outer(c, c), -A.T]])
    return _imaginary(np.linalg.eigvals(hamiltonian))


def _phase_crossovers(A: Floats, b: Floats, c: Floats) -> list[float]:
    n = len(A)
    size = 2 * n + 1
    pencil, mass = np.zeros((size, size)), np.eye(size)
    pencil[:n, :n], pencil[n:-1, n:-1] = A, -A
    pencil[:n, -1] = pencil[n:-1, -1] = b
    pencil[-1, :n] = pencil[-1, n:-1] = c
    mass[-1, -1] = 0.0
    zeros = np.asarray(eigvals(pencil, mass))
    return _imaginary(zeros[np.isfinite(zeros)])


def _imaginary(values: np.ndarray) -> list[float]:
    largest = float(np.max(np.abs(values), initial=0.0))
    return [
        float(v.imag) for v in values if v.imag > 1e-9 * max(largest, 1.0) and abs(v.real) <= ON_AXIS * abs(v)
    ]
