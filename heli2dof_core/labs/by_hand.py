"""A practised hand on the sticks, as a model: what may be asked of people who fly without a controller.

A person who holds an integrating plant acts on its error in proportion, a reaction time later, and crosses over at
some 2 rad/s (McRuer's crossover model). This one knows the trim and how the motors push, looks twenty times a second,
and is never tired: people are worse.
"""

from __future__ import annotations

from collections import deque

import numpy as np

from ..evaluate import place
from ..flight import FlightLog, Rig
from ..flight.task_flights import fly_task
from ..request import Body, spec_of

REACTION = 0.25
"""From eye to hand, s."""
LOOKS = 0.05
"""Between two looks, s."""
CROSSOVER = 2.0
"""rad/s."""


def flown_by_hand(task: str, body: Body, seed: int = 0) -> FlightLog:
    """A task flown by this hand, the controller off throughout.

    Args:
        task: its name in `flight.tasks.TASKS`.
        body: the design whose rig is flown, and whose controller is off.
        seed: of the task's gusts.

    Raises:
        Heli2DofError: the design does not exist.
    """
    spec = spec_of(body)
    plant = place(spec).plant
    damping, push = -np.diag(plant.A)[2:4], np.asarray(plant.B)[2:4]
    trim, limits = np.asarray(plant.trim), np.array([spec.limits.V_p, spec.limits.V_y])
    seen: deque[np.ndarray] = deque(maxlen=round(REACTION / LOOKS) + 1)

    def hand(rig: Rig) -> None:
        """Sets the sticks by what was seen a reaction time ago."""
        if not seen:
            rig.do("hands", 1)
        seen.append(np.array(rig.reference) - rig.y[:2])
        volts = trim + np.linalg.solve(push, CROSSOVER * damping * seen[0])
        rig.do("sticks", *np.clip(volts, -limits, limits).tolist())

    return fly_task(task, body, seed, hand=hand, every=LOOKS)
