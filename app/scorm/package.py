"""The package: the page's files, a lab as a module, the kernels as text, and the manifest, in one archive."""

from __future__ import annotations

import base64
import io
import json
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from html import escape
from pathlib import Path
from typing import Any

from .manifest import FILE, manifest
from .page_files import ENTRY, page_files

PAGE = "index.html"
_KERNELS = "kernel/kernels.wasm"
_THE_SAME_DAY = (1980, 1, 1, 0, 0, 0)
"""Of every file, so that the same lab gives the same bytes."""
_READABLE = 0o644 << 16
_UNIX = 3


@dataclass(frozen=True)
class Package:
    """A SCORM package.

    Attributes:
        content: the archive.
        files: how many it holds.
    """

    content: bytes
    files: int


def scorm_package(name: str, title: str, content: Mapping[str, Any], static: Path) -> Package:
    """Makes the package of a lab.

    Args:
        name: of the lab.
        title: of the lab, for people.
        content: what the page reads of it (static/scorm/content.js), as JSON has it.
        static: the folder of the page's files.

    Returns:
        An archive whose bytes depend on the arguments alone.
    """
    kernels = base64.b64encode((static / _KERNELS).read_bytes()).decode()
    page = (
        (static / ENTRY).read_text("utf-8").replace("<title>heli2dof", f"<title>{escape(title)} · heli2dof")
    )
    files = {
        PAGE: page.encode(),
        "content.js": _module(content),
        "kernels.js": _module(kernels),
        **{f"static/{path}": data for path, data in page_files(static).items()},
    }
    files = {FILE: manifest(name, title, files, PAGE), **dict(sorted(files.items()))}
    archive = io.BytesIO()
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as zipped:
        for path, data in files.items():
            entry = zipfile.ZipInfo(path, _THE_SAME_DAY)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.create_system = _UNIX
            entry.external_attr = _READABLE
            zipped.writestr(entry, data)
    return Package(archive.getvalue(), len(files))


def _module(value: Any) -> bytes:
    """A value as a module that exports it; servers of courses may refuse to send .json or .wasm."""
    text = json.dumps(value, sort_keys=True, ensure_ascii=True, allow_nan=False, separators=(",", ":"))
    return f"export default {text};\n".encode()
