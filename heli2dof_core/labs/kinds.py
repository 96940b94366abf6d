"""What a field of a lab's file may hold: each kind reads a node, tells what is wrong with it, and has a JSON schema.

The format is written once, as records of such kinds (`format`).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from typing import Any, Generic, Protocol, TypeVar

from .amounts import NUMBER, amount, split_amount, units_for
from .nodes import Fields, Items, Node, Scalar
from .problems import LabProblem, Severity

T = TypeVar("T")
T_co = TypeVar("T_co", covariant=True)
Schema = dict[str, Any]


class Unusable(Exception):  # noqa: N818 # no error that anybody sees: it ends the reading of one value
    """A value that has been told of already."""


@dataclass
class Reading:
    """A file while it is read.

    Attributes:
        problems: what is wrong with it so far.
        places: by path, the node that stands there.
    """

    problems: list[LabProblem] = field(default_factory=list)
    places: dict[str, Node] = field(default_factory=dict)

    def tell(self, node: Node, path: str, message: str, hint: str = "", severity: Severity = "error") -> None:
        """Notes a problem at a node."""
        self.problems.append(LabProblem(node.line, node.column, path, message, hint, severity))

    def refuse(self, node: Node, path: str, message: str, hint: str = "") -> Unusable:
        """Notes an error, and gives what is raised for it."""
        self.tell(node, path, message, hint)
        return Unusable(message)

    def tell_at(self, path: str, message: str, hint: str = "", severity: Severity = "error") -> None:
        """Notes a problem where a path stands, or else what is above it."""
        place = path
        while place not in self.places and place:
            place = re.sub(r"(\.[^.\[]+|\[\d+\]|^[^.\[]+)$", "", place)
        self.tell(self.places.get(place, Fields(1, 1)), path, message, hint, severity)

    @property
    def errors(self) -> tuple[LabProblem, ...]:
        """In the file's order."""
        return tuple(sorted(p for p in self.problems if p.severity == "error"))


class Kind(Protocol[T_co]):
    """One kind of value."""

    def read(self, node: Node, at: Reading, path: str) -> T_co:
        """The value, or `Unusable` once its problems are told."""
        ...

    def schema(self) -> Schema:
        """As JSON schema."""
        ...


@dataclass(frozen=True)
class Text:
    """Any text; a word or a number that is not quoted is taken as it is written."""

    most: int = 20_000

    def read(self, node: Node, at: Reading, path: str) -> str:
        """The text, without what is blank around it."""
        if not isinstance(node, Scalar):
            raise at.refuse(node, path, f"this is {node.kind}, not text", "Write text.")
        text = node.text.strip()
        if not text or (not node.quoted and node.value is None):
            raise at.refuse(node, path, "there is no text", "Write some, or leave the field out.")
        if len(text) > self.most:
            raise at.refuse(node, path, f"the text has {len(text)} characters", f"Shorten it to {self.most}.")
        return text

    def schema(self) -> Schema:
        """Text, or what an editor takes for a number or a flag."""
        return {"type": ["string", "number", "boolean"], "maxLength": self.most}


@dataclass(frozen=True)
class Name:
    """A short name."""

    most: int = 40

    def read(self, node: Node, at: Reading, path: str) -> str:
        """The name."""
        text = node.text if isinstance(node, Scalar) else ""
        if not re.fullmatch(rf"[a-z0-9-]{{1,{self.most}}}", text):
            given = f"{text!r} is no name" if text else f"this is {node.kind}, not a name"
            hint = f"Use lower-case letters, digits and hyphens, at most {self.most}: settle-fast."
            raise at.refuse(node, path, given, hint)
        return text

    def schema(self) -> Schema:
        """Its pattern."""
        return {"type": ["string", "integer"], "pattern": rf"^[a-z0-9-]{{1,{self.most}}}$"}


@dataclass(frozen=True)
class Number:
    """A plain number within a range."""

    low: float
    high: float
    whole: bool = False

    def read(self, node: Node, at: Reading, path: str) -> float:
        """The number."""
        value = node.value if isinstance(node, Scalar) else None
        good = isinstance(value, int if self.whole else (int, float)) and not isinstance(value, bool)
        if not good or not isinstance(value, (int, float)):
            what = "a whole number" if self.whole else "a number"
            said = f"{node.text!r}" if isinstance(node, Scalar) and node.text else node.kind
            hint = f"Give {what} between {self.low:g} and {self.high:g}."
            raise at.refuse(node, path, f"this is {said}, not {what}", hint)
        if not self.low <= value <= self.high:
            hint = f"Give a value between {self.low:g} and {self.high:g}."
            raise at.refuse(node, path, f"{value:g} is out of range", hint)
        return value

    def schema(self) -> Schema:
        """Its range."""
        kind = "integer" if self.whole else "number"
        return {"type": kind, "minimum": self.low, "maximum": self.high}


