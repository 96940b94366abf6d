"""How values are written into the page's generated modules, as Prettier has them."""

from __future__ import annotations

import re

WIDTH = 120


def quoted(text: str) -> str:
    """A string's literal: in single quotes, or in double ones where that needs fewer escapes."""
    mark = '"' if text.count("'") > text.count('"') else "'"
    plain = text.replace("\\", "\\\\").replace(mark, f"\\{mark}").replace("\u00ad", "\\u00ad")
    return f"{mark}{plain}{mark}"


def key(name: str) -> str:
    """A property's name."""
    return name if re.fullmatch(r"[A-Za-z_$][\w$]*", name) else quoted(name)


def literal(value: str | float | bool) -> str:
    """A value's literal."""
    if isinstance(value, bool):
        return str(value).lower()
    return quoted(value) if isinstance(value, str) else re.sub(r"\.0$|(?<=e)\+?(-?)0*", r"\1", repr(value))
