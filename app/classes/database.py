"""Reading and writing off the event loop: readers beside one another, one writer that commits for many at once."""

from __future__ import annotations

import asyncio
import logging
import queue
import threading
from collections import defaultdict
from collections.abc import Callable
from concurrent.futures import Future, InvalidStateError, ThreadPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from time import monotonic, sleep
from typing import Any, TypeVar

from sqlalchemy import Connection, update
from sqlalchemy.exc import DBAPIError, InterfaceError, OperationalError, SQLAlchemyError

from .engines import Engines, open_engines
from .errors import ClassError, database_away
from .schema import classes, students

_log = logging.getLogger(__name__)
T = TypeVar("T")
_READERS = 3
_TOGETHER = 64
"""Most writes in one transaction: a commit waits for the disk, however much it holds."""
_MOST_WAITING = 2000
_PAUSES = (0.05, 0.2, 0.5, 1.0, 2.0)
"""Seconds between the tries of what failed because a connection broke, or another process held a lock."""
_SAY_AGAIN = 3.0
"""Seconds for which a database that could not be opened is not tried again."""


class Writing:
    """A transaction that changes classes; each change is told to the walls by the class's version."""

    def __init__(self, connection: Connection) -> None:
        self.connection = connection
        self._changed: defaultdict[int, set[int]] = defaultdict(set)

    def changed(self, class_id: int, student_id: int | None = None) -> None:
        """Something of the class, or of this student of it, is not as it was."""
        own = self._changed[class_id]
        if student_id is not None:
            own.add(student_id)

    def take(self, other: Writing) -> None:
        """Takes over what another part of the transaction has changed."""
        for class_id, own in other._changed.items():
            self._changed[class_id] |= own

    def raise_versions(self) -> None:
        """Raises the versions, last of all and in one order, so that replicas wait shortly and in no circle."""
        for class_id in sorted(self._changed):
            raised = self.connection.execute(
                update(classes)
                .where(classes.c.id == class_id)
                .values(version=classes.c.version + 1)
                .returning(classes.c.version)
            ).scalar()
            own = self._changed[class_id]
            if raised is not None and own:
                of_them = students.c.id.in_(sorted(own))
                self.connection.execute(update(students).where(of_them).values(version=raised))


@dataclass(eq=False)
class _Job:
    work: Callable[[Writing], Any]
    future: Future[Any] = field(default_factory=Future)


