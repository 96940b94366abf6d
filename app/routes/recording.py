"""POST recording: a design and an experiment in, the rig's motion as a file out."""

from __future__ import annotations

import asyncio
from typing import Annotated, Any

from fastapi import APIRouter, HTTPException, Query, Response

from heli2dof_core import Spec, close_loop, place, preset, simulate
from heli2dof_core.geometry import RigName
from heli2dof_core.scenario import Model

from ..contract.models import described
from ..contract.requests import StepRequest
from ..scene.poses import Motion
from ..scene.recording import Format, record
from ..work.compute import Compute

Kind = Annotated[Format, Query(alias="format")]
MOST_WAITING = 8
"""Recordings asked for at one time; one is made after the other."""
_TYPES: dict[Format, str] = {"html": "text/html; charset=utf-8", "viser": "application/octet-stream"}
_NAMES: dict[Format, str] = {"html": "heli2dof-motion.html", "viser": "heli2dof-motion.viser"}


def build_router(compute: Compute) -> APIRouter:
    """The route recording under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["scene"])
    free = asyncio.Lock()
    waiting = 0

    @router.post("/recording", **_described())
    async def recording(request: StepRequest, kind: Kind = "html") -> Response:
        nonlocal waiting
        if waiting >= MOST_WAITING:
            busy = "Too many recordings are being made at this moment; try again in a few seconds."
            raise HTTPException(503, busy, {"Retry-After": "5"})
        rig, title = _of_rig(request)
        spec = request.to_spec()
        waiting += 1
        try:
            motion = await compute.run_slow(_motion, spec, request.scenario.model)
            async with free:  # one at a time leaves a processor to the designs
                content = await asyncio.to_thread(record, rig, motion, kind, _title(title, spec))
        finally:
            waiting -= 1
        name = {"Content-Disposition": f'attachment; filename="{_NAMES[kind]}"'}
        return Response(content, media_type=_TYPES[kind], headers=name)

    return router


def _of_rig(request: StepRequest) -> tuple[RigName, str]:
    chosen = preset(request.preset)
    return "aero" if chosen.rig == "aero" else "helicopter", chosen.title


def _motion(spec: Spec, model: Model) -> Motion:
    response = simulate(close_loop(place(spec), spec.outer), spec, model).response
    theta, psi = response.angles
    V_p, V_y = response.voltages
    limits = (spec.limits.V_p, spec.limits.V_y, spec.limits.theta)
    return Motion(response.t, theta, psi, V_p, V_y, response.reference, limits)


def _title(rig: str, spec: Spec) -> str:
    poles = ", ".join(_pole(p) for p in spec.poles.values)
    return f"{rig}: poles {poles} rad/s"


def _pole(p: complex) -> str:
    imaginary = f"{p.imag:+.4g}j" if p.imag else ""
    return f"{p.real:.4g}{imaginary}".replace("-", "−")


def _described() -> dict[str, Any]:
    """Route options for the schema: a file instead of JSON."""
    options = described(None, "The motion as a file: an HTML page that plays offline, or a .viser recording")
    content = {kind.partition(";")[0]: {"schema": {"type": "string"}} for kind in _TYPES.values()}
    del options["responses"][200]["model"]
    options["responses"][200]["content"] = content
    return {**options, "response_class": Response}
