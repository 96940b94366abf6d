"""A PostgreSQL server of the tests' own, where its programs are installed; on a free port of the loopback."""

from __future__ import annotations

import os
import shutil
import subprocess
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from socket import socket
from typing import Any

import pytest

from tests.patience import PATIENCE

_SERVER = "postgres"
"""The system's user of the server, which refuses to run as root; Debian's package makes it."""


@dataclass(frozen=True)
class PostgreSQL:
    """A running server; `url` is of its database, for HELI2DOF_DATABASE."""

    port: int

    def url(self, database: str = "postgres") -> str:
        return f"postgresql://heli2dof@127.0.0.1:{self.port}/{database}"

    def execute(self, statement: str, database: str = "postgres") -> list[Any]:
        """Runs a statement outside of any transaction."""
        import psycopg

        with psycopg.connect(self.url(database), autocommit=True) as connection:
            cursor = connection.execute(statement)  # pyright: ignore[reportArgumentType, reportCallIssue]
            return cursor.fetchall() if cursor.description else []

    def fresh(self, name: str) -> str:
        """The URL of a new, empty database."""
        self.execute(f'DROP DATABASE IF EXISTS "{name}" WITH (FORCE)')
        self.execute(f'CREATE DATABASE "{name}"')
        return self.url(name)


def programs() -> Path | None:
    """The folder of PostgreSQL's programs; Debian keeps it from the path."""
    found = sorted(Path("/usr/lib/postgresql").glob("*/bin/initdb"), reverse=True)
    if found:
        return found[0].parent
    on_path = shutil.which("initdb")
    return Path(on_path).resolve().parent if on_path else None


def _user() -> dict[str, Any]:
    return {"user": _SERVER, "group": _SERVER, "extra_groups": []} if os.geteuid() == 0 else {}


@contextmanager
def postgresql() -> Iterator[PostgreSQL]:
    """The server, as long as the context lasts; skips the test where there is none.

    Its files are not among pytest's, whose folder no other user may enter.
    """
    there = programs()
    if there is None:
        pytest.skip("PostgreSQL is missing: sudo apt-get install postgresql")
    user = _user()
    with tempfile.TemporaryDirectory(prefix="heli2dof-postgresql-") as data:
        if user:
            shutil.chown(data, _SERVER, _SERVER)
        with socket() as probe:
            probe.bind(("127.0.0.1", 0))
            port = probe.getsockname()[1]
        control = [str(there / "pg_ctl"), "-D", data, "-w", "-t", str(int(PATIENCE))]
        initial = ["-U", "heli2dof", "-A", "trust", "--no-sync", "-E", "UTF8"]
        settings = f"-p {port} -c listen_addresses=127.0.0.1 -c unix_socket_directories= -c fsync=off"
        _run([str(there / "initdb"), "-D", data, *initial], user)
        _run([*control, "-l", f"{data}/log", "-o", settings, "start"], user)
        try:
            yield PostgreSQL(port)
        finally:
            _run([*control, "-m", "immediate", "stop"], user)


def _run(command: list[str], user: dict[str, Any]) -> None:
    """Runs a program of the server's user; not its output, which the server would hold open."""
    nowhere = subprocess.DEVNULL
    subprocess.run(command, check=True, stdout=nowhere, stderr=nowhere, cwd="/", timeout=PATIENCE, **user)
