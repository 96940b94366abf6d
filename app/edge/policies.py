"""Content security policies: what the pages of this server may load and run."""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Iterable

from heli2dof_core.export.report_style import STYLE

NOTHING = "default-src 'none'; frame-ancestors 'none'"
"""Of what is no page, as JSON: shown by itself it loads nothing."""


def _joined(ancestors: Iterable[str], *, form_action: str = "'none'", **sources: str) -> str:
    """Nothing is allowed but what is named."""
    sources = {"default_src": "'none'", **sources, "base_uri": "'none'", "form_action": form_action}
    directives = [f"{name.replace('_', '-')} {value}" for name, value in sources.items()]
    return "; ".join([*directives, f"frame-ancestors {' '.join(ancestors)}"])


def hash_source(text: bytes) -> str:
    """The source that allows an inline script or style of exactly this content."""
    return f"'sha256-{base64.b64encode(hashlib.sha256(text).digest()).decode()}'"


def page(ancestors: Iterable[str]) -> str:
    """Of the page: everything from its own origin, nothing inline but the laboratory report's own style.

    Its scripts may compile WebAssembly, which is the kernels in static/kernel/; they may not make code of text.
    The page opens the report from a blob, which inherits this policy; the style's hash allows that one content,
    and its font stands in it as data.
    """
    return _joined(
        ancestors,
        script_src="'self' 'wasm-unsafe-eval'",
        style_src=f"'self' {hash_source(STYLE.encode())}",
        font_src="'self' data:",
        img_src="'self'",
        connect_src="'self'",
        frame_src="'self'",
    )


WORKER = _joined(("'none'",), script_src="'self' 'wasm-unsafe-eval'")
"""Of the page's worker: it loads its own modules, is sent the kernels, and can ask nobody for anything."""


def api_docs(ancestors: Iterable[str]) -> str:
    """Of /docs: Swagger UI shows its icons as data."""
    return _joined(
        ancestors,
        script_src="'self'",
        style_src="'self'",
        img_src="'self' data:",
        connect_src="'self'",
    )


def login(ancestors: Iterable[str]) -> str:
    """Of the form that asks for the access token."""
    return _joined(
        ancestors,
        style_src="'self'",
        img_src="'self'",
        form_action="'self'",
    )


def told(ancestors: Iterable[str]) -> str:
    """Of the page that tells a person what is wrong."""
    return _joined(ancestors, style_src="'self'", img_src="'self'")


def launch(ancestors: Iterable[str], sent_to: Iterable[str]) -> str:
    """Of the pages between a learning platform and this server: a script that posts, to where is named."""
    return _joined(
        ancestors,
        script_src="'self'",
        style_src="'self'",
        img_src="'self'",
        form_action=" ".join(sent_to),
    )


def viewer(ancestors: Iterable[str], scripts: Iterable[bytes]) -> str:
    """Of viser's page.

    Its scripts stand in the page itself, so each is allowed by its content's hash. It decompresses by
    WebAssembly and talks in workers that it makes from blobs; its panel's library makes style elements
    while it runs, whose content is not known before.

    Args:
        ancestors: who may show it in a frame.
        scripts: what is inline.
    """
    hashes = " ".join(hash_source(script) for script in scripts)
    return _joined(
        ancestors,
        script_src=f"'self' {hashes} 'wasm-unsafe-eval'",
        worker_src="blob:",
        style_src="'self' 'unsafe-inline'",
        img_src="'self' data: blob:",
        connect_src="'self' data: blob:",
        font_src="data:",
    )
