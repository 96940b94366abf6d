"""The browser tests under what a busy machine and a bad network do: `python -m tests.steady [--busy 5] [--late 2]`.

Some runs have four processes beside them that never rest, some have every answer, message and frame late by random,
seeded times (`tests/late.py`). What fails here is a fault of the page or of the test, to be mended, not tried again.
"""

from __future__ import annotations

import argparse
import os
import re
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

BUSY = 4
SPIN = "while True: pass"


@contextmanager
def busy(count: int) -> Iterator[None]:
    """So many processes that never rest; they end with this one's block."""
    others = [subprocess.Popen([sys.executable, "-c", SPIN]) for _ in range(count)]
    try:
        yield
    finally:
        for other in others:
            other.kill()
            other.wait()


def run(name: str, arguments: list[str], count: int, **environment: str) -> int:
    """One run of the browser tests; prints its last line and what failed, returns how many did."""
    command = [
        sys.executable,
        "-m",
        "pytest",
        "-q",
        "-m",
        "browser",
        "-n",
        "2",
        "--dist=loadfile",
        *arguments,
    ]
    began = time.perf_counter()
    with busy(count):
        done = subprocess.run(
            command, env=os.environ | environment, capture_output=True, text=True, check=False
        )
    lines = done.stdout.splitlines()
    last = next(
        (line for line in reversed(lines) if re.search(r"\d+ (passed|failed|error)", line)), "nothing ran"
    )
    print(f"{name}: {last.strip('= ')}, {time.perf_counter() - began:.0f} s", flush=True)
    told = [k for k, line in enumerate(lines) if line.startswith("✕ ")]
    failed = lines[told[0] : -1] if told else []
    print(
        "\n".join(failed) or (done.stdout + done.stderr if done.returncode else ""),
        end="\n" if failed else "",
    )
    return done.returncode


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--busy", type=int, default=5, help=f"runs beside {BUSY} busy processes")
    parser.add_argument("--late", type=int, default=2, help="runs with all late")
    parser.add_argument("--seed", type=int, default=1, help="of the first late run; the next ones count on")
    chosen, rest = parser.parse_known_args()
    statuses = [run(f"busy {k + 1}", rest, BUSY) for k in range(chosen.busy)]
    seeds = range(chosen.seed, chosen.seed + chosen.late)
    statuses += [run(f"late, seed {seed}", rest, 0, LATE=str(seed)) for seed in seeds]
    print(f"{sum(map(bool, statuses))} of {len(statuses)} runs failed")
    sys.exit(any(statuses))


if __name__ == "__main__":
    main()
