"""From a launch to a class: made at the link's first launch, joined by each student once."""

from __future__ import annotations

import json
import secrets
from dataclasses import dataclass, field, replace
from typing import Any

from sqlalchemy import Connection, Row, RowMapping, insert, select, update

from ..classes import people
from ..classes.database import Writing
from ..classes.keys import fits, hash_of, secret_for
from ..classes.rows import CLASS, ClassRow
from ..classes.schema import classes, students
from ..classes.schema_lti import links, outbox, platforms, users
from .launch import Launch
from .platforms import Platform


@dataclass(frozen=True)
class Place:
    """Where somebody lands: the class's code, and the secret that opens it for them."""

    code: str
    secret: str
    instructor: bool

    def address(self, platform: Platform) -> str:
        """The page, with what opens it behind the #: that part is sent to nobody."""
        if self.instructor:
            return f"{platform.address}/class#class={self.code}&key={self.secret}"
        return f"{platform.address}/#class={self.code}&me={self.secret}"


@dataclass(frozen=True)
class Arrival:
    """Somebody who comes by a launch.

    Attributes:
        platform: from which.
        launch: by which.
        most: students that a class may have.
        now: seconds since 1970.
        request: random; of it and the class's seed are made the secrets that are new.
    """

    platform: Platform
    launch: Launch
    most: int
    now: float
    request: str = field(default_factory=lambda: secrets.token_urlsafe(24))


def _instructor_secret(seed: str, request: str) -> str:
    """The same at each launch, and none that a page could ask for."""
    return secret_for(seed, f"lti instructor {request}")


def _student_secret(seed: str, request: str) -> str:
    return secret_for(seed, f"lti student {request}")


def class_of(connection: Connection, platform: Platform, launch: Launch, now: float) -> ClassRow | None:
    """The class of a link; None while there is none, or none any more."""
    row = _link(connection, platform, launch)
    if row is None:
        return None
    found = connection.execute(select(*CLASS).where(classes.c.id == row.class_id)).mappings().one()
    return ClassRow(**found) if found["ends"] > now else None


def _link(connection: Connection, platform: Platform, launch: Launch) -> Row[Any] | None:
    same = (links.c.platform_id == platform.id) & (links.c.deployment == launch.deployment)
    return connection.execute(select(links).where(same & (links.c.link == launch.link))).first()


def _take_turn(connection: Connection, platform: Platform) -> None:
    """Holds a platform's row until the transaction ends.

    So that of two launches at one moment on two replicas the second sees what the first has made.
    """
    held = select(platforms.c.id).where(platforms.c.id == platform.id)
    connection.execute(held.with_for_update(key_share=True))  # launches that only begin go on


def tie(writing: Writing, arrival: Arrival, new: people.NewClass) -> ClassRow:
    """Makes the class of a link; where somebody was quicker it is theirs.

    Raises:
        ClassError: no more classes are kept here.
    """
    connection, platform, launch = writing.connection, arrival.platform, arrival.launch
    _take_turn(connection, platform)
    if (known := class_of(connection, platform, launch, arrival.now)) is not None:
        return known
    if (ended := _link(connection, platform, launch)) is not None:
        connection.execute(links.delete().where(links.c.id == ended.id))
    own = replace(new, instructor=_instructor_secret(new.seed, arrival.request))
    made = people.make(writing, own, arrival.now)
    values = {"platform_id": platform.id, "deployment": launch.deployment, "link": launch.link}
    told = {"class_id": made.id, "request": arrival.request, "graded": 0, **_services(launch)}
    connection.execute(insert(links).values(**values, **told))
    return made


def _services(launch: Launch) -> dict[str, str]:
    return {
        "lineitem": launch.lineitem,
        "lineitems": launch.lineitems,
        "scopes": json.dumps(launch.scopes),
        "members": launch.members,
    }


