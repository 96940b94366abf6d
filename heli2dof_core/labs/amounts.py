"""Values with a unit, as people write them: `5 %`, `0.8 s`, `−2,5 °`, `6 dB`."""

from __future__ import annotations

import re
from math import isfinite, log10, pi

NUMBER = r"[-+−–]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:\s?(?:[eE]|[·x×*]\s?10\^?)\s?[-+−–]?\d{1,3})?"
_AMOUNT = re.compile(rf"\s*({NUMBER})\s*(\S.{{0,30}})?")
_POWER = re.compile(r"\s?[·x×*]\s?10\^?\s?")
_DEGREE = pi / 180
_UNITS: dict[str, tuple[str, float]] = {
    "": ("", 1.0),
    "%": ("", 0.01),
    "s": ("s", 1.0),
    "ms": ("s", 1e-3),
    "μs": ("s", 1e-6),
    "min": ("s", 60.0),
    "rad": ("rad", 1.0),
    "mrad": ("rad", 1e-3),
    "°": ("rad", _DEGREE),
    "rad/s": ("rad/s", 1.0),
    "1/s": ("rad/s", 1.0),
    "°/s": ("rad/s", _DEGREE),
    "rad·s": ("rad·s", 1.0),
    "°s": ("rad·s", _DEGREE),
    "rad·s²": ("rad·s²", 1.0),
    "°s²": ("rad·s²", _DEGREE),
    "V": ("V", 1.0),
    "mV": ("V", 1e-3),
    "V²·s": ("V²·s", 1.0),
    "V²s": ("V²·s", 1.0),
    "V/rad": ("V/rad", 1.0),
    "V/°": ("V/rad", 1 / _DEGREE),
    "V·s/rad": ("V·s/rad", 1.0),
    "V/(rad·s)": ("V/(rad·s)", 1.0),
    "m": ("m", 1.0),
    "cm": ("m", 0.01),
    "mm": ("m", 1e-3),
    "kg": ("kg", 1.0),
    "g": ("kg", 1e-3),
    "kg·m²": ("kg·m²", 1.0),
    "N·m": ("N·m", 1.0),
    "mN·m": ("N·m", 1e-3),
    "N·m/V": ("N·m/V", 1.0),
    "mN·m/V": ("N·m/V", 1e-3),
    "N·m/rad": ("N·m/rad", 1.0),
    "N·m·s/rad": ("N·m·s/rad", 1.0),
    "m/s²": ("m/s²", 1.0),
    "rad/(s²·V)": ("rad/(s²·V)", 1.0),
    "1/s²": ("1/s²", 1.0),
}
"""Per unit: the SI unit that it stands for, and how many of these it is. Decibels stand apart."""
_OTHER = {
    "deg": "°",
    "degree": "°",
    "degrees": "°",
    "sec": "s",
    "second": "s",
    "seconds": "s",
    "volt": "V",
    "volts": "V",
    "percent": "%",
    "us": "μs",
    "µs": "μs",
    "s^-1": "1/s",
    "s⁻¹": "1/s",
    "rads": "rad·s",
    "rad/sec": "rad/s",
    "Vs/rad": "V·s/rad",
    "Nm": "N·m",
    "mNm": "mN·m",
    "Nm/V": "N·m/V",
    "mNm/V": "mN·m/V",
    "Nm/rad": "N·m/rad",
    "Nms/rad": "N·m·s/rad",
    "N·ms/rad": "N·m·s/rad",
    "Nm·s/rad": "N·m·s/rad",
    "kgm²": "kg·m²",
    "°·s": "°s",
    "°·s²": "°s²",
}
DECIBEL = "dB"


def unit_of(text: str) -> str | None:
    """The unit as it is written here, of any of its notations; None where it is unknown."""
    plain = text.strip().replace("*", "·").replace("^2", "²").replace("s2", "s²").replace("m2", "m²")
    plain = "·".join(plain.split()) if not plain.startswith("°") else plain.replace(" ", "")
    plain = plain.replace("⋅", "·").replace("\u02da", "°").replace("º", "°")
    plain = _OTHER.get(plain, plain)
    for word in ("deg/", "degree/"):
        if plain.startswith(word):
            plain = "°/" + plain.removeprefix(word)
    return plain if plain in _UNITS or plain == DECIBEL else None


def factor(unit: str, si: str) -> float | None:
    """How many of the SI unit one of a unit is; None where it measures something else. Decibels have none."""
    known = _UNITS.get(unit)
    if known is None:
        return 1.0 if unit == si else None
    if si == "%":  # percent of a step, which stay percent
        return {"%": 1.0, "": 1.0}.get(unit)
    return known[1] if known[0] == si_of(si) else None


def si_of(unit: str) -> str:
    """The SI unit that a unit stands for; itself where it is unknown."""
    return _UNITS[unit][0] if unit in _UNITS else unit


def plain_number(text: str) -> float | None:
    """A number in any usual notation: decimal comma, true minus, power of ten; None where it is none."""
    if not re.fullmatch(rf"\s*{NUMBER}\s*", text):
        return None
    plain = _POWER.sub("e", text.strip())
    plain = plain.replace("−", "-").replace("–", "-").replace(",", ".").replace(" ", "")
    try:
        value = float(plain)
    except ValueError:
        return None
    return value if isfinite(value) else None


def split_amount(text: str) -> tuple[float, str] | None:
    """Number and unit's text; None where it does not begin with a number."""
    if len(text) > 80:
        return None
    match = _AMOUNT.fullmatch(text)
    value = match and plain_number(match[1])
    return None if match is None or value is None else (value, (match[2] or "").strip())


def amount(text: str, si: str) -> float | None:
    """The value in an SI unit of what is written with or without one; None where it is none of that unit.

    >>> amount("5 %", ""), amount("800 ms", "s"), amount("−2,5 °", "rad"), amount("3 V", "s")
    (0.05, 0.8, -0.04363323129985824, None)
    """
    parts = split_amount(text)
    if parts is None:
        return None
    value, written = parts
    if not written:
        return value
    unit = unit_of(written)
    if unit == DECIBEL:
        return 10 ** (value / 20) if si == "" and abs(value) < 400 else None
    own = None if unit is None else factor(unit, si)
    return None if own is None else value * own


def in_unit(value: float, si: str, unit: str) -> float:
    """An SI value in another unit of the same kind."""
    if unit == DECIBEL:
        return 20 * log10(value)
    return value / (factor(unit, si) or 1.0)


def units_for(si: str) -> tuple[str, ...]:
    """Units in which a value may be written."""
    own = tuple(unit for unit in _UNITS if unit and factor(unit, si) is not None)
    return (*own, DECIBEL) if si == "" else own


def conversions(unit: str) -> dict[str, float]:
    """Of all that may be typed as a unit of the same kind, how many of `unit` is one; decibels go with none other."""
    if unit == DECIBEL:
        return {DECIBEL: 1.0}
    si = si_of(unit)
    own = factor(unit, si) or 1.0
    notations = {text: text for text in _UNITS if text} | _OTHER
    found = {text: factor(plain, si) for text, plain in notations.items()}
    return {text: value / own for text, value in found.items() if value is not None}
