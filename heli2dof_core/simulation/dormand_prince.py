"""Dormand and Prince's 5(4) pair with continuous output and one located event.

Sources: Dormand & Prince, J. Comput. Appl. Math. 6 (1980) 19–26 (the pair); Hairer, Nørsett &
Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.4 (step control), II.6 (continuous
output of order 4).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import inf, isfinite, sqrt

import numpy as np

from ..signals import Floats

State = Sequence[float]
RightHandSide = Callable[[State], State]
"""ẏ of an autonomous system, on plain floats: a scalar NumPy operation costs ten times a Python one."""
EventFunction = Callable[[State], float]
"""Its change from negative to positive ends the integration."""


class StepBudgetError(RuntimeError):
    """The steps allowed did not suffice: the system is stiff for an explicit method."""


@dataclass(frozen=True)
class Segment:
    """The course from a start to the end or to the event.

    Attributes:
        states: at the sample times that were reached, shape (n, reached).
        t, state: where the integration ended.
        event: whether the event ended it.
    """

    states: Floats
    t: float
    state: Floats
    event: bool


def integrate(
    rate: RightHandSide,
    t: float,
    state: State | Floats,
    samples: Floats,
    *,
    rtol: float,
    atol: float,
    event: EventFunction | None = None,
    most_steps: int = 20_000,
) -> Segment:
    """Integrates an autonomous system from `t` over all `samples` ≥ t, or to its first event.

    Args:
        rate: the right-hand side.
        t: start, s.
        state: start, shape (n,).
        samples: increasing times at which the states are wanted, shape (m,).
        rtol: relative tolerance per step.
        atol: absolute tolerance per step, in the states' units.
        event: its change from < 0 to ≥ 0 ends the integration, located on the continuous output.
        most_steps: after that many steps the system counts as stiff.

    Raises:
        StepBudgetError: more than `most_steps` would be needed.
    """
    y, end = [float(value) for value in state], float(samples[-1])
    k_1 = rate(y)
    step = _first_step(y, k_1, end - t, rtol, atol)
    before = event(y) if event else 0.0
    pieces: list[_Piece] = []
    for _ in range(most_steps):
        step = min(step, end - t)
        trial, slopes = _stages(rate, y, k_1, step)
        error = _error(y, trial, slopes, step, rtol=rtol, atol=atol)
        if not error <= 1.0:  # also rejects a state that is not finite
            step *= max(0.2, 0.9 * error**-0.2) if isfinite(error) else 0.1
            if step < 1e-14 * max(end, 1.0):
                raise StepBudgetError("the step size vanished")
            continue

        piece = _piece(t, step, y, trial, slopes)
        pieces.append(piece)
        after = event(trial) if event else 0.0
        if event and before < 0.0 <= after:
            share = _locate(event, piece)
            t += share * step
            return Segment(_at_samples(pieces, samples, t), t, np.array(_point(piece, share)), event=True)
        t, y, before = t + step, trial, after
        if end - t < 1e-12 * end:
            return Segment(_at_samples(pieces, samples, end), end, np.array(y), event=False)
        k_1 = slopes[6]
        step *= min(5.0, 0.9 * error**-0.2) if error > 0.0 else 5.0
    raise StepBudgetError(f"{most_steps} steps do not reach t = {end:g} s")


def _stages(rate: RightHandSide, y: State, k_1: State, h: float) -> tuple[list[float], list[State]]:
    """The state after a step of h, and the seven slopes; the last one is the next step's first."""
    k_2 = rate([v + h * (a / 5) for v, a in zip(y, k_1, strict=True)])
    k_3 = rate([v + h * (3 * a + 9 * b) / 40 for v, a, b in zip(y, k_1, k_2, strict=True)])
    k_4 = rate(
        [v + h * (_C4[0] * a + _C4[1] * b + _C4[2] * c) for v, a, b, c in zip(y, k_1, k_2, k_3, strict=True)]
    )
    k_5 = rate(
        [
            v + h * (_C5[0] * a + _C5[1] * b + _C5[2] * c + _C5[3] * d)
            for v, a, b, c, d in zip(y, k_1, k_2, k_3, k_4, strict=True)
        ]
    )
    k_6 = rate(
        [
            v + h * (_C6[0] * a + _C6[1] * b + _C6[2] * c + _C6[3] * d + _C6[4] * e)
            for v, a, b, c, d, e in zip(y, k_1, k_2, k_3, k_4, k_5, strict=True)
        ]
    )
    trial = [
        v + h * (_C7[0] * a + _C7[1] * c + _C7[2] * d + _C7[3] * e + _C7[4] * f)
        for v, a, c, d, e, f in zip(y, k_1, k_3, k_4, k_5, k_6, strict=True)
    ]
    return trial, [k_1, k_2, k_3, k_4, k_5, k_6, rate(trial)]


