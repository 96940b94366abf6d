"""Flights for the tests: one in which all happens that can, and logs of which something was changed."""

from __future__ import annotations

import copy
import json
from typing import Any

from hypothesis import strategies as st

from heli2dof_core import spec_of
from heli2dof_core.flight import FlightLog, Rig, checksum

Json = dict[str, Any]

DESIGN: Json = {
    "preset": "quanser-aero",
    "poles": [-6, -7, {"re": -5, "im": 2}, {"re": -5, "im": -2}],
    "loops": {"pitch": {"kp": 8.0, "ti": 0.5}},
    "rotors": {"pitch": {"tau": 0.1}},
    "observer": {"poles": [-40, -42, -41, -43]},
    "weights": {"states": {"theta": 10.0}},
    "parameters": {"J_p": 0.03},
    "scenario": {"digital": {"sample_time": 0.004, "delay": True}, "noise": {"theta": 1e-4}, "initial": {}},
    "split": [[0, 1], [2, 3]],
}
OTHER: Json = {**DESIGN, "poles": [-4, -5, -6, -7], "scenario": {"digital": {"sample_time": 0.002}}}


def flown(seconds: float = 1.0, seed: int = 5) -> FlightLog:
    """The log of a flight with pushes, a gust, faults, hands on, and two changes of the design."""
    rig, checks = Rig(spec_of(DESIGN), seed=seed), []
    happens = (
        *(("reference", 0.1, 0.2), ("turn", 0.0, 0.3), ("push", 0.02, 0.0), ("push", 0.0, 0.0)),
        *(("gust", 0.01, 0.03, 40), ("thrust", 0.9, 1.0), ("hung", 0.02, 0.1), ("stuck", 0, 1)),
        *(("stuck", 0, 0), ("hands", 1), ("sticks", 6.0, 2.0), ("hands", 0)),
    )
    for n, event in enumerate(happens):
        rig.do(*event)
        if n in (4, 9):
            rig.change(spec_of(OTHER if n == 4 else DESIGN))
        rig.fly(seconds / len(happens))
        checks.append([rig.tick, *rig.y[:4].tolist()])
    return FlightLog.of(rig, DESIGN, checks)


def as_json(log: FlightLog) -> Json:
    """A log as a file holds it."""
    return json.loads(json.dumps(log.body()))


def sealed(body: Json) -> Json:
    """The body with the checksum of what it holds, where there is one."""
    own = {name: value for name, value in body.items() if name != "checksum"}
    try:
        return {**own, "checksum": checksum(own)}
    except OverflowError:
        return {**own, "checksum": "00000000"}


def places(value: Any, path: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    """The paths of all that stands in JSON, itself included."""
    found = [path]
    inner = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for name, part in inner:
        found += places(part, (*path, name))
    return found


def changed(body: Json, path: tuple[str | int, ...], value: Any) -> Json:
    """The body with another value at a path."""
    own = copy.deepcopy(body)
    at: Any = own
    for name in path[:-1]:
        at = at[name]
    at[path[-1]] = value
    return own


SCALARS = (
    st.none()
    | st.booleans()
    | st.integers(-3, 10**7)
    | st.integers(10**300, 10**309)
    | st.floats(allow_nan=False, allow_infinity=False)
    | st.sampled_from(
        [float("nan"), float("inf"), -0.0, 1e308, 5e-324, "", "design", "pi", "\ud800", "0" * 300]
    )
    | st.text(max_size=5)
)
_WORDS = (
    "theta psi poles re im preset method scenario digital sample_time rotors pitch tau curve observer split",
    "kp ti decoupler place_rotors rotor_poles limits V_p weights states noise encoders samples",
)
NAMES = st.sampled_from(" ".join(_WORDS).split())
JSON = st.recursive(
    SCALARS,
    lambda inner: (
        st.lists(inner, max_size=5) | st.dictionaries(NAMES | st.text(max_size=3), inner, max_size=4)
    ),
    max_leaves=10,
)
"""Whatever JSON may hold, and what Python's reader takes for it."""
