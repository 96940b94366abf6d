"""Recordings of a rig: sent, laid over the simulation, and identified with progress and cancel over a WebSocket."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any

from fastapi import APIRouter, Query, Request, Response, WebSocket

from heli2dof_core import loop_of, preset
from heli2dof_core.export.machine import machine_lines
from heli2dof_core.recordings.files import Dialect, joined_tables, read_table, write_csv
from heli2dof_core.recordings.files.text import SYNTHETIC, Decimal, Separator
from heli2dof_core.recordings.identification import Progress
from heli2dof_core.recordings.recording import Table, recording_of
from heli2dof_core.recordings.samples import deviating_rig, named_columns, sample_recording
from heli2dof_core.scenario import Digital

from ..contract.encoding import described_files, json_bytes, json_content, json_response, json_text
from ..contract.identification import IdentifyRequest, identification_reply, identified, progress_reply
from ..contract.model import described
from ..contract.recordings import (
    JoinRequest,
    OverlayReply,
    OverlayRequest,
    Preview,
    SampleRequest,
    overlaid,
    overlay_reply,
    preview_reply,
)
from ..jobs.compute import Compute, check_cancelled, current_caller, report
from ..jobs.recording_store import RecordingStore
from ..ops.settings import Settings
from .kernels import wait_for_kernels
from .progress_socket import Send, serve_with_progress

_DEFAULT_STEPS = (0.2, 0.4)
"""Reference steps of a sample where the preset's scenario names none, rad."""


def build_router(compute: Compute, settings: Settings) -> APIRouter:
    """The routes recordings under /api/v1."""
    router = APIRouter(prefix="/api/v1/recordings", tags=["recordings"])
    store = RecordingStore(settings.recordings, settings.recordings_bytes)

    @router.post("", **_upload_options())
    async def send(
        request: Request,
        name: str = "",
        separator: Annotated[Separator | None, Query(description="of text; judged by default")] = None,
        decimal: Annotated[Decimal | None, Query(description="of text; judged by default")] = None,
    ) -> Response:
        data, own = await request.body(), name[:200]
        table = await compute.run_slow(read_table, data, own, Dialect(separator, decimal), check_cancelled)
        return json_response(preview_reply(store.put(table, current_caller.get().client[0], own), own, table))

    @router.post("/join", **described(Preview, "Files of one run, one signal each, as one recording"))
    async def join(request: JoinRequest) -> Response:
        tables = [store.named(key) for key in request.recordings]
        table = await compute.run_slow(joined_tables, tables)
        name = ", ".join(own for own, _ in tables)[:200]
        return json_response(
            preview_reply(store.put(table, current_caller.get().client[0], name), name, table)
        )

    @router.post(
        "/sample",
        **described_files(
            "A recording of the design's digital rig, CSV", {"text/csv": {"schema": {"type": "string"}}}
        ),
    )
    async def sample(request: SampleRequest) -> Response:
        await wait_for_kernels()
        content = await compute.run_slow(_sample, request)
        name = {"Content-Disposition": 'attachment; filename="heli2dof-recording.csv"'}
        return Response(content, media_type="text/csv; charset=utf-8", headers=name)

    @router.post(
        "/{key}/overlay", **described(OverlayReply, "The recording over the simulation, with its fit")
    )
    async def overlay(key: str, request: OverlayRequest) -> Response:
        await wait_for_kernels()
        table = store.get(key)
        return json_content(await compute.run_slow(_overlay, request, table))

    @router.websocket("/identify")
    async def identifying(socket: WebSocket) -> None:
        """One request in; progress out, then the result. Whatever comes next cancels it."""

        async def answer(data: Any, send: Send) -> None:
            request = IdentifyRequest.model_validate(data)
            request.to_spec()  # what is refused is refused at once
            await wait_for_kernels()
            async for part in compute.stream(_identify, request, store.get(request.recording)):
                await send(part)

        await serve_with_progress(socket, answer)

    return router


def _sample(request: SampleRequest) -> bytes:
    spec, base = request.to_spec(), preset(request.preset)
    given = spec.scenario.digital or Digital(encoders=base.encoders)
    digital = replace(given, noise=request.noise, seed=request.seed)
    rig = deviating_rig(spec.parameters, request.deviation, request.seed)
    wanted = (base.scenario.theta or _DEFAULT_STEPS[0], base.scenario.psi or _DEFAULT_STEPS[1])
    size = (abs(wanted[0] - spec.theta_0) if base.scenario.theta is None else abs(wanted[0]), abs(wanted[1]))
    loop = loop_of(spec)
    about = {"rig": rig, "duration": request.length, "size": size, "wanted": check_cancelled}
    run = sample_recording(loop, spec.limits, digital, **about)
    changed = {name: v for name, v in rig.as_dict().items() if v != getattr(spec.parameters, name)}
    truth = ", ".join(f"{name} = {value:.6g}" for name, value in changed.items())
    comments = (
        f"{SYNTHETIC}: angles in rad, voltages in V",
        f"Its true parameters, SI: {truth}" if truth else "Its parameters are the design's",
        *machine_lines(spec),
    )
    return write_csv(named_columns(run), comments)


def _overlay(request: OverlayRequest, table: Table) -> bytes:
    recording = recording_of(table, request.columns.to_columns())
    return json_bytes(overlay_reply(request.driver, recording, overlaid(request, recording, check_cancelled)))


def _identify(request: IdentifyRequest, table: Table) -> str:
    """The result as text; how far the search is meanwhile."""

    def tell(progress: Progress) -> None:
        report(json_text(progress_reply(progress)))

    recording = recording_of(table, request.columns.to_columns())
    found = identified(request, request.to_spec(), recording, tell, check_cancelled)
    return json_text(identification_reply(found, recording))


def _upload_options() -> dict[str, Any]:
    options = described(Preview, "The file as it was read: columns, first rows, what they probably are")
    content = {"application/octet-stream": {"schema": {"type": "string", "format": "binary"}}}
    extra = {
        "requestBody": {"required": True, "description": "CSV, .xlsx, .mat, HDF5, JSON", "content": content}
    }
    return {**options, "openapi_extra": extra}
