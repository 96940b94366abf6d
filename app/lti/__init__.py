"""LTI 1.3: launches out of a learning platform, its names and roles, grades back to it."""
