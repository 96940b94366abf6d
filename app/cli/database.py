"""`heli2dof db`: the schema of the classes' database, and its backups."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import click
from pydantic import ValidationError

from ..classes.errors import ClassError
from ..ops.settings import Settings, complaint

FILE = click.Path(dir_okay=False, path_type=Path)


@click.group(name="db")
def db() -> None:
    """The database in which classes are kept: HELI2DOF_DATABASE, or a file in the user's data folder."""


@db.command()
def current() -> None:
    """Where the database is, and of which schema."""
    from ..classes import backups, engines, migrating

    with refused() as setting:
        click.echo(f"database  {backups.where(setting)}")
        found = None
        if engines.is_there(setting):
            opened = engines.open_engines(setting, migrate=False)
            with opened.reading.connect() as connection:
                found = migrating.revision_of(connection)
            opened.dispose()
        click.echo(f"schema    {found or 'none yet'}")
        click.echo(f"newest    {migrating.newest()}")


@db.command()
def upgrade() -> None:
    """Bring the schema to the newest; the server does so too, when it opens the database."""
    from ..classes import engines, migrating

    with refused() as setting:
        opened = engines.open_engines(setting, migrate=False)
        before, after = migrating.upgrade(opened.writing)
        opened.dispose()
        told = f"It was of schema {before or 'none'} and is of {after}." if before != after else ""
        click.echo(told or f"It is of schema {after}, the newest.")


@db.command()
@click.argument("file", type=FILE)
def backup(file: Path) -> None:
    """Copy all classes into FILE, as they are at one moment; the server may run on."""
    from ..classes.backups import backup as copied

    with refused() as setting:
        click.echo(f"{copied(setting, file)} classes are in {file}.")


@db.command()
@click.argument("file", type=FILE)
@click.option("--replace", is_flag=True, help="Delete the classes that are there.")
def restore(file: Path, replace: bool) -> None:
    """Put the classes of FILE into the database; stop the server before.

    FILE is what `heli2dof db backup` has written, of whichever database: so classes move from SQLite to
    PostgreSQL, too.
    """
    from ..classes.backups import restore as put_back

    with refused() as setting:
        click.echo(f"{put_back(setting, file, replace=replace)} classes are there.")


@contextmanager
def refused() -> Iterator[str]:
    """The database's setting; what is refused ends the command with status 2, in one line."""
    try:
        yield Settings().database_address
    except ValidationError as error:
        sys.exit(_said(complaint(error)))
    except (ClassError, OSError) as error:
        hint = f" {error.hint}" if isinstance(error, ClassError) else ""
        sys.exit(_said(f"{error}{hint}"))


def _said(words: str) -> int:
    click.echo(f"heli2dof: {words}", err=True)
    return 2
