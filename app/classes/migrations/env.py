"""How Alembic runs the migrations: on the connection that it is given, within its transaction."""

from __future__ import annotations

from alembic import context

given = context.config.attributes
context.configure(connection=given["connection"], target_metadata=given["metadata"], render_as_batch=True)
context.run_migrations()
