"""The page's names of structures and methods, made of the core's: `python -m tests.page_methods` writes the module.

As Prettier has it, so that it is checked like any other module; a test holds it to the core.
"""

from __future__ import annotations

from typing import get_args

from heli2dof_core.couplings import STRUCTURES, Coupling, Lead, Structure
from heli2dof_core.placement.registry import METHODS
from tests.children import ROOT
from tests.page_source import WIDTH, key, quoted

PAGE = ROOT / "static" / "model" / "method_names.js"
HEAD = """/**
 * Names of structures and methods, made of heli2dof_core/couplings.py and heli2dof_core/placement by
 * `python -m tests.page_methods`; not to be changed by hand.
 */

"""


def module() -> str:
    """The whole module."""
    names = [f"  {key(method.name)}: {quoted(method.short)},\n" for method in METHODS.values()]
    return "".join(
        (
            HEAD,
            *(
                f"export const {name} = [{', '.join(map(quoted, get_args(known)))}];\n"
                for name, known in (("COUPLINGS", Coupling), ("LEADS", Lead))
            ),
            "\n/** @type {[string, string, string][]} key, name, explanation */\n",
            "export const STRUCTURES = [\n",
            *map(_row, STRUCTURES),
            "];\n\n/** @type {Record<string, string>} */\nexport const METHODS = {\n",
            *names,
            "};\n",
        )
    )


def _row(structure: Structure) -> str:
    parts = ["full-rank", structure.coupling]
    own = "/".join([*parts, structure.lead] if structure.coupling == "triangular" else parts)
    cells = [*map(quoted, (own, structure.title, structure.meaning))]
    line = f"  [{', '.join(cells)}],\n"
    return line if len(line) <= WIDTH + 1 else "".join(("  [\n", *(f"    {c},\n" for c in cells), "  ],\n"))


if __name__ == "__main__":
    PAGE.write_text(module(), encoding="utf-8")
