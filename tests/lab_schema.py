"""What follows from the format of labs: its JSON schema and the tables of docs/labs.md.

`python -m tests.lab_schema` writes both; tests hold them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from heli2dof_core.flight.tasks import TASKS
from heli2dof_core.labs import LOCKS
from heli2dof_core.labs.format import HINT, LAB, STEP
from heli2dof_core.labs.goals.flight import MEASURED as FLOWN
from heli2dof_core.labs.kinds import Record
from heli2dof_core.labs.quantities import OF_DESIGNS
from heli2dof_core.labs.schema import PUBLISHED, schema_text
from heli2dof_core.measured import MEASURED
from tests.children import ROOT

DOCS = ROOT / "docs" / "labs.md"


def with_tables(text: str) -> str:
    """The documentation with its tables anew."""
    for name, lines in tables():
        begin, end = f"<!-- {name}: made by `python -m tests.lab_schema` -->", "<!-- end -->"
        pattern = re.escape(begin) + r".*?" + re.escape(end)
        body = "\n".join((begin, "", *lines, "", end))
        text, count = re.subn(pattern, lambda _, body=body: body, text, count=1, flags=re.DOTALL)
        assert count == 1, name
    return text


def tables() -> Iterator[tuple[str, list[str]]]:
    """By name, the rows."""
    fields = [
        line
        for what, record in (("lab", LAB), ("step", STEP), ("hint", HINT))
        for line in _rows(what, record)
    ]
    yield "fields", ["| of | field | what it is |", "|---|---|---|", *fields]
    locks = [
        f"| `{name}` | {', '.join(f'`{path}`' for path in paths) or 'of the page alone'} |"
        for name, paths in LOCKS.items()
    ]
    yield "locks", ["| lock | what it holds |", "|---|---|", *locks]
    figures = []
    for name, own in MEASURED.items():
        meaning = own.figure.meaning.replace("|", "\\|")
        figures.append(f"| `{name}` | {own.of} | {own.figure.shown or own.figure.unit} | {meaning} |")
    yield "figures", ["| figure | of | unit | what it is |", "|---|---|---|---|", *figures]
    titles = [f"| `{name}` | {own.title} | {own.duration:g} s |" for name, own in TASKS.items()]
    flown = [
        f"| `{name}` | {own.figure.shown or own.figure.unit} | {own.figure.meaning} |"
        for name, own in FLOWN.items()
    ]
    yield (
        "flights",
        [
            *("| task | what it is called | |", "|---|---|---|", *titles, ""),
            *("| figure of a flight | unit | what it is |", "|---|---|---|", *flown),
        ],
    )
    asked = [f"| `{own.form}` | {own.unit} | {own.meaning} |" for own in OF_DESIGNS]
    yield "quantities", ["| quantity | unit | what it is |", "|---|---|---|", *asked]


def _rows(what: str, record: Record) -> Iterator[str]:
    for member in record.members:
        yield f"| {what} | `{member.name}`{' *' if member.required else ''} | {member.meaning} |"


if __name__ == "__main__":
    PUBLISHED.write_text(schema_text(), encoding="utf-8")
    DOCS.write_text(with_tables(DOCS.read_text(encoding="utf-8")), encoding="utf-8")
