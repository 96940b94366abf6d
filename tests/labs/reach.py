"""Whether a lab can be solved by every student: its solution, moved by a search on each rig that it misses on.

    python -m tests.labs.reach one-pair my-lab.yaml --rigs 500

A search may do what the student may: move the poles and PI values that a step unlocks. It minimizes by how much the
goals are missed, in shares of their limits, by SciPy's Nelder and Mead, from the solution and from points around it.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

from heli2dof_core import Heli2DofError, warm_up
from heli2dof_core.figures.written import in_shown_unit
from heli2dof_core.labs import Lab, Marked, Step, mark, read_file, shipped_labs, student_rig
from heli2dof_core.labs.bodies import Flat, body_of_flat
from heli2dof_core.labs.flights import tried_flight
from heli2dof_core.labs.goals.figure import FigureGoal
from heli2dof_core.labs.rigs import free_paths, solution_flat
from heli2dof_core.request import Body

TRIES = 3
"""Searches from further points, each farther away, before a rig counts as unsolved."""
EVALUATIONS = 250
"""Of the core, by each search."""
FAR = 10.0
"""What an unstable loop, or a figure that does not come about, counts."""


@dataclass(frozen=True)
class Reached:
    """What came of one student's rig.

    Attributes:
        seed, step: whose.
        at_once: whether the solution itself reaches every goal.
        marked: the best that was found.
    """

    seed: int
    step: str
    at_once: bool
    marked: Marked

    @property
    def missed(self) -> list[str]:
        """Goals that are not met."""
        return [
            f"{goal.name}: {goal.value_text}, not {goal.required_text}"
            for goal in self.marked.goals
            if not goal.met
        ]


class Free:
    """The free poles and PI values of a design, as a vector."""

    def __init__(self, flat: Flat, free: list[str]) -> None:
        self.flat, self.pairs, self.positive = flat, [], []
        for pair in ("poles.pitch", "poles.yaw"):
            if any(pair == path for path in free):
                self.pairs.append(pair)
        for path in ("loops.pitch.kp", "loops.pitch.ti", "loops.yaw.kp", "loops.yaw.ti"):
            if any(path.startswith(f"{own}.") or path == own for own in free):
                self.positive.append(path)

    def vector(self) -> np.ndarray:
        """Of each pair (s₁ + s₂)/2 and the discriminant's signed root; of PI values the logarithms."""
        found = []
        for pair in self.pairs:
            p, q = (
                complex(own["re"], own["im"]) if isinstance(own, dict) else complex(own)
                for own in self.flat[pair]
            )
            found += [(p + q).real / 2, -abs(p - q) / 2 if abs(p.imag) < 1e-12 else abs(p.imag)]
        return np.array([*found, *(np.log(self.flat[path]) for path in self.positive)])

    def body(self, x: np.ndarray) -> dict:
        """The design at a vector."""
        flat, at = dict(self.flat), 0
        for pair in self.pairs:
            re, size = (float(v) for v in x[at : at + 2])
            at += 2
            if size > 0:
                flat[pair] = [{"re": re, "im": size}, {"re": re, "im": -size}]
            else:
                flat[pair] = [re + size, re - size]
        flat |= {path: float(np.exp(v)) for path, v in zip(self.positive, x[at:], strict=True)}
        return body_of_flat(flat)


def missed_by(step: Step, marked: Marked) -> float:
    """By how much goals are missed, in shares of their limits; 0 where none is."""
    total = 0.0
    for goal, told in zip(step.goals, marked.goals, strict=True):
        if told.met:
            continue
        if not isinstance(goal, FigureGoal) or told.value is None:
            total += FAR if told.value is None else 1.0 + getattr(goal, "min", 1.0) - told.value
            continue
        figure = goal.measured.figure
        shown = in_shown_unit(figure, abs(told.value) if figure.signed else told.value)
        high = np.inf if goal.max is None else in_shown_unit(figure, goal.max)
        low = -np.inf if goal.min is None else in_shown_unit(figure, goal.min)
        over = max(shown - high, low - shown, 0.0)
        total += 1e-3 + over / max(abs(high) if over == shown - high else abs(low), 1e-3)
    return total


def reached(lab: Lab, step: Step, seed: int, tries: int = TRIES) -> Reached:
    """Whether the goals of a step can be reached on a student's rig."""
    rig = student_rig(lab, seed)
    flat = solution_flat(lab, step, rig, seed)
    assert flat is not None, f"{lab.name}/{step.name} has no solution"

    def marked_of(body: Body) -> Marked:
        return mark(lab, step.name, rig, body, {}, seed=seed, flight=tried_flight(step, body))

    best = marked_of(body_of_flat(flat))
    at_once = all(goal.met is not False for goal in best.goals)
    if at_once:
        return Reached(seed, step.name, True, best)
    free, rng = Free(flat, free_paths(lab, step)), np.random.default_rng(seed)
    begin, least = free.vector(), missed_by(step, best)

    def cost(x: np.ndarray) -> float:
        nonlocal best, least
        if least == 0.0:
            return 0.0
        try:
            marked = marked_of(free.body(x))
        except Heli2DofError:
            return 1e3
        found = missed_by(step, marked)
        if found < least:
            best, least = marked, found
        return found

    for attempt in range(tries if len(begin) else 0):
        spread = 0.15 * attempt * np.maximum(np.abs(begin), 0.3)
        start = begin + spread * rng.standard_normal(len(begin))
        minimize(
            cost, start, method="Nelder-Mead", options={"maxfev": EVALUATIONS, "xatol": 1e-4, "fatol": 1e-7}
        )
        if least == 0.0:
            break
    return Reached(seed, step.name, False, best)


def over_rigs(lab: Lab, seeds: range) -> Iterator[Reached]:
    """Every step with goals, on every student's rig."""
    for step in lab.steps:
        if step.goals:
            for seed in seeds:
                yield reached(lab, step, seed)


def main() -> None:
    """Prints per lab and step how many rigs the solution reaches at once, and how many a search solves."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "labs", nargs="*", help="files, or names of labs that ship; all of these where left out"
    )
    parser.add_argument("--rigs", type=int, default=20)
    parser.add_argument("--first", type=int, default=0, help="seed")
    given = parser.parse_args()
    warm_up()
    labs = [shipped_labs().get(name) or read_file(Path(name)) for name in given.labs] or [
        *shipped_labs().values()
    ]
    failed = 0
    for lab in labs:
        for step in lab.steps:
            if not step.goals:
                continue
            found = [reached(lab, step, seed) for seed in range(given.first, given.first + given.rigs)]
            unsolved = [own for own in found if own.missed]
            failed += len(unsolved)
            at_once = sum(own.at_once for own in found)
            print(
                f"{lab.name}/{step.name}: {at_once} of {len(found)} at once, {len(found) - len(unsolved)} solved"
            )
            for own in unsolved[:10]:
                print(f"  seed {own.seed}: {'; '.join(own.missed)}")
    raise SystemExit(1 if failed else 0)


if __name__ == "__main__":
    main()
