"""What stands on and around a map's field: title, axes, marks of designs, the legend of colours and signs."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from html import escape
from math import isfinite, nan

import numpy as np

from ..body import body_of
from ..figures.written import in_shown_unit
from ..many import SHARES
from ..measured import MEASURED
from ..presets import PRESETS
from ..tables import number, poles
from ..ticks import decades, ticks
from .canvas import LEFT, SIDE, TOP, Canvas
from .colors import css

_BAR, _GAP = 16.0, 22.0
"""Width of the legend's bar, and its distance from the field."""


def head(c: Canvas) -> Iterator[str]:
    """What was measured, by which model and in which unit; what is moved, and what stays."""
    found, spec = c.found, c.found.spec
    unit = f", {c.unit}" if c.unit else ""
    known = MEASURED.get(found.measure.name)
    of_rig = known is not None and known.may_have_model and found.measure.where.model == "nonlinear"
    model = ", nonlinear model" if of_rig else ""
    if found.measure.name in SHARES and found.uncertainty is not None:
        model = f", of {found.uncertainty.samples}"
    yield f'<text class="t" x="{LEFT:g}" y="24">{escape(found.title + model + unit)}</text>'
    preset = PRESETS[body_of(spec)["preset"]]
    if c.plane.of_pair:
        other, last = (
            ("yaw", spec.poles.values[2:]) if c.plane.axis == "pitch" else ("pitch", spec.poles.values[:2])
        )
        rest = f"{other}'s {poles(last)} rad/s"
    else:
        rest = f"poles {poles(spec.poles.values)} rad/s"
    words = f"{c.plane.words[:1].upper()}{c.plane.words[1:]}; {rest}; {preset.title}"
    yield f'<text class="s" x="{LEFT:g}" y="45">{escape(words)}</text>'


def axes(c: Canvas) -> Iterator[str]:
    """Ticks and names of x and y; the imaginary axis where it is crossed."""
    bottom, right = TOP + c.height, LEFT + SIDE
    of_log = c.plane.scale == "log"
    for value in (decades if of_log else ticks)(float(c.found.x[0]), float(c.found.x[-1])):
        x = float(c.across(value))
        yield f'<path class="k" d="M{x:.1f},{bottom:.1f}v5"/>'
        yield f'<text class="n" x="{x:.1f}" y="{bottom + 18:.1f}" text-anchor="middle">{number(value)}</text>'
    for value in (decades if of_log else ticks)(float(c.found.y[0]), float(c.found.y[-1])):
        y = float(c.up(value))
        yield f'<path class="k" d="M{LEFT:g},{y:.1f}h-5"/>'
        yield f'<text class="n" x="{LEFT - 9:g}" y="{y + 4:.1f}" text-anchor="end">{number(value)}</text>'
    if c.of_poles and c.found.x[0] < 0.0 < c.found.x[-1]:
        yield f'<path class="z" d="M{float(c.across(0.0)):.1f},{TOP:g}V{bottom:g}"/>'
    across, up = (escape(words) for words in c.plane.labels)
    yield f'<text class="s" x="{(LEFT + right) / 2:g}" y="{bottom + 38:g}" text-anchor="middle">{across}</text>'
    middle = (TOP + bottom) / 2
    yield (
        f'<text class="s" x="18" y="{middle:.1f}" text-anchor="middle" '
        f'transform="rotate(-90 18 {middle:.1f})">{up}</text>'
    )


def marks(c: Canvas) -> Iterator[str]:
    """The design itself, its other poles, and the best place."""
    best, here = c.best, c.found.here
    if c.of_poles:
        own = 0 if c.plane.axis == "pitch" else 2
        for i, p in enumerate(c.found.spec.poles.values):
            if i in (own, own + 1) and here is not None:
                continue
            if p.imag >= 0.0 and c.inside(p.real, p.imag):
                yield _mark(_cross(float(c.across(p.real)), float(c.up(p.imag)), 4.0), "o")
    if best is not None:
        x, y = float(c.across(best[0])), float(c.up(best[1]))
        yield _mark(f"M{x:.1f},{y - 6:.1f}l6,6l-6,6l-6,-6Z", "o")
    if here is not None and c.inside(*here):
        x, y = float(c.across(here[0])), float(c.up(here[1]))
        circle = f"M{x - 6:.1f},{y:.1f}a6,6 0 1 0 12,0a6,6 0 1 0 -12,0"
        yield _mark(_cross(x, y, 6.0) if c.of_poles else circle, "m")


