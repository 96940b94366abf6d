"""Classes, students, attempts, drafts, hints and hand marks."""

from __future__ import annotations

from typing import Any

import sqlalchemy as sa
from alembic import op

revision = "0001"
down_revision = None
branch_labels = None
depends_on = None

_NEVER_AGAIN: Any = {"sqlite_autoincrement": True}


def _student() -> sa.Column[int]:
    return sa.Column("student_id", sa.Integer, nullable=False)


def _of_student(table: str, *keys: str) -> tuple[sa.PrimaryKeyConstraint, sa.ForeignKeyConstraint]:
    return (
        sa.PrimaryKeyConstraint("student_id", *keys, name=f"pk_{table}"),
        sa.ForeignKeyConstraint(
            ["student_id"], ["students.id"], name=f"fk_{table}_student_id", ondelete="CASCADE"
        ),
    )


def upgrade() -> None:
    """To this schema."""
    op.create_table(
        "classes",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("code", sa.String(16), nullable=False),
        sa.Column("lab_name", sa.String(40), nullable=False),
        sa.Column("lab_text", sa.Text, nullable=False),
        sa.Column("title", sa.String(120), nullable=False),
        sa.Column("instructor_hash", sa.String(64), nullable=False),
        sa.Column("seed", sa.String(64), nullable=False),
        sa.Column("created", sa.Double, nullable=False),
        sa.Column("closes", sa.Double),
        sa.Column("open", sa.Boolean, nullable=False),
        sa.Column("closed", sa.Double),
        sa.Column("ends", sa.Double, nullable=False),
        sa.Column("joined", sa.Integer, nullable=False),
        sa.Column("version", sa.Integer, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_classes"),
        sa.UniqueConstraint("code", name="uq_classes_code"),
        sa.UniqueConstraint("instructor_hash", name="uq_classes_instructor_hash"),
        **_NEVER_AGAIN,
    )
    op.create_index("ix_classes_ends", "classes", ["ends"])
    op.create_table(
        "students",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("class_id", sa.Integer, nullable=False),
        sa.Column("number", sa.Integer, nullable=False),
        sa.Column("name", sa.String(80), nullable=False),
        sa.Column("email", sa.String(254)),
        sa.Column("login", sa.String(80)),
        sa.Column("secret_hash", sa.String(64), nullable=False),
        sa.Column("seed", sa.BigInteger, nullable=False),
        sa.Column("joined", sa.Double, nullable=False),
        sa.Column("seen", sa.Double, nullable=False),
        sa.Column("at_step", sa.String(40)),
        sa.Column("poles", sa.Text),
        sa.Column("stable", sa.Boolean),
        sa.Column("version", sa.Integer, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_students"),
        sa.ForeignKeyConstraint(
            ["class_id"], ["classes.id"], name="fk_students_class_id", ondelete="CASCADE"
        ),
        sa.UniqueConstraint("secret_hash", name="uq_students_secret_hash"),
        sa.UniqueConstraint("class_id", "number", name="uq_students_class_id_number"),
        **_NEVER_AGAIN,
    )
    op.create_index("ix_students_class_id_version", "students", ["class_id", "version"])
    op.create_table(
        "attempts",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("student_id", sa.Integer, nullable=False),
        sa.Column("client_id", sa.String(36), nullable=False),
        sa.Column("step", sa.String(40), nullable=False),
        sa.Column("at", sa.Double, nullable=False),
        sa.Column("handed_at", sa.Double),
        sa.Column("design", sa.Text),
        sa.Column("answers", sa.Text),
        sa.Column("result", sa.Text, nullable=False),
        sa.Column("points", sa.Double, nullable=False),
        sa.Column("best_id", sa.Integer),
        sa.PrimaryKeyConstraint("id", name="pk_attempts"),
        sa.ForeignKeyConstraint(
            ["student_id"], ["students.id"], name="fk_attempts_student_id", ondelete="CASCADE"
        ),
        sa.UniqueConstraint("student_id", "client_id", name="uq_attempts_student_id_client_id"),
        **_NEVER_AGAIN,
    )
    op.create_index("ix_attempts_student_id_step", "attempts", ["student_id", "step"])
    op.create_table(
        "standings",
        _student(),
        sa.Column("step", sa.String(40), nullable=False),
        sa.Column("attempts", sa.Integer, nullable=False),
        sa.Column("best_id", sa.Integer, nullable=False),
        sa.Column("points", sa.Double, nullable=False),
        sa.Column("met", sa.Text, nullable=False),
        sa.Column("last_met", sa.Text, nullable=False),
        sa.Column("texts", sa.Text, nullable=False),
        sa.Column("at", sa.Double, nullable=False),
        *_of_student("standings", "step"),
    )
    op.create_table(
        "drafts",
        _student(),
        sa.Column("step", sa.String(40), nullable=False),
        sa.Column("seq", sa.BigInteger, nullable=False),
        sa.Column("design", sa.Text, nullable=False),
        sa.Column("answers", sa.Text, nullable=False),
        sa.Column("at", sa.Double, nullable=False),
        *_of_student("drafts", "step"),
    )
    op.create_table(
        "hints",
        _student(),
        sa.Column("step", sa.String(40), nullable=False),
        sa.Column("hint", sa.Integer, nullable=False),
        sa.Column("at", sa.Double, nullable=False),
        *_of_student("hints", "step", "hint"),
    )
    op.create_table(
        "hand_marks",
        _student(),
        sa.Column("step", sa.String(40), nullable=False),
        sa.Column("question", sa.String(40), nullable=False),
        sa.Column("points", sa.Double, nullable=False),
        sa.Column("comment", sa.Text, nullable=False),
        sa.Column("at", sa.Double, nullable=False),
        *_of_student("hand_marks", "step", "question"),
    )
    op.create_table(
        "chores",
        sa.Column("name", sa.String(40), nullable=False),
        sa.Column("done", sa.Double, nullable=False),
        sa.PrimaryKeyConstraint("name", name="pk_chores"),
    )
