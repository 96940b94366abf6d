"""Step responses of the real rig: gravity, coupling, voltage limits, anti-windup, travel stops."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import degrees

import numpy as np
from numpy.typing import NDArray

from ..engine import engine
from ..findings import Finding
from ..kernels.layout import (
    BOUND,
    CONSTANTS,
    GAIN,
    HELD,
    IMPACTS,
    LIMIT,
    MODES,
    MORE_CONSTANTS,
    MORE_MODES,
    OFFSET,
    PLAIN,
    REFERENCE,
    SHARE,
    START,
    STOP,
    TRACKING,
    WANTED,
    WORKSPACE,
)
from ..loop import Loop
from ..scenario import Limits, Scenario
from ..scratch import FOLLOWED_TWICE
from ..signals import AXES, INPUTS, Floats
from .augmented import inner_start, more_constants, own_states
from .experiment import NOTHING, experiment
from .response import Measured, Response, course_response, end_of_course, room

ABSOLUTE_TOLERANCE = 0.1
"""Absolute tolerance of the integration as a share of the relative one (states are of order 1)."""


@dataclass
class NonlinearLoop:
    """The loop around the nonlinear rig (Eqs. 9–12) as `kernels.rig` takes it; kernels write into it, too.

    Attributes:
        experiment: laid out as `layout` says.
        constants, modes: laid out as `kernels.rig` says.
        start: θ, ψ, θ̇, ψ̇, z_p, z_y at t = 0, and what the loop's size has behind them.
        disturbed_from: when the disturbance within `constants` sets in, s; infinite without one.
    """

    experiment: Floats
    constants: Floats
    modes: NDArray[np.int64]
    start: Floats
    disturbed_from: float

    @classmethod
    def of(cls, loop: Loop, limits: Limits, scenario: Scenario) -> NonlinearLoop:
        """The loop, limits and scenario as numbers; the loop's deviations become absolute."""
        plant, x = loop.design.plant, experiment(loop, limits, scenario)
        size, plain = loop.size, len(loop.size) == PLAIN
        constants = np.empty(CONSTANTS if plain else MORE_CONSTANTS)
        modes, start = np.empty(MODES if plain else MORE_MODES, dtype=np.int64), np.zeros(len(size))
        integral = NOTHING if loop.integral is None else loop.integral
        engine().nonlinear_loop(
            size,
            plant.constants,
            loop.design.trim,
            plant.theta_0,
            loop.padded[0],
            loop.voltage_from_reference,
            integral,
            x,
            more_constants(loop),
            constants,
            modes,
        )
        start[:4] = x[START:BOUND]
        start[PLAIN:] = inner_start(loop, x)[1, : len(size) - PLAIN]
        since = np.inf if scenario.disturbance is None else scenario.disturbance.time
        return cls(x, constants, modes, start, since)

    @property
    def gain(self) -> Floats:
        """∂u/∂y, 2×6: u = `gain` y + `offset`, V."""
        return self.constants[GAIN:OFFSET].reshape(2, 6)

    @property
    def offset(self) -> Floats:
        """Voltages at y = 0, shape (2,), V."""
        return self.constants[OFFSET:LIMIT]

    @property
    def reference(self) -> Floats:
        """θ_ref, ψ_ref, absolute, shape (2,), rad."""
        return self.constants[WANTED:TRACKING]

    @property
    def limits(self) -> Floats:
        """Of the voltages, shape (2,), V; infinite without saturation."""
        return self.constants[LIMIT:WANTED]


