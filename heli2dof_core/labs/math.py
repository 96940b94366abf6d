"""Formulas in a lab's Markdown, between dollars, as MathML that a page may show as it is."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from functools import lru_cache
from xml.etree.ElementTree import ParseError, fromstring

from ..symbolic.mathml import mathml

LONGEST = 400
"""Most characters of a formula."""
_MATH = re.compile(r"(?<![\\$])\$\$(?P<display>[^$]+)\$\$|(?<![\\$])\$(?P<inline>[^$\n]+)\$")
_CODE = re.compile(r"```.*?```|`[^`\n]*`", re.DOTALL)
_ELEMENTS = re.compile(
    "math|mrow|mi|mo|mn|ms|mtext|mspace|msup|msub|msubsup|mover|munder|munderover|mfrac|msqrt|mroot|mtable|mtr|mtd|"
    "mpadded|mphantom|menclose|mstyle"
)
_ATTRIBUTES = re.compile(
    "accent|accentunder|bevelled|columnalign|columnlines|columnspacing|denomalign|depth|display|displaystyle|fence|"
    "form|height|largeop|linethickness|lspace|mathcolor|mathsize|mathvariant|maxsize|minsize|movablelimits|notation|"
    "numalign|rowalign|rowlines|rowspacing|rspace|scriptlevel|separator|stretchy|symmetric|voffset|width"
)


def formulas_in(text: str) -> Iterator[tuple[str, bool]]:
    """Each formula's LaTeX, and whether it stands on a line of its own; code is none."""
    for match in _MATH.finditer(_CODE.sub("", text)):
        latex = (match["display"] or match["inline"]).strip()
        if latex:
            yield latex, bool(match["display"])


def math_of(texts: Iterable[str]) -> dict[str, str]:
    """MathML by LaTeX; what is no LaTeX is left out, and shown as it stands."""
    found: dict[str, str] = {}
    for text in texts:
        for latex, display in formulas_in(text):
            made = converted(latex, display=display) if latex not in found or display else None
            if made is not None:
                found[latex] = made
    return found


@lru_cache(maxsize=2000)
def converted(latex: str, *, display: bool) -> str | None:
    """The formula as MathML; None where it is no LaTeX, too long, or would be more than a formula."""
    if len(latex) > LONGEST:
        return None
    try:
        made = mathml(latex)
        root = fromstring(made)  # of our own making, and no document type can be in it
    except (ParseError, RecursionError):
        return None
    except Exception:  # latex2mathml raises whatever it meets first
        return None
    for element in root.iter():
        tag = element.tag.rpartition("}")[2]
        if not _ELEMENTS.fullmatch(tag) or not all(map(_ATTRIBUTES.fullmatch, element.attrib)):
            return None  # such as \href: a link is none of a formula's parts
        if (element.text or "").startswith("\\"):
            return None  # a command that it does not know
    return made.replace('display="inline"', 'display="block"', 1) if display else made
