"""Grades on their way to the platforms: none is lost while one is away.

What is to be sent follows from what is kept of a class, by its version: whatever raises points, an attempt or a
mark by hand, is found there, even if the process ended right after it. Until a platform has taken a grade it waits
in the outbox, of each student the newest.
"""

from __future__ import annotations

import asyncio
import json
import logging
from collections import defaultdict
from dataclasses import dataclass, replace
from typing import Any

from sqlalchemy import Connection, case, func, insert, select, update

from ..classes.database import Database, Writing
from ..classes.errors import ClassError
from ..classes.lab_library import frozen_lab
from ..classes.schema import classes, hand_marks, standings
from ..classes.schema_lti import links, outbox, users
from ..classes.schema_lti import platforms as platform_rows
from .errors import LtiError, PlatformError
from .platforms import Platform
from .services import Score
from .store import all_platforms
from .tool import Tool
from .vocabulary import SCOPE_LINEITEM, SCOPE_SCORE

_log = logging.getLogger(__name__)
_POLL_SECONDS = 3.0
_AWAY_SECONDS = 30.0
"""Between looks while the database does not answer, or nothing is registered."""
_TRYING_SECONDS = 120.0
"""For which a grade is left to who tries: another replica, or this one after a crash, takes it up then."""
_FIRST_PAUSE, _LONGEST_PAUSE = 15.0, 3600.0
_AT_ONCE = 50


@dataclass(frozen=True)
class Due:
    """A grade that is to be sent now.

    Attributes:
        user_id: of the row in the outbox.
        link_id: of the link by which the student came.
        platform_id: to which it goes.
        link: the resource link's id.
        title: of the class.
        lineitem: its column, empty where there is none yet.
        lineitems: where one may be made.
        scopes: that the platform allows.
        changed: when these points came about; tells them from those before and after.
        score: the grade.
        tries: so far, in vain.
    """

    user_id: int
    link_id: int
    platform_id: int
    link: str
    title: str
    lineitem: str
    lineitems: str
    scopes: tuple[str, ...]
    changed: float
    score: Score
    tries: int


def changed_links(connection: Connection) -> list[int]:
    """The links whose classes have changed since their points were taken."""
    of_class = links.join(classes, classes.c.id == links.c.class_id)
    chosen = select(links.c.id).select_from(of_class).where(classes.c.version != links.c.graded)
    return list(connection.execute(chosen).scalars())


def collect(writing: Writing, link_id: int, now: float) -> int:
    """Puts into the outbox what has changed of a link's students; returns how many grades."""
    connection = writing.connection
    of_class = links.join(classes, classes.c.id == links.c.class_id)
    chosen = select(classes.c.version, classes.c.lab_text, classes.c.lab_name).select_from(of_class)
    # The version comes first: what changes after it has a later one, and is found by the next look.
    row = connection.execute(chosen.where(links.c.id == link_id)).first()
    if row is None:
        return 0
    most = float(frozen_lab(row.lab_text, row.lab_name).lab.points)
    kept = {old.user_id: old for old in connection.execute(select(outbox).where(_of(link_id)))}
    count = 0
    for user_id, (points, to_mark) in _totals(connection, link_id).items():
        new = {"points": points, "most": most, "to_mark": to_mark}
        old = kept.get(user_id)
        if old is not None and all(getattr(old, name) == value for name, value in new.items()):
            continue
        when = now if old is None else max(now, old.changed + 0.001)
        told: dict[str, Any] = {**new, "changed": when, "sent": False, "tries": 0, "due": now, "error": ""}
        if old is None:
            connection.execute(insert(outbox).values(user_id=user_id, **told))
        else:
            connection.execute(update(outbox).where(outbox.c.user_id == user_id).values(**told))
        count += 1
    connection.execute(update(links).where(links.c.id == link_id).values(graded=row.version))
    return count


def _of(link_id: int) -> Any:
    return outbox.c.user_id.in_(select(users.c.id).where(users.c.link_id == link_id))


