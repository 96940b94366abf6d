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
from .relay import Admit

if TYPE_CHECKING:
    from .panel import Panel
    from .rig import RigServer

_log = logging.getLogger(__name__)

DEFAULT_RIG: RigName = "helicopter"
_PANEL_PACE = 0.15
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
    """What is known of one session; `making` yields its server once somebody has asked for it."""

    rig: RigName = DEFAULT_RIG
    making: asyncio.Task[RigServer] | None = None
    room: Room = field(default_factory=Room)
    panel: Panel | None = None
    showing: asyncio.TimerHandle | None = None
    clients: int = 0
    idle_since: float = field(default_factory=monotonic)
    lock: asyncio.Lock = field(default_factory=asyncio.Lock)

    def spare(self, after: float) -> bool:
        """Return whether nobody has watched this session for so many seconds."""
        idle = self.clients == 0 and not self.lock.locked()
        return idle and monotonic() - self.idle_since >= after

    def admit(self, element: str, updates: dict[str, Any]) -> dict[str, Any] | None:
        """Return what a visitor may set at the panel; nothing where there is none."""
        return self.panel.admit(element, updates) if self.panel else None

    def told(self, _news: Shown | Transport | None = None) -> None:
        """Bring the panel up to date, a little later, so that a drag changes it a few times a second."""
        if self.panel and self.showing is None:
            self.showing = asyncio.get_running_loop().call_later(_PANEL_PACE, self._show)

    def _show(self) -> None:
        self.showing = None
        shown, transport = self.room.shown, self.room.transport
        if self.panel and shown:
            self.panel.show(shown, wishes=shown.after < self.room.edits)
        if self.panel and transport:
            self.panel.run(transport)


@dataclass(frozen=True, slots=True)
class Watched:
    """A session's viser server on the loopback, and what its visitors may set at its panel."""

    port: int
    admit: Admit


class SceneSessions:
    """The running scenes by session id; all methods belong to one event loop.

    Args:
        capacity: how many sessions may exist at once.
        idle_seconds: how long a session outlives its last client.
        spare_seconds: after how long without a client a session may make room for another.
    """

    def __init__(self, capacity: int = 100, idle_seconds: float = 45.0, spare_seconds: float = 5.0) -> None:
        self.capacity = capacity
        self.idle_seconds = idle_seconds
        self.spare_seconds = spare_seconds
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
    async def watched(self, session_id: str) -> AsyncIterator[Watched]:
        """Yield the session's viser server and count the caller as a client.

        Raises:
            SessionsFullError: if the session is new and there is no room.
        """
        session = await self._session(session_id)
        session.clients += 1
        try:
            server = await self._server(session)
            yield Watched(server.get_port(), session.admit)
        finally:
            session.clients -= 1
            session.idle_since = monotonic()

    @contextlib.asynccontextmanager
    async def sharing(self, session_id: str, window: Window) -> AsyncIterator[Room]:
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
            if session.making is None:
                session.rig = rig
            server = await self._server(session)
            if session.rig != rig:
                await asyncio.to_thread(server.show, rig)
                session.rig = rig

    def server(self, session_id: str) -> RigServer | None:
        """Return the session's viser server, or None if it has none yet."""
        session = self._sessions.get(session_id)
        if session is None or session.making is None or not session.making.done():
            return None
        return session.making.result()

    async def _session(self, session_id: str) -> _Session:
        if session_id not in self._sessions:
            if len(self._sessions) >= self.capacity:
                await self._make_room()
            # Another request may have made the session, or taken the room, meanwhile.
            if session_id not in self._sessions and len(self._sessions) >= self.capacity:
                raise SessionsFullError(self.capacity)
        return self._sessions.setdefault(session_id, _Session())

    async def _server(self, session: _Session) -> RigServer:
        """Return the session's server, made in a thread if this is the first to ask."""
        if session.making is None:
            session.making = asyncio.create_task(asyncio.to_thread(_make_server, session.rig))
            _log.info("scene started, %d of %d", len(self._sessions), self.capacity)
        try:
            # Shielded: a visitor who leaves meanwhile must not lose a server that is half made.
            return await asyncio.shield(session.making)
        except Exception:
            session.making = None  # the next visitor tries again
            raise

    async def _add_panel(self, session: _Session) -> None:
        """Give the session its panel, unless it has one."""
        loop = asyncio.get_running_loop()

        def wished(edits: dict[str, Any]) -> None:
            loop.call_soon_threadsafe(session.room.edit, edits)

        async with session.lock:
            server = await self._server(session)
            if session.panel is None:
                session.panel = await asyncio.to_thread(_make_panel, server, wished)
                session.room.told = session.told
                session.told()

    async def _make_room(self) -> None:
        """Stop the session that has gone unwatched for longest, if there is one."""
        spare = {key: s for key, s in self._sessions.items() if s.spare(self.spare_seconds)}
        if spare:
            await self._stop([min(spare, key=lambda key: spare[key].idle_since)])

    async def _reap(self) -> None:
        while True:
            await asyncio.sleep(min(5.0, self.idle_seconds / 3.0))
            idle = [key for key, s in self._sessions.items() if s.spare(self.idle_seconds)]
            with contextlib.suppress(Exception):
                await self._stop(idle)

    async def _stop(self, session_ids: list[str]) -> None:
        stopped = [self._sessions.pop(key) for key in session_ids]
        for session in stopped:
            session.panel = None
            if session.showing:
                session.showing.cancel()
        tasks = [session.making for session in stopped]
        made = await asyncio.gather(*(task for task in tasks if task), return_exceptions=True)
        stops = [asyncio.to_thread(s.stop) for s in made if not isinstance(s, BaseException)]
        await asyncio.gather(*stops)
        if stops:
            _log.info("scenes stopped: %d, left: %d", len(stops), len(self._sessions))


def _make_server(rig: RigName) -> RigServer:
    """Import viser, if this is the first session, and start a server for the rig."""
    from .rig import RigServer

    return RigServer(rig)


def _make_panel(server: RigServer, wished: Callable[[dict[str, Any]], None]) -> Panel:
    from .panel import Panel

    return Panel(server, wished)
