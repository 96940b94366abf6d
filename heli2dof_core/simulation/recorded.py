"""Recordings simulated: the rig under recorded voltages, and the digital rig under changing references."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..engine import engine
from ..errors import RecordingError, Wanted, nobody_leaves
from ..frozen import Frozen
from ..kernels.layout import (
    ACTUATED_SENSITIVITIES,
    ACTUATED_WORKSPACE,
    ESTIMATOR,
    GAIN,
    INNER,
    LAGGED,
    MORE_CONSTANTS,
    MORE_GAIN,
    PLAIN,
    RECORDED_WORKSPACE,
    SENSITIVITIES,
    STEP,
    TAU,
    TRAVEL,
    WORKSPACE,
)
from ..loop import Loop
from ..parameters import Parameters
from ..plant import rig_constants
from ..scenario import Digital, Limits, Scenario
from ..signals import Floats
from .augmented import inner_start
from .digital import settings_of, standing_voltages
from .nonlinear import ABSOLUTE_TOLERANCE, NonlinearLoop
from .sampled import run_sampled

SHARE_OF_TIME_CONSTANT = 0.05
"""Longest step of the Runge–Kutta method in the rig's shortest time constants: an error below 1e-8 per step."""
SHARE_OF_ROTORS = 0.2
"""Likewise in the rotors': their speeds are known, and only their effect is summed up, to 1e-6."""
RTOL = 1e-6
MOST_STEPS = 30_000_000
"""Steps of the Runge–Kutta method that one simulation of a recording may take: half a minute's work."""
_AT_A_STRETCH = 200_000
"""Steps between two looks whether somebody still waits."""


@dataclass(frozen=True)
class Recorded(Frozen):
    """A digital rig's run, a row per sample of its controller.

    Attributes:
        t: s, (n,).
        measured: θ, ψ as its encoders told them, (n, 2), rad.
        states: θ, ψ, θ̇, ψ̇, z_p, z_y as they were, and what the loop's size has behind them, (n, 6 or more).
        voltages: V_p, V_y from each sample to the next, (n, 2), V.
        references: θ_ref, ψ_ref, (n, 2), rad.
        done: samples until the simulation was given up; n if it was not.
    """

    t: Floats
    measured: Floats
    states: Floats
    voltages: Floats
    references: Floats
    done: int


@dataclass(frozen=True)
class Turning(Frozen):
    """Rotors under recorded voltages, and the friction of the axes that they drive.

    Attributes:
        constants: of `rotors.Actuators`, (10,).
        speeds: v_p, v_y at each sample, (n, 2), V.
        by_tau: their derivatives by their own time constants, (n, 2), V/s.
    """

    constants: Floats
    speeds: Floats
    by_tau: Floats

    def of_rig(self, p: Any, travel: float | None = None) -> Floats:
        """The kernels' constants."""
        c = np.zeros(MORE_CONSTANTS)
        c[:GAIN] = rig_constants(p)
        c[TRAVEL] = np.inf if travel is None else travel
        c[TAU:MORE_GAIN] = self.constants
        return c

    def short(self, step: float) -> float:
        """A step that is short for the rotors, too, s."""
        return min([step, *(SHARE_OF_ROTORS * tau for tau in self.constants[:2].tolist() if tau > 0)])

    def part(self, rows: slice) -> Turning:
        """Some rows."""
        return Turning(self.constants, self.speeds[rows], self.by_tau[rows])


def turning(
    constants: Floats, bounds: NDArray[np.int64], t: Floats, volts: Floats, away: Floats | None = None
) -> Turning:
    """Rotor speeds under held voltages (n, 2) at all t.

    In each stretch, `bounds` (stretches, 2), first and last + 1, they begin settled at its first voltages, or so far
    `away` from them, (stretches, 2), V. They depend on nothing but τ and V: what is wrong with that decays with τ,
    and no segment has unknown speeds.
    """
    speeds, by_tau, c = np.zeros(volts.shape), np.zeros(volts.shape), np.zeros(MORE_CONSTANTS)
    c[TAU:MORE_GAIN] = constants
    engine().run_rotors(bounds, t, volts, c, speeds, by_tau)
    if away is not None:  # a speed's equation is linear: what it begins with more decays by itself
        tau = np.where(constants[:2] > 0.0, constants[:2], np.inf)
        for (first, end), more in zip(bounds.tolist(), away * (constants[:2] > 0.0), strict=True):
            since = (t[first:end] - t[first])[:, None]
            left = more * np.exp(-since / tau)
            speeds[first:end] += left
            by_tau[first:end] += left * since / tau**2
    return Turning(constants, speeds, by_tau)


