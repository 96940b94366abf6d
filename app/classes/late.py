"""The desk, made when the first class is asked for: SQLAlchemy and the labs take a while to import."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from typing import TYPE_CHECKING

from ..jobs.compute import Compute
from ..ops.settings import Settings
from .errors import ClassError

if TYPE_CHECKING:
    from .desk import Desk

_log = logging.getLogger(__name__)
_PURGED_EVERY = 3600.0
_LOOKED_EVERY = 1.0
"""Seconds between two looks whether the server has warmed up."""


class Classes:
    """Hands out the desk of a server.

    Args:
        settings: of the server.
        compute: threads that mark.
    """

    def __init__(self, settings: Settings, compute: Compute) -> None:
        self._settings, self._compute = settings, compute
        self._lock = asyncio.Lock()
        self._desk: Desk | None = None
        self._housekeeping: asyncio.Task[None] | None = None

    async def desk(self) -> Desk:
        """The desk.

        Raises:
            ClassError: classes_off.
        """
        if self._desk is not None:
            return self._desk
        async with self._lock:
            if self._desk is None:
                await asyncio.to_thread(_import)
                from .desk import Desk

                self._desk = Desk(self._settings, self._compute)
        return self._desk

    @contextlib.asynccontextmanager
    async def running(self):  # noqa: ANN201
        """Clears away what has ended, at the start and hourly; closes the database at the end."""
        self._housekeeping = asyncio.create_task(self._keep_house())
        try:
            yield
        finally:
            self._housekeeping.cancel()
            if self._desk is not None:
                await asyncio.to_thread(self._desk.database.close)

    async def _keep_house(self) -> None:
        while not self._compute.compiled:  # the start belongs to the first page
            await asyncio.sleep(_LOOKED_EVERY)
        while True:
            try:
                if self._desk is not None or await asyncio.to_thread(_is_there, self._settings):
                    count = await (await self.desk()).purge()
                    if count:
                        _log.info("classes that have ended were deleted: %d", count)
            except ClassError:
                pass  # said where it was found
            except Exception:
                _log.exception("classes that have ended could not be deleted")
            await asyncio.sleep(_PURGED_EVERY)


def _import() -> None:
    from . import desk  # noqa: F401


def _is_there(settings: Settings) -> bool:
    from .engines import is_there

    return is_there(settings.database_address)
