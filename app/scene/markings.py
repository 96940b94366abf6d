"""Degree scales: ticks and numerals as flat strokes, so that no font and no texture is needed."""

from __future__ import annotations

import math

from .shapes import Mesh, merged, stroke

# Polylines on a grid 2 wide and 4 high; enough for signed whole numbers.
_GLYPHS: dict[str, list[list[tuple[float, float]]]] = {
    "0": [[(0, 0), (2, 0), (2, 4), (0, 4), (0, 0)]],
    "1": [[(0.4, 3.2), (1.2, 4), (1.2, 0)]],
    "2": [[(0, 4), (2, 4), (2, 2), (0, 2), (0, 0), (2, 0)]],
    "3": [[(0, 4), (2, 4), (2, 0), (0, 0)], [(0.5, 2), (2, 2)]],
    "4": [[(0, 4), (0, 2), (2, 2)], [(2, 4), (2, 0)]],
    "5": [[(2, 4), (0, 4), (0, 2), (2, 2), (2, 0), (0, 0)]],
    "6": [[(2, 4), (0, 4), (0, 0), (2, 0), (2, 2), (0, 2)]],
    "7": [[(0, 4), (2, 4), (0.8, 0)]],
    "8": [[(0, 0), (2, 0), (2, 4), (0, 4), (0, 0)], [(0, 2), (2, 2)]],
    "9": [[(0, 0), (2, 0), (2, 4), (0, 4), (0, 2), (2, 2)]],
    "-": [[(0.2, 2), (1.8, 2)]],
    "°": [[(0, 3), (1, 3), (1, 4), (0, 4), (0, 3)]],
}
_ADVANCE = 3.0


def text(characters: str, height: float) -> Mesh:
    """Write digits, minus and degree signs on z = 0, centred, reading along +x (metres)."""
    unit = height / 4.0
    width = (_ADVANCE * len(characters) - 1.0) * unit
    pieces = []
    for place, character in enumerate(characters):
        left = place * _ADVANCE * unit - width / 2
        for line in _GLYPHS[character]:
            points = [(left + x * unit, y * unit - height / 2) for x, y in line]
            pieces.append(stroke(points, 0.5 * unit))
    return merged(pieces)


def yaw_scale(radius: float) -> Mesh:
    """Return the ground's scale for ψ: a tick every 10°, a number every 30° (radius in metres).

    Positive ψ runs clockwise seen from above. Each number stands with its foot outwards, so that
    whoever looks at the rig from outside reads the near ones upright.
    """
    pieces = []
    for degrees in range(-170, 181, 10):
        major = degrees % 30 == 0
        length, width = (0.020, 0.0030) if major else (0.011, 0.0016)
        angle = -math.radians(degrees)
        pieces.append(stroke([(radius, 0.0), (radius + length, 0.0)], width).turned("z", angle))
        if major:
            number = text(f"{degrees}°", 0.021).turned("z", math.pi / 2)
            pieces.append(number.moved(x=radius + 0.041).turned("z", angle))
    return merged(pieces)


def pitch_ticks(inner: float, outer: float, limit: int = 40) -> Mesh:
    """Return ticks every 10° of θ on z = 0, from +x and counter-clockwise (radii in metres)."""
    pieces = []
    for degrees in range(-limit, limit + 1, 10):
        start = inner if degrees % 20 == 0 else inner + 0.45 * (outer - inner)
        tick = stroke([(start, 0.0), (outer, 0.0)], 0.0011)
        pieces.append(tick.turned("z", math.radians(degrees)))
    return merged(pieces)
