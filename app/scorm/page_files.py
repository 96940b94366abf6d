"""Which of the page's files a package needs: its page, and all that this and its modules name."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator
from pathlib import Path

ENTRY = "scorm/scorm.html"
"""The package's page, within the folder of the page's files; it stands at the package's root."""
REPLACED = {"net/index.js": "net/packaged.js"}
"""By whose content a file is replaced in a package, where nobody can be asked."""

_COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)  # types are imported in comments, which loads nothing
_LINKED = re.compile(r"""<(?:link|script|img)\b[^>]*?\b(?:href|src)="static/([^"]+)\"""")
_IMPORTED = re.compile(r"""(?:\bfrom|\bimport|\bnew Worker\(new URL)\s*\(?\s*["'](\.[^"']+)["']""")
_USED = re.compile(r"""\burl\("?([^")]+)"?\)""")
_LICENCES = ("LICENSE", "NOTICE")


def page_files(static: Path) -> dict[str, bytes]:
    """The files of the page and what they hold.

    Args:
        static: the folder of the page's files.

    Returns:
        Their contents by their path within it, in order; licences of what others have written along with it. The
        page is not among them.
    """
    found: dict[str, bytes] = {}
    waiting: list[str] = _LINKED.findall((static / ENTRY).read_text("utf-8"))
    while waiting:
        name = waiting.pop()
        if name in found:
            continue
        content = (static / REPLACED.get(name, name)).read_bytes()
        found[name] = content
        waiting += _named_by(name, content)
        if name.startswith("vendor/"):
            folder = posixpath.dirname(name)
            waiting += [f"{folder}/{each}" for each in _LICENCES if (static / folder / each).is_file()]
    return dict(sorted(found.items()))


def _named_by(name: str, content: bytes) -> Iterator[str]:
    folder, suffix = posixpath.split(name)[0], posixpath.splitext(name)[1]
    if suffix == ".css":
        names = _USED.findall(_COMMENT.sub("", content.decode()))
    elif suffix == ".js" and not name.startswith("vendor/"):
        names = _IMPORTED.findall(_COMMENT.sub("", content.decode()))
    else:
        return
    for each in names:
        if not each.startswith(("data:", "#")):
            yield posixpath.normpath(posixpath.join(folder, each))
