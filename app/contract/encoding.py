"""Replies as bytes: JSON, or one binary frame with a JSON header and float32 arrays."""

from __future__ import annotations

import struct
from typing import Any

import orjson
from starlette.responses import Response

BINARY_SUBPROTOCOL = "heli2dof.v1+binary"
ARRAY_KEY = "$f32"


def json_bytes(value: Any) -> bytes:
    """JSON, NumPy arrays included."""
    return orjson.dumps(value, option=orjson.OPT_SERIALIZE_NUMPY)


def json_response(value: Any, status: int = 200) -> Response:
    """JSON as a response, past FastAPI's own encoder, which takes longer than the mathematics."""
    return Response(json_bytes(value), status, media_type="application/json")


def json_content(content: bytes) -> Response:
    """JSON that a worker has made, as a response."""
    return Response(content, media_type="application/json")


def json_text(value: Any) -> str:
    """JSON for a text frame."""
    return json_bytes(value).decode()


def described_files(summary: str, content: dict[str, Any]) -> dict[str, Any]:
    """Route options that put files into the schema instead of JSON: the schema of each media type."""
    replies = {200: {"description": summary, "content": content}}
    return {"summary": summary, "responses": replies, "response_class": Response}


def array_at(offset: int, length: int) -> dict[str, list[int]]:
    """What stands in a frame's header for an array: where it is, counted in elements from the header's end."""
    return {ARRAY_KEY: [offset, length]}


def framed(header: bytes, *data: bytes | memoryview) -> bytes:
    """uint32 header length, JSON header, then float32 arrays, all little endian.

    In the header each array is ``{"$f32": [offset, length]}``. It is padded with spaces so that they are
    aligned.
    """
    padding = b" " * (-len(header) % 4)
    return b"".join((struct.pack("<I", len(header) + len(padding)), header, padding, *data))
