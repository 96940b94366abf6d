"""`heli2dof find`: designs that meet what is required, along the front of what is to be small."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import IO, TYPE_CHECKING, Any

import click

from .fields import DESIGN, LOOPS, SCENARIO, Option, body, require_asked, takes
from .output import console, load_kernels, print_json, refusals, show
from .values import Assignment, Figures, Limits, Name, Numbers, Words

if TYPE_CHECKING:
    from heli2dof_core.finder import Designs, Progress


class _Names(Name):
    convert = Words.convert


def _free() -> Iterable[str]:
    from heli2dof_core.finder import FREE

    return FREE


def _uncertain() -> Iterable[str]:
    from heli2dof_core.parameters import PARAMETER_INFO
    from heli2dof_core.robustness import LAGS

    return (*PARAMETER_INFO, *LAGS)


_FIND = (
    Option("--free", "find.free", _Names(_free), "What may change: poles,loops; the poles by default."),
    Option(
        "--require",
        "find.require",
        Limits(),
        "Limits: settling_time<=0.8,overshoot:theta<=5; on 90 % of the rigs: overshoot<=5@0.9.",
    ),
    Option("--minimize", "find.minimize", Figures(), "Up to three figures: settling_time,V_peak:V_p."),
    Option(
        "--uncertainty",
        "find.uncertainty.spread",
        Assignment(_uncertain),
        "Relative, of a parameter: J_p=0.2; repeatable.",
    ),
    Option("--rigs", "find.uncertainty.samples", click.INT, "How many uncertain rigs, 200 by default."),
    Option(
        "--within-poles", "find.bounds.poles", Numbers(), "Least and largest size of a pole, rad/s: 1,40."
    ),
    Option(
        "--within-damping", "find.bounds.damping", click.FLOAT, "Least damping of a pair, 0.3 by default."
    ),
    Option("--within-kp", "find.bounds.kp", Numbers(), "Least and largest k_p, V/rad."),
    Option("--within-ti", "find.bounds.ti", Numbers(), "Least and largest T_i, s."),
    Option("--designs", "find.designs", click.INT, "How many are tried, 20000 by default."),
    Option("--seconds", "find.seconds", click.FLOAT, "After which it ends in any case, 60 by default."),
    Option("--seed", "find.seed", click.INT, "Of the random numbers: the same seed, the same designs."),
)


@click.command()
@takes(*DESIGN, *LOOPS, *SCENARIO, *_FIND)
def find(as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Search for designs that meet limits of figures; where none does, say which limits contradict."""
    from heli2dof_core.finder.result import why_text

    from ..contract.find import FindRequest
    from ..contract.find_replies import find_reply

    with refusals(as_json):
        asked = body(base, values)
        example = 'heli2dof find --require "settling_time<=0.8,overshoot<=5" --minimize V_peak:V_p'
        require_asked(asked, "find.require", example, or_else="find.minimize")
        request = FindRequest.model_validate(asked)
        load_kernels()
        found = _followed(request.in_parts(lambda: None))
        if as_json:
            return print_json(find_reply(found))
        lines = [found.summary()]
        if found.stopped:
            lines.append("The time had run out before all designs were tried; --seconds gives it more.")
        if found.why is not None:
            lines.append(why_text(found))
        show(found.tables(), *lines)
    return None


def _followed(parts: Iterator[Progress | Designs]) -> Designs:
    """The answer; a bar on a terminal's stderr shows how far it is."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

    from heli2dof_core.finder import Designs

    out = console(stderr=True)
    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("designs, {task.fields[met]} meet everything"))
    with Progress(*columns, console=out, transient=True, disable=not out.is_terminal) as progress:
        task = progress.add_task("designs", total=None, met=0)
        for part in parts:
            if isinstance(part, Designs):
                return part
            progress.update(task, total=part.designs, completed=part.tried, met=part.met)
    raise AssertionError("a search ends with its designs")
