"""The labs that ship, and those in an instructor's folder."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from types import MappingProxyType

from .lab import Lab
from .nodes import LONGEST, Scalar, nodes_of
from .problems import LabError, LabProblem
from .reading import read_lab

SHIPPED = Path(__file__).with_name("shipped")
ENDINGS = (".yaml", ".yml")
_log = logging.getLogger(__name__)


def read_file(path: Path) -> Lab:
    """The lab in a file, whose name it has.

    Raises:
        LabError: it is none, or has another name.
        OSError: the file cannot be read.
    """
    text = text_of(path)
    lab = read_lab(text, path.name)
    problems = named_as(text, path.stem)
    if problems:
        raise LabError(problems, path.name)
    return lab


def named_as(text: str, stem: str) -> tuple[LabProblem, ...]:
    """What is wrong with a lab's name where its file is called `stem`."""
    try:
        node = nodes_of(text).fields.get("name", (None, None))[1]
    except LabError:
        return ()
    if not isinstance(node, Scalar) or node.text == stem:
        return ()
    message = f"the lab is called {node.text}, its file {stem}"
    return (LabProblem(node.line, node.column, "name", message, "Give both one name."),)


def text_of(path: Path) -> str:
    """A lab file's text.

    Raises:
        LabError: it is too large, or no text.
        OSError: it cannot be read.
    """
    with path.open("rb") as file:
        raw = file.read(4 * LONGEST + 1)
    if len(raw) > 4 * LONGEST:
        raise LabError(
            [LabProblem(1, 1, "", "the file is too large", f"A lab has at most {LONGEST} characters.")]
        )
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError as error:
        before = raw[: error.start]
        line, column = before.count(b"\n") + 1, error.start - before.rfind(b"\n")
        raise LabError(
            [LabProblem(line, column, "", "this is no UTF-8", "Save the file as UTF-8.")]
        ) from None


def labs_in(folder: Path | str) -> Mapping[str, Lab]:
    """The labs of a folder by name, in the course's order; a broken one is told of in the log, and left out."""
    found = []
    for path in sorted(Path(folder).glob("*")):
        if path.suffix not in ENDINGS or not path.is_file():
            continue
        try:
            found.append(read_file(path))
        except (LabError, OSError) as error:
            _log.warning("the lab %s is left out: %s", path.name, error)
    return MappingProxyType({lab.name: lab for lab in sorted(found, key=_place)})


@cache
def shipped_labs() -> Mapping[str, Lab]:
    """The labs that ship, by name, in the course's order."""
    found = [read_file(path) for path in sorted(SHIPPED.glob("*.yaml"))]
    return MappingProxyType({lab.name: lab for lab in sorted(found, key=_place)})


def shipped_text(name: str) -> str:
    """The file of a lab that ships."""
    return text_of(SHIPPED / f"{shipped_labs()[name].name}.yaml")


def _place(lab: Lab) -> tuple[int, str]:
    return (1000 if lab.number is None else lab.number, lab.name)
