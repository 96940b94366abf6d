"""What the state feedback acts on where the states are not measured: filtered rates, or an observer's estimate.

An observer x̂' = A x̂ + B u + L (y − C x̂) is placed by duality: (Aᵀ, Cᵀ) through the same full-rank construction
gives Lᵀ (Luenberger, IEEE TAC 11 (1966) 190–197); or L comes from a Riccati equation (Kalman & Bucy, J. Basic Eng. 83
(1961) 95–108). The poles of the loop are then those of A − BK and of A − LC together; margins are not kept (Doyle,
IEEE TAC 23 (1978) 756–757).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Annotated, Literal

import numpy as np

from .couplings import Coupling, Lead, Structure
from .design import Design
from .eigenvalues import eigenvalues
from .frozen import Frozen, frozen
from .kernels.layout import FILTER_DAMPING, FILTER_FREQUENCY
from .placement.observers import kalman_gain, observer_gain
from .poles import PoleSet
from .quantities import Quantity, documented, require_valid
from .scenario import Measured
from .signals import C, Complexes, Floats, fixed

Kind = Literal["full-rank", "kalman"]


@documented
@dataclass(frozen=True)
class Observer:
    """How the states are estimated from the angles and the voltages.

    `poles` are those of A − LC, (q₁, q₂) pitch's and (q₃, q₄) yaw's; a Kalman filter chooses its own.
    """

    poles: PoleSet = PoleSet([-40.0, -42.0, -41.0, -43.0])
    method: Annotated[
        Kind,
        Quantity("full-rank: its poles are placed; kalman: optimal for white noise of these densities"),
    ] = "full-rank"
    coupling: Annotated[Coupling, Quantity("of the estimate's errors")] = "axis-decoupled"
    lead: Annotated[Lead, Quantity("the axis that leads where the errors' coupling is triangular")] = "pitch"
    voltage_noise: Annotated[
        float,
        Quantity("white noise that a Kalman filter expects on the motors' voltages", "V/√Hz", 1e-9, 1e6),
    ] = 1.0
    angle_noise: Annotated[
        float, Quantity("white noise that it expects on the measured angles", "rad/√Hz", 1e-12, 1e3)
    ] = 1e-4

    def __post_init__(self) -> None:
        require_valid(self)

    @property
    def structure(self) -> Structure:
        """Of the estimate's errors."""
        return Structure(self.coupling, self.lead)


@dataclass(frozen=True)
class Estimator(Frozen):
    """ẇ = F w + G y + H u, in deviations from the trim: y = measured [θ, ψ], u = the motors' voltages.

    Attributes:
        measured: filtered or observer.
        F, G, H: (m, m), (m, 2), (m, 2), m = 4, or 6 where the rotors are estimated, too.
        from_state: x̂ by w, (n, m), n = 4, or 6 where the rotors are estimated.
        from_angles: x̂ by y, (n, 2).
        L: gain of an observer, (4, 2), 1/s and 1/s²; None of filters.
        wanted: poles asked for, rad/s, (4,); None where nothing is asked for.
        model: of an observer: A, B and its rotors' time constants, 0 where it knows none.
    """

    measured: Measured
    F: Floats
    G: Floats
    H: Floats
    from_state: Floats
    from_angles: Floats
    L: Floats | None = None
    wanted: Complexes | None = None
    model: tuple[Floats, Floats, Floats] | None = None

    @property
    def order(self) -> int:
        """M."""
        return len(self.F)

    @cached_property
    def poles(self) -> Complexes:
        """Eigenvalues of A − LC, rad/s, slowest first; of filters their own."""
        A = self.F[:4, :4]
        return frozen(np.array(sorted(eigenvalues(A), key=lambda p: (-p.real, -p.imag))))

    @property
    def growing(self) -> complex | None:
        """The pole asked for, rad/s, that lies farthest right, if it does not lie left of the imaginary axis."""
        farthest = max(
            () if self.wanted is None else self.wanted.tolist(), key=lambda p: p.real, default=-1.0
        )
        return complex(farthest) if farthest.real >= 0.0 else None


def estimator(design: Design, measured: Measured, observer: Observer | None = None) -> Estimator | None:
    """What the feedback of a design acts on; None where it has the states.

    Raises:
        StructureUnavailableError: there is no observer of this structure.
    """
    if measured == "states":
        return None
    if measured == "filtered":
        return _filters()
    return observe(design, observer or Observer())


def observe(design: Design, observer: Observer) -> Estimator:
    """The observer for a design: of the model that the design knows.

    Where the rotors are placed, it tells their speeds from the voltages, v̂' = (u − v̂)/τ, which needs no correction.
    """
    plant, actuators = design.plant, design.actuators
    L = (
        kalman_gain(plant.A, _thrust(design), observer.voltage_noise, observer.angle_noise)
        if observer.method == "kalman"
        else observer_gain(plant, observer.poles, observer.structure)
    )
    wanted = observer.poles.array if observer.method == "full-rank" else None
    A, B = plant.A - L @ C, _thrust(design)
    tau = np.zeros(2) if design.rotor_poles is None or actuators is None else actuators.tau
    if not tau.any():
        parts = (A, L, B, np.eye(4), np.zeros((4, 2)))
    else:
        lag, rest = np.diag(1.0 / tau), np.zeros((2, 4))
        F = np.vstack((np.hstack((A, B)), np.hstack((rest, -lag))))
        G, H = np.vstack((L, np.zeros((2, 2)))), np.vstack((rest.T, lag))
        parts = (F, G, H, np.eye(6), np.zeros((6, 2)))
    known = plant.A, fixed(B), fixed(tau)
    return Estimator("observer", *map(fixed, parts), L=L, wanted=wanted, model=known)


def _thrust(design: Design) -> Floats:
    """B of the model that the design knows, without its rotors' lag."""
    A, B = design.model
    return B if design.rotor_poles is None else np.vstack((np.zeros((2, 2)), A[2:4, 4:]))


def _filters() -> Estimator:
    """Second-order filters on both angles; per axis w = [filtered angle, its rate/ω]."""
    w, zeta = FILTER_FREQUENCY, FILTER_DAMPING
    one = w * np.array([[0.0, 1.0], [-1.0, -2.0 * zeta]])
    F, G = fixed(np.kron(np.eye(2), one)), fixed(np.kron(np.eye(2), np.array([[0.0], [w]])))
    rates = np.zeros((4, 4))
    rates[2, 1] = rates[3, 3] = w
    return Estimator("filtered", F, G, np.zeros((4, 2)), rates, fixed(np.eye(4, 2)))
