"""The tool, made when the first platform asks or grades may wait: its libraries take a while to import."""

from __future__ import annotations

import asyncio
import contextlib
import logging
from collections.abc import AsyncIterator
from typing import TYPE_CHECKING

from ..classes.errors import ClassError
from ..classes.late import Classes
from ..jobs.compute import Compute
from ..ops.settings import Settings

if TYPE_CHECKING:
    from .tool import Tool

_log = logging.getLogger(__name__)
_LOOKED_EVERY = 1.0
"""Seconds between two looks whether the server has warmed up."""


class Lti:
    """Hands out the tool of a server, and has waiting grades sent.

    Args:
        settings: of the server.
        compute: tells when the server has warmed up.
        classes: of the server.
    """

    def __init__(self, settings: Settings, compute: Compute, classes: Classes) -> None:
        self._settings, self._compute, self._classes = settings, compute, classes
        self._lock = asyncio.Lock()
        self._tool: Tool | None = None
        self._grading: asyncio.Task[None] | None = None

    async def tool(self) -> Tool | None:
        """The tool; None where this server keeps no classes.

        Raises:
            ClassError: there is no database.
        """
        if self._settings.classes == "off":
            return None
        desk = await self._classes.desk()
        async with self._lock:
            if self._tool is None:
                await asyncio.to_thread(_import)
                from .tool import Tool

                self._tool = Tool(
                    desk.database,
                    desk.labs,
                    days=self._settings.class_days,
                    most_classes=self._settings.classes_most,
                    most_students=self._settings.students_most,
                )
                from .grades import Grader

                self._grading = asyncio.create_task(Grader(desk.database, self._tool).run())
        return self._tool

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[None]:
        """Has grades sent that an earlier process has left, and stops sending at the end."""
        looking = asyncio.create_task(self._look())
        try:
            yield
        finally:
            tasks = [task for task in (looking, self._grading) if task is not None]
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)

    async def _look(self) -> None:
        while not self._compute.compiled:  # the start belongs to the first page
            await asyncio.sleep(_LOOKED_EVERY)
        try:
            if await asyncio.to_thread(self._is_registered):
                await self.tool()
        except ClassError:
            pass  # said where it was found
        except Exception:
            _log.exception("whether grades wait could not be found out")

    def _is_registered(self) -> bool:
        """Whether there is a database with a platform in it; makes none."""
        from ..classes.engines import is_there

        setting = self._settings.database_address
        if self._settings.classes == "off" or not is_there(setting):
            return False
        from ..classes.engines import open_engines
        from .store import all_platforms

        engines = open_engines(setting)
        try:
            with engines.reading.begin() as connection:
                return bool(all_platforms(connection))
        finally:
            engines.dispose()


def _import() -> None:
    from . import grades, tool  # noqa: F401
