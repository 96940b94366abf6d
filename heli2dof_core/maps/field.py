"""The field of a map's picture: hatches where nothing is, filled contours and named lines where values are."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from ..signals import Floats
from .canvas import LEFT, SIDE, TOP, Canvas
from .colors import css, ramp
from .labels import Labels
from .mapped import Truths
from .regions import extended, opened

_EVEN, _TINY = 'fill-rule="evenodd"', 1e-9


def field(c: Canvas) -> Iterator[str]:
    """Hatches below, colours on them: within the stable region where there is a value."""
    found, known, there = c.found, np.isfinite(c.shown), np.isfinite(c.found.abscissa)
    box = f'x="{LEFT:g}" y="{TOP:g}" width="{SIDE:g}" height="{c.height:g}"'
    yield f'<rect {box} fill="url(#{c.name}n)"/>'
    # the imaginary axis is met between the places, where the loop's slowest poles say
    slowest = extended(found.abscissa, there) if np.any(there) else np.ones(found.stable.shape)
    slowest = np.where(found.stable, np.minimum(slowest, -_TINY), np.maximum(slowest, _TINY))
    stable = c.grid.below(slowest, 0.0)
    unstable = c.grid.where(there | found.stable)
    yield _clip(c, "e", unstable) + _clip(c, "s", stable)
    yield f'<g clip-path="url(#{c.name}e)"><path {_EVEN} fill="url(#{c.name}u)" '
    yield f'd="{c.grid.above(slowest, 0.0)}"/></g><g clip-path="url(#{c.name}s)">'
    if np.any(found.unlimited):
        yield f'<path {_EVEN} fill="url(#{c.name}i)" d="{_among_stable(c, found.unlimited)}"/>'
    if np.any(known):
        yield _clip(c, "c", _among_stable(c, known))
        yield f'<g clip-path="url(#{c.name}c)"><rect {box} fill="{css(c.colors[0])}"/>'
        yield from _contours(c, extended(c.shown, known))
        yield "</g>"
    yield f'</g><rect class="a" {box}/>'


def patterns(c: Canvas) -> str:
    """Hatches: both ways where loops are unstable, one way where there is no figure; dots where no limit is."""
    best = css(ramp(2)[0])
    return "".join(
        f'<pattern id="{c.name}{kind}" width="{side}" height="{side}" patternUnits="userSpaceOnUse" '
        f'patternTransform="rotate(45)"><rect width="{side}" height="{side}" fill="{ground}"/>{ink}</pattern>'
        for kind, side, ground, ink in (
            ("u", 6, "#eceef0", '<path d="M0,0V6M0,0H6" stroke="#6b7278" stroke-width="1.5"/>'),
            ("n", 7, "#fff", '<path d="M0,0V7" stroke="#8b9298" stroke-width="1.6"/>'),
            ("i", 7, best, '<circle cx="3.5" cy="3.5" r="1" fill="#5b6257"/>'),
        )
    )


def _among_stable(c: Canvas, truths: Truths) -> str:
    """The region where something is true of stable places; unstable ones are as their neighbours are."""
    return c.grid.above(extended(truths.astype(float), c.found.stable), 0.5)


def _clip(c: Canvas, kind: str, path: str) -> str:
    return f'<clipPath id="{c.name}{kind}"><path clip-rule="evenodd" d="{path}"/></clipPath>'


def _contours(c: Canvas, values: Floats) -> Iterator[str]:
    """Each region over the one before, so that no gap shows; then lines, then their values."""
    levels: Sequence[float] = c.levels
    if c.wide:  # between decades, distances are those of logarithms
        values, levels = np.log10(np.maximum(values, 1e-300)), np.log10(levels).tolist()
    for level, color in zip(levels, c.colors[1:], strict=True):
        yield f'<path {_EVEN} fill="{css(color)}" d="{c.grid.above(values, level)}"/>'
    right, bottom = LEFT + SIDE, TOP + c.height
    marks = [(float(c.across(x)), float(c.up(y))) for x, y in c.spots()]
    labels = Labels((LEFT, TOP, right, bottom), marks)
    texts: list[str] = []
    for k, level in enumerate(levels):
        ink, ground = c.ink(k)
        lines = sorted(c.grid.lines(values, level), key=len, reverse=True)
        path = "".join(map(opened, lines))
        if path:
            yield f'<path class="c" stroke="{ink}" d="{path}"/>'
        words = c.text_of(c.levels[k])
        for line in lines[:3]:
            label = labels.on(line, 6.6 * len(words) + 8, k)
            if label is not None:
                at = f'transform="translate({label.x:.1f},{label.y:.1f}) rotate({label.angle:.1f})"'
                texts.append(
                    f'<text class="l" {at} text-anchor="middle" dy="3.7" fill="{ink}" stroke="{ground}">'
                    f"{words}</text>"
                )
    yield from texts
