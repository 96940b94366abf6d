"""The tables of `app.lti`: platforms, links, people, grades on their way, launches on theirs."""

from __future__ import annotations

from sqlalchemy import (
    Boolean,
    Column,
    Double,
    ForeignKey,
    Index,
    Integer,
    String,
    Table,
    Text,
    UniqueConstraint,
)

from .schema import metadata

__all__ = ["keys", "links", "metadata", "nonces", "outbox", "platforms", "users"]

platforms = Table(
    "lti_platforms",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("name", String(40), nullable=False, unique=True),
    Column("address", Text, nullable=False),  # this server's own, as the platform knows it
    Column("issuer", String(255), nullable=False),
    Column("client_id", String(255), nullable=False),
    Column("deployments", Text, nullable=False),  # ids, JSON
    Column("auth_url", Text, nullable=False),
    Column("token_url", Text, nullable=False),
    Column("keyset_url", Text, nullable=False),
    Column("audience", Text, nullable=False),
    Column("hosts", Text, nullable=False),  # that may be asked, JSON
    Column("created", Double, nullable=False),
    UniqueConstraint("issuer", "client_id"),
    sqlite_autoincrement=True,
)
keys = Table(
    "lti_keys",
    metadata,
    Column("kid", String(64), primary_key=True),
    Column("private", Text, nullable=False),  # JWK
    Column("created", Double, nullable=False),
    Column("retired", Double),  # since when it signs no more; its public half is shown for a while
)
links = Table(
    "lti_links",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("platform_id", Integer, ForeignKey("lti_platforms.id", ondelete="CASCADE"), nullable=False),
    Column("deployment", String(255), nullable=False),
    Column("link", String(255), nullable=False),  # the resource link's id
    Column("class_id", Integer, ForeignKey("classes.id", ondelete="CASCADE"), nullable=False, index=True),
    Column("request", String(64), nullable=False),  # of which the instructor's secret is made
    Column("lineitem", Text, nullable=False),  # where grades go; empty: nowhere known
    Column("lineitems", Text, nullable=False),  # where a column for them may be made
    Column("scopes", Text, nullable=False),  # that the platform allows, JSON
    Column("members", Text, nullable=False),  # names and roles of the course
    Column("graded", Integer, nullable=False),  # the class's version whose points are in the outbox
    UniqueConstraint("platform_id", "deployment", "link"),
    sqlite_autoincrement=True,
)
users = Table(
    "lti_users",
    metadata,
    Column("id", Integer, primary_key=True),
    Column("link_id", Integer, ForeignKey("lti_links.id", ondelete="CASCADE"), nullable=False),
    Column("subject", String(255), nullable=False),  # as the platform calls the person
    Column("student_id", Integer, ForeignKey("students.id", ondelete="CASCADE"), nullable=False, unique=True),
    Column("request", String(64), nullable=False),  # of which the student's secret is made
    UniqueConstraint("link_id", "subject"),
    sqlite_autoincrement=True,
)
outbox = Table(
    "lti_outbox",
    metadata,
    Column("user_id", Integer, ForeignKey("lti_users.id", ondelete="CASCADE"), primary_key=True),
    Column("points", Double, nullable=False),
    Column("most", Double, nullable=False),  # points of the whole lab
    Column("to_mark", Integer, nullable=False),  # answers that nobody has marked yet
    Column("changed", Double, nullable=False),  # when these points came about
    Column("sent", Boolean, nullable=False),  # whether the platform has these points
    Column("tries", Integer, nullable=False),  # in vain, since they changed
    Column("due", Double, nullable=False),  # when to try next; who tries puts it off first
    Column("error", Text, nullable=False),
    Index("ix_lti_outbox_sent_due", "sent", "due"),
)
nonces = Table(
    "lti_nonces",
    metadata,
    Column("hash", String(64), primary_key=True),  # of a launch's state, or of a ticket
    Column("kind", String(8), nullable=False),  # state or ticket
    Column("platform_id", Integer, ForeignKey("lti_platforms.id", ondelete="CASCADE"), nullable=False),
    Column("told", Text, nullable=False),  # what must fit, or what was launched; JSON
    Column("expires", Double, nullable=False, index=True),
    Column("used", Boolean, nullable=False),
)
