"""Jobs and outcomes as bytes between processes of one server.

They are pickled, and who reads a pickle does what it says. So this is for sockets and pipes alone that a process has
made for its own children; nothing that a client has sent, and no file, comes here.
"""

from __future__ import annotations

import pickle
from typing import Any

PackingError = (pickle.PicklingError, AttributeError, TypeError)
"""What `packed` raises of a value that cannot be sent."""


def packed(value: Any) -> bytes:
    """The value as bytes.

    Raises:
        pickle.PicklingError, AttributeError, TypeError: it cannot be sent.
    """
    return pickle.dumps(value, pickle.HIGHEST_PROTOCOL)


def unpacked(content: bytes) -> Any:
    """The value of what `packed` has made, in this process or in one of its own."""
    return pickle.loads(content)
