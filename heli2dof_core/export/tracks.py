"""A track to take away: numbers, one row per value, or a picture that prints."""

from __future__ import annotations

import json
from collections.abc import Iterator
from html import escape
from math import isfinite, isnan

import numpy as np

from ..body import body_of
from ..signals import Complexes, Floats
from ..spec import Spec
from ..tables import number
from ..tracks import Track
from ..tracks.sweeps import side
from ..version import package_version
from .svg import ticks

WIDTH, PLANE, CHART = 720, 460, 150
LEFT, RIGHT, TOP, BOTTOM = 64, 18, 46, 40
REACH = 2.0
"""The picture reaches so many times as far as the poles of the design, the ends of the track and its zeros."""
FARTHEST = 3.0
"""No farther than so many times as far as the design's own poles: branches may go to infinity."""
_STYLE = (
    "text{font:12px system-ui,sans-serif;fill:#222}.grid{stroke:#ddd}.axis{stroke:#444;fill:none}"
    ".stable{stroke:#0b5394;stroke-width:1.8;fill:none}.unstable{stroke:#c8501e;stroke-width:1.8;fill:none;"
    "stroke-dasharray:5 3}.mark{stroke:#222;stroke-width:1.6;fill:none}.now{fill:#222}.head{font-weight:600}"
)


def track_csv(track: Track, spec: Spec) -> str:
    """Comma-separated values behind lines that begin with #; units in the header; empty where there is no figure."""
    about = track.number.quantity
    unit = f" [{about.unit}]" if about.unit else ""
    poles = "rad/s" if track.plane == "s" else "z-plane"
    order = track.poles.shape[1]
    head = [f"{track.number.path}{unit}", "stable"]
    head += [f"{part} p{i + 1} [{poles}]" for i in range(order) for part in ("Re", "Im")]
    for measure in track.measures:
        own = f" [{measure.figure.unit}]" if measure.figure.unit else ""
        head.append(f'"{measure.words}{own}"')
    lines = [
        *(f"# {line}" for line in _origin(track, spec)),
        *(f"# Poles cross the border of stability at {c.value!r}{unit}" for c in track.crossings),
        ",".join(head),
    ]
    for i, value in enumerate(track.values.tolist()):
        row = [repr(value), str(int(track.stable[i]))]
        row += [repr(part) for p in track.poles[i].tolist() for part in (p.real, p.imag)]
        row += ["" if isnan(v) else repr(v) for v in track.figures[i].tolist()]
        lines.append(",".join(row))
    return "\n".join(lines) + "\n"


def _origin(track: Track, spec: Spec) -> Iterator[str]:
    yield f"heli2dof {package_version()}: {track.summary()}"
    yield f"Swept: {track.number.quantity.described}"
    yield "Made again by POST /api/v1/track with the body"
    yield json.dumps({**body_of(spec), "track": {"path": track.number.path, "over": _ends(track)}})


def _ends(track: Track) -> list[float]:
    return [float(track.values[0]), float(track.values[-1])] if len(track.values) else []


def track_svg(track: Track, spec: Spec) -> str:
    """Courses of the poles in their plane, and below it each figure over the number.

    What is stable is told by line and colour; crosses stand where courses begin, squares where they end, circles at
    zeros, dots at the design's own value.
    """
    about = track.number.quantity
    name, short = about.symbol or track.number.path, about.meaning.partition(";")[0]
    unit = f" {about.unit}" if about.unit else ""
    parts = [f"<style>{_STYLE}</style>", '<rect width="100%" height="100%" fill="#fff"/>']
    parts += [
        f'<text class="head" x="{LEFT}" y="18">{escape(f"{track.number.path}: {short}")}</text>',
        f'<text x="{LEFT}" y="35">{escape(_legend(track, name, unit))}</text>',
        *_plane(track),
    ]
    for k in range(len(track.measures)):
        parts += _chart(track, k, PLANE + k * CHART, f"{name}{f' [{about.unit}]' if about.unit else ''}")
    height = PLANE + len(track.measures) * CHART
    title = escape(f"Poles over {track.number.path}")
    description = escape(
        json.dumps({**body_of(spec), "track": {"path": track.number.path, "over": _ends(track)}})
    )
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height}" viewBox="0 0 {WIDTH} {height}" '
        f'role="img"><title>{title}</title><desc>{description}</desc>{"".join(parts)}</svg>\n'
    )


def _legend(track: Track, name: str, unit: str) -> str:
    ends = [number(v) for v in _ends(track)] or ["", ""]
    now = "" if track.number.now is None or track.at_now is None else f", ● {number(track.number.now)}{unit}"
    zeros = ", ○ zeros" if len(track.zeros) else ""
    return f"{name}: × {ends[0]}, □ {ends[1]}{unit}{now}{zeros}; dashed where the loop is unstable"