@dataclass(frozen=True)
class Amount:
    """A number in an SI unit, or text with a unit of the same kind."""

    si: str
    low: float = -1e12
    high: float = 1e12

    def read(self, node: Node, at: Reading, path: str) -> float:
        """The value in the SI unit."""
        value = node.value if isinstance(node, Scalar) else None
        if isinstance(value, str):
            units = ", ".join(units_for(self.si)[:6])
            hint = f"Write a number, or one with its unit: {units}." if units else "Write a plain number."
            found = amount(value, self.si)
            if found is None:
                parts = split_amount(value)
                said = f"the unit {parts[1]!r} does not fit" if parts else f"{value!r} is no value"
                raise at.refuse(node, path, said, hint)
            value = found
        if isinstance(value, bool) or not isinstance(value, (int, float)):
            raise at.refuse(node, path, f"this is {node.kind}, not a value", "Write a number, or 0.8 s.")
        if not self.low <= value <= self.high:
            unit = f" {self.si}" if self.si else ""
            hint = f"Give a value between {self.low:g} and {self.high:g}{unit}."
            raise at.refuse(node, path, f"{value:g}{unit} is out of range", hint)
        return float(value)

    def schema(self) -> Schema:
        """A number, or text that begins with one."""
        return {
            "anyOf": [
                {"type": "number", "minimum": self.low, "maximum": self.high},
                {"type": "string", "pattern": rf"^\s*{NUMBER}"},
            ],
        }


@dataclass(frozen=True)
class Flag:
    """true or false."""

    def read(self, node: Node, at: Reading, path: str) -> bool:
        """The flag."""
        value = node.value if isinstance(node, Scalar) else None
        if not isinstance(value, bool):
            said = f"{node.text!r}" if isinstance(node, Scalar) and node.text else node.kind
            raise at.refuse(node, path, f"this is {said}, not true or false", "Write true or false.")
        return value

    def schema(self) -> Schema:
        """A boolean."""
        return {"type": "boolean"}


@dataclass(frozen=True)
class OneOf:
    """One of some words."""

    words: tuple[str, ...]

    def read(self, node: Node, at: Reading, path: str) -> str:
        """The word."""
        text = node.text if isinstance(node, Scalar) else ""
        if text not in self.words:
            said = f"there is no {text!r} here" if text else f"this is {node.kind}, not a word"
            raise at.refuse(node, path, said, known(text, self.words))
        return text

    def schema(self) -> Schema:
        """An enumeration."""
        return {"enum": [*self.words]}


def known(text: str, words: Sequence[str]) -> str:
    """A hint: what was probably meant, and what there is."""
    near = get_close_matches(text, words, 1)
    listed = f"Known are {', '.join(words)}."
    return f"Did you mean {near[0]}? {listed}" if near else listed


@dataclass(frozen=True)
class ListOf(Generic[T]):
    """A list of one kind; each item is read, whatever is wrong with the others."""

    of: Kind[T]
    most: int = 100
    least: int = 0
    single: bool = False
    """Whether one value may stand for a list of one."""

    def read(self, node: Node, at: Reading, path: str) -> tuple[T, ...]:
        """The items."""
        if self.single and not isinstance(node, Items):
            return (self.of.read(node, at, path),)
        if not isinstance(node, Items):
            raise at.refuse(node, path, f"this is {node.kind}, not a list", "Begin each item with a hyphen.")
        if not self.least <= len(node.items) <= self.most:
            hint = f"Give {self.least} to {self.most}."
            raise at.refuse(node, path, f"there are {len(node.items)} items", hint)
        found, bad = [], False
        for i, item in enumerate(node.items):
            own = f"{path}[{i}]"
            at.places[own] = item
            try:
                found.append(self.of.read(item, at, own))
            except Unusable:
                bad = True
        if bad:
            raise Unusable(path)
        return tuple(found)

    def schema(self) -> Schema:
        """An array."""
        own: Schema = {"type": "array", "items": self.of.schema(), "maxItems": self.most}
        if self.least:
            own["minItems"] = self.least
        return {"anyOf": [own, self.of.schema()]} if self.single else own


@dataclass(frozen=True)
class Member:
    """One field of a record.

    Attributes:
        name: in the file.
        kind: of its value.
        meaning: in a few words, for schema and documentation.
        required: whether it must be there.
        attribute: of what is made; the name where empty.
    """

    name: str
    kind: Kind[Any]
    meaning: str
    required: bool = False
    attribute: str = ""


