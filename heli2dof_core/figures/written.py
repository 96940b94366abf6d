"""How a figure of merit is written: the page's digits and units, in reports, tables and marks alike."""

from __future__ import annotations

from math import floor, log10

from .figure import Figure

DASH = "–"


def fixed(value: float | None, decimals: int = 2) -> str:
    """Fixed decimals with a true minus sign, never a negative zero."""
    if value is None:
        return DASH
    text = f"{value:.{decimals}f}"
    return text.lstrip("-") if float(text) == 0 else text.replace("-", "−")


def significant(value: float | None, digits: int = 4) -> str:
    """About `digits` significant digits, with an exponent only from 1e6 on and below 1e-4."""
    if value is None:
        return DASH
    size = abs(value)
    if size and (size >= 1e6 or size < 1e-4):
        mantissa, exponent = f"{value:.{max(0, digits - 2)}e}".split("e")
        return f"{mantissa}e{int(exponent)}".replace("-", "−")
    leading = floor(log10(float(f"{size:.{digits - 1}e}"))) if size else 0  # of what is shown
    # so that a small figure is not rounded to a zero
    whole = leading + 1 if leading >= 0 else 1 if leading == -1 else leading + 2
    return fixed(value, max(0, digits - whole))


def seconds(value: float | None) -> str:
    """Seconds with two decimals; milliseconds below 0.1 s, with one decimal below 10 ms."""
    if value is None:
        return DASH
    return f"{fixed(1e3 * value, 1 if value < 0.01 else 0)} ms" if value < 0.1 else f"{fixed(value)} s"


def percent(share: float) -> str:
    """A share, in percent; below one percent with a decimal, and never as none where it is not."""
    if 0 < share < 0.0005:
        return "< 0.1 %"
    return f"{fixed(100 * share, 1 if share < 0.01 else 0)} %"


def decibel(ratio: float | None) -> str:
    """A ratio in decibels."""
    return DASH if ratio is None or ratio <= 0 else f"{fixed(20 * log10(ratio), 1)} dB"


def told(figure: Figure, value: float | None) -> str:
    """A value as the figure says that it is written; its unit after it, where none stands at the row's head."""
    if figure.notation in ("seconds", "decibel"):
        return seconds(value) if figure.notation == "seconds" else decibel(value)
    if value is None:
        return DASH
    if figure.notation == "exponent":
        mantissa, exponent = f"{value:.{figure.digits}e}".split("e")
        return f"{mantissa}e{int(exponent)}".replace("-", "−")
    text = (significant if figure.notation == "significant" else fixed)(figure.scale * value, figure.digits)
    unit = "" if figure.in_head else figure.shown or figure.unit
    return f"{text}{'' if unit in ('', '°') else ' '}{unit}"


def in_shown_unit(figure: Figure, value: float) -> float:
    """A value in the unit that people read: °, %, dB, or its own."""
    if figure.notation == "decibel":
        return 20 * log10(value) if value > 0 else float("-inf")
    return figure.scale * value


def rounded(figure: Figure, value: float) -> float:
    """What `told` says of a value, as a number in the unit that people read."""
    if figure.notation == "seconds":
        return round(1e3 * value, 1 if value < 0.01 else 0) / 1e3 if value < 0.1 else round(value, 2)
    if figure.notation == "decibel":
        return round(in_shown_unit(figure, value), 1)
    shown = in_shown_unit(figure, value)
    if figure.notation == "exponent":
        return float(f"{shown:.{figure.digits}e}")
    if figure.notation == "significant" and shown:
        return _rounded_significant(shown, figure.digits)
    return round(shown, figure.digits)


def _rounded_significant(value: float, digits: int) -> float:
    return float(significant(value, digits).replace("−", "-"))
