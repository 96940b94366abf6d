"""The form that asks a person for the access token."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from heli2dof_core.templates import templates_beside

if TYPE_CHECKING:  # imported where a page is made
    from jinja2 import Template


def login_form(*, wrong: bool, root: str, path: str) -> str:
    """The page.

    Args:
        wrong: whether another token was tried.
        root: prefix of the app's addresses, as far as it is known.
        path: that was asked for, with the prefix; the form's own files are found relative to it.
    """
    depth = path.removeprefix(root).count("/") - 1
    return _form().render(static="../" * max(depth, 0) + "static/", wrong=wrong)


@cache
def _form() -> Template:
    return templates_beside(__file__).get_template("login.html.jinja")
