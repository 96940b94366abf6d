"""The tasks that ship."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from types import MappingProxyType

from .task import FlightTask, Mark

_EIGHT = tuple(
    Mark(time, theta, psi * pi / 180)
    for time, theta, psi in (
        *((0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (8.0, 1.0, 30.0), (13.0, 0.0, 60.0), (18.0, -0.6, 30.0)),
        *((23.0, 0.0, 0.0), (28.0, 1.0, -30.0), (33.0, 0.0, -45.0), (38.0, 0.0, 0.0)),
    )
)

_ALL = (
    FlightTask(
        "hold",
        "Hold still",
        "Keep pitch and yaw where they are while gusts come. Your design does it alone, or you do it by hand.",
        30.0,
        (Mark(0.0, 0.0, 0.0),),
        "path_error",
        (0.07, 0.025, 0.01),
        gusts=9,
        strength=0.12,
        free=False,
        figures=("flight_error_rms", "flight_error_max", "time_within", "flight_effort"),
    ),
    FlightTask(
        "path",
        "Follow the path",
        "Follow the ghost with pitch and yaw, by set points or by the sticks.",
        40.0,
        _EIGHT,
        "path_error",
        (0.14, 0.06, 0.03),
        figures=("flight_error_rms", "flight_error_max", "time_within", "flight_effort"),
    ),
    FlightTask(
        "land",
        "Land on the mark",
        "Bring it to the mark and rest there for a second, as soon as you can.",
        30.0,
        (Mark(0.0, 0.8, 60.0 * pi / 180),),
        "flight_time",
        (20.0, 8.0, 4.0),
        ends="landed",
        figures=("landing_error", "flight_impacts", "flight_effort"),
    ),
    FlightTask(
        "effort",
        "Least effort",
        "Reach the marks one after the other. Each volt counts by its square and by how long it lasts.",
        40.0,
        (Mark(0.0, 0.8, 30.0 * pi / 180), Mark(0.0, -0.5, -20.0 * pi / 180), Mark(0.0, 0.0, 0.0)),
        "flight_effort",
        (2.5, 0.87, 0.56),
        ends="reached",
        per_square_volt=True,
        figures=("flight_time", "flight_impacts"),
    ),
    FlightTask(
        "pair",
        "One axis each",
        "Two hands follow the path: one has pitch, the other has yaw.",
        40.0,
        _EIGHT,
        "path_error",
        (0.14, 0.06, 0.03),
        pilots=2,
        figures=("flight_error_rms", "flight_error_max", "time_within"),
    ),
)

TASKS: Mapping[str, FlightTask] = MappingProxyType({task.name: task for task in _ALL})
"""By name."""
