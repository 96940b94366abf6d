"""What a student sends, on its way from the call to the database."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Handed:
    """An attempt as it came.

    Attributes:
        client_id: made by the page; one attempt has one, however often it is sent.
        handed_at: by the page's clock, s; of an attempt that was made offline.
        flight: the log of a flight, where the step asks for one. It is marked and not kept: logs are long, the
            student has it, and its checksum, which is kept with the marks, tells whether a file is that very flight.
    """

    client_id: str
    step: str
    design: Mapping[str, Any]
    answers: Mapping[str, Any]
    handed_at: float | None = None
    flight: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class Draft:
    """Where a student is; `seq` grows with each draft of a page."""

    step: str
    seq: int
    design: Mapping[str, Any]
    answers: Mapping[str, Any]
