"""docs/architecture.md says of the checkout what is so: its floors, its paths, what to read first."""

from __future__ import annotations

import re
import tomllib

import pytest

from tests.children import ROOT

TEXT = (ROOT / "docs" / "architecture.md").read_text(encoding="utf-8")
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
LAYERS = {
    tuple(contract.get("containers", ())): contract["layers"]
    for contract in tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"][
        "importlinter"
    ]["contracts"]
    if contract["type"] == "layers"
}
HOMES = (
    ROOT,
    ROOT / "docs",
    *(ROOT / "app" / name for name in ("", "scene")),
    *(ROOT / "heli2dof_core" / name for name in ("", "placement", "recordings", "export")),
    *(ROOT / "static" / name for name in ("", "kernel", "model", "scene", "ui")),
)
"""Folders from which the text names files."""


def rows(header: str) -> list[list[str]]:
    """The cells of the table with this header."""
    lines = TEXT.split(f"{header}\n", 1)[1].split("\n\n", 1)[0].splitlines()[1:]
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines]


def floors(cell: str) -> list[set[str]]:
    """What stands between `>` and `>`."""
    return [set(re.findall(r"`(\w+)`", part)) for part in cell.split(">")]


def layers(container: str) -> list[set[str]]:
    return [set(layer.split(" | ")) for layer in LAYERS[(container,)]]


def first_files(text: str) -> str:
    return " ".join("".join(re.findall(r"^\d\. (?:.+\n)(?:   .+\n)*", text, re.MULTILINE)).split())


def test_floors_of_the_core_are_those_that_are_checked():
    assert [floor for _, cell in rows("| what | modules |") for floor in floors(cell)] == layers(
        "heli2dof_core"
    )


def test_floors_of_the_app_are_those_that_are_checked():
    told = [set(re.findall(r"`(\w+)`", cell)) for cell, _ in rows("| folder or file | what |")]
    assert [{"__main__"}, *told] == layers("app")


def test_rooms_of_the_page_are_those_that_are_checked():
    source = (ROOT / "eslint.config.js").read_text(encoding="utf-8")
    listed = source.split("const FLOORS = [", 1)[1].split("\n];", 1)[0]
    rooms = [set(re.findall(r"'(\w+)'", line)) for line in listed.splitlines() if line.strip()]
    assert [set(re.findall(r"`(\w+)`", cell)) for cell, _ in rows("| rooms | what |")] == rooms[::-1]


def test_the_subjects_of_the_contract_are_its_modules():
    told = re.search(r"a module per subject.*?:\n((?:.*\n)*?.*`recordings`)\.", TEXT)
    assert told
    for name in re.findall(r"`(\w+)`", told[1]):
        assert (ROOT / "app" / "contract" / f"{name}.py").is_file(), name


def test_both_texts_name_the_same_five_files():
    told = first_files(TEXT)
    assert told == first_files(CONTRIBUTING)
    files = re.findall(r"`(.+?)`", told)
    assert len(files) == 5
    assert all((ROOT / name).is_file() for name in files)


@pytest.mark.parametrize("text", [TEXT, CONTRIBUTING], ids=["architecture", "contributing"])
def test_named_files_exist(text: str):
    named = set(re.findall(r"(?<![\w/.])((?:[\w-]+/)*[\w-]+\.(?:py|js|mjs|json|md|toml))\b", text))
    assert len(named) > 10
    assert [name for name in sorted(named) if not any((home / name).is_file() for home in HOMES)] == []


def test_architecture_is_read_in_a_terminal():
    assert [line for line in TEXT.splitlines() if len(line) > 80] == []
    picture = TEXT.split("```\n")[1]
    assert max(map(len, picture.splitlines())) <= 78
    assert picture.isascii()
