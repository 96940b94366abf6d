"""Alembic's migrations of the classes' tables."""
