"""The schema of a database, and the way to the newest one; Alembic is imported only where there is a way to go."""

from __future__ import annotations

from pathlib import Path

from sqlalchemy import Connection, Engine, inspect, select, text
from sqlalchemy.sql import column, table

from .errors import no_database
from .schema_lti import metadata

SCRIPTS = Path(__file__).parent / "migrations"
_VERSIONS = table("alembic_version", column("version_num"))
_LOCK = 0x68326463
"""PostgreSQL's advisory lock that a replica holds while it migrates."""


def newest() -> str:
    """The newest revision of the schema: the last of the scripts, which are numbered."""
    return max(path.name for path in (SCRIPTS / "versions").glob("[0-9]*.py")).partition("_")[0]


def known_revisions() -> list[str]:
    """All revisions, the first one first."""
    return sorted(path.name.partition("_")[0] for path in (SCRIPTS / "versions").glob("[0-9]*.py"))


def revision_of(connection: Connection) -> str | None:
    """A database's revision; None where it is empty."""
    if not inspect(connection).has_table("alembic_version"):
        return None
    return connection.execute(select(_VERSIONS.c.version_num)).scalar()


def require_known(revision: str | None) -> None:
    """Refuses a database of a newer version of the program.

    Raises:
        ClassError: no_database.
    """
    if revision is not None and revision not in known_revisions():
        raise no_database(
            f"the database is of a newer version of heli2dof (schema {revision}).",
            "Start that version, or restore the backup that was made before it (heli2dof db restore).",
        )


def upgrade(engine: Engine, to: str = "head") -> tuple[str | None, str | None]:
    """Brings the database to a revision, all of the way in one transaction; one process at a time.

    Returns:
        Revisions before and after.
    """
    with engine.begin() as connection:
        if connection.dialect.name == "postgresql":
            connection.execute(text("SELECT pg_advisory_xact_lock(:key)"), {"key": _LOCK})
        before = revision_of(connection)
        require_known(before)
        if before != (newest() if to == "head" else to):
            _run(connection, to)
        return before, revision_of(connection)


def _run(connection: Connection, to: str) -> None:
    from alembic import command
    from alembic.config import Config

    config = Config()
    config.set_main_option("script_location", str(SCRIPTS).replace("%", "%%"))
    config.set_main_option("path_separator", "os")
    config.attributes.update(connection=connection, metadata=metadata)
    command.upgrade(config, to)
