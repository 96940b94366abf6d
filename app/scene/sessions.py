"""One viser server per session, made when it is first wanted and stopped when nobody watches."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator, Callable
from dataclasses import dataclass, field
from time import monotonic
from typing import TYPE_CHECKING, Any

from heli2dof_core.geometry import RigName

from .hub import Room, Shown, Transport, Window
from .relay import UpdateFilter

if TYPE_CHECKING:
    from .panel import Panel
    from .rig import RigServer

_log = logging.getLogger(__name__)

DEFAULT_RIG: RigName = "helicopter"
_PANEL_INTERVAL = 0.15
"""Seconds between two changes of what the panel shows: each element costs the server 0.1 ms."""


class SessionsFullError(Exception):
    """Every place for a scene is taken and watched; the message says what to do."""

    def __init__(self, capacity: int) -> None:
        super().__init__(
            f"All {capacity} scenes of this server are in use. Close one that nobody watches, "
            "or try again in a minute; everything but the 3D view works meanwhile."
        )
        self.capacity = capacity


@dataclass(slots=True)
class _Session:
    """What is known of one session; `starting` yields its server once somebody has asked for it."""

    rig: RigName = DEFAULT_RIG
    starting: asyncio.Task[RigServer] | None = None
    room: Room = field(default_factory=Room)
    panel: Panel | None = None
    panel_timer: asyncio.TimerHandle | None = None
    clients: int = 0
    idle_since: float = field(default_factory=monotonic)
    lock: asyncio.Lock = field(default_factory=asyncio.Lock)

    def idle_for(self, seconds: float) -> bool:
        """Return whether nobody has watched this session for so many seconds."""
        idle = self.clients == 0 and not self.lock.locked()
        return idle and monotonic() - self.idle_since >= seconds

    def filter_update(self, element: str, updates: dict[str, Any]) -> dict[str, Any] | None:
        """Return what a client may set at the panel; nothing where there is none."""
        return self.panel.allowed_update(element, updates) if self.panel else None

    def schedule_panel_update(self, _news: Shown | Transport | None = None) -> None:
        """Bring the panel up to date, a little later, so that a drag changes it a few times a second."""
        if self.panel and self.panel_timer is None:
            self.panel_timer = asyncio.get_running_loop().call_later(_PANEL_INTERVAL, self._update_panel)

    def _update_panel(self) -> None:
        self.panel_timer = None
        shown, transport = self.room.shown, self.room.transport
        if self.panel and shown:
            self.panel.show(shown, edits_pending=shown.after < self.room.edits)
        if self.panel and transport:
            self.panel.set_transport(transport)


@dataclass(frozen=True, slots=True)
class ViserEndpoint:
    """A session's viser server on the loopback, and what its clients may set at its panel."""

    port: int
    filter_update: UpdateFilter


