"""YAML as nodes that know where they stand, for files that strangers write.

A lab's file is untrusted input: anchors, tags and further documents are refused, so is what is too large or too deep,
and nothing is ever constructed of it but text, numbers, lists and mappings. Words are those of YAML 1.2: `no`, `on`
and `1:30` are text. The nodes are built from PyYAML's events, without recursion.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import yaml

from .problems import LabError, LabProblem

LONGEST = 256 * 1024
"""Most characters of a file."""
DEEPEST = 16
"""Most levels of nesting."""
MOST_NODES = 20_000

_LOADER: Any = getattr(yaml, "CBaseLoader", yaml.BaseLoader)
_INTEGER = re.compile(r"[-+]?[0-9]{1,30}")
_FLOAT = re.compile(r"[-+]?(\.[0-9]{1,40}|[0-9]{1,40}(\.[0-9]{0,40})?)([eE][-+]?[0-9]{1,4})?")
_WORDS = {"": None, "~": None, "null": None, "Null": None, "NULL": None}
_WORDS |= {"true": True, "True": True, "TRUE": True, "false": False, "False": False, "FALSE": False}
_UNPRINTABLE = re.compile("[^\\t\\n\\r\\x20-\\x7e\\x85\\xa0-\\ud7ff\\ue000-\\ufffd\\U00010000-\\U0010ffff]")

_CONTROL = re.compile("[^\\t\\n\\r\x20-\x7e\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_QUOTES = "In double quotes \\ begins an escape: use single quotes, or | for formulas."


@dataclass(frozen=True)
class Node:
    """Something in the file, and where it begins; lines and columns from 1."""

    line: int
    column: int

    @property
    def kind(self) -> str:
        """In a word, for messages."""
        raise NotImplementedError

    @property
    def plain(self) -> Any:
        """As JSON would have it."""
        raise NotImplementedError


@dataclass(frozen=True)
class Scalar(Node):
    """Text, or what stands for a number, true, false or nothing where it is not quoted."""

    text: str
    quoted: bool = False

    @property
    def value(self) -> Any:
        """None, a bool, an int, a float or the text, by YAML 1.2's core schema."""
        if self.quoted:
            return self.text
        if self.text in _WORDS:
            return _WORDS[self.text]
        if _INTEGER.fullmatch(self.text):
            return int(self.text)
        if _FLOAT.fullmatch(self.text):
            number = float(self.text)
            return number if math.isfinite(number) else self.text
        return self.text

    @property
    def kind(self) -> str:
        """In a word."""
        value = self.value
        if value is None:
            return "nothing"
        return (
            "true or false" if isinstance(value, bool) else "text" if isinstance(value, str) else "a number"
        )

    @property
    def plain(self) -> Any:
        """Its value."""
        return self.value


@dataclass(frozen=True)
class Items(Node):
    """A list."""

    items: list[Node] = field(default_factory=list)

    @property
    def kind(self) -> str:
        """In a word."""
        return "a list"

    @property
    def plain(self) -> Any:
        """A list."""
        return [item.plain for item in self.items]


@dataclass(frozen=True)
class Fields(Node):
    """A mapping: names, each with where it stands, and their values."""

    fields: dict[str, tuple[Scalar, Node]] = field(default_factory=dict)

    @property
    def kind(self) -> str:
        """In a word."""
        return "a mapping"

    @property
    def plain(self) -> Any:
        """A dictionary."""
        return {name: node.plain for name, (_, node) in self.fields.items()}


def nodes_of(text: str) -> Fields:
    """The file's mapping.

    Raises:
        LabError: it is no YAML, or none that a lab may be written in; with one problem, the first.
    """
    text = text.removeprefix("\ufeff")
    if len(text) > LONGEST:
        raise _refused(1, 1, f"the file has {len(text)} characters", f"A lab has at most {LONGEST}.")
    strange = _UNPRINTABLE.search(text)
    if strange:
        before = text[: strange.start()]
        line, column = before.count("\n") + 1, strange.start() - before.rfind("\n")
        raise _refused(line, column, f"the character U+{ord(strange[0]):04X} is not allowed", "Delete it.")
    loader = _LOADER(text)
    try:
        root = _built(_events(loader))
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line, column = (1, 1) if mark is None else _within(text, mark.line, mark.column)
        raise _refused(line, column, f"this is no YAML: {_words(error)}", _advice(error)) from None
    except yaml.YAMLError as error:
        raise _refused(1, 1, f"this is no YAML: {error}", "") from None
    finally:
        loader.dispose()
    if root is None:
        raise _refused(1, 1, "the file is empty", "`heli2dof lab new` writes one to begin with.")
    if not isinstance(root, Fields):
        raise _refused(root.line, root.column, f"the file is {root.kind}", "Begin with `lab: 1`.")
    return root


