"""What the module was made from: its sources, how it was built, and by which versions."""

from __future__ import annotations

import sys
from hashlib import sha256
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).parents[1]
TOOLS = ("llvmlite", "numba")
"""Whose versions decide what comes out, as does Python's; constraints.txt pins them. Which wasm-ld links does not."""


def sources() -> list[Path]:
    """The kernels, and what builds them."""
    return sorted([*(ROOT / "heli2dof_core" / "kernels").glob("*.py"), *(ROOT / "wasm").glob("*.py")])


def checksum() -> str:
    """Of all sources, whatever ends their lines."""
    digest = sha256()
    for source in sources():
        digest.update(f"{source.relative_to(ROOT).as_posix()}\n{source.read_text('utf-8')}\0".encode())
    return digest.hexdigest()


def tools() -> dict[str, str]:
    """The versions here. With others the module has other bytes, and gives the same digits."""
    return {name: version(name) for name in TOOLS} | {"python": ".".join(map(str, sys.version_info[:2]))}
