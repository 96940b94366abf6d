"""Making a class, joining it, and all that its instructor does with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from sqlalchemy import delete, func, insert, select, update

from .database import Writing
from .errors import ClassError, unknown_class
from .keys import hash_of, new_code, new_secret, new_seed
from .lab_library import KnownLab
from .rows import CLASS, ClassRow, StudentRow, for_instructor, for_student, insert_into, student_by_id
from .schema import chores, classes, hand_marks, students

_HOUR = 3600.0
_DAY = 24 * _HOUR
_CODES_TRIED = 20


@dataclass(frozen=True)
class NewClass:
    """A class that is to be made; its secrets are made before, so that trying again makes no second one."""

    known: KnownLab
    title: str
    closes: float | None
    days: int
    most: int
    instructor: str
    seed: str

    @staticmethod
    def of(known: KnownLab, title: str, closes: float | None, days: int, most: int) -> NewClass:
        """With fresh secrets."""
        return NewClass(known, title, closes, days, most, new_secret(), new_secret())


def make(writing: Writing, new: NewClass, now: float) -> ClassRow:
    """Makes a class.

    Raises:
        ClassError: too_many_classes.
    """
    connection = writing.connection
    if (connection.execute(select(func.count()).select_from(classes)).scalar() or 0) >= new.most:
        hint = "Delete classes that are over, or raise HELI2DOF_CLASSES_MOST."
        raise ClassError(503, f"This server keeps {new.most} classes already.", "too_many_classes", hint=hint)
    values: dict[str, Any] = {
        "lab_name": new.known.lab.name,
        "lab_text": new.known.file,
        "title": new.title,
        "instructor_hash": hash_of(new.instructor),
        "seed": new.seed,
        "created": now,
        "closes": new.closes,
        "open": True,
        "ends": now + new.days * _DAY,
        "joined": 0,
        "version": 1,
    }
    for _ in range(_CODES_TRIED):
        row = (
            connection.execute(
                insert_into(connection, classes)
                .values(code=new_code(), **values)
                .on_conflict_do_nothing(index_elements=[classes.c.code])
                .returning(*CLASS)
            )
            .mappings()
            .first()
        )
        if row is not None:
            return ClassRow(**row)
    raise ClassError(503, "No free code was found.", "too_many_classes", hint="Try again.", retry_after=1)


@dataclass(frozen=True)
class NewStudent:
    """Somebody who joins."""

    name: str
    email: str | None
    login: str | None
    secret: str
    seed: int

    @staticmethod
    def of(name: str, email: str | None, login: str | None, secret: str | None = None) -> NewStudent:
        """With a rig of their own, and a fresh secret where none is given."""
        return NewStudent(name, email, login, secret or new_secret(), new_seed())


def join(writing: Writing, of: ClassRow, new: NewStudent, most: int, now: float) -> StudentRow:
    """Adds a student to a class; one who has joined by the same secret is that one.

    Raises:
        ClassError: class_closed, class_full.
    """
    connection = writing.connection
    # The class's row is held from here on, so that the same request on two replicas is one student, numbers are
    # given once, and the bound holds.
    held = select(classes.c.id).where(classes.c.id == of.id).with_for_update()
    if connection.execute(held).first() is None:
        raise unknown_class()
    mine = (students.c.class_id == of.id) & (students.c.secret_hash == hash_of(new.secret))
    known = connection.execute(select(students).where(mine)).mappings().first()
    if known is not None:
        return StudentRow(**known)
    of.require_open(now)
    counted = update(classes).where(classes.c.id == of.id).values(joined=classes.c.joined + 1)
    number = connection.execute(counted.returning(classes.c.joined)).scalar_one()
    of_class = students.c.class_id == of.id
    if (connection.execute(select(func.count()).where(of_class)).scalar() or 0) >= most:
        detail = f"The class is full: {most} students have joined."
        raise ClassError(409, detail, "class_full", hint="Ask your instructor, who can remove some.")
    row = (
        connection.execute(
            insert(students)
            .values(
                class_id=of.id,
                number=number,
                name=new.name,
                email=new.email,
                login=new.login,
                secret_hash=hash_of(new.secret),
                seed=new.seed,
                joined=now,
                seen=now,
                version=0,
            )
            .returning(students)
        )
        .mappings()
        .one()
    )
    writing.changed(of.id, row["id"])
    return StudentRow(**row)


def change(writing: Writing, code: str, secret: str, changes: dict[str, Any], now: float) -> ClassRow:
    """Changes a class's title, when it closes, whether it is open."""
    of = for_instructor(writing.connection, code, secret)
    if "open" in changes:
        changes["closed"] = None if changes["open"] else now
        if changes["open"] and "closes" not in changes and of.closes is not None and of.closes <= now:
            changes["closes"] = None  # opened again by hand: a time that is over closes it no more
    if changes:
        writing.connection.execute(update(classes).where(classes.c.id == of.id).values(**changes))
        writing.changed(of.id)
    return for_instructor(writing.connection, code, secret)


