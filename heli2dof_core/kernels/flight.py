"""A flight: the rig under its digital controller, tick by tick, while hands, gusts and faults act on it.

A tick is a sample of the controller, or an equal part of one. Within a tick nothing that acts changes, so that the
rig is integrated as in `dormand_prince`; what is asked for takes effect at a tick, changes of the controller at a
sample. All that is computed here is sums, products, quotients and roots: a browser gets the same digits.
"""

from __future__ import annotations

from math import floor, inf, pi
from typing import Any

from ..frozen import frozen
from ..signals import fixed
from . import examples
from .digital import held_speeds, sample_controller, sample_estimator, stop_at_travel
from .dormand_prince import integrate
from .flight_layout import (
    BASE,
    BY_REFERENCE,
    COMPUTED,
    ENDED_AS,
    FILTERS,
    FLIGHT_CONTROLLER,
    FLIGHT_INPUTS,
    FLIGHT_MEMORY,
    FLIGHT_ROW,
    GUST,
    GUST_FROM,
    GUST_TICKS,
    HAS,
    HITS,
    HUNG,
    MANUAL,
    NOISE,
    ON_STOP,
    OUTSIDE,
    PHASE,
    PUSH,
    PUSHED,
    READ,
    REFERENCE,
    SEED,
    SEEN,
    SENSED,
    SPEED,
    STATE,
    STICK,
    STUCK,
    THRUST,
    TICK,
    TICKS,
    TURN,
    TURN_FROM,
    UNLIMITED,
    VOLTAGE,
    WISH,
    WISHED,
    ZERO_ANGLE,
)
from .jit import copy_into, entry_point, kernel
from .layout import (
    ALPHA,
    BEFORE,
    BETA,
    DELAY,
    DISTURBANCE,
    ENDED,
    FILTER_FREQUENCY,
    FILTERED,
    GAIN,
    K_PP,
    K_PY,
    K_YP,
    K_YY,
    LIMIT,
    MGL,
    ML2,
    MORE_GAIN,
    OFFSET,
    RATE,
    REST,
    SIZES,
    STEP,
    TIME,
    TORQUE,
    USUAL,
    WANTED,
    WINDUP,
    WORKSPACE,
    F,
)
from .normal import normal
from .trigonometry import sine_and_cosine

FLOWN = SIZES[2]
"""The size of every flight's loop: what a rig or a controller lacks is 0, and either may change in the air."""


def example_controller() -> tuple[Any, Any, Any]:
    """That of an example: c, m and k, which nobody may change."""
    k = examples.zeros(FLIGHT_CONTROLLER)
    k[TIME], k[TICKS] = 1e-3, 1.0
    return frozen(examples.constants(FLOWN)), frozen(examples.modes(FLOWN)), fixed(k)


@entry_point(
    lambda: (
        FLOWN,
        examples.given(len(FLOWN)),
        *example_controller(),
        *(examples.zeros(len(FLOWN)), examples.zeros(FLIGHT_MEMORY), examples.modes(FLOWN)),
    )
)
def begin_flight(size, start, c, m, k, y, s, free):
    """A flight before its first tick, into `y`, `s` and `free`: at rest at `start`, its filters settled."""
    copy_into(start, y)
    stop_at_travel(y, c)
    for j in range(len(s)):
        s[j] = 0.0
    for axis in range(2):
        step = k[STEP + axis]
        seen = step * floor(y[axis] / step + 0.5) if step > 0.0 else y[axis]
        s[READ + axis] = s[SEEN + axis] = seen
        s[FILTERS + 2 * axis] = seen / (FILTER_FREQUENCY * FILTER_FREQUENCY)
        s[HAS + axis] = s[COMPUTED + axis] = s[WISHED + axis] = k[BEFORE + axis]
    copy_into(m, free)
    free[WINDUP] = 0


@entry_point(
    lambda: (
        FLOWN,
        examples.zeros(len(FLOWN)),
        examples.zeros(FLIGHT_MEMORY),
        examples.modes(FLOWN),
        *example_controller(),
        examples.estimated(),
        examples.zeros(FLIGHT_INPUTS),
        1,
        *examples.NUMBERS,
        examples.zeros(*WORKSPACE),
        examples.constants(FLOWN),
        examples.constants(FLOWN),
        examples.zeros(2),
        examples.zeros(2, len(FLOWN)),
        examples.zeros(1, FLIGHT_ROW),
    )
)
def fly(
    size, y, s, free, c, m, k, estimator, u, ticks, rtol, atol, most_steps, w, own, plant, grid, course, rows
):
    """So many ticks from the state y, (14,), on, under what acts, u; returns how many were flown.

    `s`, `free` (modes of the rig) and y go on with the flight, `c`, `m`, `k`, `estimator` are its controller's; a row
    per tick is filled, as it begins. Ends early where the integration gives up, which `s` tells from then on.
    Scratch: `w`, WORKSPACE, `own` and `plant` like c, `grid` (2,), `course` (2, 14).
    """
    step = k[TIME] / k[TICKS]
    rig_in_flight(c, u, plant)
    copy_into(c, own)
    seen = s[SEEN : SEEN + 10]
    for n in range(ticks):
        if s[ENDED_AS] != ENDED:
            return n
        refer(k, u, s[TICK], step, own)
        if s[PHASE] == 0.0:
            read_sensors(y, s, k, u, seen)
            keep_readings(s, k, seen)
            before0, before1 = s[COMPUTED], s[COMPUTED + 1]
            if u[MANUAL] != 0.0:
                take_sticks(u, c, s)
            else:
                sample_controller(size, y, own, m, k, seen, s[WISHED:], s[COMPUTED:])
            late = k[DELAY] != 0.0
            s[HAS] = before0 if late else s[COMPUTED]
            s[HAS + 1] = before1 if late else s[COMPUTED + 1]
        gust = gust_share(u, s[TICK])
        for i in range(2):
            plant[OFFSET + i] = s[HAS + i]
            plant[TORQUE + i] = s[PUSHED + i] = u[PUSH + i] + gust * u[GUST + i]
        fill_row(size, y, s, free, own, plant, rows[n])
        grid[0], grid[1] = 0.0, step
        z0, z1 = y[4], y[5]
        outcome, _, _, _, hits = integrate(size, y, grid, plant, free, rtol, atol, most_steps, w, course)
        y[4], y[5] = z0, z1
        s[HITS] += hits
        s[ENDED_AS] = outcome
        s[TICK] += 1.0
        s[PHASE] += 1.0
        if s[PHASE] >= k[TICKS]:
            s[PHASE] = 0.0
            sample_estimator(size, y, estimator, seen, s[HAS : HAS + 2])
    return ticks