class _Box:
    """Ranges of both axes, and where they lie in the picture."""

    def __init__(self, x: tuple[float, float], y: tuple[float, float], top: float, height: float) -> None:
        self.x_range, self.y_range = x, y
        self.top, self.low, self.right = top + 8.0, top + height - BOTTOM, WIDTH - RIGHT

    def x(self, value: float) -> float:
        a, b = self.x_range
        return LEFT + (value - a) / (b - a) * (self.right - LEFT)

    def y(self, value: float) -> float:
        a, b = self.y_range
        return self.low - (value - a) / (b - a) * (self.low - self.top)

    def holds(self, x: float, y: float) -> bool:
        (a, b), (c, d) = self.x_range, self.y_range
        return isfinite(x) and isfinite(y) and a <= x <= b and c <= y <= d

    def axes(self, x_label: str, y_label: str, most: int) -> Iterator[str]:
        for value in ticks(*self.x_range, 8):
            at = self.x(value)
            yield f'<line class="grid" x1="{at:.1f}" x2="{at:.1f}" y1="{self.top:.1f}" y2="{self.low:.1f}"/>'
            yield f'<text x="{at:.1f}" y="{self.low + 15:.1f}" text-anchor="middle">{number(value)}</text>'
        for value in ticks(*self.y_range, most):
            at = self.y(value)
            yield f'<line class="grid" x1="{LEFT}" x2="{self.right}" y1="{at:.1f}" y2="{at:.1f}"/>'
            yield f'<text x="{LEFT - 6}" y="{at + 4:.1f}" text-anchor="end">{number(value)}</text>'
        yield f'<path class="axis" d="M {LEFT} {self.top:.1f} V {self.low:.1f} H {self.right}"/>'
        middle = (LEFT + self.right) / 2
        yield f'<text x="{middle:.1f}" y="{self.low + 31:.1f}" text-anchor="middle">{escape(x_label)}</text>'
        yield (
            f'<text transform="rotate(-90 14 {(self.top + self.low) / 2:.1f})" x="14" '
            f'y="{(self.top + self.low) / 2:.1f}" text-anchor="middle">{escape(y_label)}</text>'
        )

    def clipped(self, inner: str) -> str:
        width, height = self.right - LEFT, self.low - self.top
        box = f'x="{LEFT}" y="{self.top:.1f}" width="{width:.1f}" height="{height:.1f}"'
        return f'<svg {box} viewBox="{LEFT} {self.top:.1f} {width:.1f} {height:.1f}">{inner}</svg>'


def _plane(track: Track) -> Iterator[str]:
    if not len(track.values):
        return
    box = _Box(*_ranges(track), TOP, PLANE - TOP)
    unit = ", rad/s" if track.plane == "s" else ""
    yield from box.axes(f"Re{unit}", f"Im{unit}", 7)
    yield box.clipped(_border(track, box) + "".join(_courses(track, box)))
    for k, path in ((0, _CROSS), (len(track.values) - 1, _SQUARE)):
        for x, y in _seen(track.poles[k], box):
            yield f'<path class="mark" d="{path.format(l=x - 4, r=x + 4, t=y - 4, b=y + 4)}"/>'
    if track.at_now is not None:
        for x, y in _seen(track.poles[track.at_now], box):
            yield f'<circle class="now" cx="{x:.1f}" cy="{y:.1f}" r="3.5"/>'
    for x, y in _seen(track.zeros, box):
        yield f'<circle class="mark" cx="{x:.1f}" cy="{y:.1f}" r="5"/>'
    for c in track.crossings:
        if box.holds(c.pole.real, c.pole.imag):
            at = f'x="{box.x(c.pole.real) + 7:.1f}" y="{box.y(c.pole.imag) - 5:.1f}"'
            yield f"<text {at}>{number(c.value, 5)}</text>"


_CROSS = "M {l:.1f} {t:.1f} L {r:.1f} {b:.1f} M {l:.1f} {b:.1f} L {r:.1f} {t:.1f}"
_SQUARE = "M {l:.1f} {t:.1f} H {r:.1f} V {b:.1f} H {l:.1f} Z"


def _seen(points: Complexes, box: _Box) -> Iterator[tuple[float, float]]:
    """Where those points stand that the picture holds."""
    for p in points.tolist():
        if box.holds(p.real, p.imag):
            yield box.x(p.real), box.y(p.imag)