class Database:
    """The classes' database; opened at first use, by whichever thread comes first.

    What a write answers is on the disk. Works are functions of a transaction that may be run again, if a
    connection breaks: they keep nothing but what they return.

    Args:
        setting: HELI2DOF_DATABASE.
    """

    def __init__(self, setting: str) -> None:
        self._setting = setting
        self._opening = threading.Lock()
        self._engines: Engines | None = None
        self._refused: tuple[ClassError, float] | None = None
        self._readers = ThreadPoolExecutor(_READERS, "classes-read")
        self._jobs: queue.SimpleQueue[_Job | None] = queue.SimpleQueue()
        self._writer = threading.Thread(target=self._serve, name="classes-write", daemon=True)
        self._writer.start()

    async def read(self, work: Callable[[Connection], T]) -> T:
        """`work` in a transaction that changes nothing.

        Raises:
            ClassError: no_database, database_away, or whatever `work` raises.
        """
        if self._engines is not None and self._engines.shared:
            return await self.write(lambda writing: work(writing.connection))
        reading = asyncio.get_running_loop().run_in_executor(self._readers, self._read, work)
        return await reading

    async def write(self, work: Callable[[Writing], T]) -> T:
        """`work` in a transaction, committed when this returns.

        Raises:
            ClassError: no_database, database_away, or whatever `work` raises; then nothing of it is kept.
        """
        if self._jobs.qsize() > _MOST_WAITING:
            raise database_away()
        job = _Job(work)
        self._jobs.put(job)
        return await asyncio.wrap_future(job.future)

    def close(self) -> None:
        """Writes what waits, then closes all connections."""
        self._jobs.put(None)
        self._writer.join()
        self._readers.shutdown()
        if self._engines is not None:
            self._engines.dispose()

    def engines(self) -> Engines:
        """The open database.

        Raises:
            ClassError: no_database.
        """
        with self._opening:
            if self._engines is None:
                if self._refused is not None and monotonic() < self._refused[1]:
                    raise self._refused[0]
                try:
                    self._engines = open_engines(self._setting)
                except ClassError as error:
                    _log.warning("no classes: %s", error.detail)
                    self._refused = error, monotonic() + _SAY_AGAIN
                    raise
            return self._engines

    def _read(self, work: Callable[[Connection], T]) -> T:
        for pause in (*_PAUSES[:2], None):
            engines = self.engines()
            if engines.shared:  # known only now
                return self._inline(work)
            try:
                with engines.reading.begin() as connection:
                    return work(connection)
            except DBAPIError as error:
                if pause is None or not _may_pass(error):
                    _log.error("reading of the database failed", exc_info=_without_values(error))
                    raise database_away() from None
                sleep(pause)
            except SQLAlchemyError as error:
                _log.error("reading of the database failed", exc_info=_without_values(error))
                raise database_away() from None
        raise AssertionError

    def _inline(self, work: Callable[[Connection], T]) -> T:
        job = _Job(lambda writing: work(writing.connection))
        self._jobs.put(job)
        return job.future.result()

    def _serve(self) -> None:
        ending = False
        while not ending:
            jobs: list[_Job] = []
            job = self._jobs.get()
            while job is not None:
                jobs.append(job)
                if len(jobs) == _TOGETHER:
                    break
                try:
                    job = self._jobs.get_nowait()
                except queue.Empty:
                    break
            ending = job is None
            if jobs:
                self._do(jobs)

    def _do(self, jobs: list[_Job]) -> None:
        outcomes: list[tuple[bool, Any]] = []
        for pause in (*_PAUSES, None):
            try:
                outcomes = self._transaction(jobs)
                break
            except ClassError as error:  # it cannot be opened
                outcomes = [(False, error)] * len(jobs)
                break
            except SQLAlchemyError as error:
                if pause is None or not _may_pass(error):
                    _log.error("writing to the database failed", exc_info=_without_values(error))
                    outcomes = [(False, database_away())] * len(jobs)
                    break
                sleep(pause)
            except Exception as error:
                _log.exception("writing to the database failed")
                outcomes = [(False, error)] * len(jobs)
                break
        for job, (well, outcome) in zip(jobs, outcomes, strict=True):
            with suppress(InvalidStateError, RuntimeError):  # nobody waits any more, or no loop is left
                (job.future.set_result if well else job.future.set_exception)(outcome)

    def _transaction(self, jobs: list[_Job]) -> list[tuple[bool, Any]]:
        """All jobs in one transaction, each of which may fail alone."""
        outcomes: list[tuple[bool, Any]] = []
        with self.engines().writing.begin() as connection:
            whole = Writing(connection)
            for job in jobs:
                own = Writing(connection)
                try:
                    with connection.begin_nested():
                        outcome = job.work(own)
                except (OperationalError, InterfaceError):
                    raise  # the transaction as a whole is lost
                except DBAPIError as error:
                    outcomes.append((False, _without_values(error)))
                except Exception as error:
                    outcomes.append((False, error))
                else:
                    whole.take(own)
                    outcomes.append((True, outcome))
            whole.raise_versions()
        return outcomes


_PASSING = ("40001", "40P01", "55P03", "57P01", "57P02", "57P03", "57014", "08")
"""PostgreSQL's states after which the same may well succeed: serialization, deadlock, lock, connection."""


def _may_pass(error: SQLAlchemyError) -> bool:
    """Whether the same may succeed in a moment."""
    if not isinstance(error, DBAPIError):
        return isinstance(error, TimeoutError)
    if error.connection_invalidated:
        return True
    state = getattr(error.orig, "sqlstate", None)
    if state is not None:
        return str(state).startswith(_PASSING)
    told = str(error.orig).lower()
    return any(word in told for word in ("locked", "busy", "connection", "closed", "terminat"))


def _without_values(error: SQLAlchemyError) -> Exception:
    """The same for the log: a driver's words may hold a name, or the hash of a secret."""
    own = error.orig if isinstance(error, DBAPIError) else error
    state = getattr(own, "sqlstate", None) or getattr(own, "sqlite_errorname", None) or ""
    told = RuntimeError(f"{type(own).__name__} {state}".strip())
    told.__suppress_context__ = True
    return told.with_traceback(error.__traceback__)