def simulate_nonlinear(
    loop: Loop, limits: Limits, scenario: Scenario, most_steps: int | None = None
) -> Response:
    """Response of the nonlinear rig under the loop, adaptive with tolerance `scenario.rtol`.

    The rig starts at rest at its operating point unless `scenario.initial` says otherwise. Whatever
    changes the rates abruptly is located: a voltage that reaches or leaves its limit, an integrator
    that clamping stops or lets go, pitch that meets its stop (without rebound) or leaves it, a rotor that enters
    or leaves its dead zone, an axis that friction holds or lets go. After `most_steps`, by default half a second's
    work or two, it is given up and a finding says so.
    """
    system, kernels, size = NonlinearLoop.of(loop, limits, scenario), engine(), loop.size
    t, found = scenario.times, room()
    states, voltages = np.empty((len(size), len(t))), np.empty((2, len(t)))
    kernels.run_nonlinear(
        size,
        system.constants,
        system.modes,
        loop.poles,
        system.experiment,
        inner_start(loop, system.experiment)[1],
        t,
        system.disturbed_from,
        scenario.rtol,
        ABSOLUTE_TOLERANCE * scenario.rtol,
        most_steps or kernels.most_steps,
        loop.design.trim,
        np.empty(WORKSPACE),
        np.empty((len(t) + 1, len(size))),
        np.empty(len(t) + 1),
        np.empty(FOLLOWED_TWICE),
        states,
        voltages,
        *found,
    )
    remarks = rig_findings(t, system.experiment.tolist(), found[2].tolist())
    return limited_response(
        loop, system.experiment, t, (states, voltages), Measured(*found), findings=remarks
    )


def limited_response(
    loop: Loop,
    x: Floats,
    t: Floats,
    course: tuple[Floats, Floats],
    found: Measured,
    *,
    findings: tuple[Finding, ...],
) -> Response:
    """The course of an experiment: states as the kernel has filled them, voltages, and what is to be said of it."""
    states, voltages = course
    pitch, yaw = found.course[SHARE:HELD].tolist()
    return course_response(
        "nonlinear",
        x.tolist(),
        t,
        found,
        states=own_states(loop, states),
        signals=loop.states,
        voltages=voltages,
        findings=findings,
        saturated=(pitch, yaw),
    )


def rig_findings(t: Floats, x: Sequence[float], course: Sequence[float]) -> tuple[Finding, ...]:
    """What is to be said of the rig's course of an experiment, both laid out as `layout` says."""
    end = end_of_course("nonlinear", t, course)
    quiet = not (course[SHARE] or course[SHARE + 1] or course[IMPACTS])
    if quiet and abs(x[START]) <= x[STOP] and abs(x[REFERENCE]) <= x[STOP]:
        return end
    return (*end, *_remarks(x, course))


def _remarks(x: Sequence[float], course: Sequence[float]) -> Iterator[Finding]:
    for i, signal in enumerate(INPUTS):
        share = course[SHARE + i]
        if share:
            yield Finding(
                f"saturation_{signal.name}",
                "warning",
                f"The {signal.meaning} is at its limit of ±{x[BOUND + i]:g} V for {_share(share)} of "
                f"{_what_is_stepped(x)}.",
            )
    travel = x[STOP]
    if abs(x[START]) > travel:
        yield Finding(
            "starts_on_stop",
            "warning",
            "The start angle lies beyond the pitch travel. The rig starts on its stop.",
        )
    if course[IMPACTS]:
        yield Finding("travel_stop", "warning", f"Pitch hits a stop of its travel at {_stop(travel)}.")
    if abs(x[REFERENCE]) > travel:
        yield Finding(
            "reference_beyond_stop",
            "warning",
            f"The pitch reference lies beyond the travel of {_stop(travel)} and cannot be reached. Choose a "
            "smaller step.",
        )


def _stop(travel: float) -> str:
    return f"±{degrees(travel):.1f}°"


def _share(share: float) -> str:
    """In percent as tables write it, and never 0 where something is."""
    return "less than 0.1 %" if share < 0.0005 else f"{100 * share:.{1 if share < 0.01 else 0}f} %"


def _what_is_stepped(x: Sequence[float]) -> str:
    """The experiment by its steps: tables tell each axis' step alone."""
    stepped = [axis for i, axis in enumerate(AXES) if x[REFERENCE + i] != x[START + i]]
    if len(stepped) == 1:
        return f"the {stepped[0]} step"
    return "the time while both axes step at once" if stepped else "the time"