@kernel
def take_sticks(u, c, s):
    """The sticks are the voltages, within the limits; the integrals rest."""
    for i in range(2):
        s[WISHED + i] = u[STICK + i]
        s[COMPUTED + i] = min(max(u[STICK + i], -c[LIMIT + i]), c[LIMIT + i])


@kernel
def rig_in_flight(c, u, plant):
    """The rig's own constants with what hangs on it and what its motors have lost; no controller."""
    copy_into(c, plant)
    for j in range(12):
        plant[GAIN + j] = 0.0
    for j in range(MORE_GAIN, USUAL):
        plant[j] = 0.0
    for motor in range(2):
        plant[LIMIT + motor], plant[DISTURBANCE + motor] = inf, 0.0
    for motor in range(2):
        plant[K_PP if motor == 0 else K_PY] *= u[THRUST + motor]
        plant[K_YP if motor == 0 else K_YY] *= u[THRUST + motor]
    plant[ALPHA] += u[HUNG]
    plant[ML2] += u[HUNG]
    plant[MGL] += u[HUNG + 1]


@kernel
def refer(k, u, tick, step, own):
    """References as they are at a tick, into the loop's constants."""
    since = (tick - u[TURN_FROM]) * step
    for i in range(2):
        own[WANTED + i] = u[REFERENCE + i] + since * u[TURN + i]
    for i in range(2):
        row = BY_REFERENCE + 2 * i
        pitch, yaw = own[WANTED] - k[ZERO_ANGLE], own[WANTED + 1]
        own[OFFSET + i] = k[BASE + i] + k[row] * pitch + k[row + 1] * yaw


@kernel
def read_sensors(y, s, k, u, seen):
    """Angles and rates as the controller knows them at a sample: θ, ψ, θ̇, ψ̇. A stuck encoder tells no rate."""
    for axis in range(2):
        reading, step = y[axis], k[STEP + axis]
        if u[NOISE + axis] > 0.0:
            reading += u[NOISE + axis] * normal(u[SEED], 2.0 * s[TICK] + axis)
        if step > 0.0:
            reading = step * floor(reading / step + 0.5)
        stuck = u[STUCK + axis] != 0.0
        seen[axis] = s[READ + axis] if stuck else reading
        if k[FILTERED] != 0.0:
            seen[2 + axis] = k[RATE] * s[FILTERS + 2 * axis + 1]
        else:
            seen[2 + axis] = 0.0 if stuck else y[2 + axis]


@kernel
def keep_readings(s, k, seen):
    """The encoders' readings, and the rate filters by one sample on."""
    for axis in range(2):
        s[READ + axis] = seen[axis]
        at = FILTERS + 2 * axis
        x0, x1 = s[at], s[at + 1]
        s[at] = k[F] * x0 + k[F + 1] * x1 + k[BETA] * seen[axis]
        s[at + 1] = k[F + 2] * x0 + k[F + 3] * x1 + k[BETA + 1] * seen[axis]


@kernel
def gust_share(u, tick):
    """How much of a gust's largest torque there is: (1 − cos)/2 over its length, as in airworthiness (CS-25.341)."""
    since = tick - u[GUST_FROM]
    if u[GUST_TICKS] <= 0.0 or since < 0.0 or since >= u[GUST_TICKS]:
        return 0.0
    _, cosine = sine_and_cosine(2.0 * pi * since / u[GUST_TICKS])
    return 0.5 * (1.0 - cosine)


@kernel
def fill_row(size, y, s, free, own, plant, row):
    """The course at a tick, before it is flown."""
    held_speeds(size, plant, y)
    for i in range(4):
        row[STATE + i], row[SENSED + i] = y[i], s[SEEN + i]
    for i in range(2):
        row[VOLTAGE + i], row[UNLIMITED + i], row[SPEED + i] = s[HAS + i], s[WISHED + i], y[6 + i]
        row[WISH + i], row[OUTSIDE + i] = own[WANTED + i], s[PUSHED + i]
    row[ON_STOP] = free[REST]
