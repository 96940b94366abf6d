"""Launches of one link at one moment on several replicas."""

from __future__ import annotations

import asyncio
from time import time

import pytest

from app.classes.database import Database, Writing
from app.classes.lab_library import frozen_lab
from app.classes.people import NewClass
from app.lti import platforms
from app.lti.launch import Launch
from app.lti.links import Arrival, Place, enter, tie
from app.lti.platforms import platform_of
from app.lti.store import keep_platform
from tests.app.a_lab import A_LAB
from tests.loops import run
from tests.postgresql import postgresql

pytestmark = pytest.mark.slow


def test_who_comes_twice_at_one_moment_is_one_and_a_link_has_one_class():
    known = frozen_lab(A_LAB, "small")
    site = platforms.moodle("https://moodle.example")
    given = platform_of("moodle", "https://lab.example", site, client_id="heli", deployments=("7",))
    with postgresql() as server:
        replicas = [Database(setting) for setting in [server.fresh("launches")] * 3]

        async def launched() -> dict[tuple[str, str], list[Place]]:
            platform = await replicas[0].write(lambda own: keep_platform(own.connection, given, time()))

            async def comes(database: Database, link: str, subject: str) -> Place:
                launch = Launch("link", "7", subject, f"Student {subject}", instructor=False, link=link)
                arrival = Arrival(platform, launch, 500, time())
                new = NewClass.of(known, "Poles", None, 90, 2000)

                def work(writing: Writing) -> Place:
                    return enter(writing, arrival, tie(writing, arrival, new))

                return await database.write(work)

            found = {}
            for link in "abcdef":
                # The class's own first launch, then people's; each three times at one moment.
                for subject in ("1", "2", "3"):
                    landed = await asyncio.gather(*(comes(own, link, subject) for own in replicas))
                    found[link, subject] = list(landed)
            return found

        try:
            found = run(launched())
        finally:
            for database in replicas:
                database.close()
    assert all(len(set(places)) == 1 for places in found.values())
    for link in "abcdef":
        assert len({place.code for (own, _), places in found.items() if own == link for place in places}) == 1
    assert len({places[0].secret for places in found.values()}) == len(found)
