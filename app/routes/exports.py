"""POST export: a design and an experiment in, a file to take away out."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Path, Query, Response

from heli2dof_core.checks import require_known

from ..contract.encoding import described_files
from ..contract.experiment import ExportRequest
from ..contract.exports import FORMATS
from ..jobs.compute import Compute

# The characters of RFC 3986 alone: none of them ends a line, a comment or an attribute of the files.
_LINK = r"^https?://[A-Za-z0-9\-._~:/?#\[\]@!$&'()*+,;=%]+$"
MOST_LINK = 4000
"""Longest link, characters."""

FormatName = Annotated[str, Path(alias="format", json_schema_extra={"enum": [*FORMATS]})]
Link = Annotated[
    str | None,
    Query(max_length=MOST_LINK, pattern=_LINK, description="address of the design, to be named in the file"),
]


def build_router(compute: Compute) -> APIRouter:
    """The route export under /api/v1."""
    router = APIRouter(prefix="/api/v1", tags=["export"])

    @router.post("/export/{format}", **_described())
    async def export(request: ExportRequest, name: FormatName, link: Link = None) -> Response:
        chosen = require_known(name, FORMATS, "format")
        content = await compute.run_slow(_content, chosen.name, request, link or "")
        headers = {"Content-Disposition": f'attachment; filename="{chosen.filename}"'}
        return Response(content, media_type=chosen.media_type, headers=headers)

    return router


def _content(name: str, request: ExportRequest, link: str) -> bytes:
    return FORMATS[name].content(request.to_spec(), link, request.beside())


def _described() -> dict[str, Any]:
    """Route options for the schema: a file instead of JSON."""
    kinds = sorted({each.media_type.partition(";")[0] for each in FORMATS.values()})
    binary = {"schema": {"type": "string", "format": "binary"}}
    # What is JSON may be anything but text in the schema's sense.
    options = described_files(
        "The design as a file for another program, or for print",
        {kind: {} if kind.endswith("json") else binary for kind in kinds},
    )
    names = ", ".join(f"`{each.name}` ({each.title})" for each in FORMATS.values())
    return {**options, "description": f"Formats: {names}."}