def longest_step(p: Parameters) -> float:
    """A step of the Runge–Kutta method that is short for this rig, s."""
    rates = p.B_p / p.alpha, p.B_y / p.J_y, np.sqrt(p.m * p.g * p.l / p.alpha), np.sqrt(abs(p.K_s) / p.alpha)
    return SHARE_OF_TIME_CONSTANT / max(1.0, *(abs(float(rate)) for rate in rates))


def run_held(
    p: Parameters,
    start: Floats,
    t: Floats,
    volts: Floats,
    travel: float | None,
    *,
    rotors: Turning | None = None,
    wanted: Wanted = nobody_leaves,
) -> Floats:
    """States (n, 4) at all t under held voltages (n, 2) from `start`; pitch is stopped at ±`travel` (rad).

    With `rotors` their thrust drives the axes, and these rub and stick.

    Raises:
        RecordingError: it takes more than `MOST_STEPS`.
    """
    states, constants = np.empty((len(t), 4)), np.zeros(TRAVEL + 1)
    constants[:GAIN] = rig_constants(p)
    constants[TRAVEL] = np.inf if travel is None else travel
    step, y = longest_step(p), np.array(start, dtype=float)
    if rotors is not None:
        constants, step = rotors.of_rig(p, travel), rotors.short(step)
    marks = np.arange(len(t))
    for first, end in _parts(np.column_stack([marks[:-1], marks[1:]]), t, step):
        wanted()
        rows = slice(first, end + 1)  # the last row of one part is the first of the next
        own = states[rows]
        if rotors is None:
            scratch = np.zeros(RECORDED_WORKSPACE)
            engine().run_held(y, t[rows], volts[rows], constants, step, scratch, own)
        else:
            scratch, speeds = np.zeros(ACTUATED_WORKSPACE), rotors.speeds[rows]
            engine().run_actuated_held(y, t[rows], volts[rows], speeds, constants, step, scratch, own)
        y = own[-1].copy()
    return states


def run_segments(
    p: Any,
    starts: Floats,
    bounds: NDArray[np.int64],
    t: Floats,
    volts: Floats,
    *,
    step: float,
    rotors: Turning | None = None,
    wanted: Wanted = nobody_leaves,
) -> tuple[Floats, Floats]:
    """Angles (n, 2) of each segment from its own start, and their derivatives (n, 2, SENSITIVITIES).

    `p` has Parameters' fields, of any value; `bounds`, (segments, 2), are first and last + 1; samples outside are 0.
    The derivatives are by θ, ψ, θ̇, ψ̇ at the segment's start, then by K_pp, K_py, K_yp, K_yy, B_p, B_y, K_s; with
    `rotors`, (n, 2, ACTUATED_SENSITIVITIES), then by τ_p, τ_y and by Coulomb friction in pitch and yaw.

    Raises:
        RecordingError: it takes more than `MOST_STEPS`.
    """
    if rotors is not None:
        return _actuated_segments(p, starts, bounds, t, volts, step=step, rotors=rotors, wanted=wanted)
    constants = np.array(rig_constants(p), dtype=float)
    outputs, slopes = np.zeros((len(t), 2)), np.zeros((len(t), 2, SENSITIVITIES))
    scratch = np.zeros(RECORDED_WORKSPACE)
    for first, end in _parts(bounds, t, step):
        wanted()
        own = slice(first, end)
        engine().run_segments(starts[own], bounds[own], t, volts, constants, step, scratch, outputs, slopes)
    return outputs, slopes


def _actuated_segments(
    p: Any,
    starts: Floats,
    bounds: NDArray[np.int64],
    t: Floats,
    volts: Floats,
    *,
    step: float,
    rotors: Turning,
    wanted: Wanted,
) -> tuple[Floats, Floats]:
    c, step, speeds, by_tau = rotors.of_rig(p), rotors.short(step), rotors.speeds, rotors.by_tau
    outputs, slopes = np.zeros((len(t), 2)), np.zeros((len(t), 2, ACTUATED_SENSITIVITIES))
    scratch = np.zeros(ACTUATED_WORKSPACE)
    for first, end in _parts(bounds, t, step):
        wanted()
        own = slice(first, end)
        engine().run_actuated_segments(
            starts[own], bounds[own], t, volts, speeds, by_tau, c, step, scratch, outputs, slopes
        )
    return outputs, slopes


