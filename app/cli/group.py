"""The `heli2dof` command and its list of commands, none of which is imported before it is called."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module
from typing import Any

import click

COMMANDS = {
    "serve": ("serving", "Start the app and print its address."),
    "gains": ("designs", "The gain K and the poles that it gives."),
    "rga": ("designs", "Relative gain array, pairing, Niederlinski index."),
    "step": ("designs", "Step response: metrics, motors, whole loop."),
    "fly": ("flights", "A flight by a script: hands, gusts, changes in the air."),
    "place": ("systems", "K of any system, in numbers or in formulas."),
    "system": ("systems", "Any system from a file: modes, zeros, K, L."),
    "compare": ("comparisons", "The same poles through several methods."),
    "map": ("maps", "What each place of a pair or of PI gains would give."),
    "track": ("tracks", "Poles and figures as one number is swept."),
    "find": ("finding", "Designs that meet what is required."),
    "nearest": ("nearest", "The smallest moves that meet what is required."),
    "robustness": ("comparisons", "One controller on many uncertain rigs."),
    "study": ("studies", "Designs times rigs by the million, on many processors."),
    "read": ("recordings", "A recording of a rig: columns, units, what is odd."),
    "overlay": ("recordings", "The model over a recording, with its fit."),
    "identify": ("recordings", "The rig's parameters from a recording."),
    "symbolic": ("derivation", "The formulas, derived."),
    "paper": ("derivation", "The paper's numbers recomputed, its errata proved."),
    "lab": ("labs", "Labs: written, checked, tried and marked."),
    "export": ("exports", "A design as a file for other tools."),
    "db": ("database", "The classes' database: schema, backup, restore."),
    "lti": ("lti", "Learning platforms that launch labs here."),
    "completion": ("completion", "The shell's completion of commands and options."),
}
"""Per command: the module that holds it under its own name, and what it does."""


class LateGroup(click.Group):
    """A group whose help needs no command's module."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """In the order in which they stand above."""
        return list(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """The command, imported now."""
        if cmd_name not in COMMANDS:
            return None
        return getattr(import_module(f".{COMMANDS[cmd_name][0]}", __package__), cmd_name)

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Writes the list above."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, about) for name, (_, about) in COMMANDS.items()])


def _version(ctx: click.Context, _parameter: click.Parameter, wanted: bool) -> None:
    if wanted and not ctx.resilient_parsing:
        from heli2dof_core.version import package_version

        click.echo(package_version())
        ctx.exit()


@click.group(cls=LateGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version", is_flag=True, is_eager=True, expose_value=False, callback=_version, help="Show the version."
)
def heli2dof(**_options: Any) -> None:
    """Pole placement for a two-degree-of-freedom laboratory helicopter.

    Options are named as the fields of the REST API; what is left out comes from the preset. SI units:
    rad, V, s. The exit status is 0, or 2 where the input is refused, or 1.
    """


def main(arguments: Sequence[str] | None = None) -> None:
    """Entry point of the `heli2dof` command; ends the process with the exit status."""
    heli2dof.main(args=arguments, prog_name="heli2dof")
