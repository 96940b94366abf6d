"""How often intervals of τ, thrust and friction hold the truth: `python -m tests.bench.actuated [runs [case]]`.

The angles are rounded to encoder counts and noisy, and the controller sees neither; noise that is correlated in time
is added to what is recorded. Voltages come from a controller whose rotors lag, or from steps without feedback.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass

import numpy as np

from heli2dof_core import PoleSet, Spec, close_loop, place, preset
from heli2dof_core.engine import warm_up
from heli2dof_core.parameters import Parameters
from heli2dof_core.recordings.acting import acting_of
from heli2dof_core.recordings.identification import ACTUATORS, Identification, default_free, identify
from heli2dof_core.recordings.recording import Recording
from heli2dof_core.recordings.samples import deviating_rig, reference_steps
from heli2dof_core.rotors import AxisFriction, Friction, Rotor, Rotors
from heli2dof_core.scenario import OuterLoop, PIGains
from heli2dof_core.simulation.recorded import Turning, run_held
from tests.bench.identification import RUNS, autoregressive, tell

SLOW = (PoleSet([-2.5, -3.0, -3.5, -4.0]), OuterLoop("pi", PIGains(4.0, 1.5), PIGains(4.0, 1.5)))
"""A design that stays stable with rotors of up to 0.25 s."""


@dataclass(frozen=True)
class Actuated:
    """One kind of recording with rotors and friction.

    Attributes:
        name: of the preset.
        closed: whether a controller makes the voltages, of state feedback and PI loops.
        curve, dead_zone, matched_at: of both rotors.
        tau, coulomb: ranges of the truth, s and N·m, both axes.
        noise: on the measured angles, rad.
        rho, slow: of autoregressive noise beside it.
        duration, sample_time: s.
        thought: time constants that identification begins from, s.
    """

    name: str = "quanser-2dof-manual"
    closed: bool = True
    curve: str = "linear"
    dead_zone: float = 0.0
    matched_at: float | None = None
    tau: tuple[float, float] = (0.1, 0.2)
    coulomb: tuple[float, float] = (0.01, 0.03)
    noise: float = 1e-3
    rho: float = 0.0
    slow: float = 0.0
    duration: float = 20.0
    sample_time: float = 0.004
    thought: float = 0.0

    def __str__(self) -> str:
        kind = "closed loop" if self.closed else "voltage steps"
        slow = f", AR(1) {self.slow:g} rad ρ {self.rho:g}" if self.slow else ""
        return (
            f"{self.name}, {kind}, {self.curve} thrust, encoders, noise {self.noise:g} rad{slow}, "
            f"{self.duration:g} s at {1 / self.sample_time:g} Hz"
        )

    def rotors(self, tau: tuple[float, float]) -> Rotors:
        """Both, with these time constants."""
        curved = {"curve": self.curve, "dead_zone": self.dead_zone, "matched_at": self.matched_at}
        return Rotors(*(Rotor(own, **curved) for own in tau))  # pyright: ignore[reportArgumentType]


@dataclass(frozen=True)
class Truth:
    """What was recorded."""

    parameters: Parameters
    rotors: Rotors
    friction: AxisFriction

    def of(self, name: str) -> float:
        """A quantity by the name of its estimate."""
        found: object = self if "." in name else self.parameters
        for part in name.split("."):
            found = getattr(found, part)
        assert isinstance(found, float)
        return found


def made(case: Actuated, seed: int) -> tuple[Truth, Recording]:
    """A rig off its data sheet by up to 15 %, and what it did."""
    base = preset(case.name)
    rng = np.random.default_rng([seed, 7])
    taus, rubs = rng.uniform(*case.tau, 2).tolist(), rng.uniform(*case.coulomb, 2).tolist()
    p = deviating_rig(base.parameters, 0.15, seed)
    truth = Truth(p, case.rotors((taus[0], taus[1])), AxisFriction(Friction(rubs[0]), Friction(rubs[1])))
    return truth, recorded(case, truth, seed)


def recorded(case: Actuated, truth: Truth, seed: int) -> Recording:
    """What an encoder told of it; the first second is a rest at the trim."""
    base, h = preset(case.name), case.sample_time
    count = round(case.duration / h)
    rng, steps = np.random.default_rng([seed, 8]), np.array(base.encoders)
    acting = acting_of(truth.parameters, truth.rotors, truth.friction)
    assert acting is not None
    spec = Spec.from_preset(base)
    if case.closed:
        spec = Spec(
            base.parameters, base.limits, base.theta_0, SLOW[0], base.structure, SLOW[1], base.scenario
        )
    loop = close_loop(place(spec), spec.outer)
    plant, at = loop.design.plant, np.array([spec.theta_0, 0.0, 0.0, 0.0])
    references = reference_steps(case.duration, h, 0.25, 0.6, theta_0=spec.theta_0, seed=seed)
    commanded = reference_steps(case.duration, h, 15.0, 15.0, seed=seed)
    x, z, v = at.copy(), np.zeros(2), plant.trim.copy()
    seen, sent = np.empty((count, 2)), np.empty((count, 2))
    times = np.array([0.0, h])
    for k in range(count):
        u = commanded[k]
        if case.closed:
            u = plant.trim + loop.voltage_from_state @ np.concatenate([x - at, z])
            u = np.clip(u + loop.voltage_from_reference @ (references[k] - at[:2]), -24.0, 24.0)
            z = z + h * (references[k] - x[:2])
        seen[k], sent[k] = x[:2], u
        turned = Turning(acting, np.array([v, v]), np.zeros((2, 2)))
        x = run_held(truth.parameters, x, times, np.array([u, u]), None, rotors=turned)[1]
        v = np.where(acting[:2] > 0, u + (v - u) * np.exp(-h / np.maximum(acting[:2], 1e-9)), u)
    told = seen + case.noise * rng.standard_normal(seen.shape)
    told = np.round(told * steps / (2 * np.pi)) * (2 * np.pi) / steps
    return Recording(h * np.arange(count), told + case.slow * autoregressive(case.rho, count, seed), sent)


def found(case: Actuated, seed: int) -> tuple[Truth, Identification]:
    """The truth, and what is found on its recording with nothing known but the data sheet."""
    truth, recording = made(case, seed)
    p = preset(case.name).parameters
    free = (*default_free(p), *ACTUATORS)
    return truth, identify(p, recording, free, case.rotors((case.thought, case.thought)))


AERO = Actuated(
    "quanser-aero-2", False, "quadratic", 1.0, 10.0, (0.15, 0.18), (2e-4, 8e-4), duration=40.0, thought=0.1
)
ACTUATED = (
    Actuated(),
    Actuated(rho=0.9, slow=1e-3),
    AERO,
)


def main(runs: int, cases: tuple[Actuated, ...]) -> None:
    """Prints a table per case."""
    warm_up()
    for case in cases:
        tell(case, [found(case, seed) for seed in range(runs)], Truth.of)


if __name__ == "__main__":
    chosen = ACTUATED if len(sys.argv) < 3 else (ACTUATED[int(sys.argv[2])],)
    main(int(sys.argv[1]) if len(sys.argv) > 1 else RUNS, chosen)
