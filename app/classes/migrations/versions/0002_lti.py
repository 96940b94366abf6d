"""Platforms, links, people, grades on their way, launches on theirs (LTI 1.3)."""

from __future__ import annotations

import sqlalchemy as sa
from alembic import op

revision = "0002"
down_revision = "0001"
branch_labels = None
depends_on = None


def _of(table: str, column: str, other: str) -> sa.ForeignKeyConstraint:
    return sa.ForeignKeyConstraint([column], [f"{other}.id"], name=f"fk_{table}_{column}", ondelete="CASCADE")


def upgrade() -> None:
    """To this schema."""
    op.create_table(
        "lti_platforms",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("name", sa.String(40), nullable=False),
        sa.Column("address", sa.Text, nullable=False),
        sa.Column("issuer", sa.String(255), nullable=False),
        sa.Column("client_id", sa.String(255), nullable=False),
        sa.Column("deployments", sa.Text, nullable=False),
        sa.Column("auth_url", sa.Text, nullable=False),
        sa.Column("token_url", sa.Text, nullable=False),
        sa.Column("keyset_url", sa.Text, nullable=False),
        sa.Column("audience", sa.Text, nullable=False),
        sa.Column("hosts", sa.Text, nullable=False),
        sa.Column("created", sa.Double, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_lti_platforms"),
        sa.UniqueConstraint("name", name="uq_lti_platforms_name"),
        sa.UniqueConstraint("issuer", "client_id", name="uq_lti_platforms_issuer_client_id"),
        sqlite_autoincrement=True,
    )
    op.create_table(
        "lti_keys",
        sa.Column("kid", sa.String(64), nullable=False),
        sa.Column("private", sa.Text, nullable=False),
        sa.Column("created", sa.Double, nullable=False),
        sa.Column("retired", sa.Double),
        sa.PrimaryKeyConstraint("kid", name="pk_lti_keys"),
    )
    op.create_table(
        "lti_links",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("platform_id", sa.Integer, nullable=False),
        sa.Column("deployment", sa.String(255), nullable=False),
        sa.Column("link", sa.String(255), nullable=False),
        sa.Column("class_id", sa.Integer, nullable=False),
        sa.Column("request", sa.String(64), nullable=False),
        sa.Column("lineitem", sa.Text, nullable=False),
        sa.Column("lineitems", sa.Text, nullable=False),
        sa.Column("scopes", sa.Text, nullable=False),
        sa.Column("members", sa.Text, nullable=False),
        sa.Column("graded", sa.Integer, nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_lti_links"),
        _of("lti_links", "platform_id", "lti_platforms"),
        _of("lti_links", "class_id", "classes"),
        sa.UniqueConstraint(
            "platform_id", "deployment", "link", name="uq_lti_links_platform_id_deployment_link"
        ),
        sqlite_autoincrement=True,
    )
    op.create_index("ix_lti_links_class_id", "lti_links", ["class_id"])
    op.create_table(
        "lti_users",
        sa.Column("id", sa.Integer, nullable=False),
        sa.Column("link_id", sa.Integer, nullable=False),
        sa.Column("subject", sa.String(255), nullable=False),
        sa.Column("student_id", sa.Integer, nullable=False),
        sa.Column("request", sa.String(64), nullable=False),
        sa.PrimaryKeyConstraint("id", name="pk_lti_users"),
        _of("lti_users", "link_id", "lti_links"),
        _of("lti_users", "student_id", "students"),
        sa.UniqueConstraint("student_id", name="uq_lti_users_student_id"),
        sa.UniqueConstraint("link_id", "subject", name="uq_lti_users_link_id_subject"),
        sqlite_autoincrement=True,
    )
    op.create_table(
        "lti_outbox",
        sa.Column("user_id", sa.Integer, nullable=False),
        sa.Column("points", sa.Double, nullable=False),
        sa.Column("most", sa.Double, nullable=False),
        sa.Column("to_mark", sa.Integer, nullable=False),
        sa.Column("changed", sa.Double, nullable=False),
        sa.Column("sent", sa.Boolean, nullable=False),
        sa.Column("tries", sa.Integer, nullable=False),
        sa.Column("due", sa.Double, nullable=False),
        sa.Column("error", sa.Text, nullable=False),
        sa.PrimaryKeyConstraint("user_id", name="pk_lti_outbox"),
        _of("lti_outbox", "user_id", "lti_users"),
    )
    op.create_index("ix_lti_outbox_sent_due", "lti_outbox", ["sent", "due"])
    op.create_table(
        "lti_nonces",
        sa.Column("hash", sa.String(64), nullable=False),
        sa.Column("kind", sa.String(8), nullable=False),
        sa.Column("platform_id", sa.Integer, nullable=False),
        sa.Column("told", sa.Text, nullable=False),
        sa.Column("expires", sa.Double, nullable=False),
        sa.Column("used", sa.Boolean, nullable=False),
        sa.PrimaryKeyConstraint("hash", name="pk_lti_nonces"),
        _of("lti_nonces", "platform_id", "lti_platforms"),
    )
    op.create_index("ix_lti_nonces_expires", "lti_nonces", ["expires"])
