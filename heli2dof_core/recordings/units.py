"""Units as files name them: in a column's name, in a row or comment of their own, behind each number."""

from __future__ import annotations

import re
from math import radians
from types import MappingProxyType
from typing import Literal

AngleUnit = Literal["rad", "deg"]
TimeUnit = Literal["s", "ms", "us", "ns", "min", "h", "d"]
VoltageUnit = Literal["V", "mV"]
Kind = Literal["time", "angle", "voltage", "rate", "other"]

SECONDS = MappingProxyType(
    {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9, "min": 60.0, "h": 3600.0, "d": 86400.0}
)
"""How long a unit of time is."""
RADIANS = MappingProxyType({"rad": 1.0, "deg": radians(1.0)})
"""How large a unit of angle is."""
VOLTS = MappingProxyType({"V": 1.0, "mV": 1e-3})
"""How large a unit of voltage is."""

_SPELLED: dict[tuple[Kind, str], str] = {
    ("time", "s"): "s sec secs second seconds sekunde sekunden",
    ("time", "ms"): "ms msec msecs milli millis millisec milliseconds millisecond",
    ("time", "us"): "us usec usecs micro micros microsec microseconds microsecond μs µs",
    ("time", "ns"): "ns nsec nsecs nano nanos nanosec nanoseconds nanosecond",
    ("time", "min"): "min mins minute minutes",
    ("time", "h"): "h hr hrs hour hours",
    ("time", "d"): "d day days datenum",
    ("angle", "rad"): "rad rads radian radians",
    ("angle", "deg"): "deg degs degree degrees ° º",
    ("voltage", "V"): "v volt volts",
    ("voltage", "mV"): "mv millivolt millivolts",
    ("rate", "rad/s"): "rad/s rad/sec rads/s radians/second",
    ("rate", "deg/s"): "deg/s °/s deg/sec degrees/second dps",
    (
        "other",
        "1",
    ): "1 - none a.u. au n/a a ma n nm n·m n*m m % bool count counts tick ticks hz rpm rad·s rad*s",
}
_KNOWN = {word: key for key, words in _SPELLED.items() for word in words.split()}

_BRACKETED = re.compile(r"\s*[\[({<]\s*([^\])}>]*?)\s*[\])}>]\s*$")
_BEHIND = re.compile(r"(?:\s*[,/:]\s*|\s+in\s+|[\s_.\-])([a-zµμ°º]+(?:/s)?)$", re.IGNORECASE)
_JOINED = re.compile(r"(?<=[a-z])(Ms|Us|Ns|Sec|Deg|Rad)$")


def known_unit(text: str) -> tuple[Kind, str] | None:
    """What kind of quantity a unit measures, and the unit as we spell it; None where the text is no unit."""
    return _KNOWN.get(text.strip().strip("[](){}").strip().lower())


def split_unit(name: str) -> tuple[str, tuple[Kind, str] | None]:
    """A column's name without its unit, and the unit: ``Time (ms)``, ``t / s``, ``pitch_deg``, ``timeMs``.

    A bracket that holds no unit, such as the number in ``pitch(1)``, stays with the name.
    """
    name = name.strip()
    bracket = _BRACKETED.search(name)
    if bracket and (unit := known_unit(bracket[1])) and bracket[1] != "1":
        return name[: bracket.start()], unit
    for pattern in (_BEHIND, _JOINED):
        end = pattern.search(name)
        if end and end.start() > 0 and (unit := known_unit(end[1])) and _counts(end[1], unit):
            return name[: end.start()], unit
    return name, None


def _counts(word: str, unit: tuple[Kind, str]) -> bool:
    """Whether a word behind a name is a unit: ``theta_d`` are no days."""
    return unit[0] in ("time", "angle", "voltage", "rate") and (len(word) > 1 or word in "sSV°º")
