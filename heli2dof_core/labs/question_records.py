"""Questions in a lab's file: their records, and answers and tolerances understood in the question's unit."""

from __future__ import annotations

from types import MappingProxyType
from typing import Any

from ..measured import MEASURED, Where
from .amounts import DECIBEL, amount, factor, in_unit, si_of, split_amount, unit_of
from .goals.goal import MOST_POINTS
from .kinds import (
    Kind,
    ListOf,
    Member,
    Name,
    Number,
    OneOf,
    Reading,
    Record,
    Schema,
    Tagged,
    Text,
    Unusable,
    known,
)
from .lab import Question
from .nodes import Fields, Node, Scalar
from .quantities import QUANTITIES, Asked, quantity_named
from .questions import ChoiceQuestion, NumberQuestion, TextQuestion


class Answer:
    """A number with or without its unit, or the quantity that it is."""

    def read(self, node: Node, at: Reading, path: str) -> Node | Asked:
        """The quantity; a number as it stands, since its unit is not known here."""
        if not isinstance(node, Fields):
            return node
        raw = _ASKED.read(node, at, path)
        found = quantity_named(raw["quantity"])
        if found is None:
            at.tell_at(
                f"{path}.quantity",
                f"there is no quantity {raw['quantity']!r}",
                _quantity_hint(raw["quantity"]),
            )
            raise Unusable(path)
        quantity, indices = found
        where = Where(
            raw.get("axis"), raw.get("motor"), raw.get("model", "nonlinear"), raw.get("steps", "alone")
        )
        self._require_fitting(quantity.name, raw, at, path, node)
        return Asked(quantity, indices, raw.get("of", "own"), where)

    def _require_fitting(self, name: str, raw: dict[str, Any], at: Reading, path: str, node: Node) -> None:
        measured = MEASURED.get(name)
        if measured is not None and measured.has_axis and "axis" not in raw:
            raise at.refuse(
                node, f"{path}.axis", f"{name} is of an axis, and none is named", "Give theta or psi."
            )
        for part in ("axis", "motor", "model", "steps"):
            if part in raw and (
                measured is None or not getattr(measured, f"may_have_{part}", measured.may_have_model)
            ):
                at.tell_at(f"{path}.{part}", f"{name} has no {part}", "Leave it out.")

    def schema(self) -> Schema:
        """A number, text with a unit, or a quantity."""
        return {"anyOf": [{"type": ["number", "string"]}, _ASKED.schema()]}


def _quantity_hint(text: str) -> str:
    name = text.partition("[")[0].strip()
    own = QUANTITIES.get(name)
    if own is not None:
        sizes = " and ".join(f"1 to {most}" for most in own.shape)
        return f"Write {own.form}{f', {sizes}' if sizes else ''}."
    return known(name, [*QUANTITIES])


_ASKED: Record[dict[str, Any]] = Record(
    dict,
    (
        Member("quantity", Text(80), "what is asked for, such as settling_time or K[1,1]", required=True),
        Member(
            "of",
            OneOf(("own", "start", "solution", "rig")),
            "of which design; own, the standard: as handed in; rig: of the student's true rig, where it is hidden",
        ),
        Member("axis", OneOf(("theta", "psi", "both")), "of a figure: the axis that is stepped"),
        Member("motor", OneOf(("V_p", "V_y", "both")), "of a figure: the motor"),
        Member("model", OneOf(("nonlinear", "linear")), "of a figure; nonlinear where left out"),
        Member("steps", OneOf(("alone", "together")), "of a figure; alone where left out"),
    ),
    "the answer",
)


class Raw:
    """Text or a number, understood once its unit is known."""

    def read(self, node: Node, at: Reading, path: str) -> Node:
        """The node."""
        if not isinstance(node, Scalar):
            raise at.refuse(node, path, f"this is {node.kind}, not a value", "Write 2 %, or a number.")
        return node

    def schema(self) -> Schema:
        """A number or text."""
        return {"type": ["number", "string"]}


class Choices:
    """The place of the right choice from 1, or of several."""

    _of: Kind[Any] = ListOf(Number(1, 20, whole=True), 20, 1, single=True)

    def read(self, node: Node, at: Reading, path: str) -> tuple[int, ...]:
        """The places."""
        return self._of.read(node, at, path)

    def schema(self) -> Schema:
        """As a list has it."""
        return self._of.schema()


