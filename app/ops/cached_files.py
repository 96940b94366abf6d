"""Files from memory, compressed once: a class that opens the page at one moment asks for thousands of them."""

from __future__ import annotations

import gzip
import hashlib
import mimetypes
import stat
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from fastapi.staticfiles import StaticFiles
from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.responses import Response
from starlette.types import Scope

_PACKED = ("text/", "application/json", "application/wasm", "image/svg+xml")
"""Media types that gain by compression."""
_WORTH_IT = 512
"""Bytes below which compression gains nothing."""


@dataclass(frozen=True)
class Content:
    """What is sent of one file, plain or compressed, with its entity tag."""

    plain: bytes
    media_type: str

    @cached_property
    def etag(self) -> str:
        """Of the plain content; the compressed one has the same with a letter more."""
        return hashlib.sha256(self.plain).hexdigest()[:32]

    @cached_property
    def compressed(self) -> bytes | None:
        """By gzip; None where that gains nothing."""
        if len(self.plain) < _WORTH_IT or not self.media_type.startswith(_PACKED):
            return None
        return gzip.compress(self.plain, compresslevel=6, mtime=0)

    def response(self, request: Headers, more: Mapping[str, str] | None = None) -> Response:
        """The answer to a request with these headers, and more of its own: 304 where the client has it already."""
        packed = self.compressed if "gzip" in request.get("accept-encoding", "") else None
        etag = f'"{self.etag}{"z" if packed else ""}"'
        headers = {"Cache-Control": "no-cache", "ETag": etag, "Vary": "Accept-Encoding", **(more or {})}
        if etag in request.get("if-none-match", ""):
            return Response(status_code=304, headers=headers)
        if packed:
            headers["Content-Encoding"] = "gzip"
        return Response(packed or self.plain, media_type=self.media_type, headers=headers)


class CachedFiles(StaticFiles):
    """A folder's files. Browsers ask about them again (no-cache, ETag), so that an upgrade shows at once.

    Starlette's own answers cost three changes of thread each. Here only the file's date is looked at, and its
    content is read anew where that has changed.

    Args:
        directory: where they are.
        headers: of single files, by their path there.
    """

    def __init__(self, *, directory: Path, headers: Mapping[str, Mapping[str, str]] | None = None) -> None:
        super().__init__(directory=directory)
        self._headers = headers or {}
        self._kept: dict[str, tuple[tuple[int, int], Content]] = {}

    async def get_response(self, path: str, scope: Scope) -> Response:
        """Answers GET and HEAD.

        Raises:
            HTTPException: 404 where there is no such file, 405 for other methods.
        """
        if scope["method"] not in ("GET", "HEAD"):
            raise HTTPException(405, headers={"Allow": "GET, HEAD"})
        return self.content(path).response(Headers(scope=scope), self._headers.get(Path(path).as_posix()))

    def content(self, path: str) -> Content:
        """A file of the folder.

        Raises:
            HTTPException: 404 where there is none.
        """
        try:
            full_path, status = self.lookup_path(path)
        except (OSError, ValueError):  # a name that no file can have
            full_path, status = path, None
        if status is None or not stat.S_ISREG(status.st_mode):
            raise HTTPException(404)
        stamp = (status.st_mtime_ns, status.st_size)
        known, content = self._kept.get(full_path, (None, None))
        if content is None or known != stamp:
            content = Content(Path(full_path).read_bytes(), media_type_of(full_path))
            self._kept[full_path] = (stamp, content)
        return content


def media_type_of(name: str) -> str:
    """By the name's end, whatever this machine's own table says of what browsers run."""
    if name.endswith((".js", ".mjs")):
        return "text/javascript"
    if name.endswith(".wasm"):  # browsers compile it while it arrives under this type alone
        return "application/wasm"
    return mimetypes.guess_type(name)[0] or "application/octet-stream"
