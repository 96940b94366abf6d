"""A policy flies the rig in Gymnasium's environment, beside chance; the flight is kept for the page.

pip install "heli2dof[gym]"
python examples/policy.py my.flight.json
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np

from heli2dof_core.gym_env import HeliEnv

Policy = Callable[[np.ndarray], np.ndarray]


class PD:
    """A PD controller about each axis, through the inverse of the thrust matrix, above the trim."""

    def __init__(self, env: HeliEnv, stiffness: float = 8.0, damping: float = 4.0) -> None:
        """Gains in 1/s² and 1/s."""
        self.rig, self.limits = env.design.parameters, env.design.limits
        self.stiffness, self.damping = stiffness, damping

    def __call__(self, seen: np.ndarray) -> np.ndarray:
        """Shares of the motors' limits, from θ, ψ, θ̇, ψ̇ and both set points."""
        p = self.rig
        wanted = self.stiffness * (seen[4:6] - seen[0:2]) - self.damping * seen[2:4]
        weight = np.array([p.m * p.g * p.l * np.cos(seen[0]) + p.K_s * seen[0], 0.0])
        thrust = np.array([[p.K_pp, p.K_py], [p.K_yp, p.K_yy]])
        volts = np.linalg.solve(thrust, np.array([p.alpha, p.beta]) * wanted + weight)
        return volts / [self.limits.V_p, self.limits.V_y]


def flown(env: HeliEnv, policy: Policy, seed: int) -> float:
    """The sum of an episode's rewards: minus the integral of the squared errors, rad²·s."""
    seen, _ = env.reset(seed=seed)
    total, over = 0.0, False
    while not over:
        seen, reward, terminated, truncated, _ = env.step(policy(seen))
        total, over = total + reward, terminated or truncated
    return total


def main(file: Path | None) -> None:
    """Prints what both are worth, and keeps the PD controller's last flight."""
    env = HeliEnv(gust=0.05)
    env.action_space.seed(1)
    for name, policy in (("chance", lambda _: env.action_space.sample()), ("PD", PD(env))):
        print(f"{name}: {np.mean([flown(env, policy, seed) for seed in range(3)]):.3f} rad² s")
    if file is not None:
        file.write_text(json.dumps(env.log().body()), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else None)
