"""Both models' responses to one experiment or several, and their measures, in a single call of a kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..engine import engine
from ..figures import AXIS_METRICS
from ..kernels.layout import COURSE, MOTOR_METRICS
from ..loop import Loop
from ..scenario import Limits, Model, Scenario
from ..scratch import scratch
from ..signals import Floats
from .augmented import inner_starts, more_constants
from .experiment import NOTHING, numbers
from .linear import AT_REST, linear_response
from .nonlinear import ABSOLUTE_TOLERANCE, limited_response
from .response import Measured, Response

_MODELS: tuple[Model, ...] = ("linear", "nonlinear")


@dataclass
class Courses:
    """What the kernel `run_experiments` has filled for n experiments, laid out as it says."""

    loop: Loop
    t: Floats
    experiments: Floats
    linear: Floats
    nonlinear: Floats
    voltages: Floats
    axes: Floats
    motors: Floats
    courses: Floats

    def response(self, n: int, model: Model) -> Response:
        """The response of one model to the experiment `n`."""
        i, x = _MODELS.index(model), self.experiments[n]
        found = Measured(self.axes[n, i], self.motors[n, i], self.courses[n, i])
        if model == "linear":
            return linear_response(self.loop, x, self.t, (self.linear[n], self.voltages[n, 0]), found)
        return limited_response(self.loop, x, self.t, (self.nonlinear[n], self.voltages[n, 1]), found)


def run_experiments(
    loop: Loop, limits: Limits, scenarios: Sequence[Scenario], most_steps: int | None = None
) -> Courses:
    """Linear and nonlinear responses to scenarios that differ in their references and their start alone.

    The same numbers as `simulate_linear` and `simulate_nonlinear` give; disturbances are left out.
    """
    first, plant, kernels, size = scenarios[0], loop.design.plant, engine(), loop.size
    t, n = first.times, len(scenarios)
    experiments = np.array([numbers(loop, limits, scenario) for scenario in scenarios])
    filled = (
        np.empty((n, len(size) + 1, len(t))),
        np.empty((n, len(size), len(t))),
        np.empty((n, 2, 2, len(t))),
        np.empty((n, 2, 2, AXIS_METRICS)),
        np.empty((n, 2, 2, MOTOR_METRICS)),
        np.empty((n, 2, COURSE)),
    )
    law, A, B = loop.padded
    kernels.run_experiments(
        size,
        plant.constants,
        loop.design.trim,
        plant.theta_0,
        law,
        loop.voltage_from_reference,
        NOTHING if loop.integral is None else loop.integral,
        A,
        B,
        loop.poles,
        experiments,
        more_constants(loop),
        inner_starts(loop, experiments),
        t,
        first.rtol,
        ABSOLUTE_TOLERANCE * first.rtol,
        most_steps or kernels.most_steps,
        *scratch.experiments(len(size)),
        np.empty((len(t) + 1, len(size))),
        np.empty(len(t) + 1),
        AT_REST,
        *filled,
    )
    return Courses(loop, t, experiments, *filled)
