"""What the calls on labs and classes share: who may ask, from where, how often, and what is refused."""

from __future__ import annotations

import hmac
from collections import OrderedDict
from collections.abc import AsyncIterator, Callable
from typing import Annotated, Any

from fastapi import APIRouter, Depends, Header, HTTPException, Path, Request, Response

from ..classes.errors import ClassError, too_fast, unknown_secret
from ..classes.keys import code_of
from ..contract.encoding import json_response
from ..contract.problems import MEDIA_TYPE, TITLES
from ..edge.bucket import Bucket
from ..edge.limits import SocketCounts, address_of
from ..edge.origins import is_own
from ..ops.settings import Settings

Code = Annotated[
    str, Path(min_length=1, max_length=40, description="the class's code, in capitals or small letters")
]
_MOST_KEYS = 20_000
_WRONG = "wrong codes or links from this address"


def refusals(options: dict[str, Any], *statuses: int) -> dict[str, Any]:
    """Route options that say with which statuses a call may be refused, besides those of all calls."""
    content = {MEDIA_TYPE: {"schema": {"$ref": "#/components/schemas/Problem"}}}
    known = {status: {"description": TITLES[status], "content": content} for status in statuses}
    return {**options, "responses": {**options["responses"], **known}}


_METHODS = ("GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE")


def no_others(router: APIRouter, path: str, *methods: str) -> None:
    """Refuses all other methods on a path, and names those that it takes: each route knows its own alone."""

    async def refuse() -> None:
        raise HTTPException(405, "Method Not Allowed", {"Allow": ", ".join(methods)})

    others = [method for method in _METHODS if method not in methods]
    router.add_api_route(path, refuse, methods=others, include_in_schema=False)


def nothing(summary: str) -> dict[str, Any]:
    """Route options of a call that answers 204."""
    return {"summary": summary, "status_code": 204, "responses": {204: {"description": summary}}}


def private(value: Any, headers: dict[str, str] | None = None) -> Response:
    """JSON that no cache keeps: names and points."""
    response = json_response(value)
    response.headers.update({"Cache-Control": "no-store", **(headers or {})})
    return response


def csv_response(content: bytes | str, name: str) -> Response:
    """A file of comma-separated values, which no cache keeps."""
    headers = {"Content-Disposition": f'attachment; filename="{name}"', "Cache-Control": "no-store"}
    return Response(content, media_type="text/csv; charset=utf-8", headers=headers)


def _secret(
    heli2dof_secret: Annotated[
        str | None, Header(max_length=200, description="the secret of the instructor or the student")
    ] = None,
) -> str:
    """The secret of the header; secrets stand in no address.

    Raises:
        ClassError: unknown_secret, where there is none.
    """
    if not heli2dof_secret:
        raise unknown_secret("instructor")
    return heli2dof_secret


Secret = Annotated[str, Depends(_secret)]


class OwnOrigin:
    """Refuses pages of other origins: browsers tell whose page asks, tools tell nothing."""

    def __init__(self, listed: tuple[str, ...]) -> None:
        self._listed = frozenset(listed)

    def __call__(self, request: Request) -> None:
        """Passes requests of own pages, of listed origins and of tools.

        Raises:
            ClassError: foreign_origin.
        """
        origin = request.headers.get("origin")
        if origin is None or "*" in self._listed or origin.lower() in self._listed:
            return
        if not is_own(origin, request.headers.get("host", ""), request.scope["scheme"]):
            detail = "Pages of this origin may not use classes here."
            hint = "The server's setting cors_origins lists those that may."
            raise ClassError(403, detail, "foreign_origin", hint=hint)


