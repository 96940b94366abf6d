"""What one client may take of the server: sizes, rates, sockets. Around the whole app, as plain ASGI."""

from __future__ import annotations

import asyncio
import asyncio.selector_events
import contextlib
import itertools
from collections import Counter, OrderedDict
from collections.abc import Callable, Iterator
from functools import partial
from ipaddress import IPv6Address, ip_address
from time import monotonic
from typing import Any

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from heli2dof_core.recordings.files import MOST_BYTES

from ..contract.problems import problem, problem_response
from ..jobs.compute import Caller, current_caller
from ..ops.settings import Settings
from .bucket import Bucket

_POLICY, _TRY_LATER = 1008, 1013
_READ_BYTES = 16 * 1024
_UPLOAD_PATH = "/api/v1/recordings"
"""The one call that takes a file."""
_FLIGHTS_PATH, _FLIGHT_BYTES = "/api/v1/flights", 4 * 2**20
"""Calls that take a flight's log, and the largest one, bytes: two events in each frame of ten minutes."""
_KEPT_PATH, _KEPT_BYTES = "/api/v1/classes", 64 * 1024
"""Calls whose bodies are kept, and the largest of these, bytes: a design has two thousand, an answer four."""
_ATTEMPTS = "/attempts"
"""Of an attempt the flight is not kept, and its log may be long; what is kept, `contract.labs` holds small."""
_RATE_LIMITED_PATHS = ("/api/", "/scene/", "/lti/")
"""Where requests are counted: the page's own files cost nothing, and a class loads thousands of them at once."""
_MOST_ADDRESSES = 10_000
_connections = itertools.count(1)
"""Numbers of requests and sockets; not the ports of their clients, of which a proxy tells nothing."""


def address_of(scope: Scope) -> str:
    """Who counts as one client: an IPv4 address, or the /64 that an IPv6 host may choose its own from."""
    host = (scope.get("client") or ("", 0))[0]
    with contextlib.suppress(ValueError):
        address = ip_address(host)
        if isinstance(address, IPv6Address):
            return str(address.ipv4_mapped or IPv6Address(int(address) >> 64 << 64))
    return host


def read_in_small_parts() -> None:
    """Lets asyncio read 16 KiB of a connection at a time instead of 256.

    A flood of tiny frames is parsed frame by frame: 256 KiB of them would hold up everybody else for half a second.
    """
    transport = getattr(asyncio.selector_events, "_SelectorSocketTransport", None)
    if transport is not None and hasattr(transport, "max_size"):
        transport.max_size = _READ_BYTES


class Buckets:
    """A bucket for each address."""

    def __init__(self, rate: float, burst: float, clock: Callable[[], float] = monotonic) -> None:
        self._new = partial(Bucket, rate, burst, clock)
        self._by_address: OrderedDict[str, Bucket] = OrderedDict()

    def take(self, address: str) -> float:
        """Takes one of the address'; returns 0, or after how many seconds there is one again."""
        bucket = self._by_address[address] = self._by_address.pop(address, None) or self._new()
        if len(self._by_address) > _MOST_ADDRESSES:
            self._by_address.popitem(last=False)
        return bucket.take()


class SocketCounts:
    """How many WebSockets are open, by address."""

    def __init__(self) -> None:
        self.by_address: Counter[str] = Counter()

    @property
    def total(self) -> int:
        """All of them."""
        return self.by_address.total()

    @contextlib.contextmanager
    def counted(self, address: str) -> Iterator[None]:
        """Counts one while the context lasts."""
        self.by_address[address] += 1
        try:
            yield
        finally:
            self.by_address[address] -= 1
            if not self.by_address[address]:
                del self.by_address[address]


