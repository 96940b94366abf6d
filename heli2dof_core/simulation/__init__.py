"""Step responses: exact where linear, adaptive where not."""