def _within(text: str, line: int, column: int) -> tuple[int, int]:
    """Line and column from 1; what is told behind the last line is told at its end."""
    lines = text.splitlines() or [""]
    return (line + 1, column + 1) if line < len(lines) else (len(lines), len(lines[-1]) + 1)


def _events(loader: Any) -> Iterator[Any]:
    while loader.check_event():
        yield loader.get_event()


def _built(events: Iterator[Any]) -> Node | None:  # noqa: C901, PLR0912
    """The tree of the events; a stack in place of recursion, since depth is the writer's."""
    root: Node | None = None
    open_: list[tuple[Items | Fields, Scalar | None]] = []
    count = documents = 0

    for event in events:
        if isinstance(event, yaml.DocumentStartEvent):
            documents += 1
            if documents > 1:
                raise _at(event, "a second document begins", "Write one lab per file: delete this `---`.")
            continue
        if isinstance(event, (yaml.SequenceEndEvent, yaml.MappingEndEvent)):
            open_.pop()
            continue
        if not isinstance(event, yaml.NodeEvent):
            continue
        _require_plain(event)
        count += 1
        if count > MOST_NODES:
            raise _at(event, f"the file has more than {MOST_NODES} values", "Make it smaller.")
        node = _node(event)
        if not open_:
            root = node
        else:
            above, key = open_[-1]
            if isinstance(above, Items):
                above.items.append(node)
            elif key is None:
                open_[-1] = (above, _key(node, above))
            else:
                above.fields[key.text] = (key, node)
                open_[-1] = (above, None)
        if isinstance(node, (Items, Fields)):
            if len(open_) >= DEEPEST:
                raise _at(event, f"this is nested more than {DEEPEST} levels deep", "Make it flatter.")
            open_.append((node, None))
    return root


def _node(event: Any) -> Node:
    line, column = event.start_mark.line + 1, event.start_mark.column + 1
    if isinstance(event, yaml.ScalarEvent):
        escaped = event.style == '"' and ("\t" in event.value or "\r" in event.value)  # of \theta, \rho
        if escaped or _CONTROL.search(event.value):
            raise _at(event, "an escape in double quotes stands for a control character", _QUOTES)
        return Scalar(line, column, event.value, quoted=event.style is not None and event.style != "")
    return Items(line, column) if isinstance(event, yaml.SequenceStartEvent) else Fields(line, column)


def _key(node: Node, above: Fields) -> Scalar:
    if not isinstance(node, Scalar):
        raise _refused(
            node.line, node.column, f"{node.kind} stands for a field's name", "Quote it if it is text."
        )
    if node.text in above.fields:
        first = above.fields[node.text][0].line
        raise _refused(
            node.line,
            node.column,
            f"{node.text} stands here twice, first in line {first}",
            "Keep one of them.",
        )
    return node


def _require_plain(event: Any) -> None:
    if isinstance(event, yaml.AliasEvent):
        raise _at(
            event, f"*{event.anchor} stands for what is elsewhere", "Write it out: labs take no aliases."
        )
    if event.anchor is not None:
        raise _at(event, f"&{event.anchor} is an anchor", "Leave it out; quote the text if it begins with &.")
    tag = getattr(event, "tag", None)
    if tag not in (None, "!"):
        raise _at(event, f"the tag {tag} is not allowed", "Leave it out; quote the text if it begins with !.")


def _at(event: Any, message: str, hint: str) -> LabError:
    return _refused(event.start_mark.line + 1, event.start_mark.column + 1, message, hint)


def _refused(line: int, column: int, message: str, hint: str) -> LabError:
    return LabError([LabProblem(line, column, "", message, hint)])


def _words(error: yaml.MarkedYAMLError) -> str:
    return " ".join(part for part in (error.context, error.problem) if part).strip() or "it cannot be read"


_ADVICE = (
    ("'\\t'", "Indent with spaces."),
    ("tab", "Indent with spaces."),
    (
        "mapping values are not allowed",
        "Quote text that holds `: `, or begin it with | on a line of its own.",
    ),
    ("could not find expected ':'", "A colon and a space are missing, or this text is indented too little."),
    ("did not find expected key", "Look at the indentation, and at quotes within the text before."),
    ("block end", "Look at the indentation: fields of one thing begin in one column."),
    ("alias", "Quote text that begins with *."),
    ("anchor", "Quote text that begins with &."),
    ("cannot start any token", "Quote text that begins with `, @, % or a tab."),
    ("undefined tag", "Quote text that begins with !."),
    ("escape", _QUOTES),
)


def _advice(error: yaml.MarkedYAMLError) -> str:
    words = _words(error)
    return next((hint for part, hint in _ADVICE if part in words), "Look at indentation and quotes here.")
