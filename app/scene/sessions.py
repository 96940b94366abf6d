"""One viser server per session, made when it is first wanted and stopped when nobody watches."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator
from dataclasses import dataclass, field
from time import monotonic
from typing import TYPE_CHECKING

from heli2dof_core.geometry import RigName

if TYPE_CHECKING:
    from .rig import RigServer

_log = logging.getLogger(__name__)

DEFAULT_RIG: RigName = "helicopter"
_SPARE_AFTER = 5.0
"""Seconds without a client after which a session may make room for another."""


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
    clients: int = 0
    idle_since: float = field(default_factory=monotonic)
    lock: asyncio.Lock = field(default_factory=asyncio.Lock)

    def spare(self, after: float) -> bool:
        """Return whether nobody has watched this session for so many seconds."""
        idle = self.clients == 0 and not self.lock.locked()
        return idle and monotonic() - self.idle_since >= after


class SceneSessions:
    """The running scenes by session id; all methods belong to one event loop.

    Args:
        capacity: how many sessions may exist at once.
        idle_seconds: how long a session outlives its last client.
    """

    def __init__(self, capacity: int = 100, idle_seconds: float = 45.0) -> None:
        self.capacity = capacity
        self.idle_seconds = idle_seconds
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
    async def watched(self, session_id: str) -> AsyncIterator[int]:
        """Yield the port of the session's viser server and count the caller as a client.

        Raises:
            SessionsFullError: if the session is new and there is no room.
        """
        session = await self._session(session_id)
        session.clients += 1
        try:
            server = await self._server(session)
            yield server.get_port()
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

    async def _make_room(self) -> None:
        """Stop the session that has gone unwatched for longest, if there is one."""
        spare = {key: s for key, s in self._sessions.items() if s.spare(_SPARE_AFTER)}
        if spare:
            await self._stop([min(spare, key=lambda key: spare[key].idle_since)])

    async def _reap(self) -> None:
        while True:
            await asyncio.sleep(min(5.0, self.idle_seconds / 3.0))
            idle = [key for key, s in self._sessions.items() if s.spare(self.idle_seconds)]
            with contextlib.suppress(Exception):
                await self._stop(idle)

    async def _stop(self, session_ids: list[str]) -> None:
        tasks = [self._sessions.pop(key).making for key in session_ids]
        made = await asyncio.gather(*(task for task in tasks if task), return_exceptions=True)
        stops = [asyncio.to_thread(s.stop) for s in made if not isinstance(s, BaseException)]
        await asyncio.gather(*stops)
        if stops:
            _log.info("scenes stopped: %d, left: %d", len(stops), len(self._sessions))


def _make_server(rig: RigName) -> RigServer:
    """Import viser, if this is the first session, and start a server for the rig."""
    from .rig import RigServer

    return RigServer(rig)