def _totals(connection: Connection, link_id: int) -> dict[int, tuple[float, int]]:
    """Points and answers yet to be marked, of each student of a link who has handed in."""
    mine = users.c.link_id == link_id
    steps = connection.execute(
        select(users.c.id, standings.c.step, standings.c.points, standings.c.texts)
        .join(standings, standings.c.student_id == users.c.student_id)
        .where(mine)
    ).all()
    by_hand = connection.execute(
        select(users.c.id, hand_marks.c.step, hand_marks.c.question, hand_marks.c.points)
        .join(hand_marks, hand_marks.c.student_id == users.c.student_id)
        .where(mine)
    ).all()
    points: defaultdict[int, float] = defaultdict(float)
    answered: set[tuple[int, str, str]] = set()
    for user_id, step, got, texts in steps:
        points[user_id] += got
        answered |= {(user_id, step, question) for question in json.loads(texts)}
    for user_id, _, _, got in by_hand:
        points[user_id] += got
    open_ones = answered - {(user_id, step, question) for user_id, step, question, _ in by_hand}
    waiting: defaultdict[int, int] = defaultdict(int)
    for user_id, _, _ in open_ones:
        waiting[user_id] += 1
    return {user_id: (round(got, 6), waiting[user_id]) for user_id, got in points.items()}


def due_grades(connection: Connection, now: float) -> list[Due]:
    """What is to be sent now, the longest waiting first; what has nowhere to go waits for a launch that says so."""
    chosen = (
        select(outbox, users.c.subject, links, classes.c.title)
        .join(users, users.c.id == outbox.c.user_id)
        .join(links, links.c.id == users.c.link_id)
        .join(classes, classes.c.id == links.c.class_id)
        .where(
            outbox.c.sent.is_(False),
            outbox.c.due <= now,
            (links.c.lineitem != "") | (links.c.lineitems != ""),
        )
        .order_by(outbox.c.due)
        .limit(_AT_ONCE)
    )
    return [
        Due(
            user_id=row["user_id"],
            link_id=row["id"],
            platform_id=row["platform_id"],
            link=row["link"],
            title=row["title"],
            lineitem=row["lineitem"],
            lineitems=row["lineitems"],
            scopes=tuple(json.loads(row["scopes"])),
            changed=row["changed"],
            score=Score(row["subject"], row["points"], row["most"], row["changed"], row["to_mark"]),
            tries=row["tries"],
        )
        for row in connection.execute(chosen).mappings()
    ]


def _same(due: Due) -> Any:
    """The row of a grade, as long as it is that grade: points that changed meanwhile are another one."""
    return (outbox.c.user_id == due.user_id) & (outbox.c.changed == due.changed) & outbox.c.sent.is_(False)


def claim(writing: Writing, due: Due, now: float) -> bool:
    """Takes a grade in hand, so that no other replica sends it meanwhile."""
    mine = update(outbox).where(_same(due) & (outbox.c.due <= now)).values(due=now + _TRYING_SECONDS)
    return writing.connection.execute(mine).rowcount == 1


def settle(writing: Writing, due: Due) -> None:
    """Notes that the platform has a grade."""
    writing.connection.execute(update(outbox).where(_same(due)).values(sent=True, error="", tries=0))


def pause(due: Due, error: LtiError, first: float) -> float:
    """Seconds until a grade is tried again: ever more, an hour at most, and what the platform asks for."""
    own = min(first * 2.0 ** min(due.tries, 20), _LONGEST_PAUSE)
    return max(own, min(getattr(error, "retry_after", 0.0), _LONGEST_PAUSE))


def put_off(writing: Writing, due: Due, error: LtiError, now: float) -> None:
    """Notes that a grade could not be sent, and when to try again."""
    later = now + pause(due, error, _FIRST_PAUSE)
    values = {"tries": due.tries + 1, "due": later, "error": error.message[:500]}
    writing.connection.execute(update(outbox).where(_same(due)).values(**values))


def queue(connection: Connection) -> list[dict[str, Any]]:
    """Per platform: grades that wait, those of them that were tried in vain, the newest reason; for the operator."""
    chosen = (
        select(
            platform_rows.c.name,
            func.count().label("grades"),
            func.sum(case((outbox.c.sent, 1), else_=0)).label("sent"),
            func.max(outbox.c.error).label("error"),
            func.max(outbox.c.tries).label("tries"),
        )
        .join(links, links.c.platform_id == platform_rows.c.id)
        .join(users, users.c.link_id == links.c.id)
        .join(outbox, outbox.c.user_id == users.c.id)
        .group_by(platform_rows.c.name)
        .order_by(platform_rows.c.name)
    )
    return [dict(row) for row in connection.execute(chosen).mappings()]


