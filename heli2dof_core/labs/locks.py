"""What a step fixes and what it leaves to the student: parts of a design, named as in the page's links.

All is locked but what a step names as unlocked. The server takes what is locked from the step's start, whatever a
page sends.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from .bodies import Flat

LOCKS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "preset": ("preset", "parameters", "limits", "rotors", "friction"),
        "parameters": ("parameters",),
        "point": ("operating_point",),
        "poles": ("poles.pitch", "poles.yaw", "rotor_poles"),
        "pitch-poles": ("poles.pitch",),
        "yaw-poles": ("poles.yaw",),
        "rotor-poles": ("rotor_poles",),
        "method": ("method", "coupling", "lead", "shift", "place_rotors"),
        "structure": ("coupling", "lead"),
        "place-rotors": ("place_rotors",),
        "loops": ("outer", "pairing", "decoupler", "loops"),
        "outer": ("outer",),
        "pairing": ("pairing",),
        "decoupler": ("decoupler",),
        "pitch-pi": ("loops.pitch",),
        "yaw-pi": ("loops.yaw",),
        "weights": ("weights",),
        "observer": ("observer",),
        "observer-poles": ("observer.poles",),
        "scenario": ("scenario",),
        "steps-size": ("scenario.reference",),
        "digital": ("scenario.digital",),
        "sample-time": ("scenario.digital.sample_time",),
        "encoders": ("scenario.digital.encoders",),
        "measured": ("scenario.measured",),
        "noise": ("scenario.noise",),
        "anti-windup": ("scenario.anti_windup", "scenario.tracking_time"),
        "duration": ("scenario.duration",),
        "disturbance": ("scenario.disturbance",),
        "requirements": (),
        "remarks": (),
    }
)
"""Per lock the paths below which it holds; those without any are of the page alone."""
HIDDEN = ("remarks", "rga", "suggestions", "margins", "requirements", "poles", "metrics", "K")
"""What a step may keep back from the student."""


def covers(locks: Collection[str], path: str) -> bool:
    """Whether one of the locks holds what stands at a path."""
    return any(path == own or path.startswith(f"{own}.") for lock in locks for own in LOCKS[lock])


def names_of(paths: Collection[str]) -> tuple[str, ...]:
    """The smallest locks that hold these paths, in their order above; a path that none holds under its own name."""
    found: list[str] = []
    for path in paths:
        holding = [name for name in LOCKS if covers((name,), path)]
        name = min(holding, key=_size, default=path)
        if name not in found:
            found.append(name)
    order = [*LOCKS]
    return tuple(sorted(found, key=lambda name: order.index(name) if name in LOCKS else len(order)))


def _size(name: str) -> tuple[int, int]:
    paths = LOCKS[name]
    return len(paths), -max(map(len, paths))


def locked(unlocked: Collection[str]) -> tuple[str, ...]:
    """The locks that hold while these parts are free: those that hold nothing of what is."""
    free = [path for lock in unlocked for path in LOCKS[lock]]

    def apart(name: str) -> bool:
        return not any(_meet(a, b) for a in LOCKS[name] for b in free)

    return tuple(name for name in LOCKS if LOCKS[name] and apart(name))


def _meet(a: str, b: str) -> bool:
    return a == b or a.startswith(f"{b}.") or b.startswith(f"{a}.")


def forced(start: Flat, own: Flat, free: Sequence[str]) -> tuple[Flat, list[str]]:
    """A student's design with what is locked taken from the start.

    Args:
        start: the step's, as a flat table.
        own: the student's.
        free: paths below which the student's holds.

    Returns:
        the design, and the locked paths at which the student's differed.
    """

    def is_free(path: str) -> bool:
        return any(path == part or path.startswith(f"{part}.") for part in free)

    found: Flat = {}
    differing = []
    for path in dict.fromkeys((*start, *own)):
        source = own if is_free(path) else start
        if path in source:
            found[path] = source[path]
        if source is start and not _alike(start.get(path), own.get(path)):
            differing.append(path)
    return found, differing


_OWN_AFFAIR = 1e-9
"""Relative difference that is none: a number's way through a page and back."""


def _alike(a: Any, b: Any) -> bool:
    if isinstance(a, float) and isinstance(b, (int, float)):
        return abs(a - b) <= _OWN_AFFAIR * max(abs(a), abs(b))
    if isinstance(a, list) and isinstance(b, list):
        return len(a) == len(b) and all(map(_alike, a, b))
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(_alike(a[name], b[name]) for name in a)
    return a == b
