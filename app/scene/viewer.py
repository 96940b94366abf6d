"""The scene's routes: viser's page, its socket, the windows' socket and the choice of the rig."""

from __future__ import annotations

import re
from collections.abc import Iterable

from fastapi import APIRouter, HTTPException, Request, Response, WebSocket
from fastapi.responses import RedirectResponse
from pydantic import BaseModel, ConfigDict

from heli2dof_core.geometry import RigName

from ..ops.metrics import Metrics
from .hub import MOST_WINDOWS, Window, serve_window
from .page import ViewerPage
from .relay import relay, viser_subprotocol
from .sessions import SceneSessions, SessionsFullError

_SESSION_ID = re.compile(r"[A-Za-z0-9_-]{22,64}")
_TRY_LATER = 1013


class RigChoice(BaseModel):
    """The body of PUT /scene/{session}/rig."""

    model_config = ConfigDict(extra="forbid")

    rig: RigName


def build_router(
    sessions: SceneSessions, metrics: Metrics | None = None, ancestors: Iterable[str] = ("'self'",)
) -> APIRouter:
    """Return the scene's routes: the page, its socket and the choice of the rig.

    Args:
        sessions: the running scenes.
        metrics: counts the relay's messages.
        ancestors: who may show the scene's page in a frame.

    Raises:
        RuntimeError: if viser's page is not the one that the shim was written for.
    """
    page = ViewerPage.load(ancestors)
    router = APIRouter(prefix="/scene", include_in_schema=False)

    @router.get("/{session}")
    async def without_slash(session: str) -> Response:
        _require_session_id(session)
        return RedirectResponse(f"{session}/", status_code=308)

    @router.get("/{session}/")
    async def viewer(session: str, request: Request) -> Response:
        _require_session_id(session)
        return page.response(request)

    @router.put("/{session}/rig", status_code=204)
    async def choose_rig(session: str, choice: RigChoice) -> Response:
        _require_session_id(session)
        try:
            await sessions.set_rig(session, choice.rig)
        except SessionsFullError as full:
            raise HTTPException(503, str(full), {"Retry-After": "30"}) from full
        return Response(status_code=204)

    _add_sockets(router, sessions, metrics or Metrics())
    return router


def _add_sockets(router: APIRouter, sessions: SceneSessions, metrics: Metrics) -> None:
    """Add viser's socket, relayed, and the one on which a session's windows talk."""

    @router.websocket("/{session}")
    async def socket(client: WebSocket, session: str) -> None:
        if not _SESSION_ID.fullmatch(session):
            # Closed before it is accepted: the handshake is answered with 403.
            await client.close()
            return
        await client.accept(subprotocol=viser_subprotocol(client.scope["subprotocols"]))
        try:
            async with sessions.viewing(session) as scene:
                await relay(client, scene.port, scene.filter_update, metrics)
        except SessionsFullError as full:
            await client.close(_TRY_LATER, str(full)[:120])

    @router.websocket("/{session}/hub")
    async def hub(socket: WebSocket, session: str, page: bool = False) -> None:
        if not _SESSION_ID.fullmatch(session):
            await socket.close()
            return
        await socket.accept()
        window = Window(page=page)
        try:
            async with sessions.joining(session, window) as room:
                if room.full:
                    await socket.close(_TRY_LATER, f"{MOST_WINDOWS} windows of this scene are open already")
                else:
                    await serve_window(socket, room, window)
        except SessionsFullError as full:
            await socket.close(_TRY_LATER, str(full)[:120])


def _require_session_id(session: str) -> None:
    """Answer 404 to whatever cannot be a session's id."""
    if not _SESSION_ID.fullmatch(session):
        raise HTTPException(404, "no such scene")
