"""PI values that suit the poles of the inner loop, by one rule for all methods."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from .augmentation import inner_loop
from .design import Design
from .eigenvalues import eigenvalues
from .errors import InvalidInputError
from .loop import Loop, close_loop
from .placement.groups import splits
from .placement.with_rotors import require_slopes
from .scenario import OuterLoop, PIGains
from .signals import AXES, Complexes
from .tables import Shown, Table, number

DAMPING = 0.7
"""Least damping ratio of every pole of the whole loop, where the inner loop's have as much, rotors included."""
EASED = 0.8
"""Share of the inner loop's own least damping that must remain where it has less."""

FACTORS = np.geomspace(0.01, 4.0, 22)
"""Factors on each axis' own kp that are tried, for both axes independently."""
GENTLE = np.geomspace(1e-5, 0.01, 16)
"""Tried besides where none of those complies: with small gains the loop's poles are near the placed."""

RULE = (
    "Each integral time cancels the slower pole of its pair (2ζ/ωₙ of a complex pair); the two gains are "
    "those of a grid with which the whole loop decays fastest while every pole keeps a damping ratio of "
    f"{DAMPING:g}, or {100 * EASED:.0f} % of the inner loop's own where it has less."
)


@dataclass(frozen=True, repr=False)
class Suggestion(Shown):
    """PI values for a design, the loop that they give, and the rule in words."""

    outer: OuterLoop
    loop: Loop
    rule: str = RULE

    def summary(self) -> str:
        """The values."""
        return "; ".join(
            f"{axis} kp {number(pi.kp)} V/rad, ti {number(pi.ti)} s"
            for axis, pi in (("pitch", self.outer.pitch), ("yaw", self.outer.yaw))
        )

    def tables(self) -> tuple[Table, ...]:
        """The poles of the whole loop with them."""
        return self.loop.tables()


def suggest_pi(design: Design, outer: OuterLoop = OuterLoop()) -> Suggestion:
    """PI gains for both loops from pole cancellation, checked on the whole loop.

    With T_i at the slower pole p_s, the loop of one axis is kp ĝ(0) p_s p_f / (s (s − p_f)), whose
    damping is ζ for kp ĝ(0) = p_f / (4 ζ² p_s). The coupling between the axes is not in that
    formula, so both gains are scaled over a grid, and the poles of the whole loop decide. The pairs are those that
    were placed; of a method that chooses its own poles, those that `axis_poles` finds.

    Raises:
        InvalidInputError: a placed pole is not stable, or no gain complies.
        UncontrollableError: a thrust curve has no slope at the trim.
    """
    G_0 = design.steady_state
    if not design.stable or G_0 is None:
        raise InvalidInputError(
            "PI values can be suggested for stable poles only",
            field="poles",
            hint="Place all four poles left of the imaginary axis.",
        )
    columns = (0, 1) if outer.pairing == "diagonal" else (1, 0)
    gains = []
    for axis, own in enumerate(axis_poles(design)):
        slow, fast = sorted(own, key=lambda p: abs(p.real))[:2]
        static = float(G_0[axis, columns[axis]])
        if static == 0:
            raise InvalidInputError(
                f"no PI values exist for {AXES[axis]}: at rest the motor that its loop drives does not move it",
                field="outer",
                hint="Try the other pairing, or another coupling.",
            )
        if outer.pairing == "cross" or outer.decoupler:
            static = abs(static)  # the loop sets the sign itself
        if slow.imag:
            ti, effort = -2 * slow.real / abs(slow) ** 2, 0.5
        else:
            ti, effort = -1 / slow.real, fast.real / slow.real / (4 * DAMPING**2)
        gains.append((effort / static, ti))
    target = min(DAMPING, EASED * _least_damping(_inner_poles(design)))
    best: Loop | None = None
    for factors in (FACTORS, GENTLE):
        pitch, yaw = ([_scaled(f, *own) for f in factors] for own in gains)
        found = _best_of(design, replace(outer, outer="pi"), pitch, yaw, target)
        best = max(filter(None, (found, best)), key=lambda loop: _merit(loop, target), default=None)
        if best and _merit(best, target)[0] >= round(target, 3):
            break
    if best is None:
        raise _nothing_found(design)
    return Suggestion(best.outer, best)


