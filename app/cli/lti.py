"""`heli2dof lti`: the learning platforms that may launch this server (docs/lti.md)."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from time import time
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:  # the database and its libraries, when a command has begun
    from sqlalchemy import Connection

    from ..lti.platforms import Platform

_ADDRESSES = {
    "issuer": "The platform's issuer, as it stands in its tokens.",
    "auth_url": "Where it says who is there: its authentication request URL.",
    "token_url": "Where it gives tokens: its access token URL.",
    "keyset_url": "Where its public keys are: its public keyset URL.",
    "audience": "For whom a request for a token is signed, where that is not the access token URL.",
}


@click.group()
def lti() -> None:
    """Learning platforms that launch labs here, by LTI 1.3; docs/lti.md tells how, step by step."""


@contextmanager
def _database() -> Iterator[Connection]:
    """A transaction on the server's database; what is refused is told, with the exit status 2."""
    from pydantic import ValidationError

    from ..classes.engines import open_engines
    from ..classes.errors import ClassError
    from ..lti.errors import LtiError
    from ..ops.settings import Settings, complaint

    try:
        engines = open_engines(Settings().database_address)
        try:
            with engines.writing.begin() as connection:
                yield connection
        finally:
            engines.dispose()
    except (ValidationError, LtiError, ClassError) as error:
        words = complaint(error) if isinstance(error, ValidationError) else f"{error} {error.hint}".rstrip()
        print(f"heli2dof: {words}", file=sys.stderr)
        sys.exit(2)


def _of_addresses(function: Any) -> Any:
    for name, about in reversed(_ADDRESSES.items()):
        function = click.option(f"--{name.replace('_', '-')}", help=about)(function)
    return function


@lti.command()
@click.argument("name")
@click.option("--address", required=True, help="This server's own address, as https://lab.example.")
@click.option(
    "--moodle", metavar="ADDRESS", help="A Moodle at this address; the addresses below are known then."
)
@click.option(
    "--canvas", metavar="ADDRESS", help="A Canvas at this address, as https://school.instructure.com."
)
@click.option("--client-id", required=True, help="The id that the platform has given to this server.")
@click.option("--deployment", "deployments", multiple=True, help="A deployment's id; may come several times.")
@click.option("--host", "hosts", multiple=True, help="A further host of its services, as grades.example.")
@_of_addresses
def register(  # noqa: PLR0917
    name: str,
    address: str,
    moodle: str | None,
    canvas: str | None,
    client_id: str,
    deployments: tuple[str, ...],
    hosts: tuple[str, ...],
    **addresses: str | None,
) -> None:
    """Register a platform under NAME, or change what is registered under it.

    Prints what the platform's own settings ask for.
    """
    from ..lti import platforms
    from ..lti.store import keep_platform

    with _database() as connection:
        given: dict[str, str] = {}
        if moodle is not None:
            given = platforms.moodle(moodle)
        elif canvas is not None:
            given, own = platforms.canvas(canvas)
            hosts = (*own, *hosts)
        given |= {field: text for field, text in addresses.items() if text}
        platform = platforms.platform_of(
            name, address, given, client_id=client_id, deployments=deployments, hosts=hosts
        )
        kept = keep_platform(connection, platform, time())
    _show(kept)


@lti.command()
@click.argument("name")
@click.argument("deployments", nargs=-1, required=True)
def deploy(name: str, deployments: tuple[str, ...]) -> None:
    """Let further DEPLOYMENTS of the platform NAME in."""
    from dataclasses import replace

    from ..lti.store import keep_platform, platform_named

    with _database() as connection:
        known = platform_named(connection, name)
        every = tuple(dict.fromkeys((*known.deployments, *deployments)))
        keep_platform(connection, replace(known, deployments=every), time())
    print(f"{name}: deployments {', '.join(every)}")


@lti.command()
def platforms() -> None:
    """List the platforms that are registered, and the grades that wait for them."""
    from ..lti.grades import queue
    from ..lti.store import all_platforms

    with _database() as connection:
        known, queued = all_platforms(connection), {row["name"]: row for row in queue(connection)}
    if not known:
        print("No platform is registered: heli2dof lti register --help")
    for platform in known:
        _show(platform)
        if (row := queued.get(platform.name)) is not None:
            waiting = row["grades"] - row["sent"]
            print(f"  grades: {row['sent']} sent, {waiting} waiting")
            if waiting and row["error"]:
                print(f"  last trouble: {row['error']}")


@lti.command()
@click.argument("name")
def remove(name: str) -> None:
    """Take the platform NAME out: its links and waiting grades are deleted, classes stay."""
    from ..lti.store import forget_platform

    with _database() as connection:
        forget_platform(connection, name)
    print(f"{name} is not registered any more")


@lti.command()
@click.option("--rotate", is_flag=True, help="Sign with a new key; the old one is shown for a week more.")
def keys(rotate: bool) -> None:
    """List the keys of this server whose public halves platforms see at /lti/keys."""
    from ..lti.store import rotate as rotated
    from ..lti.store import shown_keys

    with _database() as connection:
        if rotate:
            rotated(connection, time())
        names = [key["kid"] for key in shown_keys(connection, time())]
    for number, name in enumerate(names):
        print(f"{name}  {'shown, signs no more' if number else 'signs'}")


def _show(platform: Platform) -> None:
    """What is known of a platform, and what its own settings ask for."""
    print(f"{platform.name}: {platform.issuer}, client id {platform.client_id}")
    print(f"  deployments: {', '.join(platform.deployments)}")
    print(f"  hosts that are asked: {', '.join(platform.hosts)}")
    print("  in the platform's settings:")
    print(f"    tool, launch and redirection URL  {platform.redirect_uri}")
    print(f"    initiate login URL                {platform.address}/lti/login")
    print(f"    public keyset URL                 {platform.address}/lti/keys")
