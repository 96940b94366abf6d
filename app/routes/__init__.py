"""The REST API's routes."""
