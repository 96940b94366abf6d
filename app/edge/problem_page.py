"""What a person gets in a browser instead of a problem object: a page that says what is wrong, and a way on."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from fastapi import Request, Response

from heli2dof_core.templates import templates_beside

from . import policies

if TYPE_CHECKING:  # imported where a page is made
    from jinja2 import Template

_WORDS = {
    404: "There is nothing at this address. It may be mistyped, or what was there is gone.",
    405: "This address takes requests of programs. What it takes is described in the API’s documentation.",
}


def problem_page(ancestors: Iterable[str]) -> Callable[[Request, Mapping[str, Any]], Response | None]:
    """Return what makes the page of a problem object; None where no person asks.

    Args:
        ancestors: who may show it in a frame.
    """
    policy = policies.told(ancestors)

    def page(request: Request, problem: Mapping[str, Any]) -> Response | None:
        if request.method not in ("GET", "HEAD") or "text/html" not in request.headers.get("accept", ""):
            return None
        root = request.scope.get("app_root_path", request.scope.get("root_path", ""))  # a mount's aside
        depth = max(request.scope["path"].removeprefix(root).count("/") - 1, 0)
        text = _template().render(
            root="../" * depth or "./",
            title=problem["title"],
            words=_WORDS.get(problem["status"], problem["detail"]),
            hint=problem.get("hint"),
        )
        headers = {"Content-Security-Policy": policy, "Vary": "Accept", "Cache-Control": "no-store"}
        return Response(text, problem["status"], headers, media_type="text/html")

    return page


@cache
def _template() -> Template:
    return templates_beside(__file__).get_template("problem.html.jinja")
