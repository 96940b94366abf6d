"""All that is kept of a student: where they left off, what they may see of themselves, what the instructor sees."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Container
from typing import Any

import orjson
from sqlalchemy import Connection, RowMapping, Table, select

from . import wall
from .lab_library import KnownLab
from .rows import ClassRow, StudentRow, lab_text, rows_of, told_time
from .schema import attempts, drafts, hand_marks, hints, standings, students
from .schema_lti import links, outbox, platforms, users

Row = dict[str, Any]


def where_left_off(connection: Connection, student: StudentRow, known: KnownLab) -> dict[str, Row]:
    """Per step: design and answers of the newest draft or attempt, the best attempt, hints and hand marks."""
    steps: dict[str, Row] = {name: {"attempts": 0, "hints": [], "hand": []} for name in known.steps}
    for row in _of_steps(connection, standings, student, steps):
        steps[row["step"]] |= _attempted(connection, row)
    for row in _of_steps(connection, drafts, student, steps):
        step, at = steps[row["step"]], told_time(row["at"])
        step["seq"] = row["seq"]
        if at >= step.get("at", ""):
            step |= {**_design(row), "at": at}
    for row in _of_steps(connection, hints, student, steps):
        steps[row["step"]]["hints"].append(row["hint"])
    for row in _of_steps(connection, hand_marks, student, steps):
        steps[row["step"]]["hand"].append(_hand_mark(row))
    return steps


def _of_steps(
    connection: Connection, table: Table, student: StudentRow, steps: Container[str]
) -> list[RowMapping]:
    return [row for row in rows_of(connection, table, student.id) if row["step"] in steps]


def _attempted(connection: Connection, standing: RowMapping) -> Row:
    """How often, how well at best, and with which design last."""
    told: Row = {"attempts": standing["attempts"]}
    best = best_of(connection, standing["best_id"])
    if best is not None:
        told["best"] = best
    of_step = (attempts.c.student_id == standing["student_id"]) & (attempts.c.step == standing["step"])
    newest = select(attempts).where(of_step).order_by(attempts.c.id.desc()).limit(1)
    last = connection.execute(newest).mappings().first()
    if last is not None and last["design"] is not None:
        told |= {**_design(last), "at": told_time(last["at"])}
    return told


def best_of(connection: Connection, attempt_id: int) -> Row | None:
    """An attempt as it was marked, with the answers to which the verdict was given."""
    marked = select(attempts.c.result, attempts.c.answers).where(attempts.c.id == attempt_id)
    row = connection.execute(marked).first()
    if row is None:
        return None
    return {**orjson.loads(row.result), "answers": orjson.loads(row.answers) if row.answers else None}


def _design(row: RowMapping) -> Row:
    return {key: orjson.loads(row[key]) for key in ("design", "answers")}


def joined(connection: Connection, of: ClassRow, student: StudentRow, known: KnownLab, now: float) -> Row:
    """What a student is told who joins or comes back, but for secret, rig and lab."""
    told: Row = {
        **_person(student),
        "code": of.code,
        "title": of.title,
        "ends": told_time(of.ends),
        "at": told_time(now),
        **wall.opening(of, now),
        "steps": where_left_off(connection, student, known),
    }
    if student.at_step is not None:
        told["step"] = student.at_step
    return told


def everything(connection: Connection, student: StudentRow, known: KnownLab, now: float) -> Row:
    """Everything that is kept of a student: for themselves (data access), the instructor and the export."""
    steps = where_left_off(connection, student, known)
    tries: defaultdict[str, list[Row]] = defaultdict(list)
    chosen = select(attempts).where(attempts.c.student_id == student.id).order_by(attempts.c.id)
    for row in connection.execute(chosen).mappings():
        tries[row["step"]].append(_try(row))
    for name, step in steps.items():
        step["tries"] = tries[name]
    for row in _of_steps(connection, drafts, student, steps):
        steps[row["step"]]["draft"] = {**_design(row), "at": told_time(row["at"])}
    return {**_person(student), "at": told_time(now), "steps": steps}


def _try(row: RowMapping) -> Row:
    """An attempt with its marks; of one that is long past without design and answers."""
    result = orjson.loads(row["result"])
    told: Row = {
        "id": row["client_id"],
        "at": told_time(row["at"]),
        "points": row["points"],
        "of": result["of"],
        "result": result,
    }
    if row["handed_at"] is not None:
        told["handed_at"] = told_time(row["handed_at"])
    return told if row["design"] is None else {**told, **_design(row)}


def export(connection: Connection, of: ClassRow, known: KnownLab, now: float) -> Row:
    """A whole class, with the lab's text, to be taken out."""
    people = connection.execute(
        select(students).where(students.c.class_id == of.id).order_by(students.c.number)
    ).mappings()
    return {
        **wall.about(of, known, now),
        "lab_text": lab_text(connection, of.id),
        "students": [everything(connection, StudentRow(**person), known, now) for person in people.all()],
    }


def at_platform(connection: Connection, student: StudentRow) -> Row:
    """What is kept of a student who came by a learning platform; empty of all others."""
    row = connection.execute(
        select(platforms.c.name, users.c.subject, outbox.c.points, outbox.c.sent)
        .select_from(users.join(links, links.c.id == users.c.link_id))
        .join(platforms, platforms.c.id == links.c.platform_id)
        .outerjoin(outbox, outbox.c.user_id == users.c.id)
        .where(users.c.student_id == student.id)
    ).first()
    if row is None:
        return {}
    told: Row = {"name": row.name, "subject": row.subject}
    grade = {} if row.points is None else {"points": row.points, "sent": bool(row.sent)}
    return {"platform": {**told, **grade}}


def _person(student: StudentRow) -> Row:
    told: Row = {
        "id": student.id,
        "number": student.number,
        "name": student.name,
        "joined": told_time(student.joined),
        "last_seen": told_time(student.seen),
    }
    return told | {key: value for key in ("email", "login") if (value := getattr(student, key)) is not None}


def _hand_mark(row: Any) -> Row:
    return {
        "question": row["question"],
        "points": row["points"],
        "comment": row["comment"],
        "at": told_time(row["at"]),
    }