def _error(y: State, trial: State, slopes: list[State], h: float, *, rtol: float, atol: float) -> float:
    """Estimated error of a step, root mean square over the tolerances; accepted up to 1."""
    total = 0.0
    k_1, _, k_3, k_4, k_5, k_6, k_7 = slopes
    for v, w, a, c, d, e, f, g in zip(y, trial, k_1, k_3, k_4, k_5, k_6, k_7, strict=True):
        difference = _E[0] * a + _E[1] * c + _E[2] * d + _E[3] * e + _E[4] * f + _E[5] * g
        total += (h * difference / (atol + rtol * max(abs(v), abs(w)))) ** 2
    return sqrt(total / len(y)) if isfinite(total) else inf


def _first_step(y: State, slope: State, length: float, rtol: float, atol: float) -> float:
    """A hundredth of the time in which the state would change by itself (Hairer, II.4)."""
    scale = [atol + rtol * abs(v) for v in y]
    size = sqrt(sum((v / s) ** 2 for v, s in zip(y, scale, strict=True)) / len(y))
    speed = sqrt(sum((v / s) ** 2 for v, s in zip(slope, scale, strict=True)) / len(y))
    return min(length, 1e-6 if min(size, speed) < 1e-5 else 0.01 * size / speed)


@dataclass(frozen=True, slots=True)
class _Piece:
    """One accepted step's continuous output of order 4: five coefficients per state (Hairer, II.6)."""

    t: float
    step: float
    coefficients: tuple[State, ...]


def _piece(t: float, h: float, y: State, trial: State, slopes: list[State]) -> _Piece:
    k_1, _, k_3, k_4, k_5, k_6, k_7 = slopes
    change = [w - v for v, w in zip(y, trial, strict=True)]
    bend = [h * a - d for a, d in zip(k_1, change, strict=True)]
    twist = [d - h * g - b for d, g, b in zip(change, k_7, bend, strict=True)]
    last = [
        h * (_D[0] * a + _D[1] * c + _D[2] * d + _D[3] * e + _D[4] * f + _D[5] * g)
        for a, c, d, e, f, g in zip(k_1, k_3, k_4, k_5, k_6, k_7, strict=True)
    ]
    return _Piece(t, h, (y, change, bend, twist, last))


def _point(piece: _Piece, x: float) -> list[float]:
    """The state at the share x of a step."""
    z = 1.0 - x
    return [
        v + x * (d + z * (b + x * (w + z * q))) for v, d, b, w, q in zip(*piece.coefficients, strict=True)
    ]


def _at_samples(pieces: list[_Piece], samples: Floats, until: float) -> Floats:
    """States at all samples up to `until`, shape (n, reached)."""
    wanted = samples[: int(np.searchsorted(samples, until, side="right"))]
    starts = np.array([piece.t for piece in pieces])
    steps = np.array([piece.step for piece in pieces])
    which = np.clip(np.searchsorted(starts, wanted, side="right") - 1, 0, len(pieces) - 1)
    x = (wanted - starts[which]) / steps[which]
    table = np.array([piece.coefficients for piece in pieces])  # steps × 5 × n
    y, change, bend, twist, last = table[which].transpose(1, 2, 0)
    z = 1.0 - x
    return y + x * (change + z * (bend + x * (twist + z * last)))


def _locate(event: EventFunction, piece: _Piece) -> float:
    """Share of the step at which the event function passes 0, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        if event(_point(piece, middle)) < 0.0:
            low = middle
        else:
            high = middle
    return high


_C4 = (44 / 45, -56 / 15, 32 / 9)
_C5 = (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729)
_C6 = (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656)
_C7 = (35 / 384, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84)
_E = (
    35 / 384 - 5179 / 57600,
    500 / 1113 - 7571 / 16695,
    125 / 192 - 393 / 640,
    -2187 / 6784 + 92097 / 339200,
    11 / 84 - 187 / 2100,
    -1 / 40,
)
_D = (
    -12715105075 / 11282082432,
    87487479700 / 32700410799,
    -10690763975 / 1880347072,
    701980252875 / 199316789632,
    -1453857185 / 822651844,
    69997945 / 29380423,
)
