"""The command; see the package."""

from __future__ import annotations

import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from .mutants import Mutant, core_mutants, equal_mutants, page_mutants, sample

ROOT = Path(__file__).parents[2]
NODE = shutil.which("node", path=f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}") or "node"
PYTEST = [sys.executable, "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider"]
PROCESSOR_SECONDS, SECONDS = 400, 1500
KERNELS = ("heli2dof_core/kernels/",)
# What the kernels' plain twins pass in seconds: most changes of a kernel need not be compiled to be noticed.
INTERPRETED = [
    f"tests/core/test_{name}.py"
    for name in ("polynomials", "sensitivity", "linear_response", "export_c", "digital_rig", "anti_windup")
]
SLOW = ("test_nonlinear_response.py", "test_full_rank_placement.py")
APP = [f"tests/app/test_{name}.py" for name in ("rest", "placement_api", "robustness_api", "recordings_api")]


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m tests.mutation", description=__doc__)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=40, help="changes, two thirds of them in the core")
    parser.add_argument("--jobs", type=int, default=1, help="changes tried at once")
    parser.add_argument(
        "--like", nargs="*", help="of the sample only what holds such a text in its description"
    )
    parser.add_argument("--list", action="store_true", help="print the sample and run nothing")
    options = parser.parse_args()

    core, page, equal = core_mutants(ROOT), page_mutants(ROOT, NODE), equal_mutants()
    for key in equal.keys() - {mutant.key for mutant in (*core, *page)}:
        print(f"equal.json: no such change any more, in {key[0]}: {key[3]}")
    of_core = round(options.count * 0.65)
    chosen = [*sample(core, of_core, options.seed), *sample(page, options.count - of_core, options.seed)]
    chosen = [m for m in chosen if not options.like or any(text in str(m) for text in options.like)]
    print(
        f"{len(chosen)} of {len(core)} changes of the core and {len(page)} of the page, seed {options.seed}"
    )
    if options.list:
        print(*chosen, sep="\n")
        return
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="heli2dof-mutation-") as folder:
        base = Path(folder) / "base"
        _copy(ROOT, base)
        _check(base, chosen)
        with ThreadPoolExecutor(options.jobs) as pool:
            tries = [pool.submit(_try, mutant, base, equal.get(mutant.key)) for mutant in chosen]
            verdicts = [each.result() for each in tries]
    counts = Counter(verdicts)
    words = ", ".join(f"{counts[verdict]} {verdict}" for verdict in ("killed", "equal", "SURVIVED"))
    print(f"{words}; {time.monotonic() - begin:.0f} s")
    sys.exit(bool(counts["SURVIVED"]))


def _copy(source: Path, target: Path) -> None:
    """The files with their dates, so that what Numba kept stays valid."""
    ignored = shutil.ignore_patterns(".git", "node_modules", ".venv", ".hypothesis", "build", "dist")
    shutil.copytree(source, target, ignore=ignored)
    (target / "node_modules").symlink_to((ROOT / "node_modules").resolve())


def _check(base: Path, chosen: list[Mutant]) -> None:
    """Unchanged, all must pass; it also compiles the kernels for all copies."""
    alike = {(m.file.partition("/")[0], m.file.startswith(KERNELS)): m for m in chosen}
    commands = {tuple(sorted(command)): command for m in alike.values() for command in _commands(m, base)}
    for command in commands.values():
        if noticed := _noticed(command, base):
            sys.exit(f"Nothing was changed, and yet: {noticed}")


def _try(mutant: Mutant, base: Path, equal: str | None) -> str:
    begin, noticed = time.monotonic(), None
    verdict = "equal" if equal else "SURVIVED"
    if not equal:
        with tempfile.TemporaryDirectory(prefix="mutant-", dir=base.parent) as folder:
            home = Path(folder) / "copy"
            _copy(base, home)
            (home / mutant.file).write_text(mutant.source, encoding="utf-8")
            for command in _commands(mutant, base):
                if noticed := _noticed(command, home):
                    verdict = "killed"
                    break
    print(
        f"{verdict}: {mutant}\n    {equal or noticed or 'no test fails'} ({time.monotonic() - begin:.0f} s)",
        flush=True,
    )
    return verdict


def _commands(mutant: Mutant, base: Path) -> list[list[str]]:
    """What could notice the change, the fastest first."""
    if mutant.file.startswith("static/"):
        tests = sorted((base / "tests/page").glob("*.test.mjs"))
        return [[NODE, "--test", "--test-timeout=30000", *(f"tests/page/{test.name}" for test in tests)]]
    stem = Path(mutant.file).stem
    tests = [*(base / "tests/core").glob("test_*.py"), *(base / "tests/authorities").glob("test_*.py")]

    def late(test: Path) -> tuple[bool, bool, str]:
        named = re.search(rf"\b{stem}\b", test.read_text(encoding="utf-8"))
        return test.name in SLOW, not named, test.as_posix()

    compiled = [*PYTEST, *(test.relative_to(base).as_posix() for test in sorted(tests, key=late))]
    first = [[*PYTEST, "-p", "tests.mutation.interpreted", *INTERPRETED]]
    return [*(first if mutant.file.startswith(KERNELS) else []), compiled, [*PYTEST, *APP]]


def _noticed(command: list[str], home: Path) -> str | None:
    """The first test that fails, or None. Time is the processor's, for other work may run beside."""
    limited = ["sh", "-c", 'ulimit -t "$0"; exec "$@"', str(PROCESSOR_SECONDS), *command]
    environment = {
        **os.environ,
        "CI": "1",
        "PYTHONWARNINGS": "",
    }  # Hypothesis draws the same examples each time
    process = subprocess.Popen(
        limited,
        cwd=home,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        start_new_session=True,
        encoding="utf-8",
        errors="replace",
    )
    try:
        output, _ = process.communicate(timeout=SECONDS)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return "it does not end"
    if process.returncode == 0:
        return None
    if process.returncode < 0:
        return f"ended by {signal.Signals(-process.returncode).name}"
    found = re.search(r"^(?:FAILED|ERROR) (.*)$|^\s*(?:not ok \d+ -|✖) (.*)$", output, re.MULTILINE)
    return next(filter(None, found.groups())) if found else output.strip()[-200:]


if __name__ == "__main__":
    main()
