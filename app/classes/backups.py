"""A database as one SQLite file, and back: the same file whether SQLite or PostgreSQL keeps the classes."""

from __future__ import annotations

import os
import shutil
import sqlite3
import tempfile
from contextlib import closing
from pathlib import Path

from sqlalchemy import URL, Connection, MetaData, Table, delete, func, insert, inspect, select, text

from .engines import Engines, open_engines
from .errors import ClassError
from .migrating import known_revisions, metadata, revision_of

_AT_ONCE = 500
"""Rows that are copied at once."""
_VERSION = "alembic_version"


def backup(setting: str, target: Path) -> int:
    """Copies the database into a new file, as it is at one moment, while it is written on.

    Args:
        setting: HELI2DOF_DATABASE.
        target: a file that does not exist yet.

    Returns:
        How many classes it holds.

    Raises:
        ClassError: the database cannot be opened, or the file exists.
    """
    if target.exists():
        raise ClassError(409, f"{target} exists already.", "file_exists", hint="Name another file.")
    engines = open_engines(setting, migrate=False)
    part = target.with_name(f".{target.name}.part")
    try:
        part.unlink(missing_ok=True)
        os.close(os.open(part, os.O_RDWR | os.O_CREAT | os.O_EXCL, 0o600))
        with engines.reading.begin() as source:
            count = _copy_out(source, part)
        part.replace(target)
    finally:
        part.unlink(missing_ok=True)
        engines.dispose()
    return count


def restore(setting: str, source: Path, *, replace: bool = False) -> int:
    """Puts a backup into the database, all of it or nothing; one of an older schema is brought to the newest.

    Args:
        setting: HELI2DOF_DATABASE.
        source: what `backup` has written.
        replace: whether classes that are there may go.

    Returns:
        How many classes there are now.

    Raises:
        ClassError: it is no backup, or the database holds classes and `replace` is not given.
    """
    _require_backup(source)
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "backup.db"
        shutil.copyfile(source, copy)
        found = open_engines(f"sqlite:///{copy}")  # which migrates the copy
        target: Engines | None = None
        try:
            target = open_engines(setting)
            with found.reading.begin() as reading, target.writing.begin() as writing:
                return _copy_in(reading, writing, replace)
        finally:
            found.dispose()
            if target is not None:
                target.dispose()


def _copy_out(source: Connection, path: Path) -> int:
    """All tables of the source, whatever its schema, into an SQLite file."""
    own = MetaData()
    own.reflect(source)
    revision = revision_of(source)
    blank = open_engines(f"sqlite:///{path}", migrate=False)
    try:
        if revision is None:
            raise ClassError(404, "There are no classes yet.", "nothing_there")
        from .migrating import upgrade

        upgrade(blank.writing, revision)
        with blank.writing.begin() as target:
            for table in own.sorted_tables:
                if table.name != _VERSION:
                    _copy(source, target, table)
            count = target.execute(select(func.count()).select_from(own.tables["classes"])).scalar() or 0
    finally:
        blank.dispose()
    with closing(sqlite3.connect(path)) as connection:
        connection.execute("PRAGMA journal_mode=DELETE")  # one file, nothing beside it
    return count


def _copy_in(source: Connection, target: Connection, replace: bool) -> int:
    tables = [table for table in metadata.sorted_tables if inspect(source).has_table(table.name)]
    classes = metadata.tables["classes"]
    if not replace and target.execute(select(func.count()).select_from(classes)).scalar():
        hint = "heli2dof db restore --replace deletes them; take a backup before."
        raise ClassError(409, "There are classes in this database.", "not_empty", hint=hint)
    for table in reversed(metadata.sorted_tables):
        target.execute(delete(table))
    for table in tables:
        _copy(source, target, table)
        if target.dialect.name == "postgresql" and "id" in table.c:
            after = f"SELECT setval(pg_get_serial_sequence('{table.name}', 'id'), COALESCE(MAX(id), 0) + 1, false)"
            target.execute(text(f"{after} FROM {table.name}"))
    return target.execute(select(func.count()).select_from(classes)).scalar() or 0


def _copy(source: Connection, target: Connection, table: Table) -> None:
    order = table.primary_key.columns
    for rows in source.execute(select(table).order_by(*order)).mappings().partitions(_AT_ONCE):
        target.execute(insert(table), [dict(row) for row in rows])


def _require_backup(path: Path) -> None:
    """Refuses what is no backup.

    Raises:
        ClassError: no_backup.
    """
    why = "there is no such file"
    if path.is_file():
        try:
            with closing(sqlite3.connect(f"file:{path}?mode=ro", uri=True)) as connection:
                found = connection.execute(f"SELECT version_num FROM {_VERSION}").fetchone()
                sound = connection.execute("PRAGMA quick_check").fetchone()
            if found and found[0] in known_revisions() and sound == ("ok",):
                return
            why = f"it is of schema {found[0]}, newer than this program" if found else "it is empty"
        except sqlite3.DatabaseError as error:
            why = str(error)
    hint = "heli2dof db backup FILE writes one."
    raise ClassError(422, f"{path} is no backup: {why}.", "no_backup", hint=hint)


def where(setting: str) -> str:
    """The database's address without its password."""
    from .engines import url_of

    url: URL = url_of(setting)
    return url.render_as_string(hide_password=True)
