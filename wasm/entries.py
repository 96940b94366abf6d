"""Which kernels the module exports: add a name here, and build."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, NamedTuple

ENTRIES = (
    "update",
    "run_rigs",
    "run_designs",
    "flight_controller",
    "begin_flight",
    "fly",
    "take_over",
    "eigenvalues",
)
"""Names in `heli2dof_core.kernels.jit.ENTRIES`, which are those of the module's functions."""


class Entry(NamedTuple):
    """A kernel with an example of its arguments: it is compiled for their types."""

    name: str
    arguments: tuple[Any, ...]


def entries() -> Iterator[Entry]:
    """All that is exported. Of a kernel for several sizes it is the one that takes any, an array of zeros as `size`.

    It gives the same digits as those whose loops over the states are unrolled, for 6 states in a tenth more time, and
    half of the module would be theirs.
    """
    from heli2dof_core import kernels
    from heli2dof_core.kernels.jit import EXAMPLES

    for module in iter_modules(kernels.__path__, f"{kernels.__name__}."):
        import_module(module.name)
    for name in ENTRIES:
        examples = (example() for example in EXAMPLES[name])
        yield next(
            Entry(name, arguments)
            for arguments in examples
            if not any(isinstance(argument, tuple) for argument in arguments)
        )
