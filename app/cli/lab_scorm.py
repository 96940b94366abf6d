"""`heli2dof lab scorm`: a lab as a SCORM package for a learning management system."""

from __future__ import annotations

from pathlib import Path

import click

from .lab_files import LabFile, opened
from .output import load_kernels, refusals


@click.command()
@click.argument("lab", type=LabFile())
@click.option("-o", "--output", type=click.Path(path_type=Path), help="File; LAB.zip where left out.")
@click.option("--force", is_flag=True, help="Write over a file that is there.")
@click.option(
    "--pass",
    "passed",
    type=click.FloatRange(0, 100),
    default=80.0,
    show_default=True,
    help="Percent of the points from which the LMS is told that the lab is passed.",
)
@click.option("--json", "as_json", is_flag=True, help="Refusals as the REST API words them.")
def scorm(lab: Path, output: Path | None, force: bool, passed: float, as_json: bool) -> None:
    """Write LAB, a name or a file, as a SCORM 1.2 package: practice that needs no server.

    The page in it marks itself, so it holds the answers: it is no proof of who did what. What needs a
    server is left out, and named here.
    """
    from ..ops.settings import static_folder
    from ..scorm import lab_content, scorm_package

    with refusals(as_json):
        chosen = opened(lab)
        load_kernels()
        content, left_out = lab_content(chosen, passed=passed / 100)
    package = scorm_package(chosen.name, chosen.title, content, static_folder())
    path = output or Path(f"{chosen.name}.zip")
    try:
        with path.open("wb" if force else "xb") as file:
            file.write(package.content)
    except FileExistsError as error:
        raise click.ClickException(f"{path} is there already; --force writes over it") from error
    except OSError as error:
        raise click.ClickException(f"cannot write {path}: {error.strerror}") from error
    click.echo(path)
    steps = len(content["lab"]["steps"])
    click.echo(
        f"{len(package.content) / 1000:.0f} kB, {steps} of {steps + len(left_out)} steps, "
        f"{len(content['rigs'])} rigs. Practice: the page marks itself, and holds the answers.",
        err=True,
    )
    for each in left_out:
        click.echo(f"left out: {each.title}: {each.why}", err=True)
