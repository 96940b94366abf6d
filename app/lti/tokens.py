"""The token of a launch: whether it is the platform's, meant for this server, fresh, and well-formed."""

from __future__ import annotations

from typing import Any

from .errors import LtiError
from .keys import ALGORITHM, KeySets
from .platforms import Platform

MOST_CHARACTERS = 65536
"""Of a token; those of large platforms have some ten thousand."""
_LEEWAY = 60
"""Seconds by which clocks may differ."""
_LONGEST = 3600
"""Seconds for which a token may be valid, counted from when it was made."""


def verified(token: str, platform: Platform, keys: KeySets, now: float) -> dict[str, Any]:
    """The claims of a token.

    Args:
        token: as it was posted.
        platform: that was asked.
        keys: of the platforms.
        now: seconds since 1970.

    Raises:
        LtiError: it is not to be believed; the code says why.
        PlatformError: the platform's keys could not be had.
    """
    from joserfc import jws
    from joserfc.errors import JoseError

    if len(token) > MOST_CHARACTERS:
        raise _refused(
            "token_too_large", f"The platform's token is larger than {MOST_CHARACTERS} characters.", 413
        )
    # Headers that nobody knows are to be ignored (RFC 7515, 4); its own default refuses them.
    registry = jws.JWSRegistry(algorithms=[ALGORITHM], strict_check_header=False)
    registry.max_header_length, registry.max_payload_length = 4096, MOST_CHARACTERS
    try:
        unread = jws.extract_compact(token.encode("ascii"), registry=registry)
        header = unread.headers()
        registry.check_header(header)
    except (JoseError, ValueError, RecursionError):
        raise _refused("bad_token", "What the platform has sent is no signed token.") from None
    kid = header.get("kid")
    if header.get("alg") != ALGORITHM:
        raise _refused("bad_algorithm", f"The platform's token is not signed with {ALGORITHM}.")
    if kid is not None and not isinstance(kid, str):
        raise _refused("bad_token", "The key of the platform's token has no proper name.")
    key = keys.key(platform, kid)
    try:
        if not jws.validate_compact(unread, key, registry=registry):
            raise _refused("bad_signature", "The platform's token is not signed by the platform.")
    except JoseError:
        raise _refused("bad_signature", "The platform's token is not signed by the platform.") from None
    claims = _claims(unread.payload)
    _check(claims, platform, now)
    return claims


def _claims(payload: bytes) -> dict[str, Any]:
    import json

    try:
        claims = json.loads(payload)
    except (ValueError, RecursionError):
        claims = None
    if not isinstance(claims, dict):
        raise _refused("bad_token", "The platform's token says nothing that can be read.")
    return claims


def _check(claims: dict[str, Any], platform: Platform, now: float) -> None:
    """Issuer, audience and times (IMS Security Framework 1.0, 5.1.3).

    Raises:
        LtiError: one of them is wrong.
    """
    from joserfc.errors import ClaimError, ExpiredTokenError
    from joserfc.jwt import JWTClaimsRegistry

    times = JWTClaimsRegistry(int(now), _LEEWAY, exp={"essential": True}, iat={"essential": True})
    try:
        times.validate({name: claims[name] for name in ("exp", "iat", "nbf") if name in claims})
    except ExpiredTokenError:
        hint = "Launch once more from the platform."
        raise LtiError("token_expired", "This launch has expired.", hint, 401) from None
    except ClaimError:
        raise _refused(
            "bad_time", "The platform's token has no proper times, or its clock is wrong."
        ) from None
    if claims["exp"] - claims["iat"] > _LONGEST:
        raise _refused("bad_time", "The platform's token is valid for too long.")
    if claims.get("iss") != platform.issuer:
        raise _refused("wrong_issuer", "The platform's token comes from another platform.")
    audience = claims.get("aud")
    listed = audience if isinstance(audience, list) else [audience]
    party = claims.get("azp")
    wrong_party = party != platform.client_id if party is not None or len(listed) > 1 else False
    if platform.client_id not in listed or wrong_party:
        raise _refused("wrong_audience", "The platform's token is meant for somebody else.")


def _refused(code: str, message: str, status: int = 401) -> LtiError:
    return LtiError(code, message, "Launch once more from the platform.", status)
