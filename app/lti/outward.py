"""How this server asks a platform: registered hosts alone, no redirects, nothing large, nothing slow."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from http.client import HTTPException
from time import monotonic
from typing import Any
from urllib.error import HTTPError, URLError
from urllib.request import HTTPRedirectHandler, Request, build_opener

from .addresses import host_of, require_host
from .errors import PlatformError

MOST_BYTES = 2**20
_SECONDS = 10.0
"""For which nothing may come, and for how long the whole may take at most."""
_PART = 65536


@dataclass(frozen=True)
class Answer:
    """What a platform has answered: status, headers with names in lower case, body."""

    status: int
    headers: Mapping[str, str]
    body: bytes

    def json(self) -> Any:
        """The body as JSON.

        Raises:
            PlatformError: it is none.
        """
        try:
            return json.loads(self.body)
        except (ValueError, RecursionError):
            raise PlatformError(
                "The platform has answered with something that is no JSON.", self.status
            ) from None


class _NoRedirect(HTTPRedirectHandler):
    """A redirect is an answer like others: where it leads was not registered."""

    def redirect_request(  # noqa: PLR0917
        self, req: Request, fp: Any, code: int, msg: str, headers: Any, newurl: str
    ) -> None:
        """Leads nowhere."""


def ask(
    method: str,
    address: str,
    hosts: tuple[str, ...],
    *,
    headers: Mapping[str, str] | None = None,
    body: bytes | None = None,
    seconds: float = _SECONDS,
) -> Answer:
    """Asks one of the hosts; blocks, so it belongs into a thread.

    Args:
        method: GET or POST.
        address: what is asked.
        hosts: that may be asked.
        headers: to be sent.
        body: to be sent.
        seconds: for which nothing may come, and which the whole may take.

    Returns:
        The answer, whatever its status.

    Raises:
        LtiError: the address is not one of the hosts', or not encrypted.
        PlatformError: no answer came, or none that is small and quick enough.
    """
    require_host(address, hosts, "What the platform names")
    request = Request(address, body, {"User-Agent": "heli2dof", **(headers or {})}, method=method)
    until = monotonic() + seconds
    try:
        with contextlib.closing(_answered(request, seconds)) as response:
            status = response.status or 0
            told = {name.lower(): value for name, value in response.headers.items()}
            return Answer(status, told, _read(response, until))
    except (URLError, HTTPException, OSError) as error:
        why = getattr(error, "reason", None) or error
        raise PlatformError(
            f"{host_of(address)} does not answer: {str(why)[:200] or type(why).__name__}."
        ) from None


def _answered(request: Request, seconds: float) -> Any:
    """The response, or the error that urllib makes of a status of 300 and more; they read alike."""
    try:
        return build_opener(_NoRedirect).open(request, timeout=seconds)
    except HTTPError as error:
        return error


def _read(response: Any, until: float) -> bytes:
    body = bytearray()
    while part := response.read1(_PART):  # what is there: `read` would wait for all of it
        body += part
        if len(body) > MOST_BYTES:
            raise PlatformError("The platform's answer is too large.")
        if monotonic() > until:
            raise PlatformError("The platform's answer is too slow.")
    return bytes(body)
