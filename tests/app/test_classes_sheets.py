"""A class as CSV: what Moodle and Canvas import, and nothing that a spreadsheet would run."""

from __future__ import annotations

import csv
import io
from typing import Any

import pytest

from app.classes.sheets import sheet

STEPS = [{"name": "a", "title": "First", "points": 12}, {"name": "b", "title": "Second, last", "points": 5}]


def person(name: str, number: int = 1, **more: Any) -> dict[str, Any]:
    step = {"points": 8.5, "of": 12, "attempts": 3, "hints": 1, "to_mark": 1}
    other = {"points": 0.0, "of": 5, "attempts": 0, "hints": 0, "to_mark": 0}
    about = {"number": number, "name": name, "points": 8.5, "of": 17, "last_seen": "2027-01-31T16:00:00.000Z"}
    return {**about, "steps": {"a": step, "b": other}, **more}


def rows(target: str, *people: dict[str, Any]) -> list[list[str]]:
    lab = {"name": "small", "title": "A small lab"}
    told = {"lab": lab, "points": 17, "steps": STEPS, "students": list(people)}
    return list(csv.reader(io.StringIO(sheet(told, target))))


def test_the_plain_sheet_has_every_step_and_its_share_in_percent():
    head, ada = rows("plain", person("Ada", email="ada@example.org"))
    told = dict(zip(head, ada, strict=True))
    assert told["First (of 12)"] == "8.5" and told["Second, last (of 5)"] == "0"
    assert (told["Points"], told["Of"], told["Share, %"]) == ("8.5", "17", "50.0")
    assert (told["Email"], told["Login"], told["To be marked"], told["Attempts"]) == (
        "ada@example.org",
        "",
        "1",
        "3",
    )


def test_moodle_finds_people_by_their_address_and_gets_feedback():
    head, ada = rows("moodle", person("Ada", email="ada@example.org", login="al1"))
    told = dict(zip(head, ada, strict=True))
    assert told["Email address"] == "ada@example.org" and told["Username"] == "al1"
    assert told["heli2dof: A small lab"] == "8.5"
    assert told["heli2dof: A small lab (feedback)"] == "First: 8.5 of 12; Second, last: 0 of 5"


def test_canvas_gets_its_columns_and_what_is_possible():
    head, possible, ada, bob = rows(
        "canvas", person("Ada", login="al1"), person("Bob", 2, email="bob@example.org")
    )
    assert head == ["Student", "ID", "SIS User ID", "SIS Login ID", "Section", "heli2dof: A small lab"]
    assert possible == ["Points Possible", "", "", "", "", "17"]
    assert ada == ["Ada", "", "", "al1", "", "8.5"] and bob[3] == "bob@example.org"


@pytest.mark.parametrize("target", ["plain", "moodle", "canvas"])
@pytest.mark.parametrize(
    "name", ["=1+1", "+1", "-1+2", "@SUM(A1)", "  =1", "＝1", '=HYPERLINK("http://x","y")']
)
def test_a_spreadsheet_runs_nothing_that_somebody_typed(target, name):
    cells = [cell for row in rows(target, person(name, email="=a@b", login="@c")) for cell in row]
    assert f"'{name}" in cells and name not in cells
    assert not [cell for cell in cells if cell.lstrip().startswith(("=", "+", "@", "＝"))]


@pytest.mark.parametrize("target", ["plain", "moodle", "canvas"])
@pytest.mark.parametrize("separator", [";", "\t", "|"])
def test_nor_where_another_sign_separates_the_cells(target, separator):
    formula = f"Ada{separator}=1+1{separator} @SUM(A1){separator}－1"
    lab = {"name": "small", "title": "A small lab"}
    told = {"lab": lab, "points": 17, "steps": STEPS, "students": [person(formula, login=formula)]}
    cells = [
        cell for row in csv.reader(io.StringIO(sheet(told, target)), delimiter=separator) for cell in row
    ]
    assert any("'=1+1" in cell for cell in cells)
    assert not [cell for cell in cells if cell.lstrip().startswith(("=", "+", "@", "－"))]


def test_quotes_commas_and_letters_of_the_world_come_through():
    for name in ('O"Neil, Jr.', "Ångström", "李小龍"):
        assert rows("canvas", person(name))[2][0] == name
