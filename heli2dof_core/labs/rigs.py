"""Each student's own rig, and the designs on it: a step's start, a solution, what was handed in."""

from __future__ import annotations

from collections.abc import Mapping
from hashlib import sha256
from typing import Any

import numpy as np

from ..errors import InvalidInputError
from ..parameters import PARAMETER_INFO
from ..request import Body
from .bodies import PATHS, Flat, body_of_flat, flat_body, merged
from .lab import Lab, Step
from .locks import LOCKS, forced, names_of

DIGITS = 9
"""Significant digits of a varied parameter: as many as make two alike improbable, and short in a file."""


def lab_rig(lab: Lab) -> Body:
    """The body of the lab's own rig, before it varies."""
    return merged({"preset": lab.preset}, lab.rig)


def path_of_varied(name: str) -> str:
    """Where what varies stands in a body: parameters by their names alone, all else by its path."""
    return f"parameters.{name}" if name in PARAMETER_INFO else name


def student_rig(lab: Lab, seed: int) -> Body:
    """The rig of the student with this seed, as a part of a design body.

    The same seed gives the same rig on every machine and with every version of NumPy: PCG64's bits themselves, seeded
    by student and path, so that a further parameter that varies changes none of the others.

    Where the lab hides it, this is the rig as it is printed, the same for all: `true_rig` is the student's.

    Args:
        lab: whose `vary` says what differs, uniformly within ± a share.
        seed: of the student, not negative.

    Raises:
        InvalidInputError: a value is varied that the rig does not have.
    """
    return lab_rig(lab) if lab.hidden_rig else true_rig(lab, seed)


def true_rig(lab: Lab, seed: int) -> Body:
    """The same; where the lab hides it, what no page is ever told.

    Raises:
        InvalidInputError: as `student_rig`.
    """
    rig = merged(lab_rig(lab), lab.worn)
    if not lab.vary:
        return rig
    flat, changes = flat_body(rig), {}
    for name, share in lab.vary.items():
        path = path_of_varied(name)
        value = flat.get(path)
        if path not in PATHS or isinstance(value, bool) or not isinstance(value, (int, float)) or not value:
            raise InvalidInputError(
                f"the rig has no value {name} that could vary",
                field=f"vary.{name}",
                hint="Name a parameter such as B_p, or a path such as rotors.pitch.tau whose value is not 0.",
            )
        about = PATHS[path][1]
        drawn = about.quantity.nearest(value * (1 + share * (2 * uniform(seed, path) - 1)))
        changes[path] = round(drawn) if about.kind is int else float(f"{drawn:.{DIGITS}g}")
    return merged(rig, nested(changes))


def uniform(seed: int, path: str) -> float:
    """A number from 0 to 1 that belongs to a student and a name."""
    own = int.from_bytes(sha256(path.encode()).digest()[:8], "big")
    bits = np.random.PCG64(np.random.SeedSequence([seed, own])).random_raw()
    return (int(bits) >> 11) * 2.0**-53


def nested(flat: Mapping[str, Any]) -> Body:
    """Paths as objects within one another."""
    body: Body = {}
    for path, value in flat.items():
        *above, last = path.split(".")
        level = body
        for name in above:
            level = level.setdefault(name, {})
        level[last] = value
    return body


def start_body(
    lab: Lab, step_name: str, rig: Mapping[str, Any], before: Mapping[str, Any] | None = None
) -> Body:
    """The full design body with which a step starts.

    Args:
        lab: the lab.
        step_name: of the step.
        rig: the student's, as `student_rig` gives it.
        before: the student's design of the step before, where this one continues it; what was not theirs to change is
            not taken from it. None: as that step starts.

    Raises:
        Heli2DofError: there is no such step, or the design does not exist.
    """
    return body_of_flat(start_flat(lab, lab.step(step_name), rig, before))


def start_flat(lab: Lab, step: Step, rig: Mapping[str, Any], before: Mapping[str, Any] | None = None) -> Flat:
    """The same as a flat table."""
    previous = lab.before(step) if step.continues else None
    if previous is None:
        return flat_body(merged(rig, step.start))
    base = start_flat(lab, previous, rig)
    if before is not None:
        base, _ = forced(base, flat_body(before), free_paths(lab, previous))
    return flat_body(merged(body_of_flat(base), step.start))


def free_paths(lab: Lab, step: Step) -> list[str]:
    """The paths of a design that are the student's own in a step.

    What it unlocks; and where it continues, what was free in the step before, unless its start names it anew: the
    page alone locks that, for the student could go back and change it.
    """
    own = [path for lock in step.unlocked for path in LOCKS[lock]]
    previous = lab.before(step) if step.continues else None
    if previous is not None:
        named = list(_named(step.start))
        own += [path for path in free_paths(lab, previous) if not any(_meet(path, name) for name in named)]
    return [*dict.fromkeys(own)]


def _named(body: Mapping[str, Any], above: str = "") -> list[str]:
    found = []
    for name, value in body.items():
        path = f"{above}{name}"
        if isinstance(value, Mapping) and value:
            found += _named(value, f"{path}.")
        else:
            found.append(path)
    return found


def _meet(a: str, b: str) -> bool:
    return a == b or a.startswith(f"{b}.") or b.startswith(f"{a}.")


def solution_flat(lab: Lab, step: Step, rig: Mapping[str, Any], seed: int | None = None) -> Flat | None:
    """The reference solution on a student's rig; None where the step has none.

    Where a step continues the one before, it is over that one's solution. Where the rig is hidden and its parameters
    are free, whoever solves it knows the true ones of the student with this seed.
    """
    if step.solution is None:
        return None
    previous = lab.before(step) if step.continues else None
    before = None if previous is None else solution_flat(lab, previous, rig, seed)
    start = body_of_flat(start_flat(lab, step, rig, None if before is None else body_of_flat(before)))
    if lab.hidden_rig and seed is not None and "parameters" in step.unlocked:
        start = merged(start, {"parameters": body_of_flat(flat_body(true_rig(lab, seed)))["parameters"]})
    return flat_body(merged(start, step.solution))


def handed_in(
    lab: Lab, step: Step, rig: Mapping[str, Any], body: Mapping[str, Any]
) -> tuple[Flat, tuple[str, ...]]:
    """A student's design on their own rig, with what is locked taken from the step's start.

    Returns:
        the design as a flat table, and the names of locked parts that it names and in which it differed.

    Raises:
        Heli2DofError: the design as it was handed in is none.
    """
    given = {name: value for name, value in body.items() if name in _KNOWN}
    own = merged({"preset": rig.get("preset", lab.preset)}, given)
    found, differing = forced(start_flat(lab, step, rig), flat_body(own), free_paths(lab, step))
    named = _named(given)
    return found, names_of([path for path in differing if any(_meet(path, name) for name in named)])


_KNOWN = {path.partition(".")[0] for path in PATHS} | {"preset", "method", "poles", "split", "rotor_poles"}
