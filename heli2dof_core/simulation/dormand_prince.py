"""Dormand and Prince's 5(4) pair with continuous output and one located event.

Sources: Dormand & Prince, J. Comput. Appl. Math. 6 (1980) 19–26 (the pair); Hairer, Nørsett &
Wanner, Solving Ordinary Differential Equations I, 2nd ed., II.4 (step control), II.6 (continuous
output of order 4).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..signals import Floats

RightHandSide = Callable[[Floats], Floats]
"""ẏ of an autonomous system."""
EventFunction = Callable[[Floats], float]
"""Its change from negative to positive ends the integration."""

_A = np.zeros((7, 7))
_A[1, :1] = [1 / 5]
_A[2, :2] = [3 / 40, 9 / 40]
_A[3, :3] = [44 / 45, -56 / 15, 32 / 9]
_A[4, :4] = [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729]
_A[5, :5] = [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656]
_A[6, :6] = [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84]
_ERROR = _A[6] - np.array([5179 / 57600, 0, 7571 / 16695, 393 / 640, -92097 / 339200, 187 / 2100, 1 / 40])
_DENSE = np.array(
    [
        -12715105075 / 11282082432,
        0,
        87487479700 / 32700410799,
        -10690763975 / 1880347072,
        701980252875 / 199316789632,
        -1453857185 / 822651844,
        69997945 / 29380423,
    ]
)


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
    state: Floats,
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
    n, end, done = len(state), float(samples[-1]), 0
    states = np.empty((n, len(samples)))
    k = np.empty((7, n))
    k[0] = rate(state)
    step = _first_step(state, k[0], end - t, rtol, atol)
    before = event(state) if event else 0.0
    for _ in range(most_steps):
        step = min(step, end - t)
        trial = state
        for i in range(1, 7):
            trial = state + step * (_A[i, :i] @ k[:i])
            k[i] = rate(trial)
        scale = atol + rtol * np.maximum(np.abs(state), np.abs(trial))
        error = _norm(step * (_ERROR @ k) / scale)
        if not error <= 1.0:  # also rejects a state that is not finite
            step *= max(0.2, 0.9 * error**-0.2) if np.isfinite(error) else 0.1
            if step < 1e-14 * max(end, 1.0):
                raise StepBudgetError("the step size vanished")
            continue

        after = event(trial) if event else 0.0
        found = event is not None and before < 0.0 <= after
        share = _locate(event, state, trial, step, k) if event and found else 1.0
        reached = t + share * step
        if share == 1.0 and end - reached < 1e-12 * end:
            reached = end
        count = int(np.searchsorted(samples, reached, side="right")) - done
        if count:
            shares = (samples[done : done + count] - t) / step
            states[:, done : done + count] = _continuous(state, trial, step, k, shares)
            done += count
        state = _continuous(state, trial, step, k, np.array([share]))[:, 0] if found else trial
        t, before = reached, after
        if found or t >= end:
            return Segment(states[:, :done], t, state, found)
        k[0] = k[6]
        step *= min(5.0, 0.9 * error**-0.2) if error > 0 else 5.0
    raise StepBudgetError(f"{most_steps} steps do not reach t = {end:g} s")


def _norm(vector: Floats) -> float:
    return float(np.sqrt(vector @ vector / len(vector)))


def _first_step(state: Floats, rate: Floats, length: float, rtol: float, atol: float) -> float:
    scale = atol + rtol * np.abs(state)
    size, speed = _norm(state / scale), _norm(rate / scale)
    return min(length, 1e-6 if min(size, speed) < 1e-5 else 0.01 * size / speed)


def _continuous(start: Floats, end: Floats, step: float, k: Floats, shares: Floats) -> Floats:
    """States at `shares` of the step, shape (n, m)."""
    difference = end - start
    bend = step * k[0] - difference
    twist = difference - step * k[6] - bend
    last = step * (_DENSE @ k)
    x, y = shares, 1.0 - shares
    inner = twist[:, None] + y * last[:, None]
    return start[:, None] + x * (difference[:, None] + y * (bend[:, None] + x * inner))


def _locate(event: EventFunction, start: Floats, end: Floats, step: float, k: Floats) -> float:
    """Share of the step at which the event function passes 0, by bisection."""
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        if event(_continuous(start, end, step, k, np.array([middle]))[:, 0]) < 0.0:
            low = middle
        else:
            high = middle
    return high
