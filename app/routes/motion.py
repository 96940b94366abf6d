"""POST motion: a design and an experiment in, the rig's motion as a file out."""

from __future__ import annotations

from typing import Annotated
from urllib.parse import quote

import numpy as np
from fastapi import APIRouter, Query, Request, Response
from fastapi.responses import RedirectResponse

from heli2dof_core import Spec, loop_of, preset, simulate
from heli2dof_core.geometry import RigName
from heli2dof_core.scenario import Model
from heli2dof_core.tables import poles

from ..contract.encoding import described_files
from ..contract.experiment import StepRequest
from ..jobs.compute import Compute
from ..scene.motion import MotionFormat, motion_file
from ..scene.poses import Motion

Kind = Annotated[MotionFormat, Query(alias="format")]
_QUERY_CHARACTERS = ":/%#?=@[]!$&'()*+,;"
"""Left as they are in an address; what else a client may have sent there is percent-encoded."""
_TYPES: dict[MotionFormat, str] = {"html": "text/html; charset=utf-8", "viser": "application/octet-stream"}
_NAMES: dict[MotionFormat, str] = {"html": "heli2dof-motion.html", "viser": "heli2dof-motion.viser"}


def build_router(compute: Compute) -> APIRouter:
    """The route motion under /api/v1, and the address that it had before."""
    router = APIRouter(prefix="/api/v1", tags=["scene"])
    content = {kind.partition(";")[0]: {"schema": {"type": "string"}} for kind in _TYPES.values()}

    @router.post(
        "/motion",
        **described_files("The motion as a file: an HTML page that plays offline, or a .viser file", content),
    )
    async def motion(request: StepRequest, kind: Kind = "html") -> Response:
        content = await compute.run_slow(_file, request, kind)
        name = {"Content-Disposition": f'attachment; filename="{_NAMES[kind]}"'}
        return Response(content, media_type=_TYPES[kind], headers=name)

    # The former address, for this version still; left out of the schema, so that no new client is made for it.
    @router.post("/recording", include_in_schema=False)
    async def moved(request: Request) -> Response:
        query = quote(request.scope["query_string"], safe=_QUERY_CHARACTERS)
        # Relative: a proxy may have cut a prefix off that the client's address has.
        return RedirectResponse(f"motion?{query}" if query else "motion", 308)

    return router


def of_rig(name: str) -> tuple[RigName, str]:
    """Which rig a preset's scene shows, and the preset's title."""
    chosen = preset(name)
    return "aero" if chosen.rig == "aero" else "helicopter", chosen.title


def _file(request: StepRequest, kind: MotionFormat) -> bytes:
    rig, title = of_rig(request.preset)
    spec = request.to_spec()
    return motion_file(rig, _motion(spec, request.scenario.model), kind, _title(title, spec))


def _motion(spec: Spec, model: Model) -> Motion:
    response = simulate(loop_of(spec), spec, model).response
    theta, psi = response.angles
    V_p, V_y = response.voltages
    limits = (spec.limits.V_p, spec.limits.V_y, spec.limits.theta)
    wanted = [np.full(len(response.t), angle) for angle in response.reference]
    return Motion(response.t, theta, psi, V_p, V_y, (wanted[0], wanted[1]), limits)


def _title(rig: str, spec: Spec) -> str:
    return f"{rig}: poles {poles(spec.poles.values)} rad/s"
