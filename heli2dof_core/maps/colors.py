"""The colours of maps: from what is good, light, to what is bad, dark, over yellow, green and blue.

Equal steps look alike, as they are equally far apart in Oklab (B. Ottosson, 2020); lightness falls all the way, so
that prints in grey keep the order; and no step is told by red against green. The page's maps have the same.
"""

from __future__ import annotations

from math import cos, radians, sin

import numpy as np

from ..signals import Floats

_WAY = (
    (0.975, 0.045, 108.0),
    (0.9, 0.095, 128.0),
    (0.8, 0.115, 160.0),
    (0.68, 0.105, 200.0),
    (0.56, 0.115, 240.0),
    (0.47, 0.12, 268.0),
    (0.39, 0.105, 285.0),
)
"""Lightness, chroma and hue (degrees) along the way."""
_STEPS = 400
_TO_CONES = np.array(
    [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.291485548],
    ]
)
_TO_LINEAR = np.array(
    [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.707614701],
    ]
)


def ramp(count: int) -> Floats:
    """So many colours in Oklab, from good to bad, equally far apart, (count, 3)."""
    at = np.linspace(0.0, len(_WAY) - 1, _STEPS + 1)
    points = np.column_stack([np.interp(at, np.arange(len(_WAY)), part) for part in zip(*_WAY, strict=True)])
    points = np.array([(L, c * cos(radians(h)), c * sin(radians(h))) for L, c, h in points.tolist()])
    length = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))))
    wanted = length[-1] * np.arange(count) / max(1, count - 1)
    return np.column_stack([np.interp(wanted, length, part) for part in points.T])


def css(color: Floats) -> str:
    """An Oklab colour as sRGB: ``#ffffff``."""
    linear = np.clip(_TO_LINEAR @ (_TO_CONES @ color) ** 3, 0.0, 1.0)
    shown = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return "#" + "".join(f"{round(255 * part):02x}" for part in shown.tolist())
