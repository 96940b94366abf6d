"""`heli2dof export`: a design as a file for another tool."""

from __future__ import annotations

from pathlib import Path
from typing import IO, Any

import click

from ..contract.exports import FORMATS
from .fields import DESIGN, LOOPS, SCENARIO, body, takes
from .output import refusals, written

_LIST = "\n".join(f"  {each.name:<12} {each.title}" for each in FORMATS.values())


@click.command(epilog=f"\b\nFormats:\n{_LIST}")
@click.argument("name", metavar="FORMAT", type=click.Choice([*FORMATS]))
@click.option("-o", "--output", type=click.Path(path_type=Path), help="File, or - for standard output.")
@click.option("--force", is_flag=True, help="Write over a file that is there.")
@takes(*DESIGN, *LOOPS, *SCENARIO)
def export(
    name: str, output: Path | None, force: bool, as_json: bool, base: IO[str] | None, **values: Any
) -> None:
    """Write a design in FORMAT to a file, and print the file's name."""
    from ..contract.experiment import StepRequest

    chosen = FORMATS[name]
    with refusals(as_json):
        content = chosen.content(StepRequest.model_validate(body(base, values)).to_spec())
    written(content, output or Path(chosen.filename), force=force)
