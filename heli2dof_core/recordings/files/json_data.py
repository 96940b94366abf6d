"""JSON: replies of this program that hold responses, and objects or rows with columns of numbers."""

from __future__ import annotations

import json
from typing import Any

from ...errors import Wanted
from ..recording import Table
from .limits import MOST_ROWS, check_size, refused
from .text import decoded
from .variables import table_of_variables


def is_json(data: bytes) -> bool:
    """Whether a file begins as JSON's objects and arrays do."""
    head = data[:200].lstrip(b"\xef\xbb\xbf \t\r\n")
    return head[:1] == b"{" or (head[:1] == b"[" and head[1:].lstrip()[:1] in (b"{", b"["))


def read_json(data: bytes, name: str, wanted: Wanted) -> Table:
    """The table in JSON: an object of arrays, nested or not, an array of rows, or a line per row.

    Raises:
        RecordingError: it is no JSON, or holds no columns.
    """
    text = decoded(data, name)
    wanted()
    try:
        content: Any = json.loads(text)
    except RecursionError as error:
        raise refused("the JSON is nested too deep", name, "Give an object of arrays.") from error
    except ValueError as error:
        content = _lines(text)
        if content is None:
            raise refused(f"the file is no JSON: {error}", name, "Give JSON, or CSV.") from error
    wanted()
    if isinstance(content, list) and content and isinstance(content[0], dict):
        content = _columns(content)
    elif isinstance(content, list):
        content = {"column": content}
    return table_of_variables(content, "JSON")


def _lines(text: str) -> Any:
    """JSON lines."""
    try:
        return [json.loads(line) for line in text.splitlines() if line.strip()]
    except (ValueError, RecursionError):
        return None


def _columns(rows: list[Any]) -> dict[str, Any]:
    check_size(len(rows) if len(rows) > MOST_ROWS else 0, 0)
    flat = [_flat(row) for row in rows if isinstance(row, dict)]
    names = dict.fromkeys(name for row in flat[:1000] for name in row)
    return {name: [row.get(name) for row in flat] for name in names}


def _flat(row: dict[str, Any], before: str = "", depth: int = 0) -> dict[str, Any]:
    """A row's numbers; what is none is left out."""
    own: dict[str, Any] = {}
    for key, value in row.items():
        if isinstance(value, dict) and depth < 4:
            own |= _flat(value, f"{before}{key}.", depth + 1)
        elif value is None or (isinstance(value, int | float) and not isinstance(value, bool)):
            own[f"{before}{key}"] = value
    return own
