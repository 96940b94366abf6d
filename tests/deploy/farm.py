"""Replicas of the app, each a process of its own, behind nginx with the shipped configuration, on the loopback."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from socket import socket
from typing import IO

import httpx2
import pytest

from tests.children import ROOT, SERVE, environment
from tests.patience import PATIENCE, until

DEPLOY = ROOT / "deploy"
_UPSTREAM = re.compile(r"^\S+ (\w+) \S+ /healthz .* from (?:[\d.:]+, )*([\d.:]+): ", re.M)
_LEFT_OUT = "fail_timeout=1s"
"""Of a replica that was away; shorter than what is shipped, since tests wait for its end."""


def free_port() -> int:
    with socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@dataclass(eq=False)
class Replica:
    """`python -m app serve` on a port that it keeps."""

    port: int
    log: IO[bytes]
    process: subprocess.Popen[bytes] = field(init=False)

    def __post_init__(self) -> None:
        self.start()

    @property
    def address(self) -> str:
        return f"127.0.0.1:{self.port}"

    def start(self) -> None:
        command = [*SERVE, "--port", str(self.port)]
        self.process = subprocess.Popen(
            command, cwd=ROOT, env=environment(), stdout=self.log, stderr=self.log
        )

    def ready(self) -> bool:
        assert self.process.poll() is None, f"the replica has ended: see {self.log.name}"
        try:
            return httpx2.get(f"http://{self.address}/healthz", timeout=PATIENCE).status_code == 200
        except httpx2.TransportError:
            return False

    def kill(self) -> None:
        """Ends it at once, as when its machine fails."""
        self.process.send_signal(signal.SIGKILL)

    def drain(self) -> None:
        """Asks it to end in good order."""
        self.process.send_signal(signal.SIGTERM)

    def stop(self) -> None:
        if self.process.poll() is None:
            self.process.terminate()
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.process.kill()
        self.process.wait(PATIENCE)


@dataclass(frozen=True)
class Farm:
    """nginx, the replicas behind it, and nginx's access log."""

    port: int
    replicas: list[Replica]
    log: Path

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/"

    def home(self, session: str) -> Replica:
        """The replica that a session belongs to, as nginx logs it."""
        return self.homes([session])[0]

    def homes(self, sessions: list[str]) -> list[Replica]:
        """As `home`, for many: nginx numbers each request and says where it went."""
        with httpx2.Client(base_url=self.url, timeout=PATIENCE, trust_env=False) as client:
            replies = [client.get("healthz", params={"session": session}) for session in sessions]
        assert {reply.status_code for reply in replies} == {200}
        numbers = [reply.headers["x-request-id"] for reply in replies]
        until(lambda: self._asked().keys() >= set(numbers), "nginx logs what it was asked")
        by_address, asked = {replica.address: replica for replica in self.replicas}, self._asked()
        return [by_address[asked[number]] for number in numbers]

    def sessions(self, replica: Replica, count: int) -> list[str]:
        """So many names of sessions that belong to a replica."""
        names = [f"session-{k}".ljust(24, "_") for k in range(16 * count)]
        found = [name for name, home in zip(names, self.homes(names), strict=True) if home is replica]
        assert len(found) >= count, "nginx sends hardly any session there"
        return found[:count]

    def whole(self) -> bool:
        """Whether nginx asks every replica again: one that was away is left out for a while, also when it is back."""
        return set(self.homes([f"session-{k}".ljust(24, "_") for k in range(32)])) == set(self.replicas)

    def _asked(self) -> dict[str, str]:
        """By the number of a request, the address of the replica that answered it."""
        return dict(_UPSTREAM.findall(self.log.read_text()))


def configuration(folder: Path, listen: str, replicas: list[str]) -> Path:
    """The shipped configuration with other addresses, as an operator would set them."""
    conf = folder / "conf"
    conf.mkdir()
    shutil.copy(DEPLOY / "nginx.conf", conf)
    (conf / "listen.conf").write_text(listen)
    settings = re.search(r":\d+( .*;)$", (DEPLOY / "replicas.conf").read_text(), re.M)
    assert settings is not None
    shorter = re.sub(r"fail_timeout=\d+s", _LEFT_OUT, settings[1])
    assert shorter != settings[1]
    (conf / "replicas.conf").write_text("".join(f"server {address}{shorter}\n" for address in replicas))
    return conf / "nginx.conf"


def program() -> str:
    """Where nginx is; Debian keeps it where only root looks. Without one the test is skipped, but not in CI."""
    found = shutil.which("nginx") or shutil.which("nginx", path="/usr/sbin:/usr/local/sbin")
    if found is None and not os.environ.get("CI"):
        pytest.skip("nginx is missing: sudo apt-get install nginx-light")
    assert found is not None
    return found


@contextmanager
def nginx(folder: Path, conf: Path, port: int) -> Iterator[Path]:
    """nginx as long as the context lasts; yields its access log."""
    log = folder / "access.log"
    with log.open("wb") as out, (folder / "error.log").open("wb") as errors:
        own = "daemon off;" if os.geteuid() else "daemon off; user root;"  # or its workers may not write here
        command = [program(), "-e", "stderr", "-p", str(folder), "-c", str(conf), "-g", own]
        process = subprocess.Popen(command, stdout=out, stderr=errors)
        try:
            until(lambda: listens(port) or process.poll() is not None, "nginx listens")
            assert process.poll() is None, (folder / "error.log").read_text()
            yield log
        finally:
            process.terminate()
            process.wait(PATIENCE)


def listens(port: int) -> bool:
    with socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


@contextmanager
def farm(folder: Path, count: int) -> Iterator[Farm]:
    """So many replicas, ready, behind nginx."""
    program()
    with ExitStack() as stack:
        log = stack.enter_context((folder / "replicas.log").open("wb"))
        replicas = []
        for _ in range(count):
            replica = Replica(free_port(), log)
            stack.callback(replica.stop)
            replicas.append(replica)
        until(lambda: all(replica.ready() for replica in replicas), "the replicas are ready")
        port = free_port()
        conf = configuration(folder, f"listen 127.0.0.1:{port};\n", [r.address for r in replicas])
        access = stack.enter_context(nginx(folder, conf, port))
        yield Farm(port, replicas, access)
