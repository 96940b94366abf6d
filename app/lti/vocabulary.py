"""The names that LTI 1.3 and its services give to claims, scopes, roles and media types."""

from __future__ import annotations

from typing import Final

CLAIM: Final = "https://purl.imsglobal.org/spec/lti/claim/"
DEEP_LINKING: Final = "https://purl.imsglobal.org/spec/lti-dl/claim/"
GRADES_CLAIM: Final = "https://purl.imsglobal.org/spec/lti-ags/claim/endpoint"
MEMBERS_CLAIM: Final = "https://purl.imsglobal.org/spec/lti-nrps/claim/namesroleservice"

VERSION: Final = "1.3.0"
RESOURCE_REQUEST: Final = "LtiResourceLinkRequest"
DEEP_REQUEST: Final = "LtiDeepLinkingRequest"
DEEP_RESPONSE: Final = "LtiDeepLinkingResponse"

SCOPE_SCORE: Final = "https://purl.imsglobal.org/spec/lti-ags/scope/score"
SCOPE_LINEITEM: Final = "https://purl.imsglobal.org/spec/lti-ags/scope/lineitem"
SCOPE_MEMBERS: Final = "https://purl.imsglobal.org/spec/lti-nrps/scope/contextmembership.readonly"
SCOPES: Final = (SCOPE_SCORE, SCOPE_LINEITEM, SCOPE_MEMBERS)
"""All that this tool asks for."""

SCORE_TYPE: Final = "application/vnd.ims.lis.v1.score+json"
LINEITEM_TYPE: Final = "application/vnd.ims.lis.v2.lineitem+json"
LINEITEMS_TYPE: Final = "application/vnd.ims.lis.v2.lineitemcontainer+json"
MEMBERS_TYPE: Final = "application/vnd.ims.lti-nrps.v2.membershipcontainer+json"

ASSERTION_TYPE: Final = "urn:ietf:params:oauth:client-assertion-type:jwt-bearer"

_ROLE: Final = "http://purl.imsglobal.org/vocab/lis/v2/"
_TEACHING: Final = ("Instructor", "Administrator", "ContentDeveloper", "Manager")
_TAUGHT: Final = ("Learner", "NonCreditLearner", "Mentor", "Member")


def is_instructor(roles: tuple[str, ...]) -> bool:
    """Whether somebody with these roles teaches here.

    Roles within the course decide, teaching assistants among the instructors; where there are none, an
    administrator of the site counts as one. Old platforms send the bare names of course roles.
    """
    here = {_here(role) for role in roles} - {""}
    if here:
        return bool(here & set(_TEACHING))
    return any(role.startswith(_ROLE) and role.endswith("/person#Administrator") for role in roles)


def _here(role: str) -> str:
    """The principal role within the course that a role stands for, empty where it is none."""
    if role in _TEACHING or role in _TAUGHT:
        return role
    for before in (f"{_ROLE}membership#", f"{_ROLE}membership/"):
        if role.startswith(before):
            return role.removeprefix(before).partition("#")[0]
    return ""
