"""An overlay as it is asked for, over REST or on the command line."""

from __future__ import annotations

from collections.abc import Callable

from heli2dof_core import close_loop, place
from heli2dof_core.recordings.overlay import (
    Overlay,
    driven_by_references,
    driven_by_voltages,
    driven_in_segments,
)
from heli2dof_core.recordings.recording import Recording

from .recording_models import OverlayRequest


def overlaid(
    request: OverlayRequest, recording: Recording, wanted: Callable[[], None] = lambda: None
) -> Overlay:
    """The design's rig under what was recorded.

    Raises:
        RecordingError: the rig runs away, or what drives it was not recorded.
    """
    spec = request.to_spec()
    if request.driver == "voltages":
        return driven_by_voltages(spec.parameters, recording, spec.limits.theta, wanted)
    if request.driver == "segments":
        return driven_in_segments(spec.parameters, recording, request.segment, spec.limits.theta, wanted)
    loop = close_loop(place(spec), spec.outer)
    return driven_by_references(loop, spec.limits, recording, spec.scenario.digital, wanted)