class Rates:
    """How often: far beyond what a class of two hundred behind one address does, and below what a flood is.

    The rates follow the settings' `request_rate`, 200 a second by default.
    """

    def __init__(self, settings: Settings) -> None:
        share = settings.request_rate / 200.0
        self._makes = _Buckets(0.5 * share, 100 * share)
        self._guesses = _Buckets(5.0 * share, 300 * share)
        self._joins = _Buckets(20.0 * share, 600 * share)
        self._attempts = _Buckets(1.0 * share, 40 * share)
        self._of_class = _Buckets(100.0 * share, 1500 * share)
        self._drafts = _Buckets(5.0 * share, 60 * share)
        self._right: OrderedDict[tuple[str, str], None] = OrderedDict()

    def make(self, request: Request) -> None:
        """A class is made: a hundred at once, then one in two seconds, per address."""
        self._makes.take(address_of(request.scope), "new classes from this address")

    def guess(self, request: Request) -> None:
        """A code or secret was wrong: three hundred at once, then five a second, per address."""
        self._guesses.take(address_of(request.scope), _WRONG)

    def try_code(self, request: Request, code: str) -> None:
        """A code comes without a secret: where too many were wrong, neither is it told whether this one is right.

        An address that was right with it before goes on: a class behind one address is not kept out of its own.
        """
        address = address_of(request.scope)
        if (address, code_of(code)) not in self._right:
            self._guesses.look(address, _WRONG)

    def was_right(self, request: Request, code: str) -> None:
        """A code that came without a secret was that of a class."""
        known = address_of(request.scope), code_of(code)
        self._right.pop(known, None)
        self._right[known] = None
        if len(self._right) > _MOST_KEYS:
            self._right.popitem(last=False)

    def join(self, code: str) -> None:
        """Somebody joins: six hundred at once, then twenty a second, per class."""
        self._joins.take(code_of(code), "students who join at once")

    def attempt(self, class_id: int, student_id: int) -> None:
        """An attempt: forty at once, then one a second, per student; and 1,500, then a hundred, per class."""
        self._attempts.take(student_id, "attempts")
        self._of_class.take(class_id, "attempts in this class")

    def draft(self, secret: str) -> None:
        """A draft: sixty at once, then five a second, per student."""
        self._drafts.take(hash(secret), "drafts")


class _Buckets:
    """A bucket for each key; the keys used longest ago are forgotten."""

    def __init__(self, rate: float, burst: float) -> None:
        self._new: Callable[[], Bucket] = lambda: Bucket(rate, max(burst, 1.0))
        self._by_key: OrderedDict[Any, Bucket] = OrderedDict()

    def take(self, key: Any, what: str) -> None:
        """Takes one.

        Raises:
            ClassError: too_many_requests.
        """
        bucket = self._by_key[key] = self._by_key.pop(key, None) or self._new()
        if len(self._by_key) > _MOST_KEYS:
            self._by_key.popitem(last=False)
        if wait := bucket.take():
            raise too_fast(wait, what)

    def look(self, key: Any, what: str) -> None:
        """Takes none.

        Raises:
            ClassError: too_many_requests, where there is none to be taken.
        """
        bucket = self._by_key.get(key)
        if bucket is not None and (wait := bucket.wait()):
            raise too_fast(wait, what)


class Streams:
    """The streams that are open: they count as sockets do, within the same bounds.

    Args:
        settings: of the server.
        counts: of its sockets.
    """

    def __init__(self, settings: Settings, counts: SocketCounts) -> None:
        self._settings, self._counts = settings, counts

    async def counted(self, request: Request, events: AsyncIterator[bytes]) -> AsyncIterator[bytes]:
        """The events, counted while somebody listens.

        Raises:
            ClassError: too_many_walls.
        """
        address, most = address_of(request.scope), self._settings
        if self._counts.total >= most.sockets or self._counts.by_address[address] >= most.sockets_per_address:
            detail = "This server, or this address, has too many sockets and streams open."
            raise ClassError(503, detail, "too_many_walls", hint="Close some.", retry_after=30)
        with self._counts.counted(address):
            async for event in events:
                yield event


class MayMake:
    """Refuses new classes where the server's operator has not allowed them."""

    def __init__(self, settings: Settings) -> None:
        self._kind = settings.classes
        key = settings.operator_key
        self._key = key.get_secret_value().encode() if key is not None else None

    def __call__(
        self,
        heli2dof_operator: Annotated[
            str | None, Header(max_length=200, description="the operator's key, where the server asks for it")
        ] = None,
    ) -> None:
        """Passes who may make a class.

        Raises:
            ClassError: classes_closed, operator_key_needed.
        """
        if self._kind == "open":
            return
        if self._kind == "off" or self._key is None:
            hint = "Its operator can allow it by HELI2DOF_CLASSES."
            if self._kind == "operator":
                hint = "Its operator sets HELI2DOF_OPERATOR_KEY, or allows all by HELI2DOF_CLASSES=open."
            raise ClassError(403, "No classes can be made on this server.", "classes_closed", hint=hint)
        if not hmac.compare_digest((heli2dof_operator or "").encode("utf-8", "replace"), self._key):
            hint = "Ask whoever runs the server for its key, and send it in the header Heli2dof-Operator."
            raise ClassError(
                401, "Making a class asks for the operator's key.", "operator_key_needed", hint=hint
            )


class Guesses:
    """Counts wrong codes and secrets of an address, around each call."""

    def __init__(self, rates: Rates) -> None:
        self._rates = rates

    async def __call__(self, request: Request) -> AsyncIterator[None]:
        """Lets the call be answered.

        Raises:
            ClassError: too_many_requests, in place of the refusal of one guess too many.
        """
        try:
            yield
        except ClassError as error:
            if error.code in ("unknown_class", "unknown_secret"):
                self._rates.guess(request)
            raise
