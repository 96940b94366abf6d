"""The engines of a database: where it is, how it is opened, what SQLite is told on each connection."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from dataclasses import dataclass
from errno import EACCES, EISDIR
from pathlib import Path
from typing import Any

from sqlalchemy import URL, Engine, create_engine, event, make_url
from sqlalchemy.exc import ArgumentError, DBAPIError, NoSuchModuleError
from sqlalchemy.pool import StaticPool

from .errors import ClassError, no_database
from .migrating import newest, require_known, revision_of, upgrade

MEMORY = "memory"
"""As a setting: kept in memory, and gone with the process."""
_SET = "Set HELI2DOF_DATABASE, as sqlite:////folder/that/can/be/written/classes.db or postgresql://…"
_LOCKED_MS = 10_000
"""Milliseconds that SQLite waits for another process's write."""
_PRAGMAS = (
    f"busy_timeout={_LOCKED_MS}",  # first: the next one may have to wait for another process, too
    "journal_mode=WAL",  # readers never wait for the writer
    "synchronous=FULL",  # what was answered outlives a power failure
    "foreign_keys=ON",
    "secure_delete=ON",  # what is deleted is overwritten
)


@dataclass(frozen=True)
class Engines:
    """A database that is open, its schema the newest.

    Attributes:
        reading: begins transactions that see one state and change nothing.
        writing: begins transactions that write; with SQLite one at a time.
        shared: whether both are one connection, so that they must take turns.
    """

    reading: Engine
    writing: Engine
    shared: bool = False

    def dispose(self) -> None:
        """Closes all connections."""
        self.reading.dispose()
        self.writing.dispose()


def default_file() -> Path:
    """Where the database is if nothing else is set: in the user's data folder."""
    if sys.platform == "darwin":
        folder = Path("~/Library/Application Support")
    elif os.name == "nt":
        folder = Path(os.environ.get("LOCALAPPDATA", "~/AppData/Local"))
    else:
        folder = Path(os.environ.get("XDG_DATA_HOME") or "~/.local/share")
    with suppress(RuntimeError):  # a user without a home
        folder = folder.expanduser()
    return folder / "heli2dof" / "classes.db"


def url_of(setting: str) -> URL:
    """The setting as SQLAlchemy's URL.

    Raises:
        ClassError: no_database, if it is none.
    """
    if not setting:
        return URL.create("sqlite", database=str(default_file()))
    if setting == MEMORY:
        return URL.create("sqlite", database=":memory:")
    try:
        url = make_url(setting)
    except (ArgumentError, ValueError):
        raise no_database("HELI2DOF_DATABASE is no address of a database.", _SET) from None
    if url.drivername in ("postgresql", "postgres"):
        url = url.set(drivername="postgresql+psycopg")
    if url.get_backend_name() not in ("sqlite", "postgresql"):
        raise no_database("HELI2DOF_DATABASE names neither SQLite nor PostgreSQL.", _SET)
    return url


def is_there(setting: str) -> bool:
    """Whether there is a database to look after: a file that exists, or a server."""
    try:
        url = url_of(setting)
    except ClassError:
        return False
    return url.get_backend_name() != "sqlite" or bool(url.database and Path(url.database).is_file())


def open_engines(setting: str, *, migrate: bool = True) -> Engines:
    """Opens the database, makes it if there is none, and brings its schema to the newest.

    Raises:
        ClassError: no_database, with what to set.
    """
    url = url_of(setting)
    own_file = url.get_backend_name() == "sqlite"
    engines = _sqlite(url) if own_file else _postgresql(url)
    try:
        with engines.reading.connect() as connection:
            revision = revision_of(connection)
        require_known(revision)
        if migrate and revision != newest():
            upgrade(engines.writing)
    except DBAPIError as error:
        engines.dispose()
        why = f"the file cannot be opened ({error.orig})."  # SQLite's words, such as "database is locked"
        if not own_file:
            why = f"the database's server does not answer ({type(error.orig).__name__})."
        raise no_database(why, _SET) from error
    except ClassError:
        engines.dispose()
        raise
    return engines


def _sqlite(url: URL) -> Engines:
    # hide_parameters: names stand in no log, whatever fails.
    options: dict[str, Any] = {"hide_parameters": True}
    shared = url.database in (None, "", ":memory:")
    if shared:
        options |= {"poolclass": StaticPool, "connect_args": {"check_same_thread": False}}
    else:
        _make_file(Path(url.database or ""))
    engines = [create_engine(url, **options) for _ in range(1 if shared else 2)]
    for engine, begin in zip(engines, ("BEGIN IMMEDIATE", "BEGIN"), strict=False):
        event.listen(engine, "connect", _configure)
        event.listen(engine, "begin", lambda connection, begin=begin: connection.exec_driver_sql(begin))
    return Engines(reading=engines[-1], writing=engines[0], shared=shared)


def _configure(connection: Any, _record: Any) -> None:
    connection.isolation_level = None  # transactions are begun by us alone
    for pragma in _PRAGMAS:
        connection.execute(f"PRAGMA {pragma}")


def _make_file(path: Path) -> None:
    """The file, empty, readable by its owner alone: names stand in it.

    Raises:
        ClassError: no_database, if it cannot be written.
    """
    try:
        path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        # One that is there is not opened: POSIX ends all locks of a process on a file where it closes it once, and
        # so SQLite's; another process would take the database for left, and remove the log that we write.
        with suppress(FileExistsError):
            os.close(os.open(path, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600))
        if path.is_dir() or not os.access(path, os.R_OK | os.W_OK):
            refused = EISDIR if path.is_dir() else EACCES
            raise OSError(refused, os.strerror(refused))
        writable = os.access(path.parent, os.W_OK)  # for the journal beside it
    except OSError as error:
        raise no_database(f"{path} cannot be written ({error.strerror}).", _SET) from error
    if not writable:
        raise no_database(f"the folder {path.parent} cannot be written.", _SET)


def _postgresql(url: URL) -> Engines:
    try:
        engine = create_engine(
            url,
            hide_parameters=True,
            pool_size=5,
            max_overflow=0,
            pool_timeout=5,
            pool_pre_ping=True,  # connections that the server has ended are replaced
            pool_recycle=1800,
            connect_args={
                "connect_timeout": 3,
                "application_name": "heli2dof",
                "options": "-c statement_timeout=15000 -c lock_timeout=8000",
            },
        )
    except (ImportError, NoSuchModuleError) as error:
        hint = "Install it: pip install 'heli2dof[postgresql]'."
        raise no_database("PostgreSQL's driver is not installed.", hint) from error
    return Engines(reading=engine.execution_options(isolation_level="REPEATABLE READ"), writing=engine)
