"""What the instructor sees of a class: a row for each student, who is where, and which goal holds them up."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from typing import Any

import orjson
from sqlalchemy import Connection, RowMapping, func, select

from .lab_library import KnownLab
from .rows import ClassRow, told_time
from .schema import hand_marks, hints, standings, students

ONLINE = 90.0
"""Seconds after the last sign of a student for which they are there; a page that is only read looks once a minute."""
_TOLD_OF_HELD_UP = 12

Row = dict[str, Any]


def steps_of(known: KnownLab) -> list[Row]:
    """The lab's steps, goals and questions, as the heads of the wall's columns."""
    return [
        {
            "name": step["name"],
            "title": step["title"],
            "points": step["points"],
            "goals": [
                {
                    key: goal[key]
                    for key in ("name", "label", "required_text", "points")
                    if goal.get(key) is not None
                }
                for goal in step["goals"]
            ],
            "questions": [
                {
                    key: question[key]
                    for key in ("name", "kind", "text", "points")
                    if question.get(key) is not None
                }
                | {"by_hand": question["kind"] == "text"}
                for question in step["questions"]
            ],
        }
        for step in known.steps.values()
    ]


def about(of: ClassRow, known: KnownLab, now: float) -> Row:
    """What is told of the class itself."""
    told: Row = {
        "code": of.code,
        "title": of.title,
        "lab": {
            key: known.view[key] for key in ("name", "number", "title") if known.view.get(key) is not None
        },
        "points": known.view["points"],
        "created": told_time(of.created),
        "ends": told_time(of.ends),
        "version": of.version,
        "at": told_time(now),
        "student_link": f"#class={of.code}",
        **opening(of, now),
    }
    if known.view.get("minutes") is not None:
        told["minutes"] = known.view["minutes"]
    return told


def opening(of: ClassRow, now: float) -> Row:
    """Whether a class is open, since when not, and when it closes by itself."""
    told: Row = {"open": of.is_open(now)}
    if of.closes is not None:
        told["closes"] = told_time(of.closes)
    if (closed := of.closed_at(now)) is not None:
        told["closed_at"] = told_time(closed)
    return told


def rows(
    connection: Connection,
    of: ClassRow,
    known: KnownLab,
    now: float,
    *,
    since: int = -1,
    only: int | None = None,
) -> list[Row]:
    """The rows of those students of whom something has changed since a version of the class; or of one."""
    chosen = (students.c.class_id == of.id) & (students.c.version > since)
    if only is not None:
        chosen &= students.c.id == only
    people = connection.execute(select(students).where(chosen).order_by(students.c.number)).mappings().all()
    ids = select(students.c.id).where(chosen)
    standing, taken, marks = (
        defaultdict[int, dict[str, Any]](dict),
        defaultdict[tuple[int, str], int](int),
        defaultdict[tuple[int, str], dict[str, float]](dict),
    )
    for one in connection.execute(select(standings).where(standings.c.student_id.in_(ids))).mappings():
        standing[one["student_id"]][one["step"]] = one
    counted = select(hints.c.student_id, hints.c.step, func.count()).where(hints.c.student_id.in_(ids))
    for student_id, step, count in connection.execute(counted.group_by(hints.c.student_id, hints.c.step)):
        taken[student_id, step] = count
    for one in connection.execute(select(hand_marks).where(hand_marks.c.student_id.in_(ids))).mappings():
        marks[one["student_id"], one["step"]][one["question"]] = one["points"]
    told = []
    for person in people:
        steps = {
            name: _step(
                step, standing[person["id"]].get(name), taken[person["id"], name], marks[person["id"], name]
            )
            for name, step in known.steps.items()
        }
        row: Row = {key: person[key] for key in ("id", "name", "number")}
        row |= {key: person[key] for key in ("email", "login", "stable") if person[key] is not None}
        if person["at_step"] is not None:
            row["step"] = person["at_step"]
        if person["poles"]:
            row["poles"] = [
                p if isinstance(p, dict) else {"re": p, "im": 0.0} for p in orjson.loads(person["poles"])
            ]
        row |= {
            "points": _rounded(sum(step["points"] for step in steps.values())),
            "of": known.view["points"],
            "joined": told_time(person["joined"]),
            "last_seen": told_time(person["seen"]),
            "online": now - person["seen"] < ONLINE,
            "steps": steps,
        }
        told.append(row)
    return told


def _step(
    step: Mapping[str, Any], standing: RowMapping | None, hints_taken: int, marks: Mapping[str, float]
) -> Row:
    if standing is None:
        given, goals, tries, to_mark = 0.0, [], 0, 0
    else:
        given, goals, tries = standing["points"], orjson.loads(standing["met"]), standing["attempts"]
        to_mark = len(set(orjson.loads(standing["texts"])) - set(marks))
    told: Row = {
        "points": _rounded(given + sum(marks.values())),
        "of": step["points"],
        "goals": goals,
        "attempts": tries,
        "hints": hints_taken,
        "to_mark": to_mark,
    }
    return told if standing is None else {**told, "last": orjson.loads(standing["last_met"])}


def _rounded(points: float) -> float:
    """Without what adding leaves behind the digits."""
    return round(points, 6)


def ids(connection: Connection, class_id: int) -> set[int]:
    """Who is in the class."""
    return set(connection.execute(select(students.c.id).where(students.c.class_id == class_id)).scalars())


def held_up(known: KnownLab, people: Iterable[Row]) -> list[Row]:
    """The goals that hold most students up: for each who has tried it or is there now, and how many meet it."""
    people, told = list(people), []
    for name, step in known.steps.items():
        there = [row for row in people if row["steps"][name]["attempts"] or row.get("step") == name]
        tried = [row for row in there if row["steps"][name]["attempts"]]
        for k, goal in enumerate(step["goals"]):
            met = sum(row["steps"][name]["goals"][k : k + 1] == [True] for row in tried)
            if len(tried) > met:
                counts = {"students": len(there), "met": met, "tried": len(tried)}
                told.append({"step": name, "goal": goal["name"], **counts})
    return sorted(told, key=lambda one: one["met"] - one["tried"])[:_TOLD_OF_HELD_UP]


def snapshot(connection: Connection, of: ClassRow, known: KnownLab, now: float) -> Row:
    """The whole class."""
    people = rows(connection, of, known, now)
    return {
        **about(of, known, now),
        "steps": steps_of(known),
        "students": people,
        "held_up": held_up(known, people),
    }
