"""Pages made of templates: files in HTML that stand beside the code and tell how a page looks, not what it says."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # Jinja2 is imported where a page is made, not at the start
    from jinja2 import Environment


def templates_beside(module: str, **filters: Callable[..., str | float]) -> Environment:
    """The templates of a module's folder `templates`, to be kept.

    They escape all text, and a name that a template uses and nobody gave is an error.

    Args:
        module: its `__file__`.
        filters: functions that the templates may write after a bar.
    """
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    pages = Environment(
        loader=FileSystemLoader(Path(module).parent / "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    pages.filters.update(filters)
    return pages
