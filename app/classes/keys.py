"""Codes and secrets: made here, kept as hashes."""

from __future__ import annotations

import hashlib
import hmac
import secrets
from base64 import urlsafe_b64encode

LETTERS = "BCDFGHJKMNPQRSTVWXYZ"
"""Of a class's code: none that is taken for another or for a digit, and no vowels, so that no code is a word."""
CODE_LENGTH = 7
_SECRET_BYTES = 24


def new_code() -> str:
    """A class's code, as it stands on the board: one of 1.28e9."""
    return "".join(secrets.choice(LETTERS) for _ in range(CODE_LENGTH))


def code_of(typed: str) -> str:
    """A code as it is typed: in small letters, with spaces or hyphens."""
    return "".join(letter for letter in typed[:40].upper() if letter not in " -\u2013\u00a0")


def new_secret() -> str:
    """192 random bits, as text of 32 characters."""
    return secrets.token_urlsafe(_SECRET_BYTES)


def secret_for(seed: str, request: str) -> str:
    """The secret of whoever joins by this request of their page: the same one, however often it is sent.

    Args:
        seed: the class's own, which nobody is told.
        request: of a page, random.
    """
    digest = hmac.new(seed.encode(), f"join {request}".encode(), hashlib.sha256).digest()
    return urlsafe_b64encode(digest[:_SECRET_BYTES]).decode()


def new_seed() -> int:
    """Of a student's rig: 48 random bits, which a float holds exactly."""
    return secrets.randbits(48)


def hash_of(secret: str) -> str:
    """What is kept of a secret: SHA-256, in hexadecimal. It has 192 random bits, so that it needs no salt."""
    return hashlib.sha256(secret.encode("utf-8", "replace")).hexdigest()


def fits(secret: str, kept: str) -> bool:
    """Whether a secret is the one whose hash is kept; takes as long either way."""
    return hmac.compare_digest(hash_of(secret), kept)
