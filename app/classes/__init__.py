"""Classes that work on a lab, in a database; SQLAlchemy is imported when the first one is asked for."""
