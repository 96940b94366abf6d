"""Which kernels the module exports, for which types of arguments: add a name here, and build."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pkgutil import iter_modules
from typing import Any, NamedTuple

ENTRIES = (
    "run_experiments",
    "run_nonlinear",
    "run_digital",
    "polynomial_matrices",
    "whole_polynomials",
    "is_stable",
    "margins",
    "sensitivity_peaks",
    "lag_margin",
    "eigenvalues",
)
"""Names in `heli2dof_core.kernels.jit.ENTRIES`."""


class Variant(NamedTuple):
    """A kernel for some types of arguments.

    Attributes:
        export: its name in the module.
        kernel: its name in `jit.ENTRIES`.
        arguments: an example, as in `jit.EXAMPLES`.
    """

    export: str
    kernel: str
    arguments: tuple[Any, ...]


def variants() -> Iterator[Variant]:
    """All that is exported. Of kernels for several sizes two: for 6 states, and for any number.

    A tuple of zeros as `size` unrolls the loops over the states, for which 6 states are worth their place; the array
    of zeros serves all others.
    """
    from heli2dof_core import kernels
    from heli2dof_core.kernels.jit import EXAMPLES
    from heli2dof_core.kernels.layout import PLAIN

    for module in iter_modules(kernels.__path__, f"{kernels.__name__}."):
        import_module(module.name)
    for name in ENTRIES:
        examples = [example() for example in EXAMPLES[name]]
        if len(examples) == 1:
            yield Variant(name, name, examples[0])
            continue
        for arguments in examples:
            size = arguments[0]
            if not isinstance(size, tuple):
                yield Variant(f"{name}_any", name, arguments)
            elif len(size) == PLAIN:
                yield Variant(f"{name}_{PLAIN}", name, arguments)
