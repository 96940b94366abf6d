"""What the server logs: lines for people, or JSON for machines, each with its request's id.

No line says who asked: no address, no query, no path but the route's template, since a scene's path holds
the secret of its session.
"""

from __future__ import annotations

import logging
import re
import sys
import uuid
from contextvars import ContextVar
from datetime import UTC, datetime
from typing import Any, Literal

import orjson

request_id: ContextVar[str] = ContextVar("request_id", default="")
"""Of the request that the present task answers; empty outside of any."""
_SANE_ID = re.compile(r"[A-Za-z0-9._-]{8,64}", re.ASCII)


def id_for(given: str | None) -> str:
    """The id that a client or proxy has given, if it is a sane one, or else a new one."""
    return given if given and _SANE_ID.fullmatch(given) else uuid.uuid4().hex


class PlainFormatter(logging.Formatter):
    """Time, level, logger, message, and the request's id in brackets."""

    def __init__(self) -> None:
        super().__init__("%(asctime)s %(levelname)s %(name)s: %(message)s")

    def formatMessage(self, record: logging.LogRecord) -> str:
        """The line, with the id at its end."""
        line = super().formatMessage(record)
        return f"{line} [{known}]" if (known := request_id.get()) else line


class JsonFormatter(logging.Formatter):
    """One JSON object a line: time, level, logger, message, request_id and a record's own `fields`."""

    def format(self, record: logging.LogRecord) -> str:
        """The object as text."""
        entry: dict[str, Any] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
            "message": record.getMessage(),
        }
        if known := request_id.get():
            entry["request_id"] = known
        entry |= getattr(record, "fields", {})
        if record.exc_info:
            entry["exception"] = self.formatException(record.exc_info)
        return orjson.dumps(entry, default=str).decode()


def configure(kind: Literal["plain", "json"], level: str) -> None:
    """Sends all of this process's log lines to standard error in one form."""
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(JsonFormatter() if kind == "json" else PlainFormatter())
    logging.basicConfig(level=level.upper(), handlers=[handler], force=True)
    for quiet in ("websockets", "numba", "asyncio"):
        logging.getLogger(quiet).setLevel(logging.WARNING)
