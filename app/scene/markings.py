"""Degree scales: ticks and numerals as flat strokes, so that no font and no texture is needed."""

from __future__ import annotations

import math

from .shapes import Mesh, merged, sector, stroke

# Polylines on a grid 2 wide and 4 high, with broken corners; enough for signed whole numbers.
_GLYPHS: dict[str, list[list[tuple[float, float]]]] = {
    "0": [[(0.6, 0), (1.4, 0), (2, 0.7), (2, 3.3), (1.4, 4), (0.6, 4), (0, 3.3), (0, 0.7), (0.6, 0)]],
    "1": [[(0.3, 3.2), (1.2, 4), (1.2, 0)]],
    "2": [[(0, 3.4), (0.6, 4), (1.4, 4), (2, 3.4), (2, 2.7), (0, 0), (2, 0)]],
    "3": [
        [(0, 3.5), (0.6, 4), (1.4, 4), (2, 3.4), (2, 2.6), (1.4, 2.1)],
        [(0.8, 2.1), (1.4, 2.1), (2, 1.5), (2, 0.6), (1.4, 0), (0.6, 0), (0, 0.5)],
    ],
    "4": [[(1.5, 0), (1.5, 4), (0, 1.2), (2, 1.2)]],
    "5": [[(1.9, 4), (0.2, 4), (0.1, 2.2), (1.3, 2.4), (2, 1.8), (2, 0.7), (1.3, 0), (0.6, 0), (0, 0.5)]],
    "6": [
        [(1.7, 4), (0.8, 3.6), (0, 2), (0, 0.7), (0.6, 0), (1.4, 0), (2, 0.7), (2, 1.7), (1.4, 2.3)],
        [(1.4, 2.3), (0.7, 2.3), (0, 1.7)],
    ],
    "7": [[(0, 4), (2, 4), (0.8, 0)]],
    "8": [
        [(0.6, 2.1), (0, 2.7), (0, 3.4), (0.6, 4), (1.4, 4), (2, 3.4), (2, 2.7), (1.4, 2.1), (0.6, 2.1)],
        [(0.6, 2.1), (0, 1.5), (0, 0.6), (0.6, 0), (1.4, 0), (2, 0.6), (2, 1.5), (1.4, 2.1)],
    ],
    "9": [
        [(0.3, 0), (1.2, 0.4), (2, 2), (2, 3.3), (1.4, 4), (0.6, 4), (0, 3.3), (0, 2.3), (0.6, 1.7)],
        [(0.6, 1.7), (1.3, 1.7), (2, 2.3)],
    ],
    "-": [[(0.1, 2), (1.9, 2)]],
    "°": [
        [(0.3, 2.9), (0.9, 2.9), (1.2, 3.2), (1.2, 3.7), (0.9, 4), (0.3, 4), (0, 3.7), (0, 3.2), (0.3, 2.9)]
    ],
}
_ADVANCE = 3.0
_WEIGHT = 0.62
"""Width of a stroke on the glyphs' grid."""


def text(characters: str, height: float) -> Mesh:
    """Write digits, minus and degree signs on z = 0, centred, reading along +x (metres)."""
    unit = height / 4.0
    width = (_ADVANCE * len(characters) - 1.0) * unit
    pieces = []
    for place, character in enumerate(characters):
        left = place * _ADVANCE * unit - width / 2
        for line in _GLYPHS[character]:
            points = [(left + x * unit, y * unit - height / 2) for x, y in line]
            pieces.append(stroke(points, _WEIGHT * unit))
    return merged(pieces)


def yaw_scale(radius: float, viewer: tuple[float, float] = (0.0, -1.0)) -> Mesh:
    """Return the ground's scale for ψ: a tick every 10°, a number every 30° (radius in metres).

    Positive ψ runs clockwise seen from above. Each number stands with its foot towards the viewer:
    outwards on the near side, inwards on the far one.

    Args:
        radius: of the scale.
        viewer: direction in the plane from which the scale is looked at; its length does not matter.
    """
    pieces = []
    for degrees in range(-170, 181, 10):
        major = degrees % 30 == 0
        length, width = (0.020, 0.0038) if major else (0.011, 0.0020)
        angle = -math.radians(degrees)
        pieces.append(stroke([(radius, 0.0), (radius + length, 0.0)], width).turned("z", angle))
        if major:
            near = math.cos(angle) * viewer[0] + math.sin(angle) * viewer[1] >= 0
            number = text(f"{degrees}°", 0.033).turned("z", math.pi / 2 if near else -math.pi / 2)
            pieces.append(number.moved(x=radius + 0.046).turned("z", angle))
    return merged(pieces)


def pitch_scale(radius: float, limit: int) -> Mesh:
    """Return the upright scale for θ about the pitch axle, from -limit to limit degrees.

    A tick every 5°, a number every 20°, to be read from either side (radius in metres). It lies in
    the plane y = 0 with its centre in the origin and 0° along +x.
    """
    return merged(_pitch_face(radius, limit, front) for front in (True, False))


def _pitch_face(radius: float, limit: int, front: bool) -> Mesh:
    """Return the scale as seen from -y (front) or from +y, drawn flat and then raised."""
    side = 1.0 if front else -1.0
    end = math.radians(limit + 4)
    middle = 0.0 if front else math.pi
    pieces = [sector(radius, radius + 0.0030, middle - end, middle + end)]
    for degrees in range(-limit, limit + 1, 5):
        angle = math.radians(degrees)
        length, width = (0.018, 0.0036) if degrees % 20 == 0 else (0.011, 0.0020)
        tick = stroke([(radius, 0.0), (radius + length, 0.0)], width)
        pieces.append(tick.turned("z", angle if front else math.pi - angle))
        if degrees % 20 == 0:
            far = radius + 0.020 + 0.012 * len(str(degrees)) + 0.008
            at = (side * far * math.cos(angle), far * math.sin(angle))
            pieces.append(text(f"{degrees}°", 0.027).moved(*at))
    raised = merged(pieces).turned("x", math.pi / 2)
    return raised if front else raised.turned("z", math.pi)
