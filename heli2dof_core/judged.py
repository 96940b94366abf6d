"""A design and its whole loop in plain numbers, as remarks and replies take them, and what is to be said of them.

Numbers of an update come from its block (`read_block`), those of a `Design` or a `Loop` from their arrays.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import NamedTuple

from .findings import Finding
from .plant import Plant
from .remarks import (
    design_remarks,
    flat_thrust,
    lag_instability,
    loop_instability,
    loop_remarks,
    observer_instability,
)
from .rotors import Actuators
from .signals import AXES

Rows = Sequence[Sequence[float]]

RINGING = 0.2
"""Least damping ratio of a whole loop below which it is said to ring."""


class Placed(NamedTuple):
    """The numbers of a design.

    Attributes:
        plant: the rig at its operating point.
        method: that has placed the poles.
        K: its rows, of both motors.
        integral: rows of the method's own integral action; None where it has none.
        wanted: all poles asked for, rad/s.
        rotor_poles: the rotors' among them; None where these are not placed.
        aims: whether the method aims at `wanted`.
        poles: those of A − BK, in their order, rad/s.
        error, bound: how far these are from `wanted` (None without aim), and how far rounding may have moved them,
            rad/s.
        stable: whether all lie left of the imaginary axis.
        steady: whether there is a steady state.
    """

    plant: Plant
    method: str
    K: Rows
    integral: Rows | None
    wanted: Sequence[complex]
    rotor_poles: tuple[float, float] | None
    aims: bool
    poles: Sequence[complex]
    error: float | None
    bound: float
    stable: bool
    steady: bool


class Size(NamedTuple):
    """Figures of a gain: its norms, and κ₂ of the eigenvectors of A − BK, None where there are too few."""

    norm: float
    spectral_norm: float
    eigenvector_condition: float | None


def placed_findings(placed: Placed) -> tuple[Finding, ...]:
    """Remarks on the poles and the gain."""
    poles = placed.wanted if placed.aims else placed.poles
    verdict = {"stable": placed.stable, "steady": placed.steady}
    return design_remarks(placed.plant, placed.K, poles, placed.error, **verdict)


class Judged(NamedTuple):
    """The numbers of a whole loop.

    Attributes:
        placed: its design.
        by_axis: what each axis' integral drives, rows are the axes of the errors, V/(rad·s); None where nothing
            integrates.
        kp: of the PI loops of pitch and yaw, V/rad.
        decoupler: whether a static one is asked for.
        connected: the poles of the loop's connected states, slowest first, rad/s.
        poles: all of them, one per state.
        stable: whether the whole loop is.
        lag_margin: s; None where there is none.
        actuators: rotors and friction of the rig; None of the paper's.
        growing: a pole of the observer that does not decay, rad/s.
        L, observer_poles: of an observer that the loop acts on.
    """

    placed: Placed
    by_axis: Rows | None
    kp: tuple[float, float]
    decoupler: bool
    connected: Sequence[complex]
    poles: Sequence[complex]
    stable: bool
    lag_margin: float | None
    actuators: Actuators | None
    growing: complex | None
    L: Rows | None
    observer_poles: Sequence[complex] | None

    @property
    def trim(self) -> list[float]:
        """Voltages that hold the rig at its operating point, V."""
        return (self.placed.plant if self.actuators is None else self.actuators).trim.tolist()


def loop_findings(loop: Judged) -> Iterator[Finding]:
    """Remarks on the whole loop."""
    if loop.placed.integral is not None:
        yield _OWN_INTEGRAL_ACTION
    idle = () if loop.actuators is None else loop.actuators.idle
    if idle:
        yield flat_thrust(idle, stable=loop.stable)
    elif not loop.stable and (loop.by_axis is not None or loop.placed.stable):
        yield _instability(loop)
    if loop.by_axis is not None and loop.placed.integral is None:
        lacking = loop.decoupler and not loop.placed.steady
        if lacking or not (any(loop.by_axis[0]) and any(loop.by_axis[1])):
            yield from loop_remarks(loop.kp, loop.by_axis, no_decoupler=lacking)
    if loop.stable:
        damping = min([-p.real / abs(p) for p in loop.connected if p.imag], default=1.0)
        if damping < RINGING:
            yield Finding(
                "poorly_damped",
                "warning",
                f"The whole loop rings: its least damping ratio is {damping:.2f}. Lower the gains or raise the "
                "integral times.",
            )


_OWN_INTEGRAL_ACTION = Finding(
    "own_integral_action",
    "info",
    "The method has its own integral action. The PI loops are not used.",
)


def _instability(loop: Judged) -> Finding:
    """What has done it: the observer, the rotors' lag, the PI loops, or the state feedback."""
    if loop.growing is not None:
        return observer_instability(loop.growing)
    lag, limit = 0.0 if loop.actuators is None else float(loop.actuators.tau.max()), loop.lag_margin
    if limit is not None and lag >= limit:
        return lag_instability(lag, limit)
    closed: list[str] = []
    if loop.by_axis is not None and loop.placed.integral is None and loop.placed.stable:
        closed = [name for name, driven in zip(AXES, loop.by_axis, strict=True) if any(driven)]
    return loop_instability(loop.connected, closed, aims=loop.placed.aims, placed=loop.placed.stable)