def legend(c: Canvas) -> Iterator[str]:
    """The bar of colours, its levels beside it; its ends are open."""
    x, count = LEFT + SIDE + _GAP, len(c.colors)
    if not np.any(np.isfinite(c.shown)):
        return
    step = c.height / count
    for k, color in enumerate(c.colors):
        y = TOP + c.height - (k + 1) * step
        yield f'<rect x="{x:g}" y="{y:.2f}" width="{_BAR:g}" height="{step + 0.4:.2f}" fill="{css(color)}"/>'
    yield f'<rect class="a" x="{x:g}" y="{TOP:g}" width="{_BAR:g}" height="{c.height:g}"/>'
    for k, level in enumerate(c.levels):
        y = TOP + c.height - (k + 1) * step
        yield f'<path class="k" d="M{x + _BAR:g},{y:.1f}h4"/>'
        yield f'<text class="n" x="{x + _BAR + 8:g}" y="{y + 4:.1f}">{c.text_of(level)}</text>'
    if not c.levels:
        only = float(np.nanmean(c.shown))
        yield f'<text class="n" x="{x + _BAR + 8:g}" y="{TOP + c.height / 2:.1f}">{number(only, 3)}</text>'
    here = c.found.own
    if isfinite(here) and c.levels and c.found.here is not None:
        y = TOP + c.height - step * _band(c, here)
        yield f'<path fill="#b3123e" d="M{x - 2:g},{y:.1f}l-8,-4.5v9Z"/>'


def key(c: Canvas) -> Iterator[str]:
    """What signs and hatches mean: those that are there."""
    found, y = c.found, TOP + c.height + 66
    known, there = found.valid | found.unlimited, np.isfinite(found.abscissa)
    lacks, none = found.stable & ~known, "no value"
    if not np.any(lacks):
        none = "no design"
    elif np.all(there) and found.measure.name == "settling_time":
        none = found.written(nan)
    x = LEFT
    for seen, kind, words in (
        (np.any(there & ~found.stable), "u", "unstable"),
        (np.any(lacks | ~there), "n", none),
        (np.any(found.unlimited), "i", "no limit"),
    ):
        if seen:
            yield f'<rect class="a" x="{x:.1f}" y="{y - 10:.1f}" width="20" height="13" fill="#fff"/>'
            yield f'<rect x="{x:.1f}" y="{y - 10:.1f}" width="20" height="13" fill="url(#{c.name}{kind})"/>'
            yield f'<text class="n" x="{x + 26:.1f}" y="{y + 1:.1f}">{words}</text>'
            x += 26 + 6.6 * len(words) + 20
    best, here = c.best, found.here
    if here is not None and c.inside(*here):
        ring = f"M{x + 1:.1f},{y - 4:.1f}a5.5,5.5 0 1 0 11,0a5.5,5.5 0 1 0 -11,0"
        yield _mark(_cross(x + 6.5, y - 4, 5.0) if c.of_poles else ring, "m")
        words = f"here {found.written(found.own)}"
        yield f'<text class="n" x="{x + 20:.1f}" y="{y + 1:.1f}">{escape(words)}</text>'
        x += 20 + 6.6 * len(words) + 20
    if best is not None:
        yield _mark(f"M{x + 6:.1f},{y - 10:.1f}l6,6l-6,6l-6,-6Z", "o")
        words = f"best {found.written(best[2])}"
        yield f'<text class="n" x="{x + 20:.1f}" y="{y + 1:.1f}">{escape(words)}</text>'


def _band(c: Canvas, value: float) -> float:
    """Where a value stands along the bar, in bands from its lower end."""
    figure = c.found.measure.figure
    own = abs(in_shown_unit(figure, value)) if figure.signed else in_shown_unit(figure, value)
    k = bisect_right(c.levels, own)
    if k in (0, len(c.levels)):
        return k + 0.5
    low, high = c.levels[k - 1], c.levels[k]
    return k + (own - low) / (high - low)


def _cross(x: float, y: float, half: float) -> str:
    return (
        f"M{x - half:.1f},{y - half:.1f}l{2 * half:g},{2 * half:g}m0,{-2 * half:g}l{-2 * half:g},{2 * half:g}"
    )


def _mark(path: str, kind: str) -> str:
    """A sign with a white rim, to be seen on every colour."""
    return f'<path class="h" d="{path}"/><path class="{kind}" d="{path}"/>'
