"""docs/labs.md says what is so: its example passes every check, its tables are the registries'."""

from __future__ import annotations

import re

from click.testing import CliRunner

from app.cli.group import heli2dof
from heli2dof_core.labs import mark, problems_of, read_lab, student_rig
from heli2dof_core.labs.bodies import body_of_flat
from heli2dof_core.labs.rigs import solution_flat
from tests.lab_schema import DOCS, with_tables

TEXT = DOCS.read_text(encoding="utf-8")
(EXAMPLE,) = [
    block for block in re.findall(r"```yaml\n(.*?)```", TEXT, re.DOTALL) if block.startswith("lab: 1")
]


def test_the_example_passes_every_check_and_is_solved_by_its_solution():
    assert problems_of(EXAMPLE) == ()
    lab = read_lab(EXAMPLE)
    rig = student_rig(lab, 12)
    solved = body_of_flat(solution_flat(lab, lab.step("rest"), rig))
    marked = mark(lab, "rest", rig, solved, {"slowest": "−6 rad/s"}, hints=[1])
    assert (marked.points, marked.of) == (4, 5) and marked.done


def test_tables_are_the_registries():
    assert with_tables(TEXT) == TEXT, "run `make contract`"


def test_commands_are_those_that_there_are():
    shown = set(re.findall(r"heli2dof lab (\w+)", TEXT))
    known = CliRunner().invoke(heli2dof, ["lab", "--help"], prog_name="heli2dof").output
    assert {"new", "check", "try", "mark", "figures", "schema"} <= shown
    assert all(re.search(rf"^  {name} ", known, re.MULTILINE) for name in shown)
