"""Triangle meshes from a few lines of geometry: turned, extruded and lofted parts, and strokes.

Everything is in metres; a mesh carries its own normals, so that edges stay crisp and barrels round.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

Points = NDArray[np.float64]
Faces = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Mesh:
    """Vertices (V, 3) in metres, unit normals (V, 3) and triangles (F, 3)."""

    vertices: Points
    normals: Points
    faces: Faces

    def moved(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Mesh:
        """Return the mesh shifted by (x, y, z) metres."""
        return Mesh(self.vertices + np.array([x, y, z]), self.normals, self.faces)

    def turned(self, axis: str, angle: float) -> Mesh:
        """Return the mesh rotated about the coordinate axis "x", "y" or "z" by radians."""
        c, s = math.cos(angle), math.sin(angle)
        i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
        rotation = np.eye(3)
        rotation[i, i] = rotation[j, j] = c
        rotation[i, j], rotation[j, i] = -s, s
        return Mesh(self.vertices @ rotation.T, self.normals @ rotation.T, self.faces)


def merged(meshes: Iterable[Mesh]) -> Mesh:
    """Return one mesh that holds all the given ones."""
    parts = list(meshes)
    starts = np.cumsum([0] + [len(part.vertices) for part in parts[:-1]])
    return Mesh(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate([part.normals for part in parts]),
        np.concatenate([part.faces + start for part, start in zip(parts, starts, strict=True)]),
    )


def lathe(profile: Sequence[tuple[float, float]], segments: int = 40, *, smooth: bool = False) -> Mesh:
    """Turn a closed or open profile of (radius, height) about z; its outside is on the right.

    With `smooth` the profile is a closed curve without repeated end and is rounded along itself;
    otherwise each of its straight pieces is a band of its own.
    """
    curve = np.asarray(profile, dtype=float)
    if smooth:
        tangent = np.roll(curve, -1, axis=0) - np.roll(curve, 1, axis=0)
        edge = np.stack([curve, np.roll(curve, -1, axis=0)], axis=1)
        edge_tangent = np.stack([tangent, np.roll(tangent, -1, axis=0)], axis=1)
    else:
        edge = np.stack([curve[:-1], curve[1:]], axis=1)
        edge_tangent = np.repeat((edge[:, 1] - edge[:, 0])[:, None, :], 2, axis=1)
    normal = np.stack([edge_tangent[..., 1], -edge_tangent[..., 0]], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    angle = np.linspace(0.0, 2.0 * math.pi, segments + 1)
    ring = np.stack([np.cos(angle), np.sin(angle)], axis=-1)

    def swept(pairs: Points) -> Points:
        flat = pairs.reshape(-1, 2)
        out = np.empty((len(flat), segments + 1, 3))
        out[..., :2] = flat[:, None, 0, None] * ring
        out[..., 2] = flat[:, 1, None]
        return out

    columns = np.arange(segments)
    first = (2 * np.arange(len(edge)) * (segments + 1))[:, None] + columns
    second = first + segments + 1
    faces = np.stack([first, first + 1, second + 1, first, second + 1, second], axis=-1).reshape(-1, 3)
    return Mesh(swept(edge).reshape(-1, 3), swept(normal).reshape(-1, 3), faces)


def cylinder(radius: float, height: float, *, bevel: float = 0.0, segments: int = 32) -> Mesh:
    """Return a solid cylinder on z = 0 with both rims bevelled (metres)."""
    b = min(bevel, radius / 2, height / 2)
    corners = [(0.0, 0.0), (radius - b, 0.0), (radius, b), (radius, height - b)]
    corners += [(radius - b, height), (0.0, height)]
    return lathe(_without_repeats(corners), segments)


def hoop(radius: float, height: float, thickness: float, *, segments: int = 56) -> Mesh:
    """Return a thin-walled ring about z, centred on z = 0, `radius` to its middle (metres)."""
    inner, outer, half = radius - thickness / 2, radius + thickness / 2, height / 2
    lip = thickness * 0.35
    corners = [(inner, -half + lip), (inner + lip, -half), (outer - lip, -half)]
    corners += [(outer, -half + lip), (outer, half - lip), (outer - lip, half)]
    corners += [(inner + lip, half), (inner, half - lip), (inner, -half + lip)]
    return lathe(corners, segments)


def torus(radius: float, thickness: float, *, segments: int = 56) -> Mesh:
    """Return a round wire of the given thickness bent to a circle about z (metres)."""
    angle = np.linspace(0.0, 2.0 * math.pi, 10, endpoint=False)
    curve = [(radius + thickness / 2 * math.cos(a), thickness / 2 * math.sin(a)) for a in angle]
    return lathe(curve, segments, smooth=True)


def ring(inner: float, outer: float, *, segments: int = 72) -> Mesh:
    """Return a flat ring on z = 0 that faces up (metres)."""
    return lathe([(outer, 0.0), (inner, 0.0)], segments)


def sector(inner: float, outer: float, start: float, stop: float, *, steps: int = 32) -> Mesh:
    """Return a part of a flat ring on z = 0 that faces up (metres, radians from +x)."""
    angle = np.linspace(start, stop, steps + 1)
    direction = np.column_stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)])
    vertices = np.concatenate([inner * direction, outer * direction])
    a = np.arange(steps)
    b = a + steps + 1
    faces = np.stack([a, b, b + 1, a, b + 1, a + 1], axis=-1).reshape(-1, 3)
    return Mesh(vertices, np.tile([0.0, 0.0, 1.0], (len(vertices), 1)), faces)


def triangle(tip: float, foot: float, width: float) -> Mesh:
    """Return a flat arrow head on z = 0 that faces up and points along +x (metres)."""
    corners = [[tip, 0.0, 0.0], [foot, width / 2, 0.0], [foot, -width / 2, 0.0]]
    return _cap(np.array(corners), 1.0)


def rounded(length: float, width: float, radius: float, *, steps: int = 5) -> Points:
    """Return the outline (N, 2) of a rectangle with round corners, counter-clockwise (metres)."""
    r = min(radius, length / 2, width / 2)
    angle = np.linspace(0.0, math.pi / 2, steps + 1)
    centres = ((1, 1), (-1, 1), (-1, -1), (1, -1))
    corners = [
        np.stack(
            [
                sx * (length / 2 - r) + r * np.cos(angle + k * math.pi / 2),
                sy * (width / 2 - r) + r * np.sin(angle + k * math.pi / 2),
            ],
            axis=-1,
        )
        for k, (sx, sy) in enumerate(centres)
    ]
    return np.concatenate(corners)


def extruded(outline: Points, height: float, *, bevel: float = 0.0) -> Mesh:
    """Raise a convex counter-clockwise outline (N, 2) from z = 0, its rims bevelled (metres)."""
    centre = outline.mean(axis=0)
    shrink = 1.0 - bevel / np.linalg.norm(outline - centre, axis=1).max()
    inset = centre + (outline - centre) * shrink
    levels = [(inset, 0.0), (outline, bevel), (outline, height - bevel), (inset, height)]
    if bevel == 0.0:
        levels = [(outline, 0.0), (outline, height)]
    solid = [np.column_stack([points, np.full(len(points), z)]) for points, z in levels]
    bands = [_band(low, high) for low, high in pairwise(solid)]
    return merged([*bands, _cap(solid[-1], 1.0), _cap(solid[0], -1.0)])


def box(length: float, width: float, height: float, *, bevel: float = 0.0008) -> Mesh:
    """Return a box centred on the origin with slightly broken edges (metres)."""
    outline = rounded(length, width, 2.0 * bevel, steps=2)
    return extruded(outline, height, bevel=bevel).moved(z=-height / 2)


def rod(start: Sequence[float], end: Sequence[float], radius: float, *, segments: int = 10) -> Mesh:
    """Return a round bar between two points (metres)."""
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    along = (b - a) / np.linalg.norm(b - a)
    helper = np.array([1.0, 0.0, 0.0]) if abs(along[0]) < 0.9 else np.array([0.0, 1.0, 0.0])
    side = np.cross(along, helper)
    side /= np.linalg.norm(side)
    frame = np.column_stack([side, np.cross(along, side), along])
    straight = cylinder(radius, float(np.linalg.norm(b - a)), segments=segments)
    return Mesh(straight.vertices @ frame.T + a, straight.normals @ frame.T, straight.faces)


def blade(root: float, tip: float, chord: float, twist: float) -> Mesh:
    """Return one propeller blade along +x that thrusts along +z when it turns about +z (metres).

    `twist` is the angle of attack in radians at the root; it falls towards the tip as a real
    blade's does, and the plan form narrows to a rounded end.
    """
    stations = np.linspace(0.0, 1.0, 9)
    width = chord * np.array([0.55, 0.8, 0.97, 1.0, 0.98, 0.92, 0.82, 0.64, 0.22])
    around = np.linspace(0.0, 2.0 * math.pi, 12, endpoint=False)
    rows = []
    for t, w in zip(stations, width, strict=True):
        y, z = w / 2 * np.cos(around), w * 0.075 * np.sin(around)
        attack = twist * (1.0 - 0.62 * t)
        c, s = math.cos(attack), math.sin(attack)
        x = np.full_like(y, root + (tip - root) * t)
        rows.append(np.column_stack([x, c * y - s * z, s * y + c * z]))
    grid = np.stack(rows)
    n, m = grid.shape[:2]
    index = np.arange(n * m).reshape(n, m)
    a, b = index[:-1], index[1:]
    c2, d = np.roll(b, -1, axis=1), np.roll(a, -1, axis=1)
    faces = np.stack([a, d, c2, a, c2, b], axis=-1).reshape(-1, 3)
    end = np.array([[index[-1, 0], index[-1, k], index[-1, k + 1]] for k in range(1, m - 1)])
    return _smoothed(grid.reshape(-1, 3), np.concatenate([faces, end]))


def stroke(points: Sequence[tuple[float, float]], width: float) -> Mesh:
    """Return a flat line through 2D points on z = 0, facing up, with square ends (metres)."""
    pieces = []
    for start, end in pairwise(points):
        a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
        along = (b - a) / np.linalg.norm(b - a) * width / 2
        side = np.array([-along[1], along[0]])
        corner = np.array([a - along - side, b + along - side, b + along + side, a - along + side])
        pieces.append(_cap(np.column_stack([corner, np.zeros(4)]), 1.0))
    return merged(pieces)


def _without_repeats(points: Sequence[tuple[float, float]]) -> list[tuple[float, float]]:
    return [p for k, p in enumerate(points) if k == 0 or p != points[k - 1]]


def _band(low: Points, high: Points) -> Mesh:
    """Join two outlines of equal count by flat quadrilaterals."""
    low_next, high_next = np.roll(low, -1, axis=0), np.roll(high, -1, axis=0)
    corners = np.stack([low, low_next, high_next, high], axis=1)
    normal = np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    first = 4 * np.arange(len(low))[:, None]
    faces = (first + np.array([[0, 1, 2, 0, 2, 3]])).reshape(-1, 3)
    return Mesh(corners.reshape(-1, 3), np.repeat(normal, 4, axis=0), faces)


def _cap(outline: Points, facing: float) -> Mesh:
    """Fill a convex outline; `facing` is the sign of its normal along z."""
    count = len(outline)
    fan = np.array([[0, k, k + 1] for k in range(1, count - 1)])
    normal = np.tile([0.0, 0.0, facing], (count, 1))
    return Mesh(outline, normal, fan if facing > 0 else fan[:, ::-1])


def _smoothed(vertices: Points, faces: Faces) -> Mesh:
    """Give each vertex the area-weighted normal of the triangles around it."""
    a, b, c = (vertices[faces[:, k]] for k in range(3))
    face_normal = np.cross(b - a, c - a)
    normal = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normal, faces[:, k], face_normal)
    length = np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    return Mesh(vertices, normal / length, faces)