class Limits:
    """Refuses what goes beyond the settings, each with its clear answer; tells the core's threads who asks."""

    def __init__(
        self, app: ASGIApp, settings: Settings, counts: SocketCounts, clock: Callable[[], float] = monotonic
    ) -> None:
        self._app, self._settings, self._counts = app, settings, counts
        self._buckets = Buckets(settings.request_rate, settings.request_burst, clock)

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Passes on what is within the limits."""
        if scope["type"] == "http":
            await self._http(scope, receive, send)
        elif scope["type"] == "websocket":
            await self._websocket(scope, receive, send)
        else:
            await self._app(scope, receive, send)

    async def _http(self, scope: Scope, receive: Receive, send: Send) -> None:
        address = address_of(scope)
        path = scope["path"].removeprefix(scope.get("root_path", ""))
        wait = self._buckets.take(address) if path.startswith(_RATE_LIMITED_PATHS) else 0.0
        if wait:
            answer = problem_response(
                problem(
                    429,
                    "Too many requests from this address.",
                    "too_many_requests",
                    hint=f"At most {self._settings.request_rate:g} a second are answered; drag over the live socket.",
                ),
                {"Retry-After": str(int(wait) + 1)},
            )
            return await answer(scope, receive, send)
        most = self._most(path)
        body = _Body(receive, most, self._settings.body_seconds)
        if body.content_length(scope) > most:
            return await body.refusal(413)(scope, receive, send)
        token = current_caller.set(Caller((address, next(_connections)), body.disconnected))
        try:
            await self._app(scope, body.receive, send)
        except _RefusedError as refused:
            await body.refusal(refused.status)(scope, receive, send)
        finally:
            current_caller.reset(token)
        return None

    def _most(self, path: str) -> int:
        """Bytes of the largest body that a path takes."""
        if path == _UPLOAD_PATH:
            return MOST_BYTES
        if path.startswith(_FLIGHTS_PATH):
            return max(_FLIGHT_BYTES, self._settings.body_bytes)
        kept = path.startswith(_KEPT_PATH) and not path.endswith(_ATTEMPTS)
        return _KEPT_BYTES if kept else self._settings.body_bytes

    async def _websocket(self, scope: Scope, receive: Receive, send: Send) -> None:
        address, settings = address_of(scope), self._settings
        if self._counts.total >= settings.sockets:
            return await _refuse_socket(receive, send, f"the server has {settings.sockets} sockets open")
        if self._counts.by_address[address] >= settings.sockets_per_address:
            return await _refuse_socket(
                receive, send, f"this address has {settings.sockets_per_address} sockets open"
            )
        token = current_caller.set(Caller((address, next(_connections))))
        try:
            with self._counts.counted(address):
                await self._app(scope, self._rate_limited(receive, send), send)
        finally:
            current_caller.reset(token)
        return None

    def _rate_limited(self, receive: Receive, send: Send) -> Receive:
        """`receive`, until the client sends more messages than any hand or page would; then the socket is closed."""
        bucket = Bucket(self._settings.message_rate, 2 * self._settings.message_rate)
        over = False

        async def receive_limited() -> Message:
            nonlocal over
            message = await receive()
            if message["type"] != "websocket.receive" or not (over or bucket.take()):
                return message
            if not over:
                over = True
                reason = f"more than {self._settings.message_rate:g} messages a second"
                with contextlib.suppress(Exception):  # it may be closed already
                    await send({"type": "websocket.close", "code": _POLICY, "reason": reason})
            return {"type": "websocket.disconnect", "code": _POLICY}

        return receive_limited


class _RefusedError(BaseException):
    """A body is too long or too slow; no handler of the app below is to mistake it for its own."""

    def __init__(self, status: int) -> None:
        super().__init__(status)
        self.status = status


class _Body:
    """A request's body, counted while it comes."""

    def __init__(self, receive: Receive, most: int, seconds: float) -> None:
        self._receive, self._most, self._seconds = receive, most, seconds
        self._size, self._whole = 0, False
        self._deadline = monotonic() + seconds

    @staticmethod
    def content_length(scope: Scope) -> int:
        """Content-Length, 0 where there is none."""
        value = dict(scope["headers"]).get(b"content-length", b"")
        return int(value) if value.isdigit() else 0

    async def receive(self) -> Message:
        """The next part.

        Raises:
            _RefusedError: it is one too many, or too late.
        """
        if self._whole:
            return await self._receive()
        try:
            message = await asyncio.wait_for(self._receive(), max(0.0, self._deadline - monotonic()))
        except TimeoutError:
            raise _RefusedError(408) from None
        self._size += len(message.get("body", b""))
        self._whole = not message.get("more_body", False)
        if self._size > self._most:
            raise _RefusedError(413)
        return message

    async def disconnected(self) -> None:
        """Returns once the client has left; the body must have been read."""
        while (await self._receive())["type"] != "http.disconnect":
            pass

    def refusal(self, status: int) -> Any:
        """The answer to a body that was refused; the connection ends with it."""
        if status == 408:
            detail, code = f"The body did not come within {self._seconds:g} s.", "body_too_slow"
        else:
            detail, code = f"The body is larger than {self._most} bytes.", "body_too_large"
        return problem_response(problem(status, detail, code), {"Connection": "close"})


async def _refuse_socket(receive: Receive, send: Send, reason: str) -> None:
    """Accepts and closes at once: a browser learns code and reason only of a socket that was accepted."""
    await receive()
    await send({"type": "websocket.accept"})
    await send({"type": "websocket.close", "code": _TRY_LATER, "reason": f"{reason}: try again in a minute"})
