"""Which addresses this server asks, and sends browsers to: those of registered platforms, over TLS."""

from __future__ import annotations

from collections.abc import Iterable
from urllib.parse import SplitResult, urlsplit, urlunsplit

from .errors import LtiError

MOST_CHARACTERS = 2000
_LOOPBACK = frozenset(("localhost", "127.0.0.1", "::1"))
_PORTS = {"http": 80, "https": 443}


def checked(address: str, what: str) -> SplitResult:
    """The parts of an address that may be used at all.

    It is https; plain http is for this machine alone, where platforms are tried.

    Args:
        address: to be looked at.
        what: its name in the refusal.

    Raises:
        LtiError: it may not be used.
    """
    try:
        parts = urlsplit(address)
        port = parts.port  # told here where it is none
    except ValueError:
        parts, port = SplitResult("", "", "", "", ""), None
    plain = address.isascii() and address.isprintable() and not set(address) & set(' "<>\\^`{|}')
    encrypted = parts.scheme == "https" or (parts.scheme == "http" and parts.hostname in _LOOPBACK)
    if (
        not plain
        or not encrypted
        or not parts.hostname
        or port == 0
        or "@" in parts.netloc
        or parts.fragment
        or len(address) > MOST_CHARACTERS
    ):
        raise LtiError(
            "bad_address",
            f"{what} is no address that this server uses: {address[:200]!r}.",
            "It has to begin with https:// and a host's name.",
        )
    return parts


def host_of(address: str, what: str = "This") -> str:
    """The host of an address, with its port where that is not the usual one.

    Raises:
        LtiError: it is no address that may be used.
    """
    parts = checked(address, what)
    host = f"[{parts.hostname}]" if ":" in (parts.hostname or "") else parts.hostname or ""
    return host if parts.port in (None, _PORTS[parts.scheme]) else f"{host}:{parts.port}"


def origin_of(address: str, what: str = "This") -> str:
    """Scheme and host of an address, as browsers tell them.

    Raises:
        LtiError: it is no address that may be used.
    """
    return f"{checked(address, what).scheme}://{host_of(address, what)}"


def require_host(address: str, hosts: Iterable[str], what: str) -> str:
    """The address, if it is one of the hosts'.

    Args:
        address: that a platform has sent.
        hosts: names, with a port where it is not the usual one.
        what: its name in the refusal.

    Raises:
        LtiError: it is elsewhere.
    """
    host = host_of(address, what)
    if host not in hosts:
        raise LtiError(
            "foreign_address",
            f"{what} is at {host[:200]}, which is no host of this platform.",
            f"If it should be, register it: heli2dof lti register … --host {host[:200]}",
            403,
        )
    return address


def beneath(address: str, name: str) -> str:
    """The address of something beneath another, whose query stays behind it.

    Moodle's line items have one: of `…/lineitem?type_id=1` the scores are at `…/lineitem/scores?type_id=1`.
    """
    parts = urlsplit(address)
    return urlunsplit(parts._replace(path=f"{parts.path.rstrip('/')}/{name}"))


def with_query(address: str, query: str) -> str:
    """The address with a query added to its own."""
    parts = urlsplit(address)
    return urlunsplit(parts._replace(query=f"{parts.query}&{query}" if parts.query else query))
