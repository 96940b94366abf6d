"""What a browser is shown between the platform and the place where somebody lands."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cache
from typing import TYPE_CHECKING, Any
from urllib.parse import urlencode, urlsplit

from starlette.responses import RedirectResponse, Response

from heli2dof_core.templates import templates_beside

from ..edge import policies
from .addresses import origin_of
from .platforms import Platform
from .tool import STATE_SECONDS, Begun, Choice, Landing, Reply, Unbound

if TYPE_CHECKING:  # imported where a page is made
    from jinja2 import Environment

_COOKIE = "heli2dof-lti-"
_LETTERS_OF_STATE = 16
_NEVER_KEPT = {"Cache-Control": "no-store"}


def key_of(state: str) -> str:
    """Under which a browser keeps what binds a launch to it."""
    return _COOKIE + state[:_LETTERS_OF_STATE]


class Pages:
    """Makes the pages.

    Args:
        ancestors: who may show this server's pages in frames; platforms may show these here besides.
    """

    def __init__(self, ancestors: Iterable[str]) -> None:
        self._ancestors = tuple(ancestors)

    def begun(self, begun: Begun) -> Response:
        """On to the platform; where it keeps values for tools, through a page that gives it one to keep."""
        if begun.login.storage:
            reply = self._page(
                "storage.html.jinja",
                begun.platform,
                do="put",
                target=begun.login.storage,
                origin=origin_of(begun.platform.auth_url),
                key=key_of(begun.state),
                value=begun.binding,
                following=begun.address,
                elsewhere=begun.address,
                form={},
            )
        else:
            reply = RedirectResponse(begun.address, 302, _NEVER_KEPT)
        self._set_cookie(reply, begun.platform, begun.state, begun.binding, int(STATE_SECONDS))
        return reply

    def forget(self, reply: Response, platform: Platform, state: str) -> None:
        """Takes the launch's cookie back: it has done its work."""
        self._set_cookie(reply, platform, state, "", 0)

    @staticmethod
    def _set_cookie(reply: Response, platform: Platform, state: str, value: str, seconds: int) -> None:
        # The platform posts the launch from its own site, so `lax` would not do; browsers take `secure` from
        # loopback, too. Within a frame it is kept for that one site's frames alone, which is all that is needed.
        reply.set_cookie(
            key_of(state),
            value,
            max_age=seconds,
            path=f"{urlsplit(platform.address).path}/lti",
            secure=True,
            httponly=True,
            samesite="none",
        )
        name, line = reply.raw_headers[-1]
        reply.raw_headers[-1] = name, line + b"; Partitioned"

    def unbound(self, unbound: Unbound, form: Mapping[str, str]) -> Response:
        """Asks the platform's frame for what binds the launch; without one, offers to begin anew in a window."""
        login, platform = unbound.login, unbound.platform
        again = {
            "iss": platform.issuer,
            "client_id": platform.client_id,
            "login_hint": login.hint,
            "target_link_uri": unbound.target,
        }
        if login.message_hint is not None:
            again["lti_message_hint"] = login.message_hint
        return self._page(
            "storage.html.jinja",
            platform,
            do="get" if login.storage and "proof" not in form else "offer",
            target=login.storage,
            origin=origin_of(platform.auth_url),
            key=key_of(form["state"]),
            value="",
            following="",
            elsewhere=f"{platform.address}/lti/login?{urlencode(again)}",
            form={name: form[name] for name in ("id_token", "state")},
        )

    def landing(self, landing: Landing) -> Response:
        """On to the page; browsers carry what stands behind the # along and send it to nobody."""
        return RedirectResponse(landing.address, 303, _NEVER_KEPT)

    def choice(self, choice: Choice) -> Response:
        """The labs, to choose one of."""
        labs = [lab.summary for lab in choice.labs]
        return self._page(
            "choose.html.jinja",
            choice.platform,
            ticket=choice.ticket,
            labs=labs,
            makes_class=choice.launch.kind == "link",
            course=choice.launch.title,
        )

    def reply(self, reply: Reply) -> Response:
        """Posts a choice to the platform, by a script or, without any, by a button."""
        return self._page("send.html.jinja", reply.platform, address=reply.address, token=reply.token)

    def told(self, title: str, words: str, hint: str, status: int) -> Response:
        """What is wrong, and what to do."""
        text = _templates().get_template("told.html.jinja").render(title=title, words=words, hint=hint)
        # Of no platform that is known: whoever shows it in a frame shows this.
        policy = policies.told(self._ancestors)
        return Response(
            text, status, {**_NEVER_KEPT, "Content-Security-Policy": policy}, media_type="text/html"
        )

    def _page(self, template: str, platform: Platform, **said: Any) -> Response:
        text = _templates().get_template(template).render(**said)
        theirs = origin_of(platform.auth_url)
        hosts = dict.fromkeys((*self._ancestors, theirs, *(f"https://{host}" for host in platform.hosts)))
        ancestors = [word for word in hosts if word != "'none'"]
        sent_to = ["'self'"] if template != "send.html.jinja" else [origin_of(said["address"])]
        policy = policies.launch(ancestors, sent_to)
        return Response(text, 200, {**_NEVER_KEPT, "Content-Security-Policy": policy}, media_type="text/html")


@cache
def _templates() -> Environment:
    return templates_beside(__file__)