def _parts(bounds: NDArray[np.int64], t: Floats, step: float) -> Iterator[tuple[int, int]]:
    """Runs of segments, first and last + 1, of some `_AT_A_STRETCH` steps each."""
    last = np.minimum(bounds[:, 1], len(t) - 1)
    count = np.ceil((t[last] - t[bounds[:, 0]]) / step) + (last - bounds[:, 0])
    total = np.cumsum(count)
    if len(total) and total[-1] > MOST_STEPS:
        raise RecordingError(
            f"the simulation of this recording takes {total[-1]:.2g} steps",
            field="parameters",
            hint=f"At most {MOST_STEPS:.0e} are made: a rig as stiff as this one (damping over inertia, a rotor's "
            "short time constant) needs a shorter recording.",
        )
    edges = np.flatnonzero(np.diff(total // _AT_A_STRETCH, prepend=-1.0) > 0).tolist()
    yield from zip(edges, [*edges[1:], len(bounds)], strict=True)


def run_recorder(
    loop: Loop,
    limits: Limits,
    digital: Digital,
    references: Floats,
    *,
    rig: Parameters | None = None,
    start: Floats | None = None,
    voltages: Floats | None = None,
    away: Floats | None = None,
    wanted: Wanted = nobody_leaves,
) -> Recorded:
    """The digital controller of `loop` on a rig, under references (n, 2) that may change at each sample.

    Rotors and friction are the loop's, and so is what estimates.

    Args:
        loop: the controller; clamping stops its integrals, the trim is fed forward.
        limits: of the rig.
        digital: sample time, encoders, filters, delay, noise.
        references: θ_ref, ψ_ref at each sample, rad.
        rig: the rig that it controls, the design's own by default.
        start: θ, ψ, θ̇, ψ̇, at rest at the operating point by default.
        voltages: V_p, V_y of the first sample; the integrals start so that the controller asks for them, and with
            a delay the motors have them until its first ones arrive.
        away: how far the rotors' speeds are from these voltages, (2,), V; without voltages rotors turn as the trim
            holds them.
        wanted: called now and then; what it raises ends the run.
    """
    theta_0, n = loop.design.plant.theta_0, len(references)
    theta, psi, theta_dot, psi_dot = (theta_0, 0.0, 0.0, 0.0) if start is None else start.tolist()
    first = (theta, psi, theta_dot, psi_dot)
    system = NonlinearLoop.of(loop, limits, Scenario(initial=first, samples=2))
    system.constants[:GAIN] = rig_constants(rig or loop.design.plant.parameters)
    at_zero = NonlinearLoop.of(loop, limits, Scenario(theta=0.0, psi=0.0, initial=first, samples=2)).offset
    references = np.ascontiguousarray(references, dtype=float)
    offsets = np.ascontiguousarray(at_zero + references @ loop.voltage_from_reference.T)
    before = standing_voltages(loop, system)
    plain, y = len(loop.size) == PLAIN, system.start.copy()
    if not plain:
        settings = settings_of(digital, before)
        y[PLAIN:] = inner_start(loop, system.experiment, (settings[STEP], settings[STEP + 1]))[
            1, : len(y) - PLAIN
        ]
    if voltages is not None:
        before = np.clip(np.asarray(voltages, dtype=float), -system.limits, system.limits)
        if not plain:
            y[PLAIN:LAGGED] = before + (0.0 if away is None else away)
        if loop.integral is not None:
            y[4:PLAIN] = _integrals(system, offsets[0], y, before)
    settings = settings_of(digital, before)
    noise = digital.noise * np.random.default_rng(digital.seed).standard_normal((n, 2))
    t = np.arange(n, dtype=np.float64) * digital.sample_time
    if not plain:
        done, measured, states, held = run_sampled(
            loop,
            system,
            y,
            settings=settings,
            noise=noise,
            references=references,
            offsets=offsets,
            rtol=RTOL,
            wanted=wanted,
        )
        return Recorded(t, measured, states, held, references, done)
    measured, states, held = np.full((n, 2), np.nan), np.full((n, 6), np.nan), np.full((n, 2), np.nan)
    kernels, c = engine(), system.constants
    numbers = (RTOL, ABSOLUTE_TOLERANCE * RTOL, kernels.most_steps)
    scratch = (np.zeros(WORKSPACE), c.copy(), c.copy(), system.modes.copy(), np.empty(2), np.empty((2, 6)))
    _, done, _ = kernels.run_recorder(
        y, c, system.modes.copy(), settings, noise, references, offsets, *numbers,
        *scratch, measured, states, held,
    )  # fmt: skip
    return Recorded(t, measured, states, held, references, done)


def _integrals(system: NonlinearLoop, offset: Floats, y: Floats, voltages: Floats) -> Floats:
    """z_p, z_y with which the controller asks for these voltages; 0 where it cannot."""
    missing = voltages - offset - system.gain[:, :4] @ y[:4]
    if len(y) > PLAIN:
        more = system.constants[MORE_GAIN:ESTIMATOR].reshape(2, INNER)
        missing = missing - more[:, : len(y) - PLAIN] @ y[PLAIN:]
    return np.asarray(np.linalg.lstsq(system.gain[:, 4:], missing, rcond=None)[0], dtype=np.float64)


def exact(digital: Digital) -> Digital:
    """The same controller, knowing its state exactly."""
    return replace(digital, encoders=(0, 0), rates="true", noise=0.0)
