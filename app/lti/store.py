"""What is kept of platforms, keys and launches: functions of a connection to the database."""

from __future__ import annotations

import hashlib
import json
import secrets
from dataclasses import replace
from typing import Any, Literal

from sqlalchemy import Connection, RowMapping, delete, func, insert, select, update

from ..classes.schema_lti import keys, nonces, platforms
from .errors import LtiError
from .keys import new_key
from .platforms import Platform

SHOWN_SECONDS = 7 * 86400.0
"""For which a key that signs no more is still shown: what it has signed lasts minutes, what platforms keep, days."""
_USED_SECONDS = 3600.0
"""For which a state is kept after its end, so that a launch that comes again is told as such."""
_JSON = ("deployments", "hosts")


def _platform(row: RowMapping) -> Platform:
    told = {name: value for name, value in row.items() if name != "created"}
    return Platform(**{**told, **{name: tuple(json.loads(told[name])) for name in _JSON}})


def all_platforms(connection: Connection) -> list[Platform]:
    """Those that are registered, by name."""
    return [
        _platform(row) for row in connection.execute(select(platforms).order_by(platforms.c.name)).mappings()
    ]


def platform_named(connection: Connection, name: str) -> Platform:
    """One of them.

    Raises:
        LtiError: there is none of this name.
    """
    row = connection.execute(select(platforms).where(platforms.c.name == name)).mappings().first()
    if row is None:
        raise LtiError("unknown_platform", f"No platform is registered as {name[:40]!r}.", status=404)
    return _platform(row)


def keep_platform(connection: Connection, platform: Platform, now: float) -> Platform:
    """Keeps a registration, in place of one of the same name; makes a key if there is none yet.

    Raises:
        LtiError: another name has this issuer and client id.
    """
    same = (platforms.c.issuer == platform.issuer) & (platforms.c.client_id == platform.client_id)
    other = connection.execute(
        select(platforms.c.name).where(same & (platforms.c.name != platform.name))
    ).scalar()
    if other is not None:
        raise LtiError("registered", f"This issuer and client id are registered already, as {other!r}.")
    values: dict[str, Any] = {
        name: json.dumps(getattr(platform, name)) if name in _JSON else getattr(platform, name)
        for name in Platform.__dataclass_fields__
        if name != "id"
    }
    known = connection.execute(select(platforms.c.id).where(platforms.c.name == platform.name)).scalar()
    if known is None:
        done = connection.execute(insert(platforms).values(**values, created=now))
        known = done.inserted_primary_key[0] if done.inserted_primary_key else 0
    else:
        connection.execute(update(platforms).where(platforms.c.id == known).values(**values))
    signing_key(connection, now)
    return replace(platform, id=known)


def forget_platform(connection: Connection, name: str) -> None:
    """Takes a platform out, with its links and who came by them; their classes stay.

    Raises:
        LtiError: there is none of this name.
    """
    platform_named(connection, name)
    connection.execute(delete(platforms).where(platforms.c.name == name))


def signing_key(connection: Connection, now: float) -> dict[str, Any]:
    """The private key that signs; made if there is none."""
    row = connection.execute(
        select(keys.c.private).where(keys.c.retired.is_(None)).order_by(keys.c.created.desc()).limit(1)
    ).first()
    return json.loads(row.private) if row is not None else _add_key(connection, now)


def shown_keys(connection: Connection, now: float) -> list[dict[str, Any]]:
    """The keys whose public halves platforms see: the one that signs, and those that did not long ago."""
    recent = keys.c.retired.is_(None) | (keys.c.retired > now - SHOWN_SECONDS)
    rows = connection.execute(select(keys.c.private).where(recent).order_by(keys.c.created.desc()))
    return [json.loads(row.private) for row in rows]


def rotate(connection: Connection, now: float) -> str:
    """A new key signs from now on; returns its name. Those that are shown no more are deleted."""
    connection.execute(update(keys).where(keys.c.retired.is_(None)).values(retired=now))
    connection.execute(delete(keys).where(keys.c.retired <= now - SHOWN_SECONDS))
    return _add_key(connection, now)["kid"]


def _add_key(connection: Connection, now: float) -> dict[str, Any]:
    key = new_key()
    connection.execute(insert(keys).values(kid=key["kid"], private=json.dumps(key), created=now))
    return key


def hash_of(word: str) -> str:
    """What is kept of a random word."""
    return hashlib.sha256(word.encode("utf-8", "replace")).hexdigest()


def put_nonce(
    connection: Connection,
    kind: Literal["state", "ticket"],
    platform: Platform,
    told: dict[str, Any],
    expires: float,
) -> str:
    """Keeps what a launch must fit to, or what was launched; returns the random word that finds it."""
    word = secrets.token_urlsafe(32)
    connection.execute(
        insert(nonces).values(
            hash=hash_of(word),
            kind=kind,
            platform_id=platform.id,
            told=json.dumps(told),
            expires=expires,
            used=False,
        )
    )
    return word


def find_nonce(
    connection: Connection, kind: Literal["state", "ticket"], word: str, now: float
) -> tuple[Platform, dict[str, Any]]:
    """What was kept under a word, and for which platform.

    Raises:
        LtiError: nothing, or not any more.
    """
    row = connection.execute(
        select(nonces).where((nonces.c.hash == hash_of(word)) & (nonces.c.kind == kind))
    ).first()
    again = "Launch once more from the platform."
    if row is None or row.expires <= now:
        raise LtiError("unknown_state", "This launch was not begun here, or too long ago.", again, 403)
    if row.used:
        raise LtiError("launch_used", "This launch has been used already.", again, 403)
    platform = connection.execute(select(platforms).where(platforms.c.id == row.platform_id)).mappings().one()
    return _platform(platform), json.loads(row.told)


def use_nonce(connection: Connection, word: str) -> None:
    """Takes a word out of use; of several who try at the same time one does.

    Raises:
        LtiError: somebody has used it already.
    """
    known = nonces.c.hash == hash_of(word)
    done = connection.execute(update(nonces).where(known & nonces.c.used.is_(False)).values(used=True))
    if done.rowcount != 1:
        again = "Launch once more from the platform."
        raise LtiError("launch_used", "This launch has been used already.", again, 403)


def sweep(connection: Connection, now: float) -> None:
    """Deletes what has ended."""
    connection.execute(delete(nonces).where(nonces.c.expires < now - _USED_SECONDS))


def make_room(connection: Connection, platform: Platform, most: int) -> None:
    """Gives up the oldest of a platform's launches on their way, where there are too many, and a tenth more.

    Whoever begins launches in vain cannot fill the database with them, nor keep others from theirs, which take
    seconds.
    """
    mine = nonces.c.platform_id == platform.id
    count = connection.execute(select(func.count()).select_from(nonces).where(mine)).scalar_one()
    if count < most:
        return
    oldest = select(nonces.c.hash).where(mine).order_by(nonces.c.expires).limit(count - most + most // 10 + 1)
    connection.execute(delete(nonces).where(nonces.c.hash.in_(oldest)))
