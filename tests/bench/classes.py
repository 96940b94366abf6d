"""A class of two hundred, by tests/class_filler.py: one process with SQLite; two, nginx and PostgreSQL.

In the second, one replica is killed in the middle and comes back, and the database ends every connection of the app.
Students send again what was not answered; nothing that was answered may be lost:

    python -m tests.bench.classes [--students 200] [--seconds 120] [--every 30]
"""

from __future__ import annotations

import argparse
import asyncio
import os
import sys
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from time import sleep

from tests.app.class_room import labs_folder
from tests.bench.faculty import processor
from tests.children import served
from tests.class_filler import Filler, Told
from tests.deploy.farm import Farm, farm
from tests.patience import until
from tests.postgresql import PostgreSQL, postgresql

KILLED, BACK, CUT = 0.4, 0.5, 0.7
"""Shares of the time after which a replica is killed, comes back, and all connections to the database end."""


def filled(title: str, url: str, given: argparse.Namespace, pids: Callable[[], list[int]]) -> Told:
    """One class on a server; prints what was measured."""
    before = {pid: processor(pid) for pid in pids()}
    filler = Filler([url.rstrip("/")], "small", given.students, given.seconds, given.every)
    told = asyncio.run(filler.run())
    spent = [f"{(processor(pid) - before.get(pid, 0.0)) / given.seconds:.0%}" for pid in pids()]
    print(f"\n{title} (processor: {', '.join(spent)})")
    print("\n".join(f"  {line}" for line in told.lines()), flush=True)
    return told


def one_process(folder: Path, given: argparse.Namespace) -> Told:
    """`heli2dof serve` with SQLite."""
    settings = {"labs": labs_folder(folder), "database": f"sqlite:///{folder}/classes.db"}
    with served(folder, **settings) as server:
        until(lambda: server.warm, "the kernels are there")
        return filled("one process, SQLite", server.http, given, lambda: [server.process.pid])


def two_replicas(folder: Path, given: argparse.Namespace, server: PostgreSQL) -> Told:
    """Two behind nginx with PostgreSQL, of which one is killed while all work."""
    os.environ |= {
        "HELI2DOF_DATABASE": server.fresh("classes"),
        "HELI2DOF_LABS": str(labs_folder(folder)),
    }
    with farm(folder, 2) as running:
        breaking = threading.Thread(target=_break, args=(running, server, given.seconds), daemon=True)
        breaking.start()
        title = "two replicas, nginx, PostgreSQL; one killed, all connections to the database ended"
        told = filled(title, running.url, given, lambda: [r.process.pid for r in running.replicas])
        breaking.join()
        return told


def _break(running: Farm, server: PostgreSQL, seconds: float) -> None:
    sleep(KILLED * seconds)
    running.replicas[0].kill()
    running.replicas[0].process.wait()
    sleep((BACK - KILLED) * seconds)
    running.replicas[0].start()
    sleep((CUT - BACK) * seconds)
    ended = server.execute(
        "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE application_name = 'heli2dof'"
    )
    print(f"  ({len(ended)} connections to the database were ended)", flush=True)


def main() -> int:
    """The command; 1 if something was lost."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--students", type=int, default=200)
    parser.add_argument("--seconds", type=float, default=120.0)
    parser.add_argument("--every", type=float, default=30.0)
    given = parser.parse_args()
    found = []
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other, postgresql() as server:
        found.append(one_process(Path(one), given))
        found.append(two_replicas(Path(other), given, server))
    return 1 if any(told.lost for told in found) else 0


if __name__ == "__main__":
    sys.exit(main())
