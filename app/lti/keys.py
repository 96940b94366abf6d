"""Keys: our own, with which this server signs, and those of the platforms."""

from __future__ import annotations

import threading
from base64 import urlsafe_b64decode
from collections.abc import Callable, Iterable, Mapping
from time import monotonic
from typing import TYPE_CHECKING, Any

from .errors import LtiError, PlatformError
from .outward import Answer
from .platforms import Platform

if TYPE_CHECKING:  # imported where something is signed: it brings cryptography along
    from joserfc.jwk import RSAKey

ALGORITHM = "RS256"
"""The one that LTI demands of all; nothing else is taken, whatever a token's header says."""
_BITS = 2048
_MOST_KEYS = 100
_KEPT_SECONDS, _AGAIN_SECONDS, _AWAY_SECONDS = 3600.0, 30.0, 3.0
"""For how long a platform's keys are kept, how soon they are asked for again for the sake of an unknown one, and how
soon after the platform did not tell them."""

Ask = Callable[[str, str, tuple[str, ...]], Answer]


def new_key() -> dict[str, Any]:
    """A private key as a JWK, which its thumbprint names."""
    from joserfc.jwk import RSAKey

    key = RSAKey.generate_key(_BITS, {"use": "sig", "alg": ALGORITHM}, auto_kid=True)
    return dict(key.as_dict(private=True))


def public_keys(private: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """The public halves as a JWK set, as platforms fetch it."""
    shown = ("kty", "n", "e", "kid", "use", "alg")
    return {"keys": [{name: key[name] for name in shown} for key in private]}


def signed(claims: Mapping[str, Any], private: Mapping[str, Any]) -> str:
    """Claims as a token of ours."""
    from joserfc import jwt
    from joserfc.jwk import RSAKey

    key = RSAKey.import_key(dict(private))
    return jwt.encode({"alg": ALGORITHM, "kid": private["kid"]}, dict(claims), key, [ALGORITHM])


class KeySets:
    """The platforms' public keys, kept for an hour. Safe for threads.

    A key that is not among them has them fetched again, so that platforms may change theirs at any time;
    but not more often than every half minute, so that tokens with invented keys are no way to have them flooded.
    Nor are threads kept waiting for a platform that is away: who comes next is told at once.
    """

    def __init__(self, ask: Ask, clock: Callable[[], float] = monotonic) -> None:
        self._ask, self._clock = ask, clock
        self._lock = threading.Lock()
        self._kept: dict[tuple[str, str], tuple[float, dict[str, RSAKey]]] = {}
        self._away: dict[tuple[str, str], tuple[float, PlatformError]] = {}

    def key(self, platform: Platform, kid: str | None) -> RSAKey:
        """The platform's key of this name; its only one where the token names none.

        Raises:
            LtiError: the platform has no such key.
            PlatformError: it could not be asked.
        """
        where, now = (platform.issuer, platform.keyset_url), self._clock()
        with self._lock:
            fetched, keys = self._kept.get(where, (float("-inf"), {}))
        found = _chosen(keys, kid)
        age = now - fetched
        if age > _KEPT_SECONDS or (found is None and age > _AGAIN_SECONDS):
            keys = self._fetched_anew(platform, where)
            found = _chosen(keys, kid)
        if found is None:
            raise LtiError(
                "unknown_key",
                "The platform does not have the key that this launch is signed with.",
                "Launch once more from the platform. If that does not help, its public keyset is registered wrongly.",
                401,
            )
        return found

    def _fetched_anew(self, platform: Platform, where: tuple[str, str]) -> dict[str, RSAKey]:
        with self._lock:
            failed, last = self._away.get(where, (float("-inf"), None))
        if last is not None and self._clock() - failed < _AWAY_SECONDS:
            raise PlatformError(last.message, last.http_status)
        try:
            keys = self._fetched(platform)
        except PlatformError as error:
            with self._lock:
                self._away[where] = self._clock(), error
            raise
        with self._lock:
            self._kept[where] = self._clock(), keys
        return keys

    def _fetched(self, platform: Platform) -> dict[str, RSAKey]:
        from joserfc.errors import JoseError
        from joserfc.jwk import RSAKey

        answer = self._ask("GET", platform.keyset_url, platform.hosts)
        told = answer.json() if answer.status == 200 else None
        listed = told.get("keys") if isinstance(told, dict) else None
        if not isinstance(listed, list) or len(listed) > _MOST_KEYS:
            raise PlatformError("The platform's public keys cannot be read.", answer.status)
        keys: dict[str, RSAKey] = {}
        for number, key in enumerate(listed):
            # Of other kinds, or for encryption: there for somebody else.
            if not isinstance(key, dict) or key.get("kty") != "RSA" or key.get("use", "sig") != "sig":
                continue
            try:
                if _bits(key["n"]) < _BITS:
                    continue
                read = RSAKey.import_key({name: key[name] for name in ("kty", "n", "e")})
            except (JoseError, KeyError, ValueError, TypeError):
                continue
            keys[str(key.get("kid", f"#{number}"))] = read
        return keys


def _bits(modulus: str) -> int:
    """Of a modulus as a JWK has it."""
    return int.from_bytes(urlsafe_b64decode(f"{modulus}==")).bit_length()


def _chosen(keys: Mapping[str, RSAKey], kid: str | None) -> RSAKey | None:
    if kid is not None:
        return keys.get(kid)
    return next(iter(keys.values())) if len(keys) == 1 else None
