"""A class's changes on their way to walls, where the database fails or many classes are watched."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import pytest

from app.classes import feeds
from app.classes.errors import ClassError, database_away
from app.classes.lab_library import frozen_lab
from app.classes.rows import ClassRow
from tests.app.a_lab import A_LAB
from tests.loops import run
from tests.patience import PATIENCE


def a_class(number: int) -> ClassRow:
    return ClassRow(number, f"C{number}", "small", "Monday", "", "", 0.0, None, True, None, 4e9, 0, 1)


class Slow:
    """A database whose reads take until they are told to go on.

    Attributes:
        most: of the reads that were under way at one time.
    """

    def __init__(self) -> None:
        self.under_way = self.most = self.asked = 0
        self.reads = asyncio.Event()
        self.go_on = asyncio.Event()

    async def read(self, work: Callable[[Any], Any]) -> Any:
        self.under_way += 1
        self.asked += 1
        self.most = max(self.most, self.under_way)
        self.reads.set()
        await self.go_on.wait()
        self.under_way -= 1
        return self.answer()

    def answer(self) -> Any:
        raise database_away()


def never() -> bool:
    return False


def test_a_first_look_that_fails_is_told_to_all_who_wait_for_it():
    async def watch() -> None:
        database: Any = Slow()
        known = frozen_lab(A_LAB, "small")
        own = feeds.Feeds(database)
        walls = [asyncio.create_task(anext(own.of(a_class(1), known).watched(never))) for _ in range(3)]
        await database.reads.wait()
        database.go_on.set()
        done, waiting = await asyncio.wait(walls, timeout=PATIENCE, return_when=asyncio.ALL_COMPLETED)
        assert not waiting
        for wall in done:
            with pytest.raises(ClassError, match="does not answer"):
                await wall
        assert not own._by_class  # who comes now looks anew
        assert database.asked == 1

    run(watch())


def test_however_many_classes_are_watched_their_looks_take_one_reader(monkeypatch):
    monkeypatch.setattr(feeds, "PERIOD", 0.0)

    class Steady(Slow):
        def answer(self) -> Any:
            return a_class(1), [], set()

    async def watch() -> None:
        database: Any = Steady()
        known = frozen_lab(A_LAB, "small")
        own = feeds.Feeds(database)
        database.go_on.set()
        walls = [own.of(a_class(k), known).watched(never) for k in range(5)]
        for wall in walls:
            assert (await anext(wall)).startswith(b"event: class\n")
        database.most = database.under_way
        database.go_on.clear()
        before = database.asked
        while database.asked == before:  # the first that looks waits for the database
            await asyncio.sleep(0)
        for _ in range(100):  # and all others for it
            await asyncio.sleep(0)
        assert database.asked == before + 1 and database.most <= 1
        database.go_on.set()
        while database.asked < before + 50:  # all get their turn
            await asyncio.sleep(0)
        assert database.most == 1
        for wall in walls:
            await wall.aclose()

    run(watch())
