"""The server as `heli2dof serve` runs it, in a process of its own."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx2

from tests.scene_server import until

ROOT = Path(__file__).parents[2]


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


@contextmanager
def served(folder: Path, ready: bool = True, **environment: str) -> Iterator[Server]:
    """Starts the server with variables HELI2DOF_… of these names; ends it if the test has not."""
    log = folder / "server.log"
    variables = {f"HELI2DOF_{name.upper()}": value for name, value in environment.items()}
    command = [sys.executable, "-m", "app", "serve", "--port", "0"]
    with log.open("w") as errors:
        process = subprocess.Popen(
            command, cwd=ROOT, env=os.environ | variables, stdout=subprocess.PIPE, stderr=errors, text=True
        )
    assert process.stdout is not None
    try:
        announcement = process.stdout.readline()
        found = re.search(r"ready: http://127.0.0.1:(\d+)", announcement)
        assert found, (announcement, log.read_text())
        server = Server(process, int(found[1]), log)
        if ready:
            until(lambda: httpx2.get(f"{server.http}/healthz").status_code == 200, "it is ready", 120)
        yield server
    finally:
        process.stdout.close()
        if process.poll() is None:
            process.kill()
            process.wait()
