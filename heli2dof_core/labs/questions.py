"""Kinds of questions: a number with tolerance and unit, a choice, a text that a person marks."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Any, ClassVar

from .amounts import DECIBEL, factor, in_unit, plain_number, si_of, split_amount, unit_of
from .context import Context
from .lab import Outcome
from .quantities import Asked

LONGEST_ANSWER = 10_000


@dataclass(frozen=True)
class BaseQuestion:
    """Base of a question: see `lab.Question`."""

    kind: ClassVar[str]
    name: str = ""
    text: str = ""
    points: float = 1.0


@dataclass(frozen=True)
class NumberQuestion(BaseQuestion):
    """A number is asked for.

    Attributes:
        answer: the right one in `unit`, or the quantity that it is.
        unit: in which it is asked for; empty: a plain number.
        tolerance: relative, where `absolute` is not set.
        absolute: the same in `unit`; None where it is relative.
        either_sign: whether the sign does not matter.
    """

    kind: ClassVar[str] = "number"
    answer: float | Asked = 0.0
    unit: str = ""
    tolerance: float = 0.02
    absolute: float | None = None
    either_sign: bool = False

    def right(self, context: Context) -> float | None:
        """The right answer in `unit`; None where there is none on this rig."""
        if not isinstance(self.answer, Asked):
            return self.answer
        value = self.answer.value(context)
        if value is None or (self.unit == DECIBEL and value <= 0):
            return None
        return in_unit(value, self.answer.quantity.unit, self.unit) if self.unit else value

    def judge(self, answer: Any, context: Context) -> Outcome:
        """Whether it is within the tolerance."""
        if answer is None or (isinstance(answer, str) and not answer.strip()):
            return Outcome(False, None, "", "No answer.")
        given = self._given(answer)
        if isinstance(given, str):
            return Outcome(False, None, str(answer)[:80], given)
        text = f"{given:.6g}".replace("-", "−") + (f" {self.unit}" if self.unit else "")
        right = self.right(context)
        if right is None:
            return Outcome(
                False, given, text, "On this design there is no such value: see that the loop is stable."
            )
        if self.either_sign:
            given_size, right_size = abs(given), abs(right)
        else:
            given_size, right_size = given, right
        room = self.absolute if self.absolute is not None else self.tolerance * abs(right_size)
        return Outcome(abs(given_size - right_size) <= room * (1 + 1e-9) + 1e-12, given, text)

    def _given(self, answer: Any) -> float | str:
        """The number in `unit`, or what is wrong with it."""
        if isinstance(answer, (int, float)) and not isinstance(answer, bool):
            value = float(answer)
            return value if abs(value) < 1e300 else "This is no number."
        if not isinstance(answer, str):
            return "This is no number."
        parts = split_amount(answer)
        if parts is None:
            return "This is no number."
        value, written = parts
        if not written:
            return value
        unit = unit_of(written)
        if unit is None:
            return f"The unit {written} is not known here; answer in {self.unit or 'a plain number'}."
        return self._converted(value, unit)

    def _converted(self, value: float, unit: str) -> float | str:
        if unit == self.unit:
            return value
        wrong = f"The answer is asked for in {self.unit}." if self.unit else "The answer has no unit."
        if DECIBEL in (unit, self.unit):
            return wrong
        own, theirs = factor(self.unit, si_of(self.unit)), factor(unit, si_of(self.unit))
        return wrong if own is None or theirs is None else value * theirs / own

    def told(self) -> dict[str, Any]:
        """Its unit."""
        return {"unit": self.unit}

    def answered(self) -> dict[str, Any]:
        """The answer, or of what it is."""
        tolerance = (
            {"absolute": self.absolute} if self.absolute is not None else {"tolerance": self.tolerance}
        )
        if not isinstance(self.answer, Asked):
            return {"answer": self.answer, **tolerance}
        own = self.answer
        indices = f"[{','.join(map(str, own.indices))}]" if own.indices else ""
        return {"answer": {"quantity": own.quantity.name + indices, "of": own.of}, **tolerance}


@dataclass(frozen=True)
class ChoiceQuestion(BaseQuestion):
    """One of several is right, or several are: then all of them, and no other, have to be chosen.

    Attributes:
        choices: Markdown of one line each.
        answer: their places from 1.
    """

    kind: ClassVar[str] = "choice"
    choices: tuple[str, ...] = ()
    answer: tuple[int, ...] = ()

    def judge(self, answer: Any, context: Context) -> Outcome:
        """Whether exactly the right ones are chosen."""
        if isinstance(answer, str):
            answer = [part.strip() for part in re.split("[,;]", answer)]
        given = answer if isinstance(answer, (list, tuple)) else [answer]
        chosen = set()
        for each in given:
            number = plain_number(each) if isinstance(each, str) else each
            if (
                isinstance(number, bool)
                or not isinstance(number, (int, float))
                or number not in range(1, len(self.choices) + 1)
            ):
                return Outcome(
                    False, None, "", "No answer." if each in (None, "") else "There is no such choice."
                )
            chosen.add(int(number))
        text = ", ".join(self.choices[i - 1] for i in sorted(chosen))
        if not chosen:
            return Outcome(False, None, "", "No answer.")
        value = float(min(chosen)) if len(chosen) == 1 else None
        return Outcome(chosen == set(self.answer), value, text)

    def told(self) -> dict[str, Any]:
        """What there is to choose, and whether several may be right."""
        return {"choices": [*self.choices], "several": len(self.answer) > 1}

    def answered(self) -> dict[str, Any]:
        """The right ones."""
        return {"answer": [*self.answer]}


@dataclass(frozen=True)
class TextQuestion(BaseQuestion):
    """A text is asked for, which a person marks.

    Attributes:
        sample: a good answer, for that person.
    """

    kind: ClassVar[str] = "text"
    sample: str = ""

    def judge(self, answer: Any, context: Context) -> Outcome:
        """Nothing is said, but where there is none."""
        text = answer.strip() if isinstance(answer, str) else ""
        if not text:
            return Outcome(False, None, "", "No answer.")
        return Outcome(None, None, text[:LONGEST_ANSWER], "To be marked by your instructor.")

    def told(self) -> dict[str, Any]:
        """Nothing more."""
        return {}

    def answered(self) -> dict[str, Any]:
        """The sample."""
        return {"sample": self.sample}
