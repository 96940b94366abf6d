"""Recordings that clients have sent, in memory: few, and not for long."""

from __future__ import annotations

import secrets
from collections import OrderedDict
from time import monotonic

from heli2dof_core.errors import RecordingError
from heli2dof_core.recordings import Table

MOST_BYTES = 256 * 2**20
KEPT_SECONDS = 1800.0


class RecordingStore:
    """Tables by unguessable names; the longest unused go first."""

    def __init__(self, most_bytes: int = MOST_BYTES) -> None:
        self._tables: OrderedDict[str, tuple[float, Table]] = OrderedDict()
        self._most = most_bytes

    def put(self, table: Table) -> str:
        """Keeps a table under a new name."""
        key = secrets.token_urlsafe(18)
        self._tables[key] = (monotonic(), table)
        self._drop()
        return key

    def get(self, key: str) -> Table:
        """The table of that name.

        Raises:
            RecordingError: it is not, or not any more, there.
        """
        self._drop()
        if key not in self._tables:
            raise RecordingError(
                "the server does not hold this recording any more",
                field="recording",
                value=key,
                hint="Send the file again.",
            )
        _, table = self._tables.pop(key)
        self._tables[key] = (monotonic(), table)
        return table

    def _drop(self) -> None:
        total = sum(table.values.nbytes for _, table in self._tables.values())
        while self._tables:
            key, (used, table) = next(iter(self._tables.items()))
            old = monotonic() - used > KEPT_SECONDS
            if not old and (total <= self._most or len(self._tables) == 1):
                return
            del self._tables[key]
            total -= table.values.nbytes
