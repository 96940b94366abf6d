"""A map as numbers: comma-separated values, a row per place, and the request that makes it again."""

from __future__ import annotations

import json
from typing import Any

import numpy as np

from ..body import body_of
from ..requirements import told_measure
from ..version import package_version
from .mapped import Mapped

STATES = ("ok", "none", "unlimited", "unstable", "no design")
"""Of a place: it has a value; a stable loop without such a figure; no limit; an unstable loop; nothing at all."""


def request_of(found: Mapped) -> dict[str, Any]:
    """The body of ``POST /api/v1/map`` that makes a map again."""
    plane, rigs = found.plane, found.uncertainty
    asked: dict[str, Any] = {
        "move": plane.move,
        "over": [[float(side[0]), float(side[-1])] for side in (plane.x, plane.y)],
        "size": [len(plane.x), len(plane.y)],
        **({"real": True} if plane.real else {}),
        **({} if plane.of_pair else {"scale": plane.scale}),
        **told_measure(found.measure),
    }
    if rigs is not None:
        asked["uncertainty"] = {**vars(rigs), "spread": dict(rigs.spread)}
    return {**body_of(found.spec), "map": asked}


def made_again(found: Mapped, kind: str) -> tuple[str, ...]:
    """Where a file comes from: lines in ASCII."""
    return (
        f"heli2dof {package_version()}",
        f"Made again by POST /api/v1/map/{kind} with the body",
        json.dumps(request_of(found)),
    )


def listed(found: Mapped) -> str:
    """Comma-separated values behind lines that begin with #; units in the header, x changing fastest."""
    plane, unit = found.plane, found.unit
    units = ("rad/s", "rad/s") if plane.of_pair else ("V/rad", "s")
    heads = [f"{name} [{of}]" for name, of in zip(plane.names, units, strict=True)]
    state = np.select(
        [found.valid, found.unlimited, found.stable, np.isfinite(found.abscissa)], [0, 2, 1, 3], default=4
    )
    heads.append(f"{found.measure.name} [{_ascii(unit)}]" if unit else found.measure.name)
    lines = [
        *(f"# {line}" for line in made_again(found, "csv")),
        f"# state: {', '.join(STATES)}",
        ",".join([*heads, "state"]),
    ]
    for y, values, states in zip(plane.y.tolist(), found.values.tolist(), state.tolist(), strict=True):
        for x, value, own in zip(plane.x.tolist(), values, states, strict=True):
            lines.append(f"{x!r},{y!r},{repr(value) if own == 0 else ''},{STATES[own]}")
    return "\n".join(lines) + "\n"


def _ascii(unit: str) -> str:
    return unit.replace("·", "*").replace("²", "^2")
