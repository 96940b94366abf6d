"""The labs that may be chosen, and those of classes as they were frozen."""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, lru_cache
from pathlib import Path
from typing import Any, Literal

from heli2dof_core.labs import (
    Lab,
    LabError,
    hint_view,
    instructor_view,
    read_file,
    read_lab,
    shipped_labs,
    shipped_text,
    student_rig,
    student_view,
)
from heli2dof_core.labs.library import ENDINGS, text_of

from .errors import ClassError, unknown_step

_log = logging.getLogger(__name__)


@dataclass(frozen=True)
class KnownLab:
    """A lab, its text, and what people may see of it."""

    lab: Lab
    source: Literal["shipped", "own"]
    file: str

    @cached_property
    def view(self) -> dict[str, Any]:
        """What a student may see."""
        return student_view(self.lab)

    @cached_property
    def instructor_view(self) -> dict[str, Any]:
        """Everything: solutions, answers, the instructor's text."""
        return instructor_view(self.lab)

    @cached_property
    def steps(self) -> Mapping[str, dict[str, Any]]:
        """The steps as a student may see them, by name, in their order."""
        return {step["name"]: step for step in self.view["steps"]}

    def view_with(self, hints: Mapping[str, Sequence[int]]) -> dict[str, Any]:
        """As `view`, with the texts of the hints that were taken, 1-based, by step."""
        steps = []
        for step in self.view["steps"]:
            taken = hints.get(step["name"], ())
            told = [
                {**hint, **self._hint(step["name"], k)} if k in taken else hint
                for k, hint in enumerate(step["hints"], 1)
            ]
            steps.append({**step, "hints": told})
        return {**self.view, "steps": steps}

    def hint(self, step: str, number: int) -> dict[str, Any]:
        """A hint's text and cost.

        Args:
            step: of the lab.
            number: 1-based.

        Raises:
            ClassError: unknown_hint.
        """
        if not 1 <= number <= len(self.steps[step]["hints"]):
            raise ClassError(404, "This step has no such hint.", "unknown_hint")
        return {"hint": number, **self._hint(step, number)}

    def require_markable(self, step: str, question: str, points: float) -> None:
        """Refuses a hand mark of what is not marked by hand, or of more points than there are.

        Raises:
            ClassError: unknown_step, unknown_question, too_many_points.
        """
        if step not in self.steps:
            raise unknown_step(step)
        for known in self.steps[step]["questions"]:
            if known["name"] == question and known["kind"] == "text":
                if points > known["points"]:
                    detail = f"The question has {known['points']:g} points."
                    raise ClassError(422, detail, "too_many_points", field="points", value=points)
                return
        detail = f"The step has no question {question[:60]!r} that is marked by hand."
        raise ClassError(422, detail, "unknown_question", field="question", value=question)

    def _hint(self, step: str, number: int) -> dict[str, Any]:
        return hint_view(self.lab, step, number)

    @property
    def summary(self) -> dict[str, Any]:
        """What a list of labs tells of it."""
        keys = ("name", "number", "title", "summary", "minutes", "points")
        told = {key: self.view[key] for key in keys if self.view.get(key) is not None}
        return {**told, "steps": len(self.steps), "source": self.source}

    @property
    def alone(self) -> bool:
        """Whether it may be marked without a class."""
        return self.lab.alone

    def rig(self, seed: int) -> dict[str, Any]:
        """The rig of a student's seed, as their page may know it."""
        return student_rig(self.lab, seed)


@lru_cache(maxsize=128)
def frozen_lab(text: str, name: str) -> KnownLab:
    """The lab of a text that was frozen with a class; read once.

    Raises:
        ClassError: lab_unreadable, by this version of the program.
    """
    try:
        return KnownLab(read_lab(text, name), "own", text)
    except LabError as error:
        _log.error("the lab %s of a class cannot be read: %s", name, error)
        detail = "This class's lab was made for another version of the program."
        raise ClassError(503, detail, "lab_unreadable", hint="Start the version it was made with.") from error


class Labs:
    """The labs that ship and those of a folder; a file that is changed is read anew.

    Args:
        folder: HELI2DOF_LABS.
    """

    def __init__(self, folder: Path | None) -> None:
        self._folder = folder
        self._told: set[tuple[str, str]] = set()

    def all(self) -> list[KnownLab]:
        """All that can be read, in the course's order; own ones behind."""
        by_name = {known.lab.name: known for known in (*_shipped(), *self._own())}
        return sorted(by_name.values(), key=_place)

    def named(self, name: str) -> KnownLab:
        """The lab of this name.

        Raises:
            ClassError: unknown_lab.
        """
        for known in self.all():
            if known.lab.name == name:
                return known
        hint = "GET /api/v1/labs lists those that are there."
        raise ClassError(404, f"There is no lab named {name[:60]!r}.", "unknown_lab", hint=hint)

    def _own(self) -> Iterator[KnownLab]:
        if self._folder is None:
            return
        for path in sorted(path for path in self._folder.glob("*") if path.suffix in ENDINGS):
            try:
                stamp = path.stat()
                yield _own_lab(path, stamp.st_mtime_ns, stamp.st_size)
            except (OSError, LabError) as error:
                self._tell(path, error)

    def _tell(self, path: Path, error: Exception) -> None:
        """Says once what is wrong with a file."""
        if (known := (path.name, str(error))) not in self._told:
            self._told.add(known)
            _log.warning("the lab %s is left out: %s (heli2dof lab check tells more)", path.name, error)


@cache
def _shipped() -> tuple[KnownLab, ...]:
    """The labs that ship."""
    return tuple(KnownLab(lab, "shipped", shipped_text(name)) for name, lab in shipped_labs().items())


@lru_cache(maxsize=128)
def _own_lab(path: Path, _modified: int, _size: int) -> KnownLab:
    """A lab of one's own, read anew when its file has changed."""
    return KnownLab(read_file(path), "own", text_of(path))


def _place(known: KnownLab) -> tuple[bool, float, str]:
    number = known.view.get("number")
    return known.source == "own", number if number is not None else float("inf"), known.lab.name
