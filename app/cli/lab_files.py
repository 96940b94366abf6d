"""A lab as commands take it: a file, or the name of one that ships."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.shell_completion import CompletionItem

if TYPE_CHECKING:
    from heli2dof_core.labs import Lab


class LabFile(click.Path):
    """A lab's file, or the name of one that ships."""

    name = "lab"

    def __init__(self) -> None:
        super().__init__(dir_okay=False, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The file's path."""
        if isinstance(value, str) and not Path(value).exists():
            shipped = _shipped()
            if value in shipped:
                return shipped[value]
            known = ", ".join(shipped) or "none"
            self.fail(f"there is no file {value!r}, and no lab of that name ships: {known}", param, ctx)
        return super().convert(value, param, ctx)

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """Names of labs that ship, and files."""
        names = [CompletionItem(name) for name in _shipped() if name.startswith(incomplete)]
        return [*names, *super().shell_complete(ctx, param, incomplete)]


def _shipped() -> dict[str, Path]:
    """The files that ship by their labs' names, unread: one that is broken is told by who reads it."""
    from heli2dof_core.labs.library import SHIPPED

    return {file.stem: file for file in sorted(SHIPPED.glob("*.yaml"))}


def opened(path: Path) -> Lab:
    """The lab; where it has errors, all are told."""
    from heli2dof_core.labs import LabError, read_file

    try:
        return read_file(path)
    except LabError as error:
        for problem in error.problems:
            click.echo(f"{path}:{problem}", err=True)
        raise click.exceptions.Exit(2) from None
    except OSError as error:
        raise click.ClickException(f"{path} cannot be read: {error.strerror}") from None
