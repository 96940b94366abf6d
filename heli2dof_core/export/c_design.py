"""The numbers of the controller in C, as the digital rig runs it."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite

import numpy as np

from ..estimators import Estimator
from ..evaluate import loop_of
from ..frozen import Frozen
from ..kernels.layout import BACK_CALCULATION, CLAMPING, MOTOR_OF, TRACKING, TRAVEL, WINDUP
from ..loop import Loop
from ..scenario import Digital, Measured
from ..signals import Floats
from ..simulation.augmented import sampled_estimator
from ..simulation.digital import standing_voltages
from ..simulation.nonlinear import NonlinearLoop
from ..spec import Spec


@dataclass(frozen=True)
class Controller(Frozen):
    """The design as the digital rig runs it.

    Attributes:
        loop: its gains.
        measured: what the feedback acts on.
        sample_time: s.
        delay: whether the voltages reach the motors one sample late.
        trim: what is fed forward, (2,), V.
        before: what the motors have until the first voltages reach them, (2,), V.
        limits: (2,), V, infinite where there are none.
        windup: kind of anti-windup.
        motor_of: the motor that each integral drives.
        tracking: gains of back-calculation, 2×2, rad/(V·s).
        sampled: Φ (m×m), Γ_y and Γ_u (m×2) of w⁺ = Φ w + Γ_y y + Γ_u u, exact for what is held between samples; None
            without an observer.
    """

    loop: Loop
    measured: Measured
    sample_time: float
    delay: bool
    trim: Floats
    before: Floats
    limits: Floats
    windup: int
    motor_of: tuple[int, int]
    tracking: Floats
    sampled: tuple[Floats, Floats, Floats] | None

    @classmethod
    def of(cls, spec: Spec) -> Controller:
        """The numbers of a spec.

        Raises:
            Heli2DofError: the design does not exist, see `evaluate`.
        """
        loop, scenario = loop_of(spec), spec.scenario
        digital, system = scenario.digital or Digital(), NonlinearLoop.of(loop, spec.limits, scenario)
        pitch, yaw = system.modes[MOTOR_OF:WINDUP].tolist()
        sampled = None
        if loop.estimator is not None and scenario.measured == "observer":
            m, rows = loop.estimator.order, sampled_estimator(loop, digital.sample_time)
            sampled = rows[:m, :m], rows[:m, 6:8], rows[:m, 8:10]
        return cls(
            loop,
            scenario.measured,
            digital.sample_time,
            digital.delay,
            loop.design.trim if scenario.trim_feedforward else np.zeros(2),
            standing_voltages(loop, system),
            system.limits,
            int(system.modes[WINDUP]),
            (pitch, yaw),
            system.constants[TRACKING:TRAVEL].reshape(2, 2),
            sampled,
        )

    @property
    def observer(self) -> Estimator | None:
        """What estimates the states; None where the rates come from outside or from the filters."""
        return None if self.sampled is None else self.loop.estimator

    @property
    def told_late(self) -> bool:
        """Whether an observer has to remember the voltages, as they reach the motors one sample late."""
        return self.delay and self.sampled is not None

    @property
    def rotors_measured(self) -> bool:
        """Whether the rotors' speeds are fed back as they are measured."""
        return self.sampled is None and self.loop.design.K.shape[1] > 4

    @property
    def integrates(self) -> bool:
        """Whether anything does."""
        return self.loop.has_integrators

    @property
    def limited(self) -> bool:
        """Whether the voltages are."""
        return all(map(isfinite, self.limits))

    @property
    def clamps(self) -> bool:
        """Whether an integral stands still at a limit."""
        return self.windup == CLAMPING

    @property
    def tracks(self) -> bool:
        """Whether the integrals follow what the limits leave."""
        return self.windup == BACK_CALCULATION
