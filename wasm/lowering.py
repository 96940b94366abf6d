"""From kernels to LLVM's intermediate language, by Numba: for a 32-bit WebAssembly machine, and without Python."""

from __future__ import annotations

import re
import warnings
from typing import Any, NamedTuple

from wasm.entries import Entry

PICKLED = re.compile(r"ptr @\.const\.picklebuf\.[0-9a-f.]+(?=[,\s])")
"""What an exception says, pickled: only Python could read it."""
INSTRUCTIONS = re.compile(r"@(sqrt|floor|ceil)\(")
"""Calls that WebAssembly has instructions for."""


class Lowered(NamedTuple):
    """A kernel with all that it calls.

    Attributes:
        name: of the kernel, and in the module.
        symbol: the function's name in the text.
        text: LLVM's intermediate language, not optimised.
        takes: the arguments' names and types, Numba's.
        returns: the type that it returns, Numba's.
    """

    name: str
    symbol: str
    text: str
    takes: dict[str, Any]
    returns: Any


def lower(entry: Entry) -> Lowered:
    """Numba's intermediate language of a kernel; its process must not optimise (NUMBA_OPT=0).

    Raises:
        RuntimeError: Numba would have optimised for this machine.
    """
    import numba
    from numba.core import config as typed

    from heli2dof_core.kernels.jit import ENTRIES

    settings: Any = typed  # made from the environment, unseen by type checkers
    if int(settings.OPT) != 0:
        raise RuntimeError(
            "Set NUMBA_OPT=0: what Numba optimises is for this machine. `python -m wasm` does it."
        )
    dispatcher: Any = ENTRIES[entry.name]
    types = tuple(numba.typeof(argument) for argument in entry.arguments)
    with warnings.catch_warnings():
        # addresses of this process stand in the text until it is optimised, which keeps Numba from caching it
        warnings.filterwarnings("ignore", "Cannot cache compiled function")
        dispatcher.compile(types)
    made = dispatcher.overloads[types]
    names = dispatcher.py_func.__code__.co_varnames
    takes = dict(zip(names, types, strict=False))  # variables of its own follow
    text = dispatcher.inspect_llvm(types)
    return Lowered(entry.name, made.fndesc.llvm_func_name, text, takes, made.signature.return_type)


def retargeted(text: str, triple: str, layout: str) -> str:
    """The text for another machine; a function that raises returns its status alone."""
    text = re.sub(r'(?m)^target datalayout = ".*"$', f'target datalayout = "{layout}"', text)
    text = re.sub(r'(?m)^target triple = ".*"$', f'target triple = "{triple}"', text)
    return INSTRUCTIONS.sub(r"@llvm.\1.f64(", PICKLED.sub("ptr null", text))
