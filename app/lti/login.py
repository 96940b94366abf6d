"""How a launch begins: the platform says that somebody comes, and is asked who (OpenID Connect)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from urllib.parse import urlencode

from .addresses import origin_of, with_query
from .errors import LtiError
from .launch import MOST_ID
from .platforms import Platform

_MOST_HINT = 8192
_FRAME = re.compile(r"[A-Za-z_][\w-]{0,63}", re.ASCII)


@dataclass(frozen=True)
class Login:
    """What a platform says at the beginning.

    Attributes:
        hint: about the person, to be sent back.
        message_hint: about the link, to be sent back; None where there was none.
        storage: the platform's frame that keeps values for tools whose cookies are blocked; empty where none does.
    """

    hint: str
    message_hint: str | None
    storage: str


def read_login(given: Mapping[str, str], platforms: Iterable[Platform]) -> tuple[Platform, Login]:
    """Finds who is coming.

    Args:
        given: the request's parameters.
        platforms: those that are registered.

    Raises:
        LtiError: the platform is not known, or something is missing.
    """
    issuer, client_id = given.get("iss", ""), given.get("client_id", "")
    of_issuer = [platform for platform in platforms if platform.issuer == issuer]
    known = [platform for platform in of_issuer if not client_id or platform.client_id == client_id]
    if len(known) != 1:
        ids = "Several ids of this server are registered for it, and it does not say which it means."
        raise LtiError(
            "unknown_platform",
            "This platform is not registered here." if not known else ids,
            "Whoever runs this server registers it: heli2dof lti register.",
            403,
        )
    platform, target = known[0], given.get("target_link_uri", "")
    deployment = given.get("lti_deployment_id", "")
    hint, message_hint = given.get("login_hint", ""), given.get("lti_message_hint")
    if not hint or len(hint) > _MOST_HINT or len(message_hint or "") > _MOST_HINT:
        raise LtiError(
            "malformed_login", "The platform does not say who comes.", "Launch once more from there."
        )
    if deployment and deployment not in platform.deployments:
        raise LtiError(
            "unknown_deployment",
            "This deployment of the tool is not registered here.",
            f"Whoever runs this server adds it: heli2dof lti deploy {platform.name} {deployment[:MOST_ID]}.",
            403,
        )
    if origin_of(target, "The launch's target") != origin_of(platform.address):
        raise LtiError(
            "foreign_target", "This launch leads to another server.", "Its link is set up wrongly.", 403
        )
    storage = given.get("lti_storage_target", "")
    return platform, Login(hint, message_hint, storage if _FRAME.fullmatch(storage) else "")


def authorization(platform: Platform, login: Login, state: str, nonce: str) -> str:
    """Where the browser goes to be told who it is.

    Args:
        platform: that is asked.
        login: what it has said.
        state: names this launch.
        nonce: that its token must hold.
    """
    query = {
        "scope": "openid",
        "response_type": "id_token",
        "response_mode": "form_post",
        "prompt": "none",
        "client_id": platform.client_id,
        "redirect_uri": platform.redirect_uri,
        "login_hint": login.hint,
        "state": state,
        "nonce": nonce,
    }
    if login.message_hint is not None:
        query["lti_message_hint"] = login.message_hint
    return with_query(platform.auth_url, urlencode(query))
