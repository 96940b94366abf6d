"""A class's changes, told to walls: one look at the database per class and replica, however many walls there are."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator, Callable
from contextlib import suppress
from datetime import datetime
from time import time
from typing import Any

import orjson
from sqlalchemy import Connection, select

from . import wall
from .database import Database
from .errors import ClassError, database_away
from .lab_library import KnownLab
from .rows import CLASS, ClassRow, told_time
from .schema import classes

_log = logging.getLogger(__name__)
PERIOD = 0.5
"""Seconds between two looks at a class's version."""
HEARTBEAT = 10.0
"""Seconds after which a wall hears that it is still served, if nothing else."""
_STALE = 3.0
"""Seconds without an answer of the database after which walls are told so."""
MOST_WALLS = 20
"""Of one class on one replica."""
_WAITING = 64
"""Messages that wait for a wall that does not read; beyond, it is sent away and comes back to a fresh snapshot."""


def event(name: str, data: Any) -> bytes:
    """One server-sent event."""
    return b"event: %b\ndata: %b\n\n" % (name.encode(), orjson.dumps(data))


class Feed:
    """One class, as long as somebody watches it."""

    def __init__(
        self,
        database: Database,
        of: ClassRow,
        known: KnownLab,
        ended: Callable[[int, Feed], None],
        turn: asyncio.Semaphore,
    ) -> None:
        self._database, self._of, self._known, self._ended, self._turn = database, of, known, ended, turn
        self._rows: dict[int, wall.Row] = {}
        self._opening: wall.Row = {}
        self._held_up: list[wall.Row] = []
        self._walls: set[asyncio.Queue[bytes | None]] = set()
        self._task: asyncio.Task[None] | None = None
        self._ready = asyncio.Event()
        self._over = False

    async def watched(self, going: Callable[[], bool]) -> AsyncIterator[bytes]:
        """The events for one wall; the whole class first.

        Args:
            going: whether the server ends; so does the stream then.
        """
        if len(self._walls) >= MOST_WALLS:
            raise ClassError(
                503, f"{MOST_WALLS} walls show this class already.", "too_many_walls", retry_after=30
            )
        messages: asyncio.Queue[bytes | None] = asyncio.Queue(_WAITING)
        first = not self._walls
        self._walls.add(messages)  # before the first look: nothing that changes meanwhile is missed
        try:
            if first:
                await self._look_whole()
                self._task = asyncio.create_task(self._poll())
                self._ready.set()
            await self._ready.wait()
            if self._task is None:  # the first look of another wall has failed
                raise database_away()
            while not (messages.empty() or self._over):
                messages.get_nowait()
            yield event("class", self._whole())
            quiet = 0.0
            while not going():
                try:
                    message = await asyncio.wait_for(messages.get(), PERIOD)
                except TimeoutError:
                    quiet += PERIOD
                    if quiet >= HEARTBEAT:
                        quiet = 0.0
                        yield b": still here\n\n"
                    continue
                if message is None:
                    return
                quiet = 0.0
                yield message
        finally:
            self._walls.discard(messages)
            # Whoever waits for a first look that has failed is told so.
            if not self._walls or (first and self._task is None):
                self._end()

    def _end(self) -> None:
        self._ready.set()
        if self._task is not None:
            self._task.cancel()
        self._ended(self._of.id, self)

    def _finish(self, name: str) -> None:
        """Tells all walls why there is nothing more, and ends them; who comes next has a feed of their own."""
        self._over = True
        self._ended(self._of.id, self)
        self._tell(event(name, {"at": told_time(time())}))
        self._tell(None)

    def _whole(self) -> wall.Row:
        people = sorted(self._rows.values(), key=lambda row: row["number"])
        told = wall.about(self._of, self._known, time())
        return {**told, "steps": wall.steps_of(self._known), "students": people, "held_up": self._held_up}

    async def _look_whole(self) -> None:
        of, rows, _ = await self._database.read(lambda connection: self._look(connection, -1))
        if of is not None:
            self._of, self._rows = of, {row["id"]: row for row in rows}
        self._opening = wall.opening(self._of, time())
        self._held_up = wall.held_up(self._known, self._rows.values())

    def _look(self, connection: Connection, since: int) -> tuple[ClassRow | None, list[wall.Row], set[int]]:
        """One look: the version, and what is newer than `since`; nothing more where nothing is."""
        row = connection.execute(select(*CLASS).where(classes.c.id == self._of.id)).mappings().first()
        if row is None or row["ends"] <= time():
            return None, [], set()
        of = ClassRow(**row)
        if of.version == since:
            return of, [], set(self._rows)
        changed = wall.rows(connection, of, self._known, time(), since=since)
        return of, changed, wall.ids(connection, of.id)

    async def _poll(self) -> None:
        failing, stale = 0.0, False
        while True:
            await asyncio.sleep(PERIOD)
            since = self._of.version
            try:
                async with self._turn:
                    looked = await self._database.read(lambda connection: self._look(connection, since))  # noqa: B023
            except ClassError:
                failing += PERIOD
                if failing >= _STALE and not stale:
                    stale = True
                    self._tell(event("stale", {"at": told_time(time())}))
                continue
            except Exception:
                _log.exception("a class's changes could not be read")
                continue
            if stale:  # a change of nothing, by which walls know that they hear all again
                self._tell(event("change", {"version": since, "at": told_time(time())}))
            failing, stale = 0.0, False
            of, changed, there = looked
            if of is None:
                return self._finish("deleted")
            if of.instructor_hash != self._of.instructor_hash:
                return self._finish("rotated")
            self._take(of, changed, there)

    def _take(self, of: ClassRow, changed: list[wall.Row], there: set[int]) -> None:
        """Takes in one look, and tells what differs."""
        now, told = time(), {row["id"]: row for row in changed}
        gone = [number for number in self._rows if number not in there]
        for number in gone:
            del self._rows[number]
        self._rows |= told
        told |= self._came_and_went(now)
        news: wall.Row = {}
        if told:
            news["students"] = list(told.values())
        if gone:
            news["gone"] = gone
        if told or gone:
            news |= self._held_up_anew()
        news |= self._head_anew(of, now)
        if news:
            self._tell(event("change", {"version": of.version, "at": told_time(now), **news}))

    def _came_and_went(self, now: float) -> dict[int, wall.Row]:
        """Who is there, or is not any more, since the last look."""
        found = {}
        for number, row in self._rows.items():
            online = now - _seconds(row["last_seen"]) < wall.ONLINE
            if online != row["online"]:
                row["online"] = online
                found[number] = row
        return found

    def _held_up_anew(self) -> wall.Row:
        before, self._held_up = self._held_up, wall.held_up(self._known, self._rows.values())
        return {} if self._held_up == before else {"held_up": self._held_up}

    def _head_anew(self, of: ClassRow, now: float) -> wall.Row:
        """What has changed of the class itself; null where something is no more."""
        opening, news = wall.opening(of, now), {}
        if opening != self._opening:
            news = {"closes": None, "closed_at": None, **opening}
        if of.title != self._of.title:
            news["title"] = of.title
        self._of, self._opening = of, opening
        return news

    def _tell(self, message: bytes | None) -> None:
        for messages in self._walls:
            if messages.full():
                while not messages.empty():
                    messages.get_nowait()
                messages.put_nowait(None)
            with suppress(asyncio.QueueFull):
                messages.put_nowait(message)


def _seconds(told: str) -> float:
    return datetime.fromisoformat(told).timestamp()


class Feeds:
    """The feeds of this replica, by class."""

    def __init__(self, database: Database) -> None:
        self._database = database
        self._by_class: dict[int, Feed] = {}
        # One look at a time: however many classes are watched, students find the other readers free.
        self._turn = asyncio.Semaphore(1)

    def of(self, found: ClassRow, known: KnownLab) -> Feed:
        """The feed of a class."""
        feed = self._by_class.get(found.id)
        if feed is None:
            feed = Feed(self._database, found, known, self._forget, self._turn)
            self._by_class[found.id] = feed
        return feed

    def _forget(self, class_id: int, feed: Feed) -> None:
        if self._by_class.get(class_id) is feed:
            del self._by_class[class_id]
