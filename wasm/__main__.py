"""`python -m wasm` builds static/kernel/kernels.wasm and table.js; with `--check` it only says whether they are so."""

from __future__ import annotations

import argparse
import os
import sys
import tempfile
from pathlib import Path

from wasm import stamp

PLACE = stamp.ROOT / "static" / "kernel"
UNOPTIMISED = {"NUMBA_OPT": "0", "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": ""}
"""Numba reads these when it is imported: its text shall say nothing of this machine."""


def made() -> dict[Path, bytes]:
    """Both files. To be called before Numba is imported; its cache is left as it is."""
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
    return {PLACE / "kernels.wasm": module, PLACE / "table.js": table.encode()}


def main() -> int:
    """0 where all is well, 1 where `--check` finds other files."""
    options = argparse.ArgumentParser(prog="python -m wasm", description=__doc__)
    options.add_argument("--check", action="store_true", help="write nothing, compare")
    checking = options.parse_args().check
    status = 0
    for path, content in made().items():
        if not checking:
            PLACE.mkdir(exist_ok=True)
            path.write_bytes(content)
        elif not path.is_file() or path.read_bytes() != content:
            print(f"{path.relative_to(stamp.ROOT)} is not what is built here: call `make wasm`.")
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
