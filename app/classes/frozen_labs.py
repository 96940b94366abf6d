"""The labs of classes, as they were when the classes were made; read once, then at hand."""

from __future__ import annotations

import threading
from collections import OrderedDict

from sqlalchemy import Connection

from .lab_library import KnownLab, frozen_lab
from .rows import ClassRow, lab_text

_REMEMBERED = 500
"""Classes whose labs are at hand."""


class FrozenLabs:
    """Hands out a class's lab within the transaction that found the class; for all threads."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._known: OrderedDict[tuple[int, str, float], KnownLab] = OrderedDict()

    def of(self, connection: Connection, found: ClassRow) -> KnownLab:
        """The lab of a class.

        Raises:
            ClassError: unknown_class, lab_unreadable.
        """
        key = (found.id, found.code, found.created)
        with self._lock:
            known = self._known.get(key)
        if known is None:
            known = frozen_lab(lab_text(connection, found.id), found.lab_name)
            with self._lock:
                self._known[key] = known
                if len(self._known) > _REMEMBERED:
                    self._known.popitem(last=False)
        return known