def enter(writing: Writing, arrival: Arrival, of: ClassRow) -> Place:
    """Lets somebody into the class of their link.

    Raises:
        ClassError: the class is full, or closed and this student has not joined before.
    """
    _take_turn(writing.connection, arrival.platform)
    row = _link(writing.connection, arrival.platform, arrival.launch)
    if row is None:
        raise LookupError("a link is tied before anybody enters")
    _keep_services(writing.connection, row, arrival)
    if arrival.launch.instructor:
        return Place(of.code, _teach(writing, arrival, of, row), instructor=True)
    same = (users.c.link_id == row.id) & (users.c.subject == arrival.launch.subject)
    user = (
        writing.connection.execute(
            select(users.c.request, students).join(students, students.c.id == users.c.student_id).where(same)
        )
        .mappings()
        .first()
    )
    secret = _join(writing, arrival, of, row.id) if user is None else _return(writing, arrival, of, user)
    return Place(of.code, secret, instructor=False)


def _keep_services(connection: Connection, row: Row[Any], arrival: Arrival) -> None:
    """Keeps where grades go; where that is new, those that wait are tried again at once."""
    told = _services(arrival.launch)
    if not told["lineitem"] and told["lineitems"] == row.lineitems:
        told["lineitem"] = row.lineitem  # one that this server has made
    if all(getattr(row, name) == value for name, value in told.items()):
        return
    connection.execute(update(links).where(links.c.id == row.id).values(**told))
    of_link = select(users.c.id).where(users.c.link_id == row.id)
    late = outbox.c.user_id.in_(of_link) & outbox.c.sent.is_(False)
    connection.execute(update(outbox).where(late).values(due=arrival.now))


def _teach(writing: Writing, arrival: Arrival, of: ClassRow, row: Row[Any]) -> str:
    """The class's secret. Where another was set, by a rotation, it gives way: who teaches comes by the platform."""
    secret = _instructor_secret(of.seed, row.request)
    if fits(secret, of.instructor_hash):
        return secret
    secret = _instructor_secret(of.seed, arrival.request)
    writing.connection.execute(update(links).where(links.c.id == row.id).values(request=arrival.request))
    other = {"instructor_hash": hash_of(secret)}
    writing.connection.execute(update(classes).where(classes.c.id == of.id).values(**other))
    writing.changed(of.id)
    return secret


def _join(writing: Writing, arrival: Arrival, of: ClassRow, link_id: int) -> str:
    secret = _student_secret(of.seed, arrival.request)
    name = arrival.launch.name or f"Student {of.joined + 1}"
    new = people.NewStudent.of(name, None, None, secret)
    student = people.join(writing, of, new, arrival.most, arrival.now)
    values = {"link_id": link_id, "subject": arrival.launch.subject, "student_id": student.id}
    writing.connection.execute(insert(users).values(**values, request=arrival.request))
    return secret


def _return(writing: Writing, arrival: Arrival, of: ClassRow, user: RowMapping) -> str:
    """The secret of somebody who has joined. Where the instructor has given out another link, that one ends."""
    secret = _student_secret(of.seed, user["request"])
    changes: dict[str, Any] = {}
    if not fits(secret, user["secret_hash"]):
        secret = _student_secret(of.seed, arrival.request)
        own = users.c.student_id == user["id"]
        writing.connection.execute(update(users).where(own).values(request=arrival.request))
        changes["secret_hash"] = hash_of(secret)
    if arrival.launch.name and arrival.launch.name != user["name"]:
        changes["name"] = arrival.launch.name
    if changes:
        own = students.c.id == user["id"]
        writing.connection.execute(update(students).where(own).values(**changes))
        writing.changed(of.id, user["id"])
    return secret


def roster_of(connection: Connection, class_id: int) -> tuple[int, str, dict[str, int]] | None:
    """The platform's id, where the course's members are told, and the students who have joined, by subject.

    None where the class has no link.
    """
    row = connection.execute(select(links).where(links.c.class_id == class_id)).first()
    if row is None:
        return None
    joined = connection.execute(select(users.c.subject, users.c.student_id).where(users.c.link_id == row.id))
    return row.platform_id, row.members, {user.subject: user.student_id for user in joined}
