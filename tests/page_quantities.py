"""The page's module of the quantities that a user gives: `python -m tests.page_quantities` makes it of the core's.

As Prettier has it, so that it is checked like any other module; a test holds it to the core. Parameters and limits
are not in it: each preset is served with theirs.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import MISSING

from app.contract.places import COLUMNS
from heli2dof_core.estimators import Observer
from heli2dof_core.poles import LARGEST
from heli2dof_core.quantities import Field
from heli2dof_core.request import LIMITS, OUTER, PARAMETERS, ROTORS, STRUCTURE, Place, quantities
from tests.children import ROOT
from tests.page_source import key, literal

PAGE = ROOT / "static" / "model" / "quantities.js"
HEAD = """/**
 * What a design and its experiment are made of, under their paths in the contract: units, ranges, words, and what
 * they are unless someone says otherwise. Made of the core's dataclasses by `python -m tests.page_quantities`; not to
 * be changed by hand.
 *
 * @typedef {object} Quantity
 * @property {string} [unit]  SI
 * @property {number} [min]
 * @property {number} [max]
 * @property {string[]} [words]  that it may be
 * @property {number|boolean|string} [standard]  without: the preset's, or none
 */

/** @type {Partial<Record<string, Quantity>>} */
export const QUANTITIES = {
"""
GROUPS = {
    "STRUCTURE": ("The structure of the closed loop", STRUCTURE),
    "OUTER": ("The outer loops' own", OUTER),
    "ROTORS": ("Whether the rotors are placed, too", ROTORS),
}
"""What stands right in a request, by what it makes up there: name in the module → in words, place."""


def module() -> str:
    """The whole module."""
    own = (item for item in (*quantities(), *quantities([COLUMNS])) if item[1] not in (PARAMETERS, LIMITS))
    poles = f"  poles: {{ unit: 'rad/s', min: {literal(-LARGEST)}, max: {literal(LARGEST)} }},\n"
    observer = ", ".join(literal(pole.real) for pole in Observer().poles.values)
    standing = (
        "\n/** Of an observer, unless someone says otherwise: q₁ to q₄, rad/s. */\n"
        f"export const OBSERVER_POLES = [{observer}];\n"
    )
    return "".join((HEAD, poles, *(_entry(*item) for item in own), "};\n", standing, *map(_names, GROUPS)))


def _names(name: str) -> str:
    about, place = GROUPS[name]
    return (
        f"\n/** {about}: the names right in a request. */\n"
        f"export const {name} = /** @type {{const}} */ ([{', '.join(map(literal, place.fields))}]);\n"
    )


def _entry(path: str, place: Place, known: Field) -> str:
    said = ", ".join(f"{name}: {value}" for name, value in _said(path, place, known))
    return f"  {key(path)}: {{ {said} }},\n" if said else f"  {key(path)}: {{}},\n"


def _said(path: str, place: Place, known: Field) -> Iterator[tuple[str, str]]:
    about = known.quantity
    if about.unit:
        yield "unit", literal(about.unit)
    if about.low is not None and about.high is not None:
        yield "min", literal(about.low)
        yield "max", literal(about.high)
    if known.choices:
        yield "words", f"[{', '.join(map(literal, known.choices))}]"
    if not place.proposed(path.rpartition(".")[2]) and known.default not in (MISSING, None):
        yield "standard", literal(known.default)


if __name__ == "__main__":
    PAGE.write_text(module(), encoding="utf-8")
