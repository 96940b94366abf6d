"""Binary glTF 2.0 from meshes and materials: one file per moving part, a primitive per material.

Not trimesh, which comes with viser: it rounds colours to 8 bits of linear light, where dark ones are off by a tenth,
and importing it takes half a second and 50 MB. The format:
https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html (§4.4 GLB, §3.9 materials).
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import msgspec
import numpy as np

from .shapes import Mesh, merged

_FLOAT, _UINT16, _UINT32 = 5126, 5123, 5125
_VERTICES, _INDICES = 34962, 34963


@dataclass(frozen=True, slots=True)
class Material:
    """A surface: sRGB colour as "#rrggbb", and metallicity, roughness and opacity in 0…1."""

    color: str
    metallic: float = 0.0
    roughness: float = 0.7
    opacity: float = 1.0
    double_sided: bool = False

    def gltf(self) -> dict[str, Any]:
        """Return the material as glTF wants it, with a linear colour."""
        surface: dict[str, Any] = {
            "pbrMetallicRoughness": {
                "baseColorFactor": [*_linear(self.color), self.opacity],
                "metallicFactor": self.metallic,
                "roughnessFactor": self.roughness,
            },
            "doubleSided": self.double_sided,
        }
        if self.opacity < 1.0:
            surface["alphaMode"] = "BLEND"
        return surface


Part = tuple[Material, Mesh]
"""A mesh and what it is made of."""


def glb(parts: Sequence[Part]) -> bytes:
    """Return the parts as one binary glTF; z stays up, as viser expects of its own scenes."""
    by_material: dict[Material, list[Mesh]] = {}
    for material, mesh in parts:
        by_material.setdefault(material, []).append(mesh)
    body = bytearray()
    views: list[dict[str, Any]] = []
    accessors: list[dict[str, Any]] = []
    primitives: list[dict[str, Any]] = []

    def store(data: bytes, target: int, accessor: dict[str, Any]) -> int:
        body.extend(bytes(-len(body) % 4))
        views.append({"buffer": 0, "byteOffset": len(body), "byteLength": len(data), "target": target})
        accessors.append({"bufferView": len(views) - 1, **accessor})
        body.extend(data)
        return len(accessors) - 1

    for number, meshes in enumerate(by_material.values()):
        mesh = merged(meshes)
        vertices = mesh.vertices.astype("<f4")
        kind, dtype = (_UINT16, "<u2") if len(vertices) < 65535 else (_UINT32, "<u4")
        shape = {"componentType": _FLOAT, "count": len(vertices), "type": "VEC3"}
        bounds = {"min": vertices.min(axis=0).tolist(), "max": vertices.max(axis=0).tolist()}
        faces = mesh.faces.astype(dtype)
        scalar = {"componentType": kind, "count": faces.size, "type": "SCALAR"}
        primitives.append(
            {
                "attributes": {
                    "POSITION": store(vertices.tobytes(), _VERTICES, shape | bounds),
                    "NORMAL": store(mesh.normals.astype("<f4").tobytes(), _VERTICES, shape),
                },
                "indices": store(faces.tobytes(), _INDICES, scalar),
                "material": number,
            }
        )
    body.extend(bytes(-len(body) % 4))
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": primitives}],
        "materials": [material.gltf() for material in by_material],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(body)}],
    }
    header = msgspec.json.encode(document)
    header += b" " * (-len(header) % 4)
    total = 12 + 8 + len(header) + 8 + len(body)
    return b"".join(
        (
            struct.pack("<4sII", b"glTF", 2, total),
            struct.pack("<I4s", len(header), b"JSON"),
            header,
            struct.pack("<I4s", len(body), b"BIN\0"),
            bytes(body),
        )
    )


def _linear(color: str) -> list[float]:
    """Return "#rrggbb" as linear red, green and blue in 0…1."""
    srgb = np.array([int(color[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0
    low, high = srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4
    return [float(c) for c in np.where(srgb <= 0.04045, low, high)]
