"""What students send: attempts, drafts, hints that they take. Each may come twice and counts once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import orjson
from sqlalchemy import Connection, func, null, select, update

from .database import Writing
from .errors import ClassError, unknown_secret
from .handed import Draft, Handed
from .rows import ClassRow, StudentRow, for_student, insert_into, json_of, told_time
from .schema import attempts, drafts, hints, standings, students
from .states import best_of

KEPT_WHOLE = 20
"""Newest attempts of a student's step that keep design and answers; so does the best one. Of older ones the marks
are kept."""
MOST_ATTEMPTS = 1000
"""Attempts of one student in all."""


@dataclass(frozen=True)
class Waiting:
    """An attempt that is to be marked: who hands it in, and which hints were taken."""

    of: ClassRow
    student: StudentRow
    hints: tuple[int, ...]


def looked_up(
    connection: Connection, code: str, secret: str, handed: Handed, now: float
) -> Waiting | dict[str, Any]:
    """Who hands in; or the reply, if this attempt has been answered before.

    Raises:
        ClassError: unknown_class, unknown_secret, class_closed, too many attempts.
    """
    of, student = for_student(connection, code, secret)
    known = _kept(connection, student.id, handed.client_id)
    if known is not None:
        return known
    of.require_open(now)
    mine = standings.c.student_id == student.id
    if (
        connection.execute(select(func.sum(standings.c.attempts)).where(mine)).scalar() or 0
    ) >= MOST_ATTEMPTS:
        raise ClassError(
            429,
            f"You have handed in {MOST_ATTEMPTS} times; no more is taken.",
            "too_many_attempts",
            hint="Your best attempts count.",
            retry_after=3600,
        )
    return Waiting(of, student, taken_hints(connection, student.id, handed.step))


def keep(writing: Writing, waiting: Waiting, handed: Handed, result: Mapping[str, Any], now: float) -> Any:
    """Keeps a marked attempt and answers it; one that is kept already is answered as it was."""
    connection, student = writing.connection, waiting.student
    # What was judged: on the student's rig and the step's locks. The marks need it no second time.
    design, result = result["body"], {name: part for name, part in result.items() if name != "body"}
    if (known := _kept(connection, student.id, handed.client_id)) is not None:
        return known
    _require_there(connection, student)
    before = connection.execute(
        select(standings).where(standings.c.student_id == student.id, standings.c.step == handed.step)
    ).first()
    better = before is None or result["points"] > before.points
    number = connection.execute(
        insert_into(connection, attempts)
        .values(
            student_id=student.id,
            client_id=handed.client_id,
            step=handed.step,
            at=now,
            handed_at=handed.handed_at,
            design=json_of(design),
            answers=json_of(handed.answers),
            result=json_of(result),
            points=result["points"],
            best_id=None if better or before is None else before.best_id,
        )
        .on_conflict_do_nothing()
        .returning(attempts.c.id)
    ).scalar()
    if number is None:  # another replica has kept it in this moment
        return _kept(connection, student.id, handed.client_id)
    _raise_standing(connection, student.id, handed, result, number=number, better=better, now=now)
    poles = design.get("poles")
    changes: dict[str, Any] = {"seen": now, "at_step": handed.step, "stable": result.get("stable")}
    if poles:
        changes["poles"] = json_of(poles)
    connection.execute(update(students).where(students.c.id == student.id).values(**changes))
    writing.changed(waiting.of.id, student.id)
    return _kept(connection, student.id, handed.client_id)


def _raise_standing(
    connection: Connection,
    student_id: int,
    handed: Handed,
    result: Mapping[str, Any],
    *,
    number: int,
    better: bool,
    now: float,
) -> None:
    """Counts the attempt, notes it if it is the best, and lets those long past keep their marks alone."""
    met = json_of([goal.get("met") for goal in result["goals"]])
    by_hand = {told["name"] for told in result["questions"] if told.get("met") is None}
    texts = [name for name in sorted(by_hand) if str(handed.answers.get(name) or "").strip()]
    insert = insert_into(connection, standings).values(
        student_id=student_id,
        step=handed.step,
        attempts=1,
        best_id=number,
        points=result["points"],
        met=met,
        last_met=met,
        texts=json_of(texts),
        at=now,
    )
    changes: dict[str, Any] = {"attempts": standings.c.attempts + 1, "last_met": met, "at": now}
    if texts:
        changes["texts"] = json_of(texts)
    if better:
        changes |= {"best_id": number, "points": result["points"], "met": met}
    insert = insert.on_conflict_do_update(
        index_elements=[standings.c.student_id, standings.c.step], set_=changes
    ).returning(standings.c.attempts, standings.c.best_id)
    standing = connection.execute(insert).mappings().one()
    if standing["attempts"] > KEPT_WHOLE:
        of_step = (attempts.c.student_id == student_id) & (attempts.c.step == handed.step)
        newest = select(attempts.c.id).where(of_step).order_by(attempts.c.id.desc()).limit(KEPT_WHOLE)
        past = (
            of_step
            & attempts.c.id.not_in(newest)
            & (attempts.c.id != standing["best_id"])
            & attempts.c.design.is_not(None)
        )
        connection.execute(update(attempts).where(past).values(design=null(), answers=null()))


def _kept(connection: Connection, student_id: int, client_id: str) -> dict[str, Any] | None:
    """The reply to an attempt that is kept, the same for ever; None if there is none."""
    of_page = (attempts.c.student_id == student_id) & (attempts.c.client_id == client_id)
    row = connection.execute(select(attempts).where(of_page)).first()
    if row is None:
        return None
    result = orjson.loads(row.result)
    best = best_of(connection, row.id if row.best_id is None else row.best_id)
    reply = {**result, "id": row.client_id, "step": row.step, "at": told_time(row.at), "best": best}
    if row.handed_at is not None:
        reply["handed_at"] = told_time(row.handed_at)
    return reply


def keep_draft(writing: Writing, of: ClassRow, student: StudentRow, draft: Draft, now: float) -> None:
    """Keeps where a student is, unless what is kept is newer.

    Raises:
        ClassError: class_closed.
    """
    connection = writing.connection
    of.require_open(now)
    own = {
        "seq": draft.seq,
        "design": json_of(draft.design),
        "answers": json_of(draft.answers),
        "at": now,
    }
    insert = insert_into(connection, drafts).values(student_id=student.id, step=draft.step, **own)
    newer = drafts.c.seq < draft.seq
    changed = connection.execute(
        insert.on_conflict_do_update(
            index_elements=[drafts.c.student_id, drafts.c.step], set_=own, where=newer
        ).returning(drafts.c.seq)
    ).first()
    if changed is not None:
        changes: dict[str, Any] = {"seen": now, "at_step": draft.step}
        if draft.design.get("poles"):
            changes["poles"] = json_of(draft.design["poles"])
        connection.execute(update(students).where(students.c.id == student.id).values(**changes))
        writing.changed(of.id, student.id)


def take_hint(
    writing: Writing, of: ClassRow, student: StudentRow, *, step: str, hint: int, now: float
) -> None:
    """Notes a hint that a student takes; once.

    Raises:
        ClassError: class_closed, if the hint is not taken already.
    """
    connection = writing.connection
    if hint in taken_hints(connection, student.id, step):
        return
    of.require_open(now)
    row = {"student_id": student.id, "step": step, "hint": hint, "at": now}
    connection.execute(insert_into(connection, hints).values(**row).on_conflict_do_nothing())
    connection.execute(update(students).where(students.c.id == student.id).values(seen=now, at_step=step))
    writing.changed(of.id, student.id)


def taken_hints(connection: Connection, student_id: int, step: str) -> tuple[int, ...]:
    """The hints of a step that a student has taken, 1-based."""
    chosen = select(hints.c.hint).where(hints.c.student_id == student_id, hints.c.step == step)
    return tuple(connection.execute(chosen.order_by(hints.c.hint)).scalars())


def _require_there(connection: Connection, student: StudentRow) -> None:
    """Refuses what is kept of a student who was deleted while it was marked.

    Raises:
        ClassError: unknown_secret.
    """
    chosen = select(students.c.id).where(students.c.id == student.id).with_for_update()
    if connection.execute(chosen).first() is None:
        raise unknown_secret("student")
