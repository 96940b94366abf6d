"""Both models' responses to one experiment or several, and their measures, in a single call of a kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..engine import engine
from ..figures import AXIS_METRICS
from ..kernels.layout import AUGMENTED, COURSE, MOTOR_METRICS
from ..loop import Loop
from ..scenario import Limits, Model, Scenario
from ..scratch import scratch
from ..signals import Floats
from .experiment import NOTHING, numbers
from .linear import AT_REST, linear_response
from .nonlinear import ABSOLUTE_TOLERANCE, limited_response
from .response import Measured, Response

_MODELS: tuple[Model, ...] = ("linear", "nonlinear")


@dataclass
class Courses:
    """What the kernel `run_experiments` has filled for n experiments, laid out as it says."""

    t: Floats
    order: int
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
            return linear_response(x, self.t, self.linear[n, : self.order], self.voltages[n, 0], found)
        return limited_response(x, self.t, self.nonlinear[n, : self.order], self.voltages[n, 1], found)


def run_experiments(
    loop: Loop, limits: Limits, scenarios: Sequence[Scenario], most_steps: int | None = None
) -> Courses:
    """Linear and nonlinear responses to scenarios that differ in their references and their start alone.

    The same numbers as `simulate_linear` and `simulate_nonlinear` give; disturbances are left out.
    """
    first, plant, kernels = scenarios[0], loop.design.plant, engine()
    t, n = first.times, len(scenarios)
    experiments = np.array([numbers(loop, limits, scenario) for scenario in scenarios])
    filled = (
        np.empty((n, AUGMENTED, len(t))),
        np.empty((n, 6, len(t))),
        np.empty((n, 2, 2, len(t))),
        np.empty((n, 2, 2, AXIS_METRICS)),
        np.empty((n, 2, 2, MOTOR_METRICS)),
        np.empty((n, 2, COURSE)),
    )
    kernels.run_experiments(
        plant.constants,
        plant.trim,
        plant.theta_0,
        loop.voltage_from_state,
        loop.voltage_from_reference,
        NOTHING if loop.integral is None else loop.integral,
        loop.A,
        loop.B,
        loop.poles,
        experiments,
        t,
        first.rtol,
        ABSOLUTE_TOLERANCE * first.rtol,
        most_steps or kernels.most_steps,
        *scratch.experiments,
        np.empty((len(t) + 1, 6)),
        np.empty(len(t) + 1),
        AT_REST,
        *filled,
    )
    return Courses(t, len(loop.A), experiments, *filled)
