"""The file that `heli2dof lab new` writes: a lab that passes every check, with a word on each of its fields."""

from __future__ import annotations

from pathlib import Path

TEMPLATE = Path(__file__).with_name("new.yaml")


def new_lab(name: str) -> str:
    """A lab's file of this name, to be changed; `name` as the format has it."""
    return TEMPLATE.read_text(encoding="utf-8").replace("name: my-lab", f"name: {name}", 1)