class NumberRecord(Record[Question]):
    """The record of a number's question."""

    def read(self, node: Node, at: Reading, path: str) -> Question:
        """The question."""
        raw: dict[str, Any] = super().read(node, at, path)  # pyright: ignore[reportAssignmentType]
        answer, unit = raw["answer"], raw.get("unit")
        if unit is not None:
            own = unit_of(unit)
            if own is None:
                raise at.refuse(
                    at.places[f"{path}.unit"], f"{path}.unit", f"the unit {unit!r} is not known", _UNITS_HINT
                )
            raw["unit"] = own
        if isinstance(answer, Asked):
            quantity = answer.quantity
            raw.setdefault("unit", quantity.shown or (quantity.unit if unit_of(quantity.unit) else ""))
            fits = (raw["unit"] == DECIBEL and quantity.unit == "") or factor(
                raw["unit"], quantity.unit
            ) is not None
            if unit is not None and not fits:
                hint = f"Give one of {quantity.unit or 'a plain number'}."
                raise at.refuse(
                    at.places[f"{path}.unit"],
                    f"{path}.unit",
                    f"{quantity.name} is not measured in {unit}",
                    hint,
                )
        else:
            raw["answer"] = self._number(answer, raw.get("unit", ""), at, f"{path}.answer")
        raw.update(self._tolerance(raw.pop("tolerance", None), raw, at, f"{path}.tolerance"))
        raw["either_sign"] = raw.pop("sign", "") == "any"
        return NumberQuestion(**raw)

    def _number(self, node: Node, unit: str, at: Reading, path: str) -> float:
        value = node.value if isinstance(node, Scalar) else None
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            return float(value)
        parts = split_amount(value) if isinstance(value, str) else None
        if parts is not None and unit == DECIBEL and unit_of(parts[1]) in ("", DECIBEL):
            return parts[0]
        found = amount(value, si_of(unit)) if isinstance(value, str) else None
        if found is None or parts is None:
            raise at.refuse(
                node,
                path,
                f"{getattr(node, 'text', node.kind)!r} is no answer in {unit or 'a plain number'}",
                "Write a number, or {quantity: …}.",
            )
        return parts[0] if not parts[1] else in_unit(found, si_of(unit), unit or "")

    def _tolerance(self, node: Node | None, raw: dict[str, Any], at: Reading, path: str) -> dict[str, Any]:
        if node is None:
            return {}
        value = node.value if isinstance(node, Scalar) else None
        unit = raw.get("unit", "")
        if isinstance(value, str):
            parts = split_amount(value)
            written = parts and unit_of(parts[1]) if parts and parts[1] else ""
            if parts and written == "%" and unit != "%":
                return {"tolerance": self._positive(parts[0] / 100, node, at, path)}
            if parts and written is not None:
                own = factor(written or unit, si_of(unit))
                mine = factor(unit, si_of(unit))
                if DECIBEL in (written, unit) and written in ("", unit):
                    return {"absolute": self._positive(parts[0], node, at, path)}
                if own is not None and mine:
                    return {"absolute": self._positive(parts[0] * own / mine, node, at, path)}
            raise at.refuse(
                node, path, f"{value!r} is no tolerance", f"Write 2 %, or {'0.1 ' + unit if unit else 0.1}."
            )
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise at.refuse(node, path, f"this is {node.kind}, not a tolerance", "Write 2 %.")
        return {"absolute": self._positive(float(value), node, at, path)}

    def _positive(self, value: float, node: Node, at: Reading, path: str) -> float:
        if value < 0:
            raise at.refuse(node, path, "the tolerance is negative", "Give 0 or more.")
        return value


_UNITS_HINT = (
    "Known are s, ms, rad, °, rad/s, °/s, V, %, dB, N·m, N·m/V, N·m·s/rad, kg·m², V/rad and some more."
)
_SHARED = (
    Member("name", Name(), "its name within the step", required=True),
    Member("text", Text(), "the question, Markdown", required=True),
    Member("points", Number(0, MOST_POINTS), "what the right answer is worth, 1 where left out"),
)


def _raw(**values: Any) -> Any:
    return values


def _choice(question: Any, at: Reading, path: str) -> None:
    for i in question.answer:
        if i > len(question.choices):
            at.tell_at(
                f"{path}.answer",
                f"there is no choice {i}",
                f"Choices count from 1 to {len(question.choices)}.",
            )


RECORDS: MappingProxyType[str, Record[Any]] = MappingProxyType(
    {
        "number": NumberRecord(
            _raw,
            (
                *_SHARED,
                Member(
                    "answer", Answer(), "a number, with its unit if you like, or a quantity", required=True
                ),
                Member("unit", Text(20), "in which it is asked for; the quantity's own where left out"),
                Member("tolerance", Raw(), "`2 %` of the answer, the standard, or in the question's unit"),
                Member("sign", OneOf(("any",)), "any: the sign does not matter"),
            ),
            "the question",
        ),
        "choice": Record(
            ChoiceQuestion,
            (
                *_SHARED,
                Member(
                    "choices", ListOf(Text(500), 20, 2), "what there is to choose, Markdown", required=True
                ),
                Member(
                    "answer",
                    Choices(),
                    "the right one, counted from 1, or a list of all that are",
                    required=True,
                ),
            ),
            "the question",
            _choice,
        ),
        "text": Record(
            TextQuestion,
            (*_SHARED, Member("sample", Text(), "a good answer, for whoever marks it")),
            "the question",
        ),
    }
)
"""By the word in a question's field `kind`."""
QUESTION: Tagged[Question] = Tagged(RECORDS, "number", "the question")
