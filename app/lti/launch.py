"""What a launch says: who comes, to which link, and what the platform lets this server do."""

from __future__ import annotations

import unicodedata
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any, Literal

from .addresses import origin_of, require_host
from .errors import LtiError
from .platforms import Platform
from .vocabulary import (
    CLAIM,
    DEEP_LINKING,
    DEEP_REQUEST,
    GRADES_CLAIM,
    MEMBERS_CLAIM,
    RESOURCE_REQUEST,
    SCOPES,
    VERSION,
    is_instructor,
)

MOST_ID = 255
_MOST_ROLES = 100
_MOST_NAME = 80
_MOST_DATA = 16384
_UNSEEN = frozenset(("Cc", "Cf", "Cs", "Co", "Cn", "Zl", "Zp"))
"""Categories of signs that are not seen; some turn the direction of what follows."""


@dataclass(frozen=True)
class Launch:
    """A launch that is to be believed.

    Attributes:
        kind: `link` to a lab, or `choice` of a lab by an instructor (deep linking).
        deployment: its id.
        subject: the person, as the platform calls them.
        name: the person's, empty where the platform keeps it to itself.
        instructor: whether the person teaches here.
        link: the resource link's id, empty at a choice.
        title: of link or course.
        lab: the custom parameter `lab`, empty where there is none.
        lineitem: address of the link's column of grades, empty where there is none.
        lineitems: address at which one may be made, empty where that is not allowed.
        scopes: what this server may do there, of all that it asks for.
        members: address of the course's names and roles, empty where they are not offered.
        return_url: to which a choice goes.
        data: that goes back with it; None where there was none.
        takes_links: whether the platform takes a link at the choice.
    """

    kind: Literal["link", "choice"]
    deployment: str
    subject: str
    name: str
    instructor: bool
    link: str = ""
    title: str = ""
    lab: str = ""
    lineitem: str = ""
    lineitems: str = ""
    scopes: tuple[str, ...] = ()
    members: str = ""
    return_url: str = ""
    data: str | None = None
    takes_links: bool = False

    def as_json(self) -> dict[str, Any]:
        """As `from_json` takes it."""
        return asdict(self)

    @classmethod
    def from_json(cls, told: Mapping[str, Any]) -> Launch:
        """The launch that was kept."""
        return cls(**{**told, "scopes": tuple(told["scopes"])})


def launch_of(claims: Mapping[str, Any], platform: Platform) -> Launch:
    """Reads the claims of a token that was verified.

    Raises:
        LtiError: something is missing, not of its kind, or not allowed; the code says what.
    """
    if claims.get(f"{CLAIM}version") != VERSION:
        raise _malformed("it is not of LTI 1.3.0")
    deployment = _text(claims, f"{CLAIM}deployment_id")
    if deployment not in platform.deployments:
        raise LtiError(
            "unknown_deployment",
            "This deployment of the tool is not registered here.",
            f"Whoever runs this server adds it: heli2dof lti deploy {platform.name} ID.",
            403,
        )
    target = _text(claims, f"{CLAIM}target_link_uri", 2000)
    if origin_of(target, "The launch's target") != origin_of(platform.address):
        raise LtiError(
            "foreign_target", "This launch leads to another server.", "Its link is set up wrongly.", 403
        )
    subject = claims.get("sub")
    if not isinstance(subject, str) or not subject or len(subject) > MOST_ID:
        raise LtiError(
            "anonymous",
            "The platform does not say who you are.",
            "Log in there and launch once more; anonymous launches are not taken.",
            403,
        )
    kind = claims.get(f"{CLAIM}message_type")
    shared = {
        "deployment": deployment,
        "subject": subject,
        "name": _name(claims),
        "instructor": is_instructor(_roles(claims)),
    }
    if kind == RESOURCE_REQUEST:
        return _to_link(claims, platform, shared)
    if kind == DEEP_REQUEST:
        return _to_choose(claims, platform, shared)
    raise _malformed("its kind is not known here")


def _to_link(claims: Mapping[str, Any], platform: Platform, shared: dict[str, Any]) -> Launch:
    resource = _object(claims, f"{CLAIM}resource_link")
    grades, custom = _object(claims, GRADES_CLAIM), _object(claims, f"{CLAIM}custom")
    scopes = grades.get("scope")
    lab = custom.get("lab")
    return Launch(
        kind="link",
        link=_text(resource, "id"),
        title=shown(resource.get("title")) or shown(_object(claims, f"{CLAIM}context").get("title")),
        lab=lab if isinstance(lab, str) and len(lab) <= MOST_ID else "",
        lineitem=_address(grades, "lineitem", platform),
        lineitems=_address(grades, "lineitems", platform),
        scopes=tuple(scope for scope in SCOPES if isinstance(scopes, list) and scope in scopes),
        members=_address(_object(claims, MEMBERS_CLAIM), "context_memberships_url", platform),
        **shared,
    )


def _to_choose(claims: Mapping[str, Any], platform: Platform, shared: dict[str, Any]) -> Launch:
    if not shared["instructor"]:
        raise LtiError("not_allowed", "Only who teaches a course chooses its labs.", status=403)
    asked = _object(claims, f"{DEEP_LINKING}deep_linking_settings")
    address = _address(asked, "deep_link_return_url", platform)
    data, types = asked.get("data"), asked.get("accept_types")
    if not address:
        raise _malformed("it does not say where the choice goes")
    if data is not None and not (isinstance(data, str) and len(data) <= _MOST_DATA):
        raise _malformed("its data are too large")
    return Launch(
        kind="choice",
        title=shown(_object(claims, f"{CLAIM}context").get("title")),
        return_url=address,
        data=data,
        takes_links=isinstance(types, list) and "ltiResourceLink" in types,
        **shared,
    )


def _text(told: Mapping[str, Any], name: str, most: int = MOST_ID) -> str:
    value = told.get(name)
    if not isinstance(value, str) or not value or len(value) > most:
        raise _malformed(f"{name.rpartition('/')[2]} is missing or too long")
    return value


def _object(told: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    value = told.get(name)
    return value if isinstance(value, dict) else {}


def _address(told: Mapping[str, Any], name: str, platform: Platform) -> str:
    """An address of the platform's, empty where it names none; of a foreign host it is refused."""
    value = told.get(name)
    if not isinstance(value, str) or not value:
        return ""
    return require_host(value, platform.hosts, f"The launch's {name}")


def _roles(claims: Mapping[str, Any]) -> tuple[str, ...]:
    roles = claims.get(f"{CLAIM}roles")
    if not isinstance(roles, list):
        return ()
    return tuple(role for role in roles[:_MOST_ROLES] if isinstance(role, str))


def _name(claims: Mapping[str, Any]) -> str:
    parts = (shown(claims.get("given_name")), shown(claims.get("family_name")))
    return shown(claims.get("name")) or " ".join(part for part in parts if part)[:_MOST_NAME]


def shown(value: Any) -> str:
    """A text that is shown to people: one line, not long; empty where it is none."""
    if not isinstance(value, str):
        return ""
    text = unicodedata.normalize("NFC", value[: 4 * _MOST_NAME])
    seen = "".join(" " if unicodedata.category(sign) in _UNSEEN else sign for sign in text)
    return " ".join(seen.split())[:_MOST_NAME].rstrip()


def _malformed(what: str) -> LtiError:
    return LtiError(
        "malformed_launch", f"This launch cannot be read: {what}.", "Whoever runs the platform can help."
    )
