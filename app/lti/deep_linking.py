"""What goes back to the platform when an instructor has chosen a lab (LTI Deep Linking 2.0)."""

from __future__ import annotations

import secrets
from collections.abc import Mapping
from typing import Any

from .keys import signed
from .launch import Launch
from .platforms import Platform
from .vocabulary import CLAIM, DEEP_LINKING, DEEP_RESPONSE, VERSION

_SECONDS = 300


def chosen(
    platform: Platform,
    launch: Launch,
    key: Mapping[str, Any],
    now: float,
    *,
    lab: str,
    title: str,
    text: str,
    points: float,
) -> str:
    """The signed choice: a link with the lab as its custom parameter, and a column for its grades.

    Args:
        platform: that has asked.
        launch: with which it has.
        key: that signs.
        now: seconds since 1970.
        lab: the lab's name.
        title: the lab's.
        text: the lab's summary.
        points: of the whole lab.
    """
    item: dict[str, Any] = {
        "type": "ltiResourceLink",
        "title": title,
        "text": text,
        "url": f"{platform.address}/lti/launch",
        "custom": {"lab": lab},
        "window": {"targetName": "_blank"},
    }
    if points > 0:
        item["lineItem"] = {"label": title, "scoreMaximum": points, "resourceId": lab}
    claims: dict[str, Any] = {
        "iss": platform.client_id,
        "aud": [platform.issuer],
        "iat": int(now),
        "exp": int(now) + _SECONDS,
        "nonce": secrets.token_urlsafe(16),
        f"{CLAIM}message_type": DEEP_RESPONSE,
        f"{CLAIM}version": VERSION,
        f"{CLAIM}deployment_id": launch.deployment,
        f"{DEEP_LINKING}content_items": [item],
    }
    if launch.data is not None:
        claims[f"{DEEP_LINKING}data"] = launch.data
    return signed(claims, key)
