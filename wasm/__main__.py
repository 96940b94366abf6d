"""`python -m wasm` builds static/kernel/kernels.wasm and table.js."""

from __future__ import annotations

import argparse
import os
import tempfile
from pathlib import Path

from wasm import stamp

PLACE = stamp.ROOT / "static" / "kernel"
UNOPTIMISED = {"NUMBA_OPT": "0", "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
"""Numba reads these when it is imported: its text shall say nothing of this machine."""


def made() -> dict[str, bytes]:
    """Both files by name. To be called before Numba is imported; its cache is left as it is."""
    with tempfile.TemporaryDirectory() as cache:
        os.environ.update(UNOPTIMISED, NUMBA_CACHE_DIR=cache)
        from wasm.entries import entries
        from wasm.lowering import lower
        from wasm.module import build
        from wasm.table import script

        kernels = []
        for entry in entries():
            print(f"Compiling {entry.name}", flush=True)
            kernels.append(lower(entry))
        module = build(kernels)
        table = script(kernels, module, stamp.checksum(), stamp.tools())
    return {"kernels.wasm": module, "table.js": table.encode()}


def main() -> None:
    """Builds into static/kernel, or elsewhere."""
    options = argparse.ArgumentParser(prog="python -m wasm", description=__doc__)
    options.add_argument("--into", type=Path, default=PLACE, metavar="FOLDER", help="default: static/kernel")
    folder = options.parse_args().into
    for name, content in made().items():
        (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()
