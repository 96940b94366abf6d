"""Serves viser's page with our shim in it, and the routes of the scene.

The page derives its socket from its own address: /scene/{session}/ opens ws:/scene/{session}. All
addresses in the page are relative, so the app may be mounted under any prefix.
"""

from __future__ import annotations

import gzip
import hashlib
import re
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from fastapi import APIRouter, HTTPException, Request, Response, WebSocket
from fastapi.responses import RedirectResponse
from pydantic import BaseModel, ConfigDict

from heli2dof_core.geometry import RigName

from .relay import relay, viser_subprotocol
from .sessions import SceneSessions, SessionsFullError

_SESSION_ID = re.compile(r"[A-Za-z0-9_-]{22,64}")
_TRY_LATER = 1013
_MARKER = "<title>Viser</title>"

# Hides viser's panel (a bottom sheet in narrow windows), its notices and its logo, and lets the
# canvas stand on the page's own ground instead of on white.
_STYLE = """
html, body { background: #eef0f2 radial-gradient(circle at 50% 38%, #fbfcfc, #e4e7ea) fixed; }
html[data-theme=dark], html[data-theme=dark] body {
  background: #2a2f36 radial-gradient(circle at 50% 38%, #474e58, #24282e) fixed; }
#root :has(canvas) { background: transparent !important; }
[data-floating-window], [data-dock-region], .mantine-Notifications-root,
.mantine-ScrollAreaAutosize-root, .mantine-Paper-root { display: none !important; }
"""
_INJECTED = (
    "<title>heli2dof scene</title>\n"
    f"<style>{_STYLE}</style>\n"
    '<script src="../../static/scene_shim.js"></script>'
)


class RigChoice(BaseModel):
    """The body of PUT /scene/{session}/rig."""

    model_config = ConfigDict(extra="forbid")

    rig: RigName


@dataclass(frozen=True, slots=True)
class ViewerPage:
    """Viser's page with our additions, plain and compressed, and its entity tag."""

    body: bytes
    compressed: bytes
    etag: str

    @classmethod
    def load(cls) -> ViewerPage:
        """Read the installed viser's page, without importing viser, and add to it.

        Raises:
            RuntimeError: if the page is missing or has changed so that the shim has no place.
        """
        spec = find_spec("viser")
        if spec is None or spec.origin is None:
            raise RuntimeError("viser is not installed")
        path = Path(spec.origin).parent / "client" / "build" / "index.html"
        page = path.read_text(encoding="utf-8")
        if page.count(_MARKER) != 1:
            raise RuntimeError(f"{path} does not hold {_MARKER} once: is this viser 1.1.1?")
        body = page.replace(_MARKER, _INJECTED).encode()
        etag = f'"{hashlib.sha256(body).hexdigest()[:32]}"'
        return cls(body, gzip.compress(body, compresslevel=6, mtime=0), etag)

    def response(self, request: Request) -> Response:
        """Answer a request for the page, with 304 where the browser has it already."""
        headers = {
            "Cache-Control": "private, no-cache",
            "Content-Security-Policy": "frame-ancestors 'self'",
            "ETag": self.etag,
            "Referrer-Policy": "no-referrer",
            "Vary": "Accept-Encoding",
            "X-Content-Type-Options": "nosniff",
        }
        if self.etag in request.headers.get("if-none-match", ""):
            return Response(status_code=304, headers=headers)
        if "gzip" in request.headers.get("accept-encoding", ""):
            headers["Content-Encoding"] = "gzip"
            return Response(self.compressed, media_type="text/html", headers=headers)
        return Response(self.body, media_type="text/html", headers=headers)


def build_router(sessions: SceneSessions) -> APIRouter:
    """Return the scene's routes: the page, its socket and the choice of the rig.

    Raises:
        RuntimeError: if viser's page is not the one that the shim was written for.
    """
    page = ViewerPage.load()
    router = APIRouter(prefix="/scene", include_in_schema=False)

    @router.get("/{session}")
    async def without_slash(session: str) -> Response:
        _check(session)
        return RedirectResponse(f"{session}/", status_code=308)

    @router.get("/{session}/")
    async def viewer(session: str, request: Request) -> Response:
        _check(session)
        return page.response(request)

    @router.put("/{session}/rig", status_code=204)
    async def choose_rig(session: str, choice: RigChoice) -> Response:
        _check(session)
        try:
            await sessions.set_rig(session, choice.rig)
        except SessionsFullError as full:
            raise HTTPException(503, str(full), {"Retry-After": "30"}) from full
        return Response(status_code=204)

    @router.websocket("/{session}")
    async def socket(visitor: WebSocket, session: str) -> None:
        if not _SESSION_ID.fullmatch(session):
            # Closed before it is accepted: the handshake is answered with 403.
            await visitor.close()
            return
        await visitor.accept(subprotocol=viser_subprotocol(visitor.scope["subprotocols"]))
        try:
            async with sessions.watched(session) as port:
                await relay(visitor, port)
        except SessionsFullError as full:
            await visitor.close(_TRY_LATER, str(full)[:120])

    return router


def _check(session: str) -> None:
    """Answer 404 to whatever cannot be a session's id."""
    if not _SESSION_ID.fullmatch(session):
        raise HTTPException(404, "no such scene")
