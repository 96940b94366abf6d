"""`heli2dof compare` and `robustness`: several methods, many rigs. These take a while and say how far they are."""

from __future__ import annotations

from collections.abc import Iterator
from typing import IO, TYPE_CHECKING, Any

import click

from .fields import DESIGN, LOOPS, SCENARIO, Option, body, takes
from .output import console, load_kernels, print_json, refusals, show
from .values import Assignment, Name, Words

if TYPE_CHECKING:
    from heli2dof_core import Cloud


class _Methods(Name):
    convert = Words.convert


def _method_names() -> Iterator[str]:
    from heli2dof_core import METHODS

    yield from METHODS


def _parameter_names() -> Iterator[str]:
    from heli2dof_core.parameters import PARAMETER_INFO

    yield from PARAMETER_INFO


_METHODS = Option("--methods", "methods", _Methods(_method_names), "Which, with commas; all by default.")
_TUNING = Option(
    "--tuning",
    "tuning",
    Name(lambda: ("kept", "placed", "tuned")),
    "Of the outer loops: kept as given; placed, none; tuned, each method's own by one rule.",
)
_SPREAD = Option(
    "--uncertainty",
    "uncertainty",
    Assignment(_parameter_names),
    "Relative, of a parameter: J_p=0.2; repeatable. By default 0.1 of all but g.",
)
_CLOUD = (
    _SPREAD,
    Option("--distribution", "distribution", Name(lambda: ("uniform", "normal")), "uniform or normal."),
    Option("--rigs", "samples", click.INT, "How many rigs (samples), 200 by default."),
    Option("--seed", "seed", click.INT, "Of the random rigs."),
)


@click.command()
@takes(*DESIGN, *LOOPS, *SCENARIO, _METHODS, _TUNING)
def compare(as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Print the same poles through several methods, side by side."""
    from heli2dof_core import compare as compare_methods

    from ..contract.comparison import CompareRequest, comparison_reply

    with refusals(as_json):
        request = CompareRequest.model_validate(body(base, values))
        spec = request.to_spec()
        load_kernels()
        result = compare_methods(spec, request.methods, request.tuning)
        if as_json:
            return print_json(comparison_reply(result))
        show(result.tables())
        click.echo(result.rule)
        click.echo(result.claim)
    return None


@click.command()
@takes(*DESIGN, *LOOPS, *SCENARIO, *_CLOUD)
def robustness(as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Print what one controller does on many rigs with uncertain parameters."""
    from heli2dof_core.robustness import cloud_in_parts

    from ..contract.robustness import RobustnessRequest, cloud_reply

    with refusals(as_json):
        request = RobustnessRequest.model_validate(body(base, values))
        spec, uncertainty = request.to_spec(), request.to_uncertainty()
        load_kernels()
        result = _followed(cloud_in_parts(spec, uncertainty), uncertainty.samples)
        if as_json:
            return print_json(cloud_reply(result))
        show(result.tables(), result.summary())
    return None


def _followed(parts: Iterator[Cloud], samples: int) -> Cloud:
    """The last of the parts; a bar on a terminal's stderr shows how far it is."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    out = console(stderr=True)
    columns = (BarColumn(), MofNCompleteColumn(), "rigs", TimeRemainingColumn())
    part = next(parts)
    with Progress(*columns, console=out, transient=True, disable=not out.is_terminal) as progress:
        task = progress.add_task("rigs", total=samples, completed=part.done)
        for part in parts:
            progress.update(task, completed=part.done)
    return part
