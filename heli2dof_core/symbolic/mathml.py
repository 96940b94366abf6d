"""LaTeX as MathML that browsers draw well: as `latex2mathml` writes it, with accents for accents."""

from __future__ import annotations

from html import unescape
from xml.etree.ElementTree import Element, tostring

from latex2mathml.converter import convert_to_element

_ACCENTS = {"^": "ˆ", "ˆ": "ˆ", "˙": "˙", "¨": "¨", "¯": "¯", "~": "˜", "˜": "˜"}
"""Marks over a letter, and the signs by which a font for mathematics has them at their size."""


def mathml(latex: str) -> str:
    """A whole math element, in line.

    MathML Core sets what stands over a letter small, as a limit over a sum, unless it is said to be an accent; and a
    hat or bar would be stretched over its letter.
    """
    math = convert_to_element(latex)
    for over in math.iter("mover"):
        accent = _accent(over)
        if accent and _one_letter(over[0]):
            over.set("accent", "true")
            over[1].attrib.clear()
            over[1].set("stretchy", "false")
            over[1].text = f"&#x{ord(accent):05X};"
    return tostring(math, encoding="unicode").replace("&amp;#x", "&#x")


def _accent(over: Element) -> str | None:
    """The sign of the accent, if it is one."""
    mark = over[1]
    return _ACCENTS.get(unescape(mark.text or "")) if mark.tag == "mo" else None


def _one_letter(base: Element) -> bool:
    """Whether one sign is written there, which may have an accent already."""
    while (base.tag == "mrow" and len(base) == 1) or (base.tag == "mover" and _accent(base)):
        base = base[0]
    return base.tag == "mi"
