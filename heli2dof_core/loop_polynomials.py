"""A loop whose rotors take time, or whose controller estimates, as polynomials for margins and stability."""

from __future__ import annotations

import numpy as np

from .engine import engine
from .frozen import frozen
from .kernels.layout import (
    ALL_STATES,
    BY_ANGLES,
    BY_INTEGRALS,
    CONTROLLER,
    FILTERED_RATES,
    K_STATES,
    KIND,
    KIND_ROW,
    OBSERVED,
    OBSERVER_ROW,
    OMEGA,
    OWN_A,
    OWN_B,
    OWN_L,
    OWN_L_ANGLES,
    OWN_TAU,
    WHOLE_POLYNOMIALS,
    ZETA,
)
from .scratch import scratch
from .signals import Floats


def controller_numbers(
    K: Floats,
    proportional: Floats,
    integral: Floats | None,
    filters: tuple[float, float] | None = None,
    observer: tuple[Floats, Floats, Floats, Floats] | None = None,
) -> Floats:
    """A controller as `kernels.whole` takes it: u = −K x̂ − K_v v̂ + `proportional` e + `integral` ∫ e dt.

    Args:
        K: by the states, 2×4, or with both rotors' speeds, 2×6.
        proportional: by the errors of the measured angles, 2×2, V/rad.
        integral: by their integrals, 2×2, V/(rad·s); None where nothing integrates.
        filters: natural frequency, rad/s, and damping of what makes rates of the measured angles.
        observer: its own A (4×4) and B (4×2, the thrust curves' slopes within where it knows the rotors), L (4×2),
            and its rotors' time constants, s, shape (2,), 0 where it knows none.
    """
    c = np.zeros(CONTROLLER)
    c[:2, K_STATES : K_STATES + K.shape[1]] = K
    c[:2, BY_ANGLES : BY_ANGLES + 2] = -proportional
    if integral is not None:
        c[:2, BY_INTEGRALS:] = integral
    c[KIND_ROW, KIND] = ALL_STATES
    if filters is not None:
        c[KIND_ROW, [KIND, OMEGA, ZETA]] = FILTERED_RATES, *filters
    if observer is not None:
        A, B, L, tau = observer
        own = c[OBSERVER_ROW : OBSERVER_ROW + 2]
        own[:, OWN_A : OWN_A + 4], own[:, OWN_B : OWN_B + 2] = A[2:], B[2:]
        own[:, OWN_L : OWN_L + 2], own[:, OWN_L_ANGLES:] = L[2:], L[:2]
        c[KIND_ROW, KIND], c[KIND_ROW, OWN_TAU : OWN_TAU + 2] = OBSERVED, tau
    return frozen(c)


def whole_polynomials(A: Floats, B: Floats, tau: Floats, controller: Floats) -> Floats:
    """The loop's eight polynomials with the sizes of their terms, (8, 2, 16): see `kernels.whole`.

    Args:
        A: of the rig, 4×4.
        B: of the rig, 4×2, its columns times the slopes of the thrust curves at the trim.
        tau: both rotors' time constants, s, shape (2,).
        controller: of `controller_numbers`.
    """
    f = np.empty(WHOLE_POLYNOMIALS)
    engine().whole_polynomials(A, B, tau, controller, *scratch.whole, f)
    return frozen(f)
