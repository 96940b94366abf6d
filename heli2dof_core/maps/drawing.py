"""A map as a picture: filled contours with values, axes, legend; what is forbidden is hatched. Prints in grey."""

from __future__ import annotations

from html import escape

from .canvas import LEFT, SIDE, TOP, Canvas
from .field import field, patterns
from .mapped import Mapped
from .numbers import made_again
from .surround import axes, head, key, legend, marks

WIDTH = LEFT + SIDE + 104.0
_STYLE = """
.t{font:600 15px %(f)s;fill:#111}.s{font:12px %(f)s;fill:#444}.n{font:11px %(f)s;fill:#333}
.l{font:600 10.5px %(f)s;paint-order:stroke;stroke-width:3px;stroke-linejoin:round}
.a{fill:none;stroke:#333}.k{stroke:#333}.z{stroke:#333;stroke-dasharray:4 3}
.c{fill:none;stroke-width:.9;stroke-opacity:.7}.h,.m,.o{fill:none;stroke-linecap:round}
.h{stroke:#fff;stroke-width:4.5}.m{stroke:#b3123e;stroke-width:2.2}.o{stroke:#111;stroke-width:1.4}
""" % {"f": "'DejaVu Sans',Verdana,Arial,sans-serif"}  # noqa: UP031 # braces are the sheet's own


def drawn(found: Mapped) -> str:
    """The picture as SVG text, by itself."""
    c = Canvas(found)
    bottom = TOP + c.height + 84
    about = "\n".join((found.summary(), *made_again(found, "svg")))
    parts = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:g} {bottom:g}" width="{WIDTH:g}" '
        f'height="{bottom:g}" role="img">',
        f"<title>{escape(found.title)}</title><desc>{escape(about)}</desc>",
        f"<style>{_STYLE}</style><defs>{patterns(c)}</defs>",
        f'<rect width="{WIDTH:g}" height="{bottom:g}" fill="#fff"/>',
        *head(c),
        *field(c),
        *axes(c),
        *marks(c),
        *legend(c),
        *key(c),
        "</svg>",
    )
    return "".join(parts)
