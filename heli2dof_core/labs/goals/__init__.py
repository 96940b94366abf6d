"""Kinds of goals, one file each: a record for the file, and a goal that judges and says what it requires.

A further kind is a module with its `RECORD`, and a line here.
"""

from __future__ import annotations

from types import MappingProxyType

from ..kinds import Record, Tagged
from ..lab import Goal
from . import cloud, figure, flight, setting

RECORDS = MappingProxyType(
    {"figure": figure.RECORD, "cloud": cloud.RECORD, "setting": setting.RECORD, "flight": flight.RECORD}
)
"""By the word in a goal's field `kind`."""
GOAL: Tagged[Goal] = Tagged(RECORDS, "figure", "the goal")

__all__ = ["GOAL", "RECORDS", "Record"]
