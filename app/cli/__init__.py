"""The command line: `heli2dof`, a module for each family of commands, imported when one is called."""

from .group import main

__all__ = ["main"]
