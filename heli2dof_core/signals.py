"""Order, names, symbols and units of states, inputs and outputs, used everywhere."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .frozen import frozen

Floats = NDArray[np.float64]
"""An array of real numbers."""
Complexes = NDArray[np.complex128]
"""An array of complex numbers."""


def fixed(values: ArrayLike) -> Floats:
    """An array of these numbers that nobody can change; to the kernels it is a type of its own."""
    return frozen(np.array(values, dtype=np.float64, order="C"))


@dataclass(frozen=True)
class Signal:
    """One signal: its name in replies, its printed symbol, its SI unit and its meaning."""

    name: str
    symbol: str
    unit: str
    meaning: str


STATES = (
    Signal("theta", "θ", "rad", "pitch angle"),
    Signal("psi", "ψ", "rad", "yaw angle"),
    Signal("theta_dot", "θ̇", "rad/s", "pitch rate"),
    Signal("psi_dot", "ψ̇", "rad/s", "yaw rate"),
)
INPUTS = (
    Signal("V_p", "V_p", "V", "voltage of the pitch motor (main rotor)"),
    Signal("V_y", "V_y", "V", "voltage of the yaw motor (tail rotor)"),
)
OUTPUTS = STATES[:2]
INTEGRALS = (
    Signal("z_p", "z_p", "rad·s", "integral of the pitch error"),
    Signal("z_y", "z_y", "rad·s", "integral of the yaw error"),
)
ROTORS = (
    Signal("v_p", "v_p", "V", "speed of the pitch motor's rotor, as the voltage that would hold it"),
    Signal("v_y", "v_y", "V", "speed of the yaw motor's rotor, as the voltage that would hold it"),
)
AXES = ("pitch", "yaw")
"""Names of the two axes and of their loops, in the order of the outputs."""

C: Floats = fixed(np.eye(2, 4))
"""Output matrix, 2×4: y = [θ, ψ] (theory: y = Cx)."""
