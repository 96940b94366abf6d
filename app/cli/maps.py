"""`heli2dof map`: one figure over a plane of designs, as a table, as rows of numbers or as a picture."""

from __future__ import annotations

from pathlib import Path
from typing import IO, Any

import click

from .fields import DESIGN, LOOPS, MAP, SCENARIO, body, takes
from .output import load_kernels, print_json, refusals, show, written

_KINDS = {".svg": "svg", ".csv": "csv"}


@click.command()
@takes(*DESIGN, *LOOPS, *SCENARIO, *MAP)
@click.option("--svg", "kind", flag_value="svg", help="Write a picture.")
@click.option("--csv", "kind", flag_value="csv", help="Write a row per place.")
@click.option(
    "-o", "--output", type=click.Path(path_type=Path), help="File, .svg or .csv, or - for standard output."
)
@click.option("--force", is_flag=True, help="Write over a file that is there.")
def map(  # noqa: A001 # as the command is called
    as_json: bool,
    base: IO[str] | None,
    kind: str | None,
    output: Path | None,
    force: bool,
    **values: Any,
) -> None:
    """Print what each place of a pair of poles, or of an axis' PI gains, would give."""
    from ..contract.maps import MapRequest, map_reply

    chosen = kind or (_KINDS.get(output.suffix.lower()) if output is not None else None)
    if output is not None and chosen is None:
        raise click.UsageError("-o: say what is to be written: --svg, --csv, or a name that ends so")
    request = body(base, values)
    if not isinstance(request.get("map"), dict) or "move" not in request["map"]:
        raise click.UsageError("--move: say what is moved: pitch-pair, yaw-pair, pitch-pi or yaw-pi")
    with refusals(as_json):
        asked = MapRequest.model_validate(request)
        asked.to_spec()  # what is refused at once needs no kernels
        load_kernels()
        found = asked.to_map(_nobody_leaves)
        if chosen is not None:
            content = found.svg() if chosen == "svg" else found.csv()
        elif as_json:
            return print_json(map_reply(found))
        else:
            show(found.tables(), found.summary())
            return None
    written(content, output or Path(f"heli2dof_map.{chosen}"), force=force)
    return None


def _nobody_leaves() -> None:
    """Who waits at a terminal leaves by the keyboard."""
