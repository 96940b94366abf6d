"""Step responses of the rig under a digital controller: samples, encoders, filtered rates, delay, noise."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil

import numpy as np

from ..engine import engine
from ..findings import Finding
from ..kernels.layout import FED, FILTER_DAMPING, FILTER_FREQUENCY, PLAIN, STEP, WORKSPACE
from ..loop import Loop
from ..scenario import Digital, Limits, Scenario
from ..scratch import FOLLOWED_TWICE
from ..signals import Floats
from .augmented import inner_start, sampled_estimator
from .nonlinear import ABSOLUTE_TOLERANCE, NonlinearLoop, limited_response, rig_findings
from .response import Measured, Response, room

SLOW_SAMPLING = 0.25
"""Sample time times the fastest pole beyond which the digital loop is no longer like the continuous one:
about 25 samples per period of it (Åström & Wittenmark, Computer-Controlled Systems, 1997, section 4.4
advises 10 to 30)."""


def simulate_digital(loop: Loop, limits: Limits, scenario: Scenario, digital: Digital) -> Response:
    """As `simulate_nonlinear`, the controller running every `digital.sample_time` on what it can measure.

    Angles are rounded to encoder steps, rates come from second-order filters on them, the voltages are
    held between samples and, with `digital.delay`, reach the motors one sample late, the first ones too: until
    then the motors have the trim that is fed forward, and 0 V without it. The integrals are sums (Euler), and an
    anti-windup acts at the samples.
    """
    system = NonlinearLoop.of(loop, limits, scenario)
    t = scenario.times
    size, start = loop.size, system.start.copy()
    settings = settings_of(digital, standing_voltages(loop, system))
    start[PLAIN:] = inner_start(loop, system.experiment, (settings[STEP], settings[STEP + 1]))[
        1, : len(size) - PLAIN
    ]
    states, held, found = np.empty((len(t), len(size))), np.empty((len(t), 2)), room()
    kernels = engine()
    kernels.run_digital(
        size,
        start,
        t,
        system.constants,
        system.modes.copy(),
        settings,
        sampled_estimator(loop, digital.sample_time),
        loop.poles,
        system.experiment,
        noise_of(scenario, digital),
        system.disturbed_from,
        scenario.rtol,
        ABSOLUTE_TOLERANCE * scenario.rtol,
        kernels.most_steps,
        loop.design.trim,
        np.zeros(WORKSPACE),
        np.empty_like(system.constants),
        np.empty_like(system.modes),
        np.empty(len(t) + 2),
        np.empty((len(t) + 2, len(size))),
        np.empty(FOLLOWED_TWICE),
        states,
        held,
        *found,
    )
    course, voltages = np.ascontiguousarray(states.T), np.ascontiguousarray(held.T)
    remarks = rig_findings(t, system.experiment.tolist(), found[2].tolist())
    remarks = (*remarks, *sampling_findings(loop, scenario, digital))
    return limited_response(
        loop, system.experiment, t, (course, voltages), Measured(*found), findings=remarks
    )


def noise_of(scenario: Scenario, digital: Digital) -> Floats:
    """What is added to the measured angles at each sample, rad: (samples of the controller, 2), or a row of zeros."""
    noises = np.hypot(scenario.noise, digital.noise)
    if not noises.any():
        return NO_NOISE
    # for twice the window: settling is looked at beyond its end
    count = ceil(2 * scenario.duration / digital.sample_time) + 2
    return noises * np.random.default_rng(digital.seed).standard_normal((count, 2))


NO_NOISE = np.zeros((1, 2))
"""What a quiet rig's samples have."""


def standing_voltages(loop: Loop, system: NonlinearLoop) -> Floats:
    """What the motors have until the controller's first voltages arrive: the trim fed forward, within the limits."""
    trim = loop.design.trim * system.experiment[FED]
    return np.clip(trim, -system.limits, system.limits)


def settings_of(digital: Digital, before: Floats) -> Floats:
    """`kernels.digital`'s array d; `before`, (2,), V, is what the motors have until the first voltages arrive."""
    steps = [2 * np.pi / counts if counts else 0.0 for counts in digital.encoders]
    filtered = float(digital.rates == "filtered")
    F, b = rate_filter(digital.sample_time)
    rate, delay = FILTER_FREQUENCY**2, float(digital.delay)
    return np.array([digital.sample_time, *steps, filtered, *F.ravel(), *b, rate, delay, *before])


def rate_filter(sample_time: float) -> tuple[Floats, Floats]:
    """F 2×2 and b of a rate filter, exact for held angles: x⁺ = F x + b θ, rate = `FILTER_FREQUENCY`² x₂."""
    from scipy.linalg import expm

    w, zeta = FILTER_FREQUENCY, FILTER_DAMPING
    continuous = np.array([[0.0, 1.0, 0.0], [-(w**2), -2 * zeta * w, 1.0], [0.0, 0.0, 0.0]])
    step = np.asarray(expm(continuous * sample_time), dtype=np.float64)
    return step[:2, :2], step[:2, 2]


def sampling_findings(loop: Loop, scenario: Scenario, digital: Digital) -> Iterator[Finding]:
    """What is to be said of the controller's sampling."""
    fastest = float(np.max(np.abs(loop.poles)))
    if digital.sample_time * fastest > SLOW_SAMPLING:
        yield Finding(
            "slow_sampling",
            "warning",
            f"A sample time of {1e3 * digital.sample_time:g} ms is slow for a pole {fastest:.3g} rad/s out: the "
            f"digital loop differs from the continuous one. Sample every "
            f"{1e3 * SLOW_SAMPLING / fastest:.2g} ms or faster.",
        )
    if scenario.anti_windup == "back-calculation" and loop.has_integrators and scenario.saturation:
        tracking = scenario.tracking_time or float(np.min(loop.integral_times))
        if tracking < digital.sample_time:
            yield Finding(
                "fast_tracking",
                "warning",
                f"A tracking time of {1e3 * tracking:.3g} ms is shorter than the sample time of "
                f"{1e3 * digital.sample_time:g} ms: at a limit the integral overshoots in every "
                "sample. Choose a longer one.",
            )
