"""`heli2dof completion`: the script that a shell wants."""

from __future__ import annotations

import click
from click.shell_completion import get_completion_class

from .group import heli2dof

_SHELLS = ("bash", "zsh", "fish")


@click.command()
@click.argument("shell", type=click.Choice(_SHELLS))
def completion(shell: str) -> None:
    """Print the completion script of SHELL.

    For bash: eval "$(heli2dof completion bash)", in ~/.bashrc to keep it.
    """
    kind = get_completion_class(shell)
    assert kind is not None  # click has these three
    click.echo(kind(heli2dof, {}, "heli2dof", "_HELI2DOF_COMPLETE").source())