class Grader:
    """Sends grades as they come about, and those that wait when their platform is back.

    Args:
        database: of the classes.
        tool: whose services are asked.
    """

    def __init__(self, database: Database, tool: Tool) -> None:
        self._database, self._tool = database, tool
        self._unreadable: set[int] = set()

    async def run(self) -> None:
        """Goes on until it is cancelled."""
        while True:
            seconds = _POLL_SECONDS
            try:
                if not await self.once():
                    seconds = _AWAY_SECONDS
            except Exception:
                # Whatever it is, grades must go on when it is over.
                _log.exception("grades could not be sent")
                seconds = _AWAY_SECONDS
            await asyncio.sleep(seconds)

    async def once(self) -> bool:
        """Collects and sends what is due; returns whether any platform is registered."""
        platforms = {platform.id: platform for platform in await self._database.read(all_platforms)}
        if not platforms:
            return False
        for link_id in await self._database.read(changed_links):
            await self._collect(link_id)
        now = self._tool.now()
        due = await self._database.read(lambda connection: due_grades(connection, now))
        by_platform: defaultdict[int, list[Due]] = defaultdict(list)
        for grade in due:
            by_platform[grade.platform_id].append(grade)
        if due:
            await self._tool.load_key()
        await asyncio.gather(*(self._send(platforms[number], own) for number, own in by_platform.items()))
        return True

    async def _collect(self, link_id: int) -> None:
        """Puts aside what cannot be read, a lab of a newer version perhaps: the other classes' grades go on."""
        now = self._tool.now()
        try:
            await self._database.write(lambda writing: collect(writing, link_id, now))
        except ClassError as error:
            if link_id not in self._unreadable:
                _log.warning("grades of the link %d wait: %s", link_id, error.detail)
            self._unreadable.add(link_id)

    async def _send(self, platform: Platform, grades: list[Due]) -> None:
        """Sends one after another; once the platform does not answer, the others wait as well."""
        away: LtiError | None = None
        for due in grades:
            now = self._tool.now()
            if not await self._database.write(lambda writing, due=due, now=now: claim(writing, due, now)):
                continue
            error = away or await self._sent(platform, due)
            if error is None:
                await self._database.write(lambda writing, due=due: settle(writing, due))
                continue
            if isinstance(error, PlatformError) and not error.http_status:
                away = error
            _log.warning("a grade for %s waits: %s", platform.name, error.message)
            now = self._tool.now()
            await self._database.write(
                lambda writing, due=due, error=error, now=now: put_off(writing, due, error, now)
            )

    async def _sent(self, platform: Platform, due: Due) -> LtiError | None:
        """Tries to send a grade; returns what went wrong."""
        try:
            if SCOPE_SCORE not in due.scopes:
                return PlatformError("The platform does not let this server send grades.", 403)
            column = due.lineitem or await self._column(platform, due)
            # As of now: a platform refuses what is not later than what it has, and Moodle counts from when it took
            # that, in whole seconds. So what it refuses as too old (409) is sent again, as of then.
            score = replace(due.score, stamp=self._tool.now())
            await asyncio.to_thread(self._tool.services.put_score, platform, column, score)
        except LtiError as error:
            return error
        return None

    async def _column(self, platform: Platform, due: Due) -> str:
        if SCOPE_LINEITEM not in due.scopes:
            raise PlatformError("The platform has no column for these grades and lets none be made.", 403)
        services = self._tool.services
        column = await asyncio.to_thread(
            services.lineitem, platform, due.lineitems, due.link, due.title, due.score.most
        )
        own = (links.c.id == due.link_id) & (links.c.lineitem == "")
        await self._database.write(
            lambda writing: (
                writing.connection.execute(update(links).where(own).values(lineitem=column)) and None
            )
        )
        return column
