"""Recordings that clients have sent, in memory: few, and not for long."""

from __future__ import annotations

import secrets
from collections import Counter, OrderedDict
from dataclasses import dataclass
from time import monotonic

from heli2dof_core.errors import RecordingError
from heli2dof_core.recordings.recording import Table

KEPT_SECONDS = 1800.0


@dataclass
class _Entry:
    """A table, who sent it, and when it was last used."""

    table: Table
    owner: str
    used: float
    name: str

    @property
    def size(self) -> int:
        return self.table.values.nbytes


class RecordingStore:
    """Tables by unguessable keys. Where there are too many, the owner who holds most loses the longest unused.

    Args:
        most: tables.
        most_bytes: of all their numbers.
    """

    def __init__(self, most: int, most_bytes: int) -> None:
        self._kept: OrderedDict[str, _Entry] = OrderedDict()
        self._most, self._most_bytes = most, most_bytes

    def __len__(self) -> int:
        return len(self._kept)

    def put(self, table: Table, owner: str = "", name: str = "") -> str:
        """Keeps a table, and its file's name, under a new key."""
        key = secrets.token_urlsafe(18)
        self._drop_expired()
        self._kept[key] = _Entry(table, owner, monotonic(), name)
        while len(self._kept) > 1 and (len(self._kept) > self._most or self._bytes() > self._most_bytes):
            self._drop_one(key)
        return key

    def get(self, key: str) -> Table:
        """The table under that key.

        Raises:
            RecordingError: it is not, or not any more, there.
        """
        return self.named(key)[1]

    def named(self, key: str) -> tuple[str, Table]:
        """The file's name and the table under that key, see `get`."""
        self._drop_expired()
        if key not in self._kept:
            raise RecordingError(
                "the server does not hold this recording any more",
                field="recording",
                value=key,
                hint="Send the file again.",
            )
        kept = self._kept[key]
        kept.used = monotonic()
        self._kept.move_to_end(key)
        return kept.name, kept.table

    def _bytes(self) -> int:
        return sum(kept.size for kept in self._kept.values())

    def _drop_expired(self) -> None:
        now = monotonic()
        while self._kept and now - next(iter(self._kept.values())).used > KEPT_SECONDS:
            self._kept.popitem(last=False)

    def _drop_one(self, newest: str) -> None:
        """Drops the longest unused of the owner who holds most bytes, but not what has just come."""
        held: Counter[str] = Counter()
        for kept in self._kept.values():
            held[kept.owner] += kept.size
        largest_owner = max(held, key=lambda owner: held[owner])
        old = [key for key, kept in self._kept.items() if key != newest]
        del self._kept[next((key for key in old if self._kept[key].owner == largest_owner), old[0])]
