"""Recordings of the students' own rigs, where a lab hides these: what there is to identify them by."""

from __future__ import annotations

from hashlib import sha256
from math import radians

from ..errors import InvalidInputError, Wanted, nobody_leaves
from ..evaluate import loop_of
from ..presets import preset
from ..recordings.files import write_csv
from ..recordings.files.text import SYNTHETIC
from ..recordings.samples import named_columns, sample_recording
from ..request import spec_of
from ..scenario import Digital
from .bodies import body_of_flat
from .lab import Lab
from .rigs import start_flat, student_rig, true_rig

LENGTH = 30.0
"""Of a recording, s."""
SAMPLE_TIME = 0.01
"""Short beside every motion of the rigs, and few enough rows for a class that identifies at once, s."""
NOISE = radians(0.05)
"""Standard deviation on both angles, rad."""
STEPS = (radians(10.0), radians(20.0))
"""Largest reference steps of pitch and yaw, rad."""


def recording_csv(lab: Lab, step_name: str, seed: int, wanted: Wanted = nobody_leaves) -> bytes:
    """A student's true rig under the controller with which a step starts: CSV, angles in rad, voltages in V.

    The controller is the digital one of the printed rig, and its references step at random times; the same seed gives
    the same recording.

    Args:
        lab: one that hides the true rig.
        step_name: of the step.
        seed: of the student.
        wanted: called now and then; what it raises ends the work.

    Raises:
        InvalidInputError: the lab hides no rig, or there is no such step; or the rig runs away.
    """
    step = lab.step(step_name)
    if not lab.hidden_rig:
        raise InvalidInputError(
            f"the lab {lab.name} has no recordings",
            field="lab",
            value=lab.name,
            hint="Its rig is told: there is nothing to identify.",
        )
    spec = spec_of(body_of_flat(start_flat(lab, step, student_rig(lab, seed))))
    digital = Digital(
        sample_time=SAMPLE_TIME,
        encoders=preset(lab.preset).encoders,
        noise=NOISE,
        seed=int.from_bytes(sha256(f"{lab.name} {seed}".encode()).digest()[:4], "big"),
    )
    run = sample_recording(
        loop_of(spec),
        spec.limits,
        digital,
        rig=spec_of(true_rig(lab, seed)).parameters,
        duration=LENGTH,
        size=STEPS,
        wanted=wanted,
    )
    return write_csv(named_columns(run), (f"{SYNTHETIC}: angles in rad, voltages in V",))
