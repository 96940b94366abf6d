"""The WebAssembly kernels for Python: calls them in Node, as the page does, with arguments of the compiled ones.

`recorded()` writes down what any code asks of the compiled kernels, and what they answer; `replayed()` asks the
same of the page's.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from inspect import signature
from pathlib import Path
from typing import Any

import numpy as np

from heli2dof_core import engine as engines
from tests.children import ROOT
from wasm.entries import ENTRIES

MODULE = ROOT / "static" / "kernel" / "kernels.wasm"
TYPES = {"float64": "f64", "complex128": "c128", "int64": "i64"}


@dataclass(frozen=True)
class Call:
    """A kernel's call: its arguments before and after, and what it returned."""

    kernel: str
    before: dict[str, Any]
    after: dict[str, Any]
    returned: Any


@dataclass(frozen=True)
class Replayed:
    """What the page's kernel made of the same call."""

    after: dict[str, Any]
    returned: Any
    error: str | None
    seconds: float


def _kept(value: Any) -> Any:
    return np.array(value, order="C") if isinstance(value, np.ndarray) else value


def called(kernel: str, *arguments: Any) -> Call:
    """A call of the compiled kernel; arrays are copied, before and after."""
    return _called(getattr(engines.warm_up(), kernel), kernel, arguments)


def _called(function: Any, kernel: str, arguments: Sequence[Any]) -> Call:
    names = list(signature(function.py_func).parameters)
    before = {name: _kept(value) for name, value in zip(names, arguments, strict=True)}
    returned = function(*arguments)
    after = {name: _kept(value) for name, value in zip(names, arguments, strict=True)}
    return Call(kernel, before, after, returned)


@contextmanager
def recorded(kernels: Sequence[str] = ENTRIES) -> Iterator[list[Call]]:
    """All calls of these kernels by any code, in the order of their ends."""
    compiled, calls = engines.warm_up(), []

    def recording(kernel: str) -> Any:
        def run(*arguments: Any) -> Any:
            calls.append(_called(getattr(compiled, kernel), kernel, arguments))
            return calls[-1].returned

        return run

    listening = {**vars(compiled), **{name: recording(name) for name in kernels}}
    engines._ready.append(engines.Engine(**listening))
    try:
        yield calls
    finally:
        engines._ready.pop()


def replayed(calls: Sequence[Call], *, repeat: int = 1, module: Path = MODULE) -> tuple[list[Replayed], int]:
    """The same calls of the page's kernels, each in the shortest of `repeat` times, and the stack's most bytes."""
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        places = _written(folder, calls, repeat)
        node = str(Path(sys.executable).with_name("node"))
        script = ROOT / "tests" / "wasm" / "replay.mjs"
        subprocess.run([node, script, folder, module], check=True, cwd=ROOT)
        data = (folder / "after.bin").read_bytes()
        told = json.loads((folder / "returned.json").read_text("utf-8"))
    found = []
    for call, own, result in zip(calls, places, told["results"], strict=True):
        after = dict(call.before)
        for name, at in own.items():
            like = call.before[name]
            after[name] = np.frombuffer(data, like.dtype, like.size, at).reshape(like.shape)
        returned = result.get("returned")
        returned = float(returned) if isinstance(returned, str) else returned
        found.append(Replayed(after, returned, result.get("error"), result["milliseconds"] / 1e3))
    return found, told["stack"]


def _written(folder: Path, calls: Sequence[Call], repeat: int) -> list[dict[str, int]]:
    """Writes what replay.mjs reads; at which byte each array stands."""
    places, tasks, at = [], [], 0
    with (folder / "before.bin").open("wb") as data:
        for call in calls:
            takes, own = {}, {}
            for name, value in call.before.items():
                if isinstance(value, tuple | np.ndarray):
                    array = np.zeros(len(value)) if isinstance(value, tuple) else value  # the first is `size`
                    takes[name] = (TYPES[array.dtype.name], array.shape, at)
                    if isinstance(value, np.ndarray):
                        own[name] = at
                    at += data.write(array.tobytes())
                else:
                    takes[name] = str(value).replace("inf", "Infinity")
            tasks.append({"kernel": call.kernel, "takes": takes, "repeat": repeat})
            places.append(own)
    (folder / "calls.json").write_text(json.dumps(tasks), "utf-8")
    return places
