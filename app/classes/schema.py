"""The tables. Times are seconds since 1970 (UTC), JSON is text. What changes here needs a migration."""

from __future__ import annotations

from typing import Any

from sqlalchemy import (
    BigInteger,
    Boolean,
    Column,
    Double,
    ForeignKey,
    Index,
    Integer,
    MetaData,
    String,
    Table,
    Text,
    UniqueConstraint,
)

metadata = MetaData(
    naming_convention={
        "ix": "ix_%(table_name)s_%(column_0_N_name)s",
        "uq": "uq_%(table_name)s_%(column_0_N_name)s",
        "fk": "fk_%(table_name)s_%(column_0_name)s",
        "pk": "pk_%(table_name)s",
    }
)
# No number is given twice (AUTOINCREMENT): what a replica remembers of a deleted class is never another one's.
_NEVER_AGAIN: Any = {"sqlite_autoincrement": True}


def _student() -> Column[int]:
    return Column(
        "student_id", Integer, ForeignKey("students.id", ondelete="CASCADE"), primary_key=True, nullable=False
    )


classes = Table(
    "classes",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("code", String(16), nullable=False, unique=True),
    Column("lab_name", String(40), nullable=False),
    Column("lab_text", Text, nullable=False, doc="frozen: yesterday's class opens tomorrow"),
    Column("title", String(120), nullable=False),
    Column("instructor_hash", String(64), nullable=False, unique=True),
    Column("seed", String(64), nullable=False, doc="of the secrets of those who join; told to nobody"),
    Column("created", Double, nullable=False),
    Column("closes", Double),
    Column("open", Boolean, nullable=False),
    Column("closed", Double, doc="when the instructor closed it"),
    Column("ends", Double, nullable=False, index=True),
    Column("joined", Integer, nullable=False, doc="students so far, those who left included"),
    Column("version", Integer, nullable=False, doc="raised by every change; walls poll it"),
    **_NEVER_AGAIN,
)
students = Table(
    "students",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("class_id", Integer, ForeignKey("classes.id", ondelete="CASCADE"), nullable=False),
    Column("number", Integer, nullable=False, doc="by order of joining"),
    Column("name", String(80), nullable=False),
    Column("email", String(254)),
    Column("login", String(80)),
    Column("secret_hash", String(64), nullable=False, unique=True),
    Column("seed", BigInteger, nullable=False, doc="of the rig"),
    Column("joined", Double, nullable=False),
    Column("seen", Double, nullable=False),
    Column("at_step", String(40)),
    Column("poles", Text, doc="of the newest design, for the wall"),
    Column("stable", Boolean, doc="of the newest attempt"),
    Column("version", Integer, nullable=False, doc="the class's at the last change"),
    Index("ix_students_class_id_version", "class_id", "version"),
    UniqueConstraint("class_id", "number"),
    **_NEVER_AGAIN,
)
attempts = Table(
    "attempts",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("student_id", Integer, ForeignKey("students.id", ondelete="CASCADE"), nullable=False),
    Column("client_id", String(36), nullable=False),
    Column("step", String(40), nullable=False),
    Column("at", Double, nullable=False, doc="the server's time"),
    Column("handed_at", Double, doc="the page's time, of an attempt made offline"),
    Column("design", Text, doc="none of those that are long past"),
    Column("answers", Text),
    Column("result", Text, nullable=False),
    Column("points", Double, nullable=False),
    Column("best_id", Integer, doc="the best one of the step when this was handed in; none: this"),
    UniqueConstraint("student_id", "client_id"),
    Index("ix_attempts_student_id_step", "student_id", "step"),
    **_NEVER_AGAIN,
)
standings = Table(
    "standings",
    metadata,
    _student(),
    Column("step", String(40), primary_key=True),
    Column("attempts", Integer, nullable=False),
    Column("best_id", Integer, nullable=False),
    Column("points", Double, nullable=False),
    Column("met", Text, nullable=False, doc="goals of the best attempt, JSON"),
    Column("last_met", Text, nullable=False, doc="of the newest one"),
    Column("texts", Text, nullable=False, doc="questions marked by hand that were answered, JSON"),
    Column("at", Double, nullable=False),
)
drafts = Table(
    "drafts",
    metadata,
    _student(),
    Column("step", String(40), primary_key=True),
    Column("seq", BigInteger, nullable=False),
    Column("design", Text, nullable=False),
    Column("answers", Text, nullable=False),
    Column("at", Double, nullable=False),
)
hints = Table(
    "hints",
    metadata,
    _student(),
    Column("step", String(40), primary_key=True),
    Column("hint", Integer, primary_key=True, doc="1-based"),
    Column("at", Double, nullable=False),
)
hand_marks = Table(
    "hand_marks",
    metadata,
    _student(),
    Column("step", String(40), primary_key=True),
    Column("question", String(40), primary_key=True),
    Column("points", Double, nullable=False),
    Column("comment", Text, nullable=False),
    Column("at", Double, nullable=False),
)
chores = Table(
    "chores",
    metadata,
    Column("name", String(40), primary_key=True),
    Column("done", Double, nullable=False, doc="by one of the replicas"),
)
