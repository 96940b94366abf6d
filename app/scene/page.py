"""Viser's page with our shim in it.

The page derives its socket from its own address: /scene/{session}/ opens ws:/scene/{session}. All
addresses in the page are relative, so the app may be mounted under any prefix.
"""

from __future__ import annotations

import html
from collections.abc import Iterable
from dataclasses import dataclass
from importlib.util import find_spec
from pathlib import Path

from fastapi import Request, Response

from ..edge import policies
from ..ops.cached_files import Content
from .viser_scripts import inline_scripts

_MARKER = "<title>Viser</title>"

# The canvas stands on the page's own ground instead of on white.
_GROUND = """
html, body { background: #eef0f2 radial-gradient(circle at 50% 38%, #fbfcfc, #e4e7ea) fixed; }
html[data-theme=dark], html[data-theme=dark] body {
  background: #2a2f36 radial-gradient(circle at 50% 38%, #474e58, #24282e) fixed; }
#root :has(canvas) { background: transparent !important; }
"""
_NOTES = """
.window-notes { position: fixed; left: 12px; top: 10px; max-width: calc(100vw - 24px); pointer-events: none;
  font: 15px/1.4 system-ui, sans-serif; font-variant-numeric: tabular-nums; color: #2b3138; }
html[data-theme=dark] .window-notes { color: #e6e9ec; }
.window-notes p { margin: 0; }
.window-time { white-space: pre; }
.window-partner { position: fixed; z-index: 1000; left: 50%; bottom: 16px; display: grid; gap: 6px;
  justify-content: center;
  grid-template: ". up ." 52px "left down right" 52px "words words words" auto / 52px 52px 52px;
  translate: -50%; font: 15px/1.4 system-ui, sans-serif; color: #2b3138; user-select: none; touch-action: none; }
.window-partner[hidden] { display: none; }
.window-partner button { border: 1px solid #9aa3ad; border-radius: 10px; background: #fcfdfdd9; color: #2b3138;
  font-size: 22px; touch-action: none; }
.window-partner button:active { background: #24689b; color: #fff; }
.window-partner p { grid-area: words; width: 300px; margin: 0 -66px; text-align: center; }
.ArrowUp { grid-area: up; } .ArrowDown { grid-area: down; } .ArrowLeft { grid-area: left; }
.ArrowRight { grid-area: right; }
html[data-theme=dark] .window-partner { color: #e6e9ec; }
"""
# In the page's frame, viser's panel (a bottom sheet in narrow windows), its notices and its logo are hidden, and the
# rig has their room; a finger that goes up or down moves the page: sideways it turns the rig, two of them zoom. In a
# narrow window whoever flies along sees the rig and the arrows instead of the panel.
_BARE = """
html[data-place=frame] :is([data-floating-window], [data-dock-root] > :not(:has(canvas)), .mantine-Notifications-root,
  .mantine-ScrollAreaAutosize-root, .mantine-Paper-root) { display: none !important; }
html[data-place=frame] [data-dock-root] > :has(canvas) { inset: 0 !important; }
@media (max-width: 760px) {
  body:has(.window-partner:not([hidden])) :is([data-floating-window], [data-dock-root] > :not(:has(canvas)),
    .mantine-ScrollAreaAutosize-root, .mantine-Paper-root:not(.mantine-Notifications-root *)) {
      display: none !important; }
  body:has(.window-partner:not([hidden])) [data-dock-root] > :has(canvas) { inset: 0 !important; }
}
.mantine-Notifications-root { top: auto !important; bottom: 0; }
html[data-place=frame] * { touch-action: pan-y !important; }
"""
_INJECTED = (
    "<title>heli2dof: the rig</title>\n"
    f"<style>{_GROUND}{_NOTES}{_BARE}</style>\n"
    '<script src="../../static/scene/shim.js"></script>'
)


@dataclass(frozen=True, slots=True)
class ViewerPage:
    """Viser's page with our additions, and its policy."""

    content: Content
    policy: str

    @classmethod
    def load(cls, ancestors: Iterable[str] = ("'self'",)) -> ViewerPage:
        """Read the installed viser's page, without importing viser, and add to it.

        Args:
            ancestors: who may show it in a frame, besides the page.

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
        return cls(Content(body, "text/html"), policies.viewer(ancestors, inline_scripts(page)))

    def response(self, request: Request) -> Response:
        """Answer a request for the page, with 304 where the browser has it already."""
        headers = {"Cache-Control": "private, no-cache", "Content-Security-Policy": self.policy}
        return self.content.response(request.headers, headers)


def standalone_page(page: str, title: str) -> str:
    """Return viser's page with a motion in it, on our ground and under a title (plain text)."""
    words = html.escape(title)
    head = f"<title>{words}</title>\n<style>{_GROUND}{_NOTES}</style>"
    note = f'<div class="window-notes">{words}</div>'
    return page.replace(_MARKER, head, 1).replace("</body>", f"{note}</body>", 1)
