"""Exact step responses of the linear loop: one matrix exponential, then doubling."""

from __future__ import annotations

import numpy as np

from ..engine import engine
from ..findings import Finding
from ..kernels.layout import exact_shapes
from ..loop import Loop
from ..scenario import Scenario
from ..scratch import FOLLOWED_TWICE
from ..signals import Floats, fixed
from .augmented import inner_start, own_states
from .experiment import experiment
from .response import Measured, Response, course_response, end_of_course, room


def simulate_linear(loop: Loop, scenario: Scenario, most_steps: int | None = None) -> Response:
    """Step response of the loop without limits, exact at every sample.

    Ignores saturation, anti-windup, travel stops, friction and feed-forward; thrust curves are straight. The states
    are augmented by a constant 1 that carries the references, so that one exponential holds the whole step. Its
    figures are given up after `most_steps` groups of steps, by default a tenth of a second's work.
    """
    x, t, size = experiment(loop, None, scenario), scenario.times, loop.size
    law, A, B = loop.padded
    states, voltages, found, kernels = (
        np.empty((len(size) + 1, len(t))),
        np.empty((2, len(t))),
        room(),
        engine(),
    )
    kernels.run_linear(
        size,
        loop.design.plant.theta_0,
        law,
        loop.voltage_from_reference,
        A,
        B,
        loop.poles,
        x,
        inner_start(loop, x)[0],
        t,
        most_steps or kernels.most_steps,
        fixed(loop.design.plant.trim),
        *map(np.empty, exact_shapes(len(size))),
        np.empty(FOLLOWED_TWICE),
        states,
        voltages,
        *found,
    )
    remarks = end_of_course("linear", t, found[2].tolist())
    return linear_response(loop, x, t, (states, voltages), Measured(*found), findings=remarks)


def linear_response(
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
    return course_response(
        "linear",
        x.tolist(),
        t,
        found,
        states=own_states(loop, states),
        signals=loop.states,
        voltages=voltages,
        findings=findings,
    )