def rotate(writing: Writing, code: str, secret: str, new: str) -> ClassRow:
    """Gives the class another instructor's secret; the old one ends."""
    connection = writing.connection
    try:
        of = for_instructor(connection, code, secret)
    except ClassError:
        return for_instructor(connection, code, new)  # done already, and tried again
    connection.execute(update(classes).where(classes.c.id == of.id).values(instructor_hash=hash_of(new)))
    writing.changed(of.id)
    return of


def new_link(writing: Writing, code: str, secret: str, student_id: int, new: str) -> ClassRow:
    """Gives a student another secret; the old one ends."""
    connection = writing.connection
    of = for_instructor(connection, code, secret)
    student = student_by_id(connection, of.id, student_id)
    connection.execute(update(students).where(students.c.id == student.id).values(secret_hash=hash_of(new)))
    writing.changed(of.id, student.id)
    return of


def mark_by_hand(writing: Writing, of: ClassRow, student_id: int, mark: dict[str, Any]) -> None:
    """Keeps a hand mark: step, question, points, comment and time."""
    connection = writing.connection
    student = student_by_id(connection, of.id, student_id)
    own = {key: mark[key] for key in ("points", "comment", "at")}
    row = {"student_id": student.id, "step": mark["step"], "question": mark["question"], **own}
    keys = [hand_marks.c.student_id, hand_marks.c.step, hand_marks.c.question]
    statement = insert_into(connection, hand_marks).values(**row)
    connection.execute(statement.on_conflict_do_update(index_elements=keys, set_=own))
    writing.changed(of.id, student.id)


def delete_student(writing: Writing, code: str, secret: str, student_id: int) -> None:
    """Deletes a student and all of theirs."""
    of = for_instructor(writing.connection, code, secret)
    _delete(writing, student_by_id(writing.connection, of.id, student_id))


def delete_mine(writing: Writing, code: str, secret: str) -> None:
    """Deletes who has this secret, and all of theirs."""
    _delete(writing, for_student(writing.connection, code, secret)[1])


def _delete(writing: Writing, student: StudentRow) -> None:
    writing.connection.execute(delete(students).where(students.c.id == student.id))
    writing.changed(student.class_id)


def delete_class(writing: Writing, code: str, secret: str) -> None:
    """Deletes a class and everybody in it."""
    of = for_instructor(writing.connection, code, secret)
    writing.connection.execute(delete(classes).where(classes.c.id == of.id))


def purge(writing: Writing, now: float) -> int | None:
    """Deletes the classes that have ended; once an hour, by whichever replica comes first.

    Returns:
        How many; None where it was another one's turn.
    """
    connection = writing.connection
    first = insert_into(connection, chores).values(name="purge", done=0.0).on_conflict_do_nothing()
    connection.execute(first)
    due = (chores.c.name == "purge") & (chores.c.done <= now - 0.9 * _HOUR)
    if connection.execute(update(chores).where(due).values(done=now)).rowcount != 1:
        return None
    return connection.execute(delete(classes).where(classes.c.ends <= now)).rowcount
