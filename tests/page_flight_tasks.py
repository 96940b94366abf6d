"""The page's module of tasks in the air and of flights' figures: `python -m tests.page_flight_tasks` writes it.

As Prettier and TypeScript have it; a test holds it to the core.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from heli2dof_core.figures import FLIGHT, FLIGHT_BY_AXIS
from heli2dof_core.flight import scores
from heli2dof_core.flight.tasks import TASKS, task, told
from tests.children import ROOT
from tests.page_figures import figure_object
from tests.page_source import WIDTH, literal, quoted

PAGE = ROOT / "static" / "kernel" / "flight_tasks.js"
HEAD = """/**
 * Tasks in the air, and the figures of flights by which they are scored. Made of heli2dof_core/flight/tasks and of
 * heli2dof_core/figures by `python -m tests.page_flight_tasks`; not to be changed by hand.
 *
 * @typedef {import('../model/figures.js').Figure} Figure
 * @typedef {keyof typeof FLIGHT} Name  of a figure
 * @typedef {object} Task
 * @property {string} name
 * @property {string} title
 * @property {string} words  what is to be done
 * @property {number} duration  s
 * @property {[time: number, theta: number, psi: number][]} marks  what is asked: s, share of the reach from θ₀, rad
 * @property {Name} figure  by which stars are given
 * @property {Name[]} figures  that are told, it first
 * @property {[number, number, number]} stars  limits of one, two and three
 * @property {number} gusts
 * @property {number} strength  of their torques, as a share of what a motor's limit gives
 * @property {boolean} free  whether set points are the pilot's
 * @property {''|'landed'|'reached'} ends  how it is done before its time
 * @property {number} pilots
 * @property {boolean} per_square_volt  whether stars' limits are times V_p² + V_y² of the motors' limits
 */
"""
LIMITS = ("HIGHEST", "ROOM", "REACHED", "LANDED", "AT_REST", "RESTED", "EARLY")


def module() -> str:
    """The whole module."""
    parts = [HEAD, "\n/** What tasks and scores mean by near, at rest and later (flight/tasks/task.py). */\n"]
    parts += ["export const NEAR = {\n", *(f"  {name}: {literal(getattr(task, name))},\n" for name in LIMITS)]
    parts += [
        f"  WITHIN: {literal(scores.WITHIN)},\n}};\n\n/** @type {{Task[]}} */\nexport const TASKS = [\n"
    ]
    for own in TASKS.values():
        parts += ["  {\n", *(_property(name, value) for name, value in told(own).items()), "  },\n"]
    by_axis = ", ".join(map(quoted, FLIGHT_BY_AXIS))
    parts += [f"];\n\n/** Figures with a value per axis. */\nexport const BY_AXIS = [{by_axis}];\n\n"]
    parts.append(figure_object("flight", FLIGHT))
    return "".join(parts)


def _property(name: str, value: Any) -> str:
    if isinstance(value, list):
        return "".join(_list(name, value))
    line = f"    {name}: {literal(value)},\n"
    if len(line) - 1 <= WIDTH:
        return line
    return f"    {name}:\n      {literal(value)},\n"


def _list(name: str, values: list[Any]) -> Iterator[str]:
    shown = [_flat(value) if isinstance(value, list) else literal(value) for value in values]
    line = f"    {name}: [{', '.join(shown)}],\n"
    if len(line) - 1 <= WIDTH and not (len(values) > 1 and isinstance(values[0], list)):
        yield line
        return
    yield f"    {name}: [\n"
    yield from (f"      {value},\n" for value in shown)
    yield "    ],\n"


def _flat(values: list[float]) -> str:
    return f"[{', '.join(literal(value) for value in values)}]"


if __name__ == "__main__":
    PAGE.write_text(module(), encoding="utf-8")
