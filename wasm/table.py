"""The module's description as a JavaScript module, static/kernel/table.js: what each function takes and returns."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from hashlib import sha256
from typing import Any

from wasm.lowering import Lowered

HEAD = """/**
 * What the functions of kernels.wasm take, in order, and return. Made with it by `python -m wasm`; not to be
 * changed by hand.
 *
 * @typedef {'f64' | 'i64' | 'c128' | 'bool'} Scalar  c128: two f64, in arrays alone
 * @typedef {object} Parameter
 * @property {string} name
 * @property {Scalar} type  of an array's elements, or of the value
 * @property {number} [dimensions]  of an array, rows first
 * @typedef {object} Signature
 * @property {Parameter[]} takes
 * @property {Scalar} [returns]
 */
"""


def script(kernels: Sequence[Lowered], module: bytes, sources: str, tools: Mapping[str, str]) -> str:
    """The whole JavaScript module, as Prettier has it."""
    made = "".join(f"  {name}: '{version}',\n" for name, version in tools.items())
    return (
        f"{HEAD}\n/** @type {{Record<string, Signature>}} */\nexport const SIGNATURES = {{\n"
        f"{''.join(_signature(kernel) for kernel in kernels)}}};\n\n"
        f"/** Checksums of what it was made from, and of kernels.wasm. */\n"
        f"export const SOURCES = '{sources}';\nexport const MODULE = '{sha256(module).hexdigest()}';\n\n"
        f"/** What made it. */\nexport const TOOLS = {{\n{made}}};\n"
    )


def _signature(kernel: Lowered) -> str:
    returned = _returned(kernel.returns)
    last = f"    returns: '{returned}',\n" if returned else ""
    takes = (_parameter(name, kind) for name, kind in kernel.takes.items())
    return f"  {kernel.name}: {{\n    takes: [\n{''.join(takes)}    ],\n{last}  }},\n"


def _parameter(name: str, kind: Any) -> str:
    from numba import types

    more = ""
    if isinstance(kind, types.Array):
        if kind.layout != "C":
            raise TypeError(f"{name}: arrays are told to JavaScript row by row, this one is {kind}")
        kind, more = kind.dtype, f", dimensions: {kind.ndim}"
    elif kind not in (types.float64, types.int64):
        raise TypeError(f"{name}: JavaScript gives arrays, floats and integers, not {kind}")
    return f"      {{ name: '{name}', type: '{_scalar(kind)}'{more} }},\n"


def _returned(kind: Any) -> str:
    from numba import types

    if kind == types.complex128:
        raise TypeError("Complex numbers are returned in arrays alone")
    return "" if kind == types.none else _scalar(kind)


def _scalar(kind: Any) -> str:
    from numba import types

    known = {
        types.float64: "f64",
        types.int64: "i64",
        types.complex128: "c128",
        types.boolean: "bool",
    }
    if kind not in known:
        raise TypeError(f"The page's table has no word for {kind}")
    return known[kind]
