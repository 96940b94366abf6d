"""What a command prints: tables for people, the REST API's JSON for programs, refusals that name the field."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from rich.console import Console

    from heli2dof_core import Finding
    from heli2dof_core.tables import Table

_PIPED_WIDTH = 120


def console(*, stderr: bool = False) -> Console:
    """Rich's console; as wide as the terminal, and plain text where there is none."""
    from rich.console import Console

    stream = sys.stderr if stderr else sys.stdout
    width = None if stream.isatty() else _PIPED_WIDTH
    return Console(file=stream, width=width, highlight=False, markup=False, emoji=False)


def load_kernels() -> None:
    """Has the compiled kernels ready; the first time on a machine they take some two minutes."""
    from heli2dof_core import warm_up

    with console(stderr=True).status(
        "Loading the kernels; the first time they are compiled, some two minutes"
    ):
        warm_up()


def show(tables: Iterable[Table], *lines: str, findings: Iterable[Finding] = ()) -> None:
    """Prints lines, tables and findings."""
    from rich import box
    from rich.table import Table as RichTable
    from rich.text import Text

    out = console()
    for line in lines:
        out.print(line)
    for table in tables:
        shown = RichTable(title=Text(table.title), title_justify="left", box=box.SIMPLE_HEAD, pad_edge=False)
        for head, right in zip(table.columns, table.numeric, strict=True):
            shown.add_column(Text(head), justify="right" if right else "left")
        for row in table.rows:
            shown.add_row(*map(Text, row))
        out.print(shown)
    for finding in findings:
        out.print(f"{finding.severity}: {finding.message}")


def print_json(reply: Any) -> None:
    """Prints a reply as the REST API encodes it, on one line."""
    from ..contract.encoding import json_bytes

    click.echo(json_bytes(reply))


def written(content: str | bytes, path: Path | None, *, force: bool, err: bool = False) -> None:
    """Writes a file and prints its name; to standard output where there is no path, or where it is -.

    The name is printed on stderr where `err` says so.

    Raises:
        click.ClickException: it is there already, and `force` does not say to write over it; or it cannot be written.
    """
    if path is None or path == Path("-"):
        click.echo(content, nl=False)
        return
    data = content.encode() if isinstance(content, str) else content
    try:
        with path.open("wb" if force else "xb") as file:
            file.write(data)
    except FileExistsError as error:
        raise click.ClickException(f"{path} is there already; --force writes over it") from error
    except OSError as error:
        raise click.ClickException(f"cannot write {path}: {error.strerror}") from error
    click.echo(path, err=err)


@contextmanager
def refusals(as_json: bool) -> Iterator[None]:
    """Turns refused input into a problem on stderr, as the REST API words it, and exit status 2."""
    from pydantic import ValidationError

    from heli2dof_core import Heli2DofError

    try:
        yield
    except (Heli2DofError, ValidationError) as error:
        from ..contract.problems import problem_of

        problem = problem_of(error)
        if as_json:
            from ..contract.encoding import json_bytes

            click.echo(json_bytes(problem), err=True)
        else:
            click.echo(_in_words(problem), err=True)
        raise click.exceptions.Exit(2) from error


def _in_words(problem: dict[str, Any]) -> str:
    from .fields import flag_of

    field, detail = problem.get("field", ""), problem["detail"]
    flag = flag_of(field)
    where = f"{flag} ({field}): " if flag else f"{field}: " if field else ""
    hint = f"\n{problem['hint']}" if "hint" in problem else ""
    return f"heli2dof: {where}{detail.removeprefix(f'{field}: ')}{hint}"