class SceneSessions:
    """The running scenes by session id; all methods belong to one event loop.

    Args:
        capacity: how many sessions may exist at once.
        idle_seconds: how long a session outlives its last client.
        evict_after_seconds: after how long without a client a session may make room for another.
    """

    def __init__(
        self, capacity: int = 100, idle_seconds: float = 45.0, evict_after_seconds: float = 5.0
    ) -> None:
        self.capacity = capacity
        self.idle_seconds = idle_seconds
        self.evict_after_seconds = evict_after_seconds
        self._sessions: dict[str, _Session] = {}

    def __len__(self) -> int:
        """Return the number of sessions that exist."""
        return len(self._sessions)

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[SceneSessions]:
        """Stop idle sessions while the context lasts, and all of them at its end."""
        reaper = asyncio.create_task(self._reap(), name="scene-reaper")
        try:
            yield self
        finally:
            reaper.cancel()
            await asyncio.gather(reaper, return_exceptions=True)
            await self._stop(list(self._sessions))

    @contextlib.asynccontextmanager
    async def viewing(self, session_id: str) -> AsyncIterator[ViserEndpoint]:
        """Yield the session's viser server and count the caller as a client.

        Raises:
            SessionsFullError: if the session is new and there is no room.
        """
        session = await self._session(session_id)
        session.clients += 1
        try:
            server = await self._server(session)
            yield ViserEndpoint(server.get_port(), session.filter_update)
        finally:
            session.clients -= 1
            session.idle_since = monotonic()

    @contextlib.asynccontextmanager
    async def joining(self, session_id: str, window: Window) -> AsyncIterator[Room]:
        """Yield the session's room and count the caller as a client.

        A window that is no page brings the panel with it.

        Raises:
            SessionsFullError: if the session is new and there is no room for it.
        """
        session = await self._session(session_id)
        session.clients += 1
        try:
            if not window.page:
                await self._add_panel(session)
            yield session.room
        finally:
            session.clients -= 1
            session.idle_since = monotonic()

    async def set_rig(self, session_id: str, rig: RigName) -> None:
        """Show the named rig in the session; does nothing where it is shown already.

        Raises:
            SessionsFullError: if the session is new and there is no room.
        """
        session = await self._session(session_id)
        session.idle_since = monotonic()
        async with session.lock:
            if session.starting is None:
                session.rig = rig
            server = await self._server(session)
            if session.rig != rig:
                await asyncio.to_thread(server.show, rig)
                session.rig = rig

    def server(self, session_id: str) -> RigServer | None:
        """Return the session's viser server, or None if it has none yet."""
        session = self._sessions.get(session_id)
        if session is None or session.starting is None or not session.starting.done():
            return None
        return session.starting.result()

    async def _session(self, session_id: str) -> _Session:
        if session_id not in self._sessions:
            if len(self._sessions) >= self.capacity:
                await self._evict_idle()
            # Another request may have made the session, or taken the room, meanwhile.
            if session_id not in self._sessions and len(self._sessions) >= self.capacity:
                raise SessionsFullError(self.capacity)
        return self._sessions.setdefault(session_id, _Session())

    async def _server(self, session: _Session) -> RigServer:
        """Return the session's server, made in a thread if this is the first to ask."""
        if session.starting is None:
            session.starting = asyncio.create_task(asyncio.to_thread(_make_server, session.rig))
            _log.info("scene started, %d of %d", len(self._sessions), self.capacity)
        try:
            # Shielded: a client who leaves meanwhile must not lose a server that is half made.
            return await asyncio.shield(session.starting)
        except Exception:
            session.starting = None  # the next client tries again
            raise

    async def _add_panel(self, session: _Session) -> None:
        """Give the session its panel, unless it has one."""
        loop = asyncio.get_running_loop()

        def on_edit(edits: dict[str, Any]) -> None:
            loop.call_soon_threadsafe(session.room.edit, edits)

        async with session.lock:
            server = await self._server(session)
            if session.panel is None:
                session.panel = await asyncio.to_thread(_make_panel, server, on_edit)
                session.room.on_change = session.schedule_panel_update
                session.schedule_panel_update()

    async def _evict_idle(self) -> None:
        """Stop the session that has gone unwatched for longest, if there is one."""
        idle = {key: s for key, s in self._sessions.items() if s.idle_for(self.evict_after_seconds)}
        if idle:
            await self._stop([min(idle, key=lambda key: idle[key].idle_since)])

    async def _reap(self) -> None:
        while True:
            await asyncio.sleep(min(5.0, self.idle_seconds / 3.0))
            idle = [key for key, s in self._sessions.items() if s.idle_for(self.idle_seconds)]
            with contextlib.suppress(Exception):
                await self._stop(idle)

    async def _stop(self, session_ids: list[str]) -> None:
        stopped = [self._sessions.pop(key) for key in session_ids]
        for session in stopped:
            session.panel = None
            if session.panel_timer:
                session.panel_timer.cancel()
        tasks = [session.starting for session in stopped]
        made = await asyncio.gather(*(task for task in tasks if task), return_exceptions=True)
        stops = [asyncio.to_thread(s.stop) for s in made if not isinstance(s, BaseException)]
        await asyncio.gather(*stops)
        if stops:
            _log.info("scenes stopped: %d, left: %d", len(stops), len(self._sessions))


def _make_server(rig: RigName) -> RigServer:
    """Import viser, if this is the first session, and start a server for the rig."""
    from .rig import RigServer

    return RigServer(rig)


def _make_panel(server: RigServer, on_edit: Callable[[dict[str, Any]], None]) -> Panel:
    from .panel import Panel

    return Panel(server, on_edit)
