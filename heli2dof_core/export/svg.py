"""Small drawings as SVG text: curves over time, and poles in the s-plane. Black on white, told apart by shape."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from html import escape

import numpy as np

from ..frozen import Frozen
from ..signals import Floats
from ..tables import number
from ..ticks import ticks

WIDTH, HEIGHT = 340, 210
LEFT, RIGHT, TOP, BOTTOM = 46, 10, 10, 34
MOST_POINTS = 400


@dataclass(frozen=True)
class Curve(Frozen):
    """One line: values over x, and the class that the style draws: `pitch`, `yaw` (`…-linear`) or `mark`."""

    x: Floats
    y: Floats
    kind: str


@dataclass(frozen=True)
class Marks:
    """Points of one shape: `cross`, `plus` or `circle`; labels may be empty."""

    points: Sequence[complex]
    shape: str
    labels: Sequence[str] = ()


def thinned(x: Floats, y: Floats, most: int = MOST_POINTS) -> tuple[Floats, Floats]:
    """At most about `most` points, each stretch's smallest and largest among them, so that no peak is lost."""
    if len(x) <= most:
        return x, y
    keep = {0, len(x) - 1}
    for stretch in np.array_split(np.arange(len(x)), most // 2):
        keep |= {int(stretch[np.argmin(y[stretch])]), int(stretch[np.argmax(y[stretch])])}
    chosen = sorted(keep)
    return x[chosen], y[chosen]


def chart(title: str, x_label: str, y_label: str, curves: Iterable[Curve]) -> str:
    """Curves over x with both axes, the title for screen readers.

    A linear model's curve that goes far beyond the others, as an unstable one does, is cut off.
    """
    curves = list(curves)
    low, high = _range([curve for curve in curves if not curve.kind.endswith("linear")])
    room = high - low or 1.0
    linear_low, linear_high = _range(curves)
    low, high = max(linear_low, low - room), min(linear_high, high + room)
    frame = _Frame.around(float(curves[0].x[0]), float(curves[0].x[-1]), low, high)
    lines = "".join(frame.line(*thinned(curve.x, curve.y), curve.kind) for curve in curves)
    return _svg(title, [*frame.axes(x_label, y_label), _inside(lines)])


def _range(curves: Sequence[Curve]) -> tuple[float, float]:
    return min(float(curve.y.min()) for curve in curves), max(float(curve.y.max()) for curve in curves)


def _inside(parts: str) -> str:
    """What is drawn within the axes alone: a picture in the picture cuts off what lies beyond it."""
    width, height = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
    box = f'x="{LEFT}" y="{TOP}" width="{width}" height="{height}" viewBox="{LEFT} {TOP} {width} {height}"'
    return f"<svg {box}>{parts}</svg>"


def pole_map(title: str, groups: Iterable[Marks]) -> str:
    """Poles in the s-plane, to equal scales, the imaginary axis drawn."""
    groups = list(groups)
    points = [p for group in groups for p in group.points]
    x_low, x_high = min(0.0, *(p.real for p in points)), max(0.0, *(p.real for p in points))
    half = max(0.1, 0.15 * (x_high - x_low), *(abs(p.imag) for p in points))
    width, height = WIDTH - LEFT - RIGHT, HEIGHT - TOP - BOTTOM
    scale = max(1.16 * (x_high - x_low) / width, 2.3 * half / height)  # units per pixel
    middle = (x_low + x_high) / 2
    frame = _Frame(
        middle - scale * width / 2, middle + scale * width / 2, -scale * height / 2, scale * height / 2
    )
    zero = frame.x(0.0)
    axis = f'<line class="mark" x1="{zero:.1f}" x2="{zero:.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}"/>'
    shapes = [shape for group in groups for shape in _shapes(frame, group)]
    return _svg(title, [*frame.axes("Re, rad/s", "Im, rad/s"), axis, *shapes])


@dataclass(frozen=True)
class _Frame:
    """Ranges of both axes, and where they lie in the picture."""

    x_low: float
    x_high: float
    y_low: float
    y_high: float

    @classmethod
    def around(cls, x_low: float, x_high: float, y_low: float, y_high: float) -> _Frame:
        room = 0.06 * (y_high - y_low) or 0.1 * abs(y_high) or 1.0
        return cls(x_low, x_high, y_low - room, y_high + room)

    def x(self, value: float) -> float:
        return LEFT + (value - self.x_low) / (self.x_high - self.x_low) * (WIDTH - LEFT - RIGHT)

    def y(self, value: float) -> float:
        return HEIGHT - BOTTOM - (value - self.y_low) / (self.y_high - self.y_low) * (HEIGHT - TOP - BOTTOM)

    def line(self, x: Floats, y: Floats, kind: str) -> str:
        points = " ".join(
            f"{self.x(a):.1f},{self.y(b):.1f}" for a, b in zip(x.tolist(), y.tolist(), strict=True)
        )
        return f'<polyline class="{kind}" points="{points}"/>'

    def axes(self, x_label: str, y_label: str) -> Iterable[str]:
        right, low = WIDTH - RIGHT, HEIGHT - BOTTOM
        for value in ticks(self.x_low, self.x_high):
            x = self.x(value)
            yield f'<line class="grid" x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{low}"/>'
            yield f'<text x="{x:.1f}" y="{low + 13}" text-anchor="middle">{number(value)}</text>'
        for value in ticks(self.y_low, self.y_high):
            y = self.y(value)
            yield f'<line class="grid" x1="{LEFT}" x2="{right}" y1="{y:.1f}" y2="{y:.1f}"/>'
            yield f'<text x="{LEFT - 4}" y="{y + 3.5:.1f}" text-anchor="end">{number(value)}</text>'
        yield f'<path class="axis" d="M {LEFT} {TOP} V {low} H {right}"/>'
        yield f'<text x="{(LEFT + right) / 2:.1f}" y="{HEIGHT - 6}" text-anchor="middle">{escape(x_label)}</text>'
        middle = (TOP + low) / 2
        turned = f'transform="rotate(-90 11 {middle:.1f})"'
        yield f'<text x="11" y="{middle:.1f}" text-anchor="middle" {turned}>{escape(y_label)}</text>'


_PATHS = {
    "cross": "M {l:.1f} {t:.1f} L {r:.1f} {b:.1f} M {l:.1f} {b:.1f} L {r:.1f} {t:.1f}",
    "plus": "M {x:.1f} {t:.1f} V {b:.1f} M {l:.1f} {y:.1f} H {r:.1f}",
    "circle": "M {l:.1f} {y:.1f} a 4 4 0 1 0 8 0 a 4 4 0 1 0 -8 0",
}


def _shapes(frame: _Frame, group: Marks) -> Iterable[str]:
    for i, p in enumerate(group.points):
        x, y = frame.x(p.real), frame.y(p.imag)
        path = _PATHS[group.shape].format(x=x, y=y, l=x - 4, r=x + 4, t=y - 4, b=y + 4)
        yield f'<path class="pole" d="{path}"/>'
        if i < len(group.labels):
            above = p.imag > 0 or (
                p.imag == 0 and i % 2 == 0
            )  # labels of neighbours keep clear of each other
            at = y - 7 if above else y + 14
            yield f'<text x="{x:.1f}" y="{at:.1f}" text-anchor="middle">{escape(group.labels[i])}</text>'


def _svg(title: str, parts: Iterable[str]) -> str:
    inner = "".join(parts)
    return f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img"><title>{escape(title)}</title>{inner}</svg>'
