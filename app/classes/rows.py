"""Finding what a call is about: the class by its code, the people by their secrets."""

from __future__ import annotations

from dataclasses import dataclass
from datetime import UTC, datetime
from time import time
from typing import Any

import orjson
from sqlalchemy import Connection, RowMapping, Table, select
from sqlalchemy.dialects import postgresql, sqlite

from .errors import class_closed, unknown_class, unknown_secret, unknown_student
from .keys import code_of, fits, hash_of
from .schema import classes, students

CLASS = [column for column in classes.c if column.name != "lab_text"]
"""The columns of a class but for its lab's text, which is long and never changes."""


@dataclass(frozen=True)
class ClassRow:
    """A class, as it stands in the database, but for its lab's text; times in seconds since 1970."""

    id: int
    code: str
    lab_name: str
    title: str
    instructor_hash: str
    seed: str
    created: float
    closes: float | None
    open: bool
    closed: float | None
    ends: float
    joined: int
    version: int

    def is_open(self, now: float) -> bool:
        """Whether attempts are taken."""
        return self.open and (self.closes is None or now < self.closes)

    def closed_at(self, now: float) -> float | None:
        """Since when none are; None while they are."""
        if self.is_open(now):
            return None
        return self.closed if not self.open and self.closed is not None else self.closes

    def require_open(self, now: float) -> None:
        """Refuses what a closed class does not take.

        Raises:
            ClassError: class_closed.
        """
        if not self.is_open(now):
            closed = self.closed_at(now)
            raise class_closed(told_time(closed) if closed is not None else None)


@dataclass(frozen=True)
class StudentRow:
    """A student, as they stand in the database."""

    id: int
    class_id: int
    number: int
    name: str
    email: str | None
    login: str | None
    secret_hash: str
    seed: int
    joined: float
    seen: float
    at_step: str | None
    poles: str | None
    stable: bool | None
    version: int


def told_time(seconds: float) -> str:
    """A time as replies have it: ISO 8601, UTC."""
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds").replace("+00:00", "Z")


def json_of(value: Any) -> str:
    """A value as the database keeps it."""
    return orjson.dumps(value, option=orjson.OPT_SERIALIZE_NUMPY).decode()


def class_by_code(connection: Connection, code: str) -> ClassRow:
    """The class of a code, as it is typed.

    Raises:
        ClassError: unknown_class; also when the class has ended and nobody has cleared it away yet.
    """
    row = connection.execute(select(*CLASS).where(classes.c.code == code_of(code))).mappings().first()
    if row is None or row["ends"] <= time():
        raise unknown_class()
    return ClassRow(**row)


def for_instructor(connection: Connection, code: str, secret: str) -> ClassRow:
    """The class of a code, for who has its instructor's secret.

    Raises:
        ClassError: unknown_class, unknown_secret.
    """
    found = class_by_code(connection, code)
    if not fits(secret, found.instructor_hash):
        raise unknown_secret("instructor")
    return found


def for_student(connection: Connection, code: str, secret: str) -> tuple[ClassRow, StudentRow]:
    """The class of a code and the student of it who has this secret.

    Raises:
        ClassError: unknown_class, unknown_secret.
    """
    found = class_by_code(connection, code)
    of_class = students.c.class_id == found.id
    row = connection.execute(select(students).where(of_class, students.c.secret_hash == hash_of(secret)))
    student = row.mappings().first()
    if student is None or not fits(secret, student["secret_hash"]):
        raise unknown_secret("student")
    return found, StudentRow(**student)


def student_by_id(connection: Connection, class_id: int, student_id: int) -> StudentRow:
    """A student of a class.

    Raises:
        ClassError: unknown_student.
    """
    of_class = students.c.class_id == class_id
    row = connection.execute(select(students).where(of_class, students.c.id == student_id)).mappings().first()
    if row is None:
        raise unknown_student()
    return StudentRow(**row)


def lab_text(connection: Connection, class_id: int) -> str:
    """The text of a class's lab, as it was frozen.

    Raises:
        ClassError: unknown_class, where it was deleted just now.
    """
    text = connection.execute(select(classes.c.lab_text).where(classes.c.id == class_id)).scalar()
    if text is None:
        raise unknown_class()
    return text


def insert_into(connection: Connection, table: Table) -> Any:
    """An INSERT that can say what happens ON CONFLICT, in the database's own words."""
    return (postgresql if connection.dialect.name == "postgresql" else sqlite).insert(table)


def rows_of(connection: Connection, table: Table, student_id: int) -> list[RowMapping]:
    """All rows of a student in a table."""
    chosen = select(table).where(table.c.student_id == student_id)
    return list(connection.execute(chosen.order_by(*table.primary_key.columns)).mappings())
