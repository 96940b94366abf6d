"""Figures of a flight, by which tasks in the air are scored."""

from collections.abc import Mapping

from .figure import Figure

_DORF = "Dorf and Bishop, Modern Control Systems, 2017, section 5.7"

FLIGHT: Mapping[str, Figure] = {
    "flight_error_rms": Figure(
        "RMS error",
        "root mean square, over the task's time, of what the angle differs from what the task asks",
        "rad",
        shown="°",
        title="RMS error",
        short="RMS",
    ),
    "flight_error_max": Figure(
        "largest error",
        "largest difference of the angle from what the task asks",
        "rad",
        shown="°",
        title="Largest error",
        short="Largest",
    ),
    "path_error": Figure(
        "path error",
        "root mean square, over the task's time, of the distance from what the task asks, both angles together",
        "rad",
        shown="°",
        title="Path error",
        short="Path",
    ),
    "time_within": Figure(
        "time within 2°",
        "share of the task's time in which both angles are within 2° of what it asks",
        better="higher",
        shown="%",
        digits=0,
        title="Time within 2°",
        short="Within",
    ),
    "flight_effort": Figure(
        "flight effort",
        "time integral of the squares of both motors' voltages",
        "V²s",
        source=_DORF,
        digits=0,
        title="Effort",
        short="Effort",
    ),
    "flight_time": Figure(
        "time to rest",
        "time until the last mark is reached, and rested at for 1 s where the task asks for it",
        "s",
        absent="where it is not reached",
        notation="seconds",
        title="Time",
        short="Time",
    ),
    "landing_error": Figure(
        "landing error",
        "larger of both angles' differences from the last mark, at the end",
        "rad",
        shown="°",
        title="Landing error",
        short="Landing",
    ),
    "flight_impacts": Figure(
        "impacts", "how often pitch met a stop of its travel", digits=0, title="Impacts", short="Impacts"
    ),
    "by_hand": Figure(
        "time by hand",
        "share of the time in which the sticks were the motors' voltages and the controller was off",
        better="none",
        shown="%",
        digits=0,
        title="By hand",
        short="By hand",
    ),
}
"""By name."""
FLIGHT_BY_AXIS = ("flight_error_rms", "flight_error_max")
"""Names of those with a value per axis."""
