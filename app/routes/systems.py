"""Any system that is pasted: examples, reading, design, formulas, files."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Path, Response

from heli2dof_core.checks import require_known
from heli2dof_core.export.any_system import STEM
from heli2dof_core.systems.textbook import EXAMPLES

from ..contract.encoding import described_files, json_bytes, json_content, json_response
from ..contract.model import described
from ..contract.system_replies import FILES, design_reply, example_reply, formulas_reply, read_reply
from ..contract.systems import (
    SystemDesign,
    SystemDesignRequest,
    SystemExample,
    SystemFormulas,
    SystemFormulasRequest,
    SystemRead,
    SystemText,
)
from ..jobs.compute import Compute, check_cancelled
from .exports import Link

FormatName = Annotated[str, Path(alias="format", json_schema_extra={"enum": [*FILES]})]


def build_router(compute: Compute) -> APIRouter:
    """The routes under /api/v1/system."""
    router = APIRouter(prefix="/api/v1/system", tags=["any system"])

    @router.get("/examples", **described(list[SystemExample], "Systems of textbooks, to be pasted"))
    async def examples() -> Response:
        return json_response([example_reply(example) for example in EXAMPLES.values()])

    @router.post(
        "/read", **described(SystemRead, "A pasted system: matrices, letters, modes, zeros, indices")
    )
    async def read(request: SystemText) -> Response:
        return json_content(await compute.run_slow(_read, request.text))

    @router.post(
        "/design",
        **described(SystemDesign, "State feedback and observer of any system, with their responses"),
    )
    async def design(request: SystemDesignRequest) -> Response:
        return json_content(await compute.run_slow(_design, request))

    @router.post(
        "/formulas", **described(SystemFormulas, "K and L of any system of few states, in closed form")
    )
    async def formulas(request: SystemFormulasRequest) -> Response:
        return json_content(await compute.run_slow(_formulas, request))

    @router.post("/export/{format}", **_described())
    async def export(request: SystemDesignRequest, name: FormatName, link: Link = None) -> Response:
        require_known(name, FILES, "format")
        suffix, media_type, _ = FILES[name]
        content = await compute.run_slow(_file, name, request, link or "")
        headers = {"Content-Disposition": f'attachment; filename="{STEM}{suffix}"'}
        return Response(content, media_type=media_type, headers=headers)

    return router


def _read(text: str) -> bytes:
    return json_bytes(read_reply(text, check_cancelled))


def _design(request: SystemDesignRequest) -> bytes:
    return json_bytes(design_reply(request))


def _formulas(request: SystemFormulasRequest) -> bytes:
    return json_bytes(formulas_reply(request, check_cancelled))


def _file(name: str, request: SystemDesignRequest, link: str) -> bytes:
    make = FILES[name][2]
    return make(request, link)


def _described() -> dict[str, Any]:
    kinds = sorted({media_type.partition(";")[0] for _, media_type, _ in FILES.values()})
    binary = {"schema": {"type": "string", "format": "binary"}}
    content = {kind: {} if kind.endswith("json") else binary for kind in kinds}
    return described_files("The design of any system as a file for another program", content)