@dataclass(frozen=True)
class Record(Generic[T]):
    """A mapping with known fields.

    Attributes:
        make: what is made of the fields that are there, by their attributes.
        members: the fields.
        what: its name, for messages and the schema.
        check: what is wrong with several fields together, told by itself; it may raise `Unusable`.
    """

    make: Callable[..., T]
    members: tuple[Member, ...]
    what: str
    check: Callable[[T, Reading, str], None] | None = None

    def read(self, node: Node, at: Reading, path: str) -> T:
        """What is made of it."""
        if not isinstance(node, Fields):
            hint = f"Give its fields: {', '.join(m.name for m in self.members[:6])} …"
            raise at.refuse(node, path, f"{self.what} is {node.kind}, not a mapping", hint)
        by_name = {member.name: member for member in self.members}
        values: dict[str, Any] = {}
        bad = False
        for name, (key, value) in node.fields.items():
            own = f"{path}.{name}".lstrip(".")
            if name not in by_name:
                at.tell(key, own, f"{self.what} has no field {name}", known(name, [*by_name]))
                bad = True
                continue
            at.places[own] = value
            try:
                values[by_name[name].attribute or name] = by_name[name].kind.read(value, at, own)
            except Unusable:
                bad = True
        for member in self.members:
            if member.required and member.name not in node.fields:
                missing = f"{path}.{member.name}".lstrip(".")
                at.tell(node, missing, f"{self.what} has no {member.name}", f"Give it: {member.meaning}.")
                bad = True
        if bad:
            raise Unusable(path)
        made = self.make(**values)
        if self.check is not None:
            self.check(made, at, path)
        return made

    def schema(self) -> Schema:
        """An object."""
        properties = {m.name: {**m.kind.schema(), "description": _sentence(m.meaning)} for m in self.members}
        required = [m.name for m in self.members if m.required]
        return {
            "type": "object",
            "properties": properties,
            "additionalProperties": False,
            **({"required": required} if required else {}),
        }


def _sentence(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}."


@dataclass(frozen=True)
class Tagged(Generic[T]):
    """One of several records, by the word in one of its fields.

    Attributes:
        kinds: the records by that word.
        standard: where the field is missing.
        tag: its name.
        what: for messages.
    """

    kinds: Mapping[str, Record[Any]]
    standard: str
    what: str
    tag: str = "kind"

    def read(self, node: Node, at: Reading, path: str) -> T:
        """What the record makes."""
        if not isinstance(node, Fields):
            raise at.refuse(node, path, f"{self.what} is {node.kind}, not a mapping", "Give its fields.")
        word = self.standard
        if self.tag in node.fields:
            value = node.fields[self.tag][1]
            word = OneOf(tuple(self.kinds)).read(value, at, f"{path}.{self.tag}")
        rest = {name: own for name, own in node.fields.items() if name != self.tag}
        return self.kinds[word].read(Fields(node.line, node.column, rest), at, path)

    def schema(self) -> Schema:
        """A choice of objects, by if and then, so that an editor tells what is wrong with the one that is meant."""
        words = [*self.kinds]
        cases = []
        for word, record in self.kinds.items():
            own = record.schema()
            own["properties"] = {self.tag: {"const": word}, **own["properties"]}
            named: Schema = {"properties": {self.tag: {"const": word}}}
            if word != self.standard:
                named["required"] = [self.tag]
            cases.append({"if": named, "then": own})
        return {"type": "object", "properties": {self.tag: {"enum": words}}, "allOf": cases}


@dataclass(frozen=True)
class MapOf(Generic[T]):
    """Any names, each with a value of one kind."""

    of: Kind[T]
    most: int = 50
    names: str = ""
    """What they name, for the schema."""

    def read(self, node: Node, at: Reading, path: str) -> dict[str, T]:
        """By name."""
        if not isinstance(node, Fields):
            raise at.refuse(
                node, path, f"this is {node.kind}, not a mapping", "Give names with their values."
            )
        if len(node.fields) > self.most:
            raise at.refuse(node, path, f"there are {len(node.fields)} names", f"Give at most {self.most}.")
        found, bad = {}, False
        for name, (_, value) in node.fields.items():
            own = f"{path}.{name}"
            at.places[own] = value
            try:
                found[name] = self.of.read(value, at, own)
            except Unusable:
                bad = True
        if bad:
            raise Unusable(path)
        return found

    def schema(self) -> Schema:
        """An object of any names."""
        return {"type": "object", "additionalProperties": self.of.schema(), "maxProperties": self.most}
