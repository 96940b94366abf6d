"""The rig as an environment of Gymnasium, for policies that learn or are written; needs the extra ``gym``.

>>> import gymnasium
>>> env = gymnasium.make("heli2dof_core.gym_env:heli2dof/Heli-v0", seconds=10.0)
>>> observation, info = env.reset(seed=1)
>>> observation.shape
(6,)
"""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box
from numpy.typing import NDArray

from .engine import warm_up
from .errors import InvalidInputError
from .flight import FlightLog, Rig
from .flight.rig import LARGEST_SEED, LONGEST
from .flight.tasks.task import ticks_of
from .kernels.flight_layout import OUTSIDE, SENSED, STATE, VOLTAGE, WISH
from .signals import Floats
from .spec import Spec

_FARTHEST = np.array([1e3, 1e3, 1e3, 1e3, 1e3, 1e3])
"""Of an observation: an angle at which a flight ends, and rates beyond all that a rig reaches; rad and rad/s."""
_GUST = (0.2, 1.0)
"""Shortest and longest gust, s."""


class HeliEnv(gymnasium.Env[Floats, NDArray[np.float32]]):
    """Bring pitch and yaw to set points with the motors' voltages: the nonlinear rig, with its sensors and limits.

    An action is (V_p, V_y) as shares of the motors' limits, −1 to 1, held for `samples` of the controller. An
    observation is θ, ψ, θ̇, ψ̇ as the rig's sensors tell them, and the set points of θ and ψ: rad and rad/s. Set points
    are drawn anew every `every` s, from around the operating point. The reward of a step is minus the integral over
    it of both errors squared, rad², and of `effort` times both voltages' shares squared. An episode is truncated
    after `seconds`, and terminates where the rig has turned beyond 150 times.

    `info` tells the truth: ``state`` θ, ψ, θ̇, ψ̇; ``volts``; ``torques`` from outside, N·m; ``time``, s; ``ended``.

    Attributes:
        design: rig, sensors, sample time, and the start of an episode; its controller does not act.
        rig: that flies; None before the first `reset`.
        period: how long an action is held, s.
    """

    metadata = {"render_modes": []}  # noqa: RUF012 - as the base class has it

    def __init__(
        self,
        design: Spec | None = None,
        *,
        seconds: float = 20.0,
        samples: int = 10,
        every: float = 5.0,
        span: tuple[float, float] = (0.2, 0.8),
        gust: float = 0.0,
        effort: float = 0.0,
        render_mode: str | None = None,
    ) -> None:
        """Chooses rig and task, and has the kernels compiled: the first time on a machine that is two minutes.

        Args:
            design: as above; by default the default preset, which samples every 2 ms and measures exactly.
            seconds: length of an episode.
            samples: of the rig's controller in a step.
            every: s, from one set point to the next.
            span: how far set points of θ and ψ are from (θ₀, 0) at most, rad.
            gust: largest torque of gusts about each axis, N·m, one per set point; 0: calm.
            effort: weight of the voltages in the reward, rad².
            render_mode: there is none: what was flown is shown by the page, from `log`.

        Raises:
            Heli2DofError: the design does not exist, or a value is out of its range.
        """
        self.design = Spec.from_preset() if design is None else design
        self.seconds, self.samples, self.every = float(seconds), int(samples), float(every)
        self.span, self.gust, self.effort = span, float(gust), float(effort)
        self.render_mode = render_mode
        if render_mode is not None:
            raise InvalidInputError("the environment draws nothing", field="render_mode", value=render_mode)
        for name, good in (
            ("seconds", 0.0 < self.seconds <= LONGEST),
            ("samples", 1 <= self.samples <= 1000),
            ("every", self.every > 0.0),
            ("span", len(span) == 2 and all(0.0 <= own <= 100.0 for own in span)),
            ("gust", 0.0 <= self.gust <= 100.0),
            ("effort", 0.0 <= self.effort <= 1e6),
        ):
            if not good:
                raise InvalidInputError(
                    f"{name} is out of its range", field=name, value=getattr(self, name), hint="See HeliEnv."
                )
        warm_up()  # since policies take steps by the million
        first = Rig(self.design)  # which also proves the design
        self.period = self.samples * first.controller.ticks_per_sample * first.controller.tick
        self.rig: Rig | None = None
        self._limits = np.array([self.design.limits.V_p, self.design.limits.V_y])
        self.observation_space = Box(-_FARTHEST, _FARTHEST, dtype=np.float64)
        self.action_space = Box(-1.0, 1.0, (2,), dtype=np.float32)  # as libraries of policies have theirs
        self._next, self._windy = 0.0, 0.0

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """A new episode, at rest where the design's experiment begins.

        Args:
            seed: of set points, gusts and noise.
            options: ``reference``: (θ, ψ), rad, is the set point of the whole episode.
        """
        super().reset(seed=seed)
        self.rig = Rig(self.design, seed=int(self.np_random.integers(LARGEST_SEED)))
        self.rig.do("hands", 1)
        self._next, self._windy = 0.0, np.inf
        if options and "reference" in options:
            theta, psi = options["reference"]
            self.rig.do("reference", float(theta), float(psi))
            self._next = np.inf
        self._happen(self.rig)
        return self._seen(self.rig)

    def step(self, action: NDArray[np.floating]) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Holds an action for `period`: (observation, reward, terminated, truncated, info)."""
        rig = self.rig
        if rig is None:
            raise InvalidInputError("nothing flies", field="rig", hint="Call reset() first.")
        shares = np.clip(np.asarray(action, dtype=np.float64), -1.0, 1.0)
        rig.do("sticks", *(shares * self._limits).tolist())
        rows, _ = rig.fly_ticks(self.samples * rig.controller.ticks_per_sample)
        errors = rows[:, STATE : STATE + 2] - rows[:, WISH : WISH + 2]
        volts = rows[:, VOLTAGE : VOLTAGE + 2] / self._limits
        cost = float((errors**2).sum() + self.effort * (volts**2).sum()) * rig.controller.tick
        self._happen(rig)
        over = rig.time > self.seconds - 0.5 * rig.controller.tick
        observation, info = self._seen(rig)
        return observation, -cost, bool(rig.ended), over, info

    def log(self) -> FlightLog:
        """What was flown in this episode: `log().body()` as JSON is a file that the page replays.

        Raises:
            InvalidInputError: nothing was flown.
        """
        if self.rig is None:
            raise InvalidInputError("nothing was flown", field="rig", hint="Call reset() and step() first.")
        return FlightLog.of(self.rig)

    def _happen(self, rig: Rig) -> None:
        """New set points and gusts, where it is time."""
        if rig.time > self._next - 1e-6:
            theta, psi = self.np_random.uniform(-1.0, 1.0, 2) * self.span
            rig.do("reference", self.design.theta_0 + float(theta), float(psi))
            self._windy = self._next + float(self.np_random.uniform(0.0, self.every))
            self._next += self.every
        if self.gust and rig.time > self._windy - 1e-6:
            torques = self.np_random.uniform(-self.gust, self.gust, 2).tolist()
            rig.do("gust", *torques, ticks_of(self.np_random.uniform(*_GUST), rig.controller.tick))
            self._windy = np.inf

    @staticmethod
    def _seen(rig: Rig) -> tuple[Floats, dict[str, Any]]:
        """The observation now, and what sensors do not tell."""
        row = rig.row()
        if row is None:
            found, torques = np.array([*rig.y[:4].tolist(), *rig.reference]), np.zeros(2)
        else:
            found = np.concatenate((row[SENSED : SENSED + 4], row[WISH : WISH + 2]))
            torques = row[OUTSIDE : OUTSIDE + 2].copy()
        truth = {
            "state": rig.y[:4].copy(),
            "volts": np.array(rig.volts),
            "torques": torques,
            "time": rig.time,
            "ended": rig.ended,
        }
        return np.clip(np.nan_to_num(found), -_FARTHEST, _FARTHEST), truth


gymnasium.register("heli2dof/Heli-v0", entry_point="heli2dof_core.gym_env:HeliEnv")
