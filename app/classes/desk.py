"""All that is done with classes, as the calls and an LMS do it: who asks, then marked, then kept, then answered."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from time import time
from typing import Any, TypeVar

from sqlalchemy import Connection

from ..jobs.compute import Compute
from ..ops.settings import Settings
from . import handing, people, sheets, states, wall
from .database import Database, Writing
from .errors import ClassError, unknown_step
from .feeds import Feeds
from .frozen_labs import FrozenLabs
from .handed import Draft, Handed
from .keys import new_secret, secret_for
from .lab_library import KnownLab, Labs, frozen_lab
from .marking import Marker
from .people import NewClass, NewStudent
from .rows import ClassRow, class_by_code, for_instructor, for_student, student_by_id, told_time

T = TypeVar("T")
Reply = dict[str, Any]


class Desk:
    """The classes of a server. Replies are JSON; times are told in ISO 8601, UTC.

    Args:
        settings: of the server.
        compute: threads that mark.
    """

    def __init__(self, settings: Settings, compute: Compute) -> None:
        self._settings = settings
        self._compute = compute
        self.labs = Labs(settings.labs)
        self.database = Database(settings.database_address)
        self.marker = Marker(compute)
        self._feeds = Feeds(self.database)
        self._frozen = FrozenLabs()

    async def make(self, lab: str, title: str, closes: float | None) -> Reply:
        """Makes a class of a lab."""
        known = await asyncio.to_thread(self.labs.named, lab)
        settings = self._settings
        new = NewClass.of(known, title, closes, settings.class_days, settings.classes_most)
        of = await self.database.write(lambda writing: people.make(writing, new, time()))
        return {
            "code": of.code,
            "instructor": new.instructor,
            "student_link": f"#class={of.code}",
            "instructor_link": _instructor_link(of.code, new.instructor),
            "ends": told_time(of.ends),
        }

    async def about(self, code: str) -> Reply:
        """What anyone is told who has the code."""

        def look(connection: Connection) -> Reply:
            of = class_by_code(connection, code)
            return wall.about(of, self._frozen.of(connection, of), time())

        told = await self.database.read(look)
        return {name: value for name, value in told.items() if name not in ("version", "created", "points")}

    async def join(
        self, code: str, name: str, email: str | None, login: str | None, request: str | None
    ) -> Reply:
        """Adds a student; whoever sends the same request again is the same one."""
        of = await self.database.read(lambda connection: class_by_code(connection, code))
        secret = new_secret() if request is None else secret_for(of.seed, request)
        new = NewStudent.of(name, email, login, secret)
        most = self._settings.students_most
        await self.database.write(lambda writing: people.join(writing, of, new, most, time()))
        return await self.come_back(code, secret)

    async def come_back(self, code: str, secret: str) -> Reply:
        """Where a student left off, with rig and lab."""

        def look(connection: Connection) -> Reply:
            of, student = for_student(connection, code, secret)
            known = self._frozen.of(connection, of)
            told = states.joined(connection, of, student, known, time())
            taken = {name: step["hints"] for name, step in told["steps"].items()}
            return {"student": secret, **told, "rig": known.rig(student.seed), "lab": known.view_with(taken)}

        return await self.database.read(look)

    async def hand_in(
        self, code: str, secret: str, handed: Handed, allow: Callable[[int, int], None]
    ) -> Reply:
        """Marks an attempt, keeps it, then answers; what was answered once is answered the same again.

        Args:
            code: of the class.
            secret: of the student.
            handed: the attempt.
            allow: is called with class and student before anything is computed, and may refuse.
        """

        def look(connection: Connection) -> tuple[handing.Waiting, KnownLab] | Reply:
            found = handing.looked_up(connection, code, secret, handed, time())
            return found if isinstance(found, dict) else (found, self._frozen.of(connection, found.of))

        looked = await self.database.read(look)
        if isinstance(looked, dict):
            return looked
        found, known = looked
        allow(found.of.id, found.student.id)
        require_step(known, handed.step)
        result = await self.marker.marked(
            known,
            handed.step,
            seed=found.student.seed,
            body=handed.design,
            answers=handed.answers,
            hints=found.hints,
            flight=handed.flight,
            whose=(f"class {found.of.id}", found.student.id),
        )
        return await self.database.write(lambda writing: handing.keep(writing, found, handed, result, time()))

    async def keep_draft(self, code: str, secret: str, draft: Draft) -> None:
        """Keeps where a student is."""

        def keep(writing: Writing) -> None:
            of, student = for_student(writing.connection, code, secret)
            require_step(self._frozen.of(writing.connection, of), draft.step)
            handing.keep_draft(writing, of, student, draft, time())

        await self.database.write(keep)

    async def hint(self, code: str, secret: str, step: str, number: int) -> Reply:
        """The text of a hint, whose cost counts from now on."""

        def take(writing: Writing) -> Reply:
            of, student = for_student(writing.connection, code, secret)
            known = self._frozen.of(writing.connection, of)
            require_step(known, step)
            told = known.hint(step, number)
            handing.take_hint(writing, of, student, step=step, hint=number, now=time())
            return told

        return await self.database.write(take)

    async def mine(self, code: str, secret: str) -> Reply:
        """Everything that is kept of a student, for themselves."""

        def look(connection: Connection) -> Reply:
            of, student = for_student(connection, code, secret)
            known, now = self._frozen.of(connection, of), time()
            joined = states.joined(connection, of, student, known, now)
            kept = states.everything(connection, student, known, now)
            return {**joined, **kept, **states.at_platform(connection, student)}

        return await self.database.read(look)

    async def delete_mine(self, code: str, secret: str) -> None:
        """Deletes a student at their own wish."""
        await self.database.write(lambda writing: people.delete_mine(writing, code, secret))

    async def recording(self, code: str, secret: str, step: str) -> bytes:
        """A recording of a student's own rig, as CSV."""

        def look(connection: Connection) -> tuple[KnownLab, int]:
            of, student = for_student(connection, code, secret)
            return self._frozen.of(connection, of), student.seed

        known, seed = await self.database.read(look)
        return await self.record(known, step, seed)

    async def record(self, known: KnownLab, step: str, seed: int) -> bytes:
        """A recording of the rig of a seed, as CSV.

        Raises:
            ClassError: no_recording, where the step has none.
        """
        require_step(known, step)
        if not known.steps[step].get("recording"):
            raise ClassError(404, "This step has no recording.", "no_recording")
        return await self._compute.run_slow(_recorded, known.file, known.lab.name, step, seed)

    # Alone, without a class: nothing is kept.

    def require_alone(self, known: KnownLab) -> None:
        """Refuses labs of one's own that are for classes.

        Raises:
            ClassError: class_only.
        """
        if not known.alone:
            hint = "Its author can allow it: alone: true in the lab's file."
            raise ClassError(403, "This lab is for classes.", "class_only", hint=hint)

    def view_alone(self, known: KnownLab, seed: int | None) -> Reply:
        """A lab as a student may see it, and the rig of a seed."""
        return known.view if seed is None else {**known.view, "rig": known.rig(seed)}

    def hint_alone(self, known: KnownLab, step: str, number: int) -> Reply:
        """A hint's text."""
        self.require_alone(known)
        require_step(known, step)
        return known.hint(step, number)

    async def mark_alone(self, known: KnownLab, step: str, **given: Any) -> Reply:
        """An attempt's marks; `given` is the seed, the body and what comes with it (see `Marker.marked`)."""
        self.require_alone(known)
        require_step(known, step)
        return await self.marker.marked(known, step, **given)

    # The instructor's.

    async def snapshot(self, code: str, secret: str) -> Reply:
        """The whole class, as the wall shows it."""
        return await self._of_instructor(code, secret, wall.snapshot)

    async def sheet(self, code: str, secret: str, target: str) -> tuple[str, str]:
        """The class as CSV, and the name of its file."""
        told = await self.snapshot(code, secret)
        return sheets.sheet(told, target), f"heli2dof-{told['code']}-{target}.csv"

    async def events(self, code: str, secret: str, ending: Callable[[], bool]) -> AsyncIterator[bytes]:
        """The class's changes as server-sent events."""
        of, known = await self._of_instructor(code, secret, lambda _connection, of, known, _now: (of, known))
        return self._feeds.of(of, known).watched(ending)

    async def student(self, code: str, secret: str, student_id: int) -> Reply:
        """Everything of one student."""

        def look(connection: Connection, of: ClassRow, known: KnownLab, now: float) -> Reply:
            student = student_by_id(connection, of.id, student_id)
            told = states.everything(connection, student, known, now)
            (row,) = wall.rows(connection, of, known, now, only=student.id)
            for name, step in told["steps"].items():
                step |= {key: row["steps"][name][key] for key in ("points", "of", "goals", "to_mark")}
            return {**row, **told}

        return await self._of_instructor(code, secret, look)

    async def mark_by_hand(self, code: str, secret: str, student_id: int, mark: dict[str, Any]) -> None:
        """Keeps an instructor's mark of a text answer."""

        def keep(writing: Writing) -> None:
            of = for_instructor(writing.connection, code, secret)
            known = self._frozen.of(writing.connection, of)
            known.require_markable(mark["step"], mark["question"], mark["points"])
            people.mark_by_hand(writing, of, student_id, {**mark, "at": time()})

        await self.database.write(keep)

    async def change(self, code: str, secret: str, changes: dict[str, Any]) -> Reply:
        """Changes title, opening or closing time."""

        def keep(writing: Writing) -> Reply:
            of, now = people.change(writing, code, secret, dict(changes), time()), time()
            return wall.about(of, self._frozen.of(writing.connection, of), now)

        return await self.database.write(keep)

    async def rotate(self, code: str, secret: str) -> Reply:
        """A new instructor's link; the old one ends."""
        new = new_secret()
        of = await self.database.write(lambda writing: people.rotate(writing, code, secret, new))
        return {"instructor": new, "instructor_link": _instructor_link(of.code, new)}

    async def new_link(self, code: str, secret: str, student_id: int) -> Reply:
        """A new personal link for a student; the old one ends."""
        new = new_secret()
        of = await self.database.write(
            lambda writing: people.new_link(writing, code, secret, student_id, new)
        )
        return {"student": new, "link": f"#class={of.code}&me={new}"}

    async def instructor_view(self, code: str, secret: str) -> Reply:
        """The lab with solutions, answers and the instructor's text."""
        return await self._of_instructor(
            code, secret, lambda _connection, _of, known, _now: known.instructor_view
        )

    async def delete_student(self, code: str, secret: str, student_id: int) -> None:
        """Deletes a student."""
        await self.database.write(lambda writing: people.delete_student(writing, code, secret, student_id))

    async def delete_class(self, code: str, secret: str) -> None:
        """Deletes a class with everybody in it."""
        await self.database.write(lambda writing: people.delete_class(writing, code, secret))

    async def export(self, code: str, secret: str) -> Reply:
        """All of a class, to be taken out."""
        return await self._of_instructor(code, secret, states.export)

    async def purge(self) -> int | None:
        """Deletes the classes that have ended, if it is this replica's turn."""
        return await self.database.write(lambda writing: people.purge(writing, time()))

    async def _of_instructor(
        self, code: str, secret: str, look: Callable[[Connection, ClassRow, KnownLab, float], T]
    ) -> T:
        def found(connection: Connection) -> T:
            of = for_instructor(connection, code, secret)
            return look(connection, of, self._frozen.of(connection, of), time())

        return await self.database.read(found)


def require_step(known: KnownLab, step: str) -> None:
    """Refuses a step that the lab has not.

    Raises:
        ClassError: unknown_step.
    """
    if step not in known.steps:
        raise unknown_step(step)


def _instructor_link(code: str, secret: str) -> str:
    return f"class#class={code}&key={secret}"


def _recorded(text: str, name: str, step: str, seed: int) -> bytes:
    from heli2dof_core.labs.recordings import recording_csv

    return recording_csv(frozen_lab(text, name).lab, step, seed)
