"""A checksum of JSON values that does not depend on how numbers are written: the page makes the same.

CRC-32 of the values' bytes: any single bit that changes changes it, for sure. It guards against damage, not against
somebody who makes a new one: what a flight is worth is what the server finds when it simulates it.
"""

from __future__ import annotations

import struct
from collections.abc import Iterator, Mapping
from typing import Any
from zlib import crc32


def checksum(value: Any) -> str:
    """Eight hexadecimal digits: of what JSON can hold.

    Numbers count as 64-bit floats, −0 as 0, which not every writer of JSON tells from it; text as a browser holds it,
    in units of UTF-16, whose order is that of an object's names.

    Raises:
        OverflowError: a number is larger than a float can be.
    """
    found = 0
    for part in _parts(value):
        found = crc32(part, found)
    return f"{found:08x}"


def _parts(value: Any) -> Iterator[bytes]:
    if value is None:
        yield b"z"
    elif value is True or value is False:
        yield b"t" if value else b"f"
    elif isinstance(value, (int, float)):
        yield b"n" + struct.pack("<d", value + 0.0)
    elif isinstance(value, str):
        own = value.encode("utf-16-le", "surrogatepass")
        yield b"s" + struct.pack("<I", len(own)) + own
    elif isinstance(value, Mapping):
        yield b"o" + struct.pack("<I", len(value))
        for name in sorted(value, key=lambda text: text.encode("utf-16-be", "surrogatepass")):
            yield from _parts(name)
            yield from _parts(value[name])
    else:
        yield b"l" + struct.pack("<I", len(value))
        for part in value:
            yield from _parts(part)