def _border(track: Track, box: _Box) -> str:
    if track.plane == "s":
        return f'<line class="axis" x1="{box.x(0):.1f}" x2="{box.x(0):.1f}" y1="{box.top}" y2="{box.low}"/>'
    rx, ry = box.x(1.0) - box.x(0.0), box.y(0.0) - box.y(1.0)
    return f'<ellipse class="axis" cx="{box.x(0):.1f}" cy="{box.y(0):.1f}" rx="{rx:.1f}" ry="{ry:.1f}"/>'


def _courses(track: Track, box: _Box) -> Iterator[str]:
    """Each course as lines, a new one where stability changes; points far outside are left out."""
    heights = side(track.poles, track.plane)
    far = 4.0 * max(abs(v) for v in (*box.x_range, *box.y_range))
    for a, b in zip(track.starts, (*track.starts[1:], len(track.values)), strict=True):
        for j in range(track.poles.shape[1]):
            at, kind = [], ""
            for k in range(a, b):
                p, own = complex(track.poles[k, j]), "unstable" if heights[k, j] > 0.0 else "stable"
                if own != kind or abs(p) > far:
                    yield _line(at, kind)
                    at, kind = at[-1:] if abs(p) <= far else [], own
                if abs(p) <= far:
                    at.append((box.x(p.real), box.y(p.imag)))
            yield _line(at, kind)


def _line(points: list[tuple[float, float]], kind: str) -> str:
    if len(points) < 2:
        return ""
    return f'<polyline class="{kind}" points="{" ".join(f"{x:.1f},{y:.1f}" for x, y in points)}"/>'


def _ranges(track: Track) -> tuple[tuple[float, float], tuple[float, float]]:
    """What is seen: equal scales on both axes."""
    if track.plane == "z":
        half, wide = 1.15, 1.15 * (WIDTH - LEFT - RIGHT) / (PLANE - TOP - BOTTOM - 8.0)
        return (-wide, wide), (-half, half)
    row = track.poles[track.at_now if track.at_now is not None else 0]
    own = float(min(np.max(np.abs(track.poles[k])) for k in (0, len(track.poles) - 1))) or 1.0
    if track.at_now is not None:
        own = float(np.max(np.abs(row))) or 1.0
    marks = [*track.poles[0].tolist(), *track.poles[-1].tolist(), *row.tolist(), *track.zeros.tolist()]
    near = [p for p in marks if abs(p) <= FARTHEST * own]
    reach = min(max(REACH * own, *(abs(p) for p in near)), FARTHEST * own)
    inside = track.poles[np.abs(track.poles) <= reach]
    low, high = float(min(inside.real.min(), 0.0)), float(max(inside.real.max(), 0.0))
    room = 0.08 * (high - low) or 1.0
    low, high = low - room, high + room
    half = 1.1 * float(np.max(np.abs(inside.imag), initial=0.0))
    width, height = WIDTH - LEFT - RIGHT, PLANE - TOP - BOTTOM - 8.0
    scale = max((high - low) / width, 2.0 * half / height)
    middle = 0.5 * (low + high)
    return (middle - scale * width / 2, middle + scale * width / 2), (-scale * height / 2, scale * height / 2)


def _chart(track: Track, k: int, top: float, x_label: str) -> Iterator[str]:
    """One figure over the number."""
    measure, values = track.measures[k], track.figures[:, k]
    figure, valid = measure.figure, np.isfinite(values)
    head = measure.words + (f" [{figure.shown or figure.unit}]" if figure.unit else "")
    yield f'<text class="head" x="{LEFT}" y="{top + 4:.1f}">{escape(head)}</text>'
    if not valid.any():
        yield f'<text x="{LEFT}" y="{top + 40:.1f}">nowhere a value</text>'
        return
    shown: Floats = values * figure.scale
    low, high = float(shown[valid].min()), float(shown[valid].max())
    room = 0.08 * (high - low) or 0.1 * abs(high) or 1.0
    ends = (float(track.values[0]), float(track.values[-1]))
    box = _Box(ends, (low - room, high + room), top + 4.0, CHART - 4.0)
    yield from box.axes(x_label, "", 4)
    points: list[tuple[float, float]] = []
    for i, value in enumerate(track.values.tolist()):
        if i in track.starts or not valid[i]:
            yield _line(points, "stable")
            points = []
        if valid[i]:
            points.append((box.x(value), box.y(float(shown[i]))))
    yield _line(points, "stable")
    now = track.at_now
    if now is not None:
        at = box.x(float(track.values[now]))
        yield f'<line class="axis" stroke-dasharray="2 3" x1="{at:.1f}" x2="{at:.1f}" y1="{box.top}" y2="{box.low}"/>'
        if valid[now]:
            yield f'<circle class="now" cx="{at:.1f}" cy="{box.y(float(shown[now])):.1f}" r="3.5"/>'
