"""Recordings of the digital rig, as a laboratory would make them: reference steps, encoders, noise, another rig."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..checks import require_within
from ..errors import InvalidInputError, Wanted, nobody_leaves
from ..loop import Loop
from ..parameters import Parameters
from ..scenario import MOST_SAMPLE_TIMES, Digital, Limits
from ..signals import Floats
from ..simulation.recorded import Recorded, run_recorder
from .unknowns import default_free

MOST_DEVIATION = 0.5


def reference_steps(
    duration: float, sample_time: float, theta: float, psi: float, *, theta_0: float = 0.0, seed: int = 0
) -> Floats:
    """References (n, 2), rad, that step at random times to random levels within θ₀ ± `theta` and ± `psi`.

    Steps are 1 to 3 s apart; the first second is at rest.
    """
    n = round(duration / sample_time)
    rng = np.random.default_rng([seed, 2])  # not the stream that the noise takes
    references = np.tile([theta_0, 0.0], (n, 1))
    for axis, (middle, size) in enumerate(((theta_0, theta), (0.0, psi))):
        at, side = 1.0 + 0.5 * axis, 1.0
        while at < duration:
            references[int(at / sample_time) :, axis] = middle + side * rng.uniform(0.4, 1.0) * size
            at, side = at + rng.uniform(1.0, 3.0), -side
    return references


def deviating_rig(p: Parameters, deviation: float, seed: int) -> Parameters:
    """A rig whose identifiable parameters are off their data sheet by up to ± `deviation` (relative)."""
    require_within(deviation, "deviation", "", 0.0, MOST_DEVIATION)
    rng = np.random.default_rng([seed, 1])
    return p.replaced(
        {name: getattr(p, name) * (1.0 + deviation * rng.uniform(-1, 1)) for name in default_free(p)}
    )


def sample_recording(
    loop: Loop,
    limits: Limits,
    digital: Digital,
    *,
    rig: Parameters,
    duration: float,
    size: tuple[float, float],
    wanted: Wanted = nobody_leaves,
) -> Recorded:
    """What the digital controller of `loop` measures on `rig` while its references step by up to `size` (rad).

    Rotors and friction are the loop's: a curve keeps the point where it meets the linear one on the loop's rig.

    Raises:
        InvalidInputError: it takes too many samples, or the rig runs away under this controller.
    """
    require_within(duration, "duration", "s", 2.0, 600.0)
    if duration / digital.sample_time > MOST_SAMPLE_TIMES:
        raise InvalidInputError(
            "these are too many samples",
            field="duration",
            value=duration,
            hint=f"At most {MOST_SAMPLE_TIMES}.",
        )
    theta_0 = loop.design.plant.theta_0
    steps = reference_steps(duration, digital.sample_time, *size, theta_0=theta_0, seed=digital.seed)
    run = run_recorder(loop, limits, digital, steps, rig=rig, wanted=wanted)
    if run.done < len(run.t) or not np.all(np.abs(run.states[:, :2]) < 100.0):
        raise InvalidInputError(
            "under this controller the rig runs away",
            field="poles",
            hint="Make the loop stable before it is recorded.",
        )
    return run


def named_columns(run: Recorded) -> Mapping[str, Floats]:
    """A run as the columns of a file."""
    pairs = {"psi_ref": run.references[:, 1], "V_p": run.voltages[:, 0], "V_y": run.voltages[:, 1]}
    angles = {"theta": run.measured[:, 0], "psi": run.measured[:, 1], "theta_ref": run.references[:, 0]}
    return {"time": run.t, **angles, **pairs}
