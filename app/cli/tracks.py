"""`heli2dof track`: the loop's poles, and figures, as one number is swept."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

import click

from .fields import DESIGN, LOOPS, SCENARIO, Option, body, takes
from .output import load_kernels, print_json, refusals, show, written
from .values import Figures, Name, Numbers


def _paths() -> Iterator[str]:
    from heli2dof_core import Spec
    from heli2dof_core.tracks import swept_paths

    return swept_paths(Spec.from_preset())


_TRACK = (
    Option("--over", "track.over", Numbers(), "Lowest and highest value: 0,2; around its own by default."),
    Option("--points", "track.points", click.INT, "How many values, 200 by default."),
    Option("--scale", "track.scale", Name(lambda: ("linear", "log")), "linear, or log."),
    Option("--kept/--anew", "track.kept", None, "Keep the gains, so that only the rig changes."),
    Option(
        "--measures",
        "track.measures",
        Figures(),
        "Figures along it: disk_margin,settling_time:theta:linear.",
    ),
)


@click.command()
@click.argument("path", metavar="PATH", type=Name(_paths))
@click.option("--csv", "csv", is_flag=True, help="Write numbers, one row per value.")
@click.option("--svg", "svg", is_flag=True, help="Draw the courses of the poles, and figures below.")
@click.option("-o", "--output", type=click.Path(path_type=Path), help="File for --csv or --svg.")
@click.option("--force", is_flag=True, help="Write over a file that is there.")
@takes(*DESIGN, *LOOPS, *SCENARIO, *_TRACK)
def track(
    path: str,
    *,
    csv: bool,
    svg: bool,
    output: Path | None,
    force: bool,
    as_json: bool,
    base: IO[str] | None,
    **values: Any,
) -> None:
    """Sweep the number PATH of a design: gain, gain.pitch, loops.pitch.kp, rotors.tau, pitch-pair.damping.

    Any number of a request has its path. gain is the factor on the motors' voltages, from the open loop, 0, to the
    design, 1: the root locus.
    """
    from ..contract.tracks import TrackRequest, track_reply

    with refusals(as_json):
        request = TrackRequest.model_validate(body(base, {**values, "track__path": path}))
        load_kernels()
        found = request.to_track()
        if as_json:
            return print_json(track_reply(found))
        if csv or svg:
            from heli2dof_core.export.tracks import track_csv, track_svg

            content = (track_csv if csv else track_svg)(found, request.to_spec())
            return written(content, output, force=force)
        show(found.tables(), found.summary())
    return None
