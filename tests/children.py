"""Processes of their own for tests: as users start them, which is with bytecode kept on disk."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import httpx2

ROOT = Path(__file__).parents[1]
SERVE = (sys.executable, "-m", "app", "serve")


def environment(**more: str) -> dict[str, str]:
    """This process's, but as users start it: with workers, and with bytecode.

    Without that every child compiles all that it imports.
    """
    not_theirs = ("PYTHONDONTWRITEBYTECODE", "HELI2DOF_WORKERS")
    return {name: value for name, value in os.environ.items() if name not in not_theirs} | more


def variables(settings: Mapping[str, object]) -> dict[str, str]:
    """The app's settings as its environment."""
    return {f"HELI2DOF_{name.upper()}": str(value) for name, value in settings.items()}


def python(*words: str, cwd: Path = ROOT, **more: str) -> str:
    """What a Python process writes; it must end with status 0."""
    return subprocess.run(
        [sys.executable, *words], cwd=cwd, env=environment(**more), capture_output=True, text=True, check=True
    ).stdout


@dataclass(frozen=True)
class Server:
    """A running process, its port and the file that its log goes to."""

    process: subprocess.Popen[str]
    port: int
    log: Path

    @property
    def http(self) -> str:
        return f"http://127.0.0.1:{self.port}"

    @property
    def ws(self) -> str:
        return f"ws://127.0.0.1:{self.port}"

    @property
    def answers(self) -> bool:
        """Whether it can compute."""
        return httpx2.get(f"{self.http}/healthz", timeout=20).status_code == 200

    @property
    def warm(self) -> bool:
        """Whether its kernels are compiled."""
        return "kernels ready" in self.log.read_text()


@contextmanager
def served(
    folder: Path, command: tuple[str, ...] = (*SERVE, "--port", "0"), **settings: object
) -> Iterator[Server]:
    """Starts the server, by default the checkout's; ends it if the test has not."""
    log = folder / "server.log"
    with log.open("w") as errors:
        process = subprocess.Popen(
            command,
            cwd=ROOT if command[:4] == SERVE else folder,
            env=environment(**variables(settings)),
            stdout=subprocess.PIPE,
            stderr=errors,
            text=True,
        )
    assert process.stdout is not None
    try:
        yield Server(process, announced(process.stdout, log), log)
    finally:
        process.stdout.close()
        if process.poll() is None:
            process.kill()
            process.wait()


def announced(out: IO[str], log: Path) -> int:
    """The port that a server tells once it answers."""
    line = out.readline()
    found = re.search(r"ready: http://127.0.0.1:(\d+)", line)
    assert found, (line, log.read_text())
    return int(found[1])
