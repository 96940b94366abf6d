"""Tasks in the air: what each asks, its gusts, and what it is scored by."""

from .catalogue import TASKS
from .task import FlightTask, Mark, reach_of, told

__all__ = ["TASKS", "FlightTask", "Mark", "reach_of", "told"]