def _best_of(
    design: Design, outer: OuterLoop, pitch: Sequence[PIGains], yaw: Sequence[PIGains], target: float
) -> Loop | None:
    """The loop of most merit over a grid of gains, integral times alike; None where none is stable.

    The loop's matrix is affine in the gains: three corners give them all, and one call their poles.
    """

    def closed(p: PIGains, y: PIGains) -> Loop:
        return close_loop(design, replace(outer, pitch=p, yaw=y))

    corner = closed(pitch[0], yaw[0])
    kept = np.ix_(corner.connected, corner.connected)
    A = corner.A[kept]
    over = [(np.array([pi.kp for pi in own]) - own[0].kp) / (own[-1].kp - own[0].kp) for own in (pitch, yaw)]
    by_pitch, by_yaw = closed(pitch[-1], yaw[0]).A[kept] - A, closed(pitch[0], yaw[-1]).A[kept] - A
    stack = A + over[0][:, None, None, None] * by_pitch + over[1][:, None, None] * by_yaw
    poles = np.linalg.eigvals(stack.reshape(-1, *A.shape))
    decay = -np.max(poles.real, axis=1)
    size = np.maximum(np.abs(poles), np.finfo(float).tiny)
    damping = np.round(np.minimum(np.min(-poles.real / size, axis=1), target), 3)
    alike = np.round(decay / np.max(np.abs(decay)), 9)  # of those alike but for rounding, the smaller gains
    for k in np.lexsort((-alike, -damping)):
        if decay[k] <= 0.0:
            continue
        loop = closed(pitch[k // len(yaw)], yaw[k % len(yaw)])
        if loop.stable:
            return loop
    return None


def axis_poles(design: Design) -> tuple[Sequence[complex], Sequence[complex]]:
    """The inner loop's poles of pitch and of yaw, rad/s: the pairs that were placed.

    Where the method chooses its own, they are dealt, conjugates together, so that pitch's poles take part most in
    pitch's states, and yaw's in yaw's. What a pole takes part in says |v_ki w_ik| of its right and left eigenvectors
    (Pérez-Arriaga, Verghese and Schweppe, IEEE Trans. Power App. Syst. 101 (1982) 3117–3125).
    """
    if design.aims:
        return design.poles.values[:2], design.poles.values[2:]
    values, right = np.linalg.eig(design.A_closed)
    shares = np.abs(right * np.linalg.pinv(right).T)  # states by poles
    shares /= np.sum(shares, axis=0)
    n = len(values)
    owned = shares[0::2].sum(axis=0) - shares[1::2].sum(axis=0)  # the states take turns: pitch's, yaw's
    deals = splits(values.astype(np.complex128), (n // 2, n - n // 2))
    best = max(deals, key=lambda deal: sum(owned[list(deal[0])]), default=None)
    if best is None:  # three conjugate pairs of six cannot be dealt into two threes
        order = np.argsort(-owned, kind="stable")
        best = tuple(order[: n // 2]), tuple(order[n // 2 :])
    pitch, yaw = ([complex(values[i]) for i in own] for own in best)
    return pitch, yaw


def _inner_poles(design: Design) -> Complexes:
    """Of the inner loop with the rig's rotors, rad/s: those placed, unless the design does not know these."""
    if design.actuators is None or design.rotor_poles is not None:
        return design.closed_loop_poles
    require_slopes(design.actuators.slope)
    found = np.array(eigenvalues(inner_loop(design)[0]), dtype=np.complex128)
    if not max(found.real) < 0:
        raise InvalidInputError(
            "no PI values keep the loop stable: the rig's rotors make the inner loop unstable by itself",
            field="rotors",
            hint="Place slower poles, or place the rotors, too.",
        )
    return found


def _nothing_found(design: Design) -> InvalidInputError:
    lagging = design.actuators is not None and design.actuators.lags and design.rotor_poles is None
    return InvalidInputError(
        "no PI values were found that keep the whole loop stable",
        field="outer",
        hint="Try the cross pairing, the decoupler or another coupling"
        + (", slower poles, or place the rotors, too." if lagging else "."),
    )


def _merit(loop: Loop, target: float) -> tuple[float, float]:
    """Damping up to the target first, then the decay rate of the slowest pole (rad/s)."""
    poles = loop.connected_poles
    return round(min(_least_damping(poles), target), 3), -float(poles[0].real)


def _scaled(factor: float, kp: float, ti: float) -> PIGains:
    return PIGains(float(f"{factor * kp:.3g}"), float(f"{ti:.3g}"))


def _least_damping(poles: Complexes) -> float:
    return float(np.min(-poles.real / np.abs(poles)))
