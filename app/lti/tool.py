"""What the routes call: a launch from its beginning to the place where somebody lands."""

from __future__ import annotations

import asyncio
import secrets
from collections.abc import Callable, Iterable, Mapping
from dataclasses import asdict, dataclass
from hmac import compare_digest
from time import time
from typing import Any

from sqlalchemy import Connection

from ..classes.database import Database, Writing
from ..classes.lab_library import KnownLab, Labs
from ..classes.people import NewClass
from ..classes.rows import for_instructor, told_time
from . import links, store
from .deep_linking import chosen
from .errors import LtiError
from .keys import KeySets
from .launch import Launch, launch_of
from .login import Login, authorization, read_login
from .outward import Answer, ask
from .platforms import Platform
from .services import Services
from .store import hash_of
from .tokens import verified

STATE_SECONDS = 600.0
"""For which a launch may be on its way: a person may have to log in at the platform."""
_TICKET_SECONDS = 3600.0
"""For which an instructor may look at the labs."""
_MOST_WAITING = 20_000
"""Launches of one platform that are kept at once; the oldest give way."""


@dataclass(frozen=True)
class Begun:
    """A launch that goes to the platform to ask who is there.

    Attributes:
        platform: that is asked.
        login: what it has said.
        state: names the launch.
        binding: known to this browser alone; it comes back with the launch.
        address: where the browser goes.
    """

    platform: Platform
    login: Login
    state: str
    binding: str
    address: str


@dataclass(frozen=True)
class Unbound:
    """A launch that cannot be told to be of this browser.

    Attributes:
        platform: that has sent it.
        login: with which it began.
        target: to which it was to lead.
    """

    platform: Platform
    login: Login
    target: str


@dataclass(frozen=True)
class Choice:
    """An instructor's choice that is open.

    Attributes:
        platform: that they come from.
        launch: with which they came.
        ticket: opens the choice.
        labs: there are.
    """

    platform: Platform
    launch: Launch
    ticket: str
    labs: list[KnownLab]


@dataclass(frozen=True)
class Landing:
    """Where somebody lands."""

    platform: Platform
    address: str


@dataclass(frozen=True)
class Reply:
    """A choice that goes to the platform: a signed token, and where it is posted to."""

    platform: Platform
    address: str
    token: str


class Tool:
    """This server as platforms see it.

    Args:
        database: of classes and platforms.
        labs: that may be chosen.
        days: for which a class is kept.
        most_classes: that are kept.
        most_students: of a class.
        send: how platforms are asked; blocks.
        clock: seconds since 1970.
    """

    def __init__(
        self,
        database: Database,
        labs: Labs,
        *,
        days: int,
        most_classes: int,
        most_students: int,
        send: Callable[..., Answer] = ask,
        clock: Callable[[], float] = time,
    ) -> None:
        self._database, self._labs, self._clock = database, labs, clock
        self._days, self._most_classes, self._most_students = days, most_classes, most_students
        self._keys = KeySets(send)
        self._key: Mapping[str, Any] = {}
        self.services = Services(lambda: self._key, send, clock)

    def now(self) -> float:
        """Seconds since 1970."""
        return self._clock()

    async def platforms(self) -> list[Platform]:
        """Those that are registered.

        Raises:
            ClassError: there is no database.
        """
        return await self._database.read(store.all_platforms)

    async def public_keys(self) -> list[dict[str, Any]]:
        """The private keys whose public halves are shown; empty where nothing is registered."""
        now = self._clock()

        def shown(connection: Connection) -> list[dict[str, Any]]:
            return store.shown_keys(connection, now) if store.all_platforms(connection) else []

        return await self._database.read(shown)

    async def load_key(self) -> Mapping[str, Any]:
        """The key that signs now, for the services as well; another replica may have changed it."""
        now = self._clock()
        self._key = await self._database.write(lambda writing: store.signing_key(writing.connection, now))
        return self._key

    async def begin(self, given: Mapping[str, str]) -> Begun:
        """Begins a launch.

        Args:
            given: what the platform says.

        Raises:
            LtiError: the platform is not known, or what it says is not enough.
        """
        now, nonce, binding = self._clock(), secrets.token_urlsafe(32), secrets.token_urlsafe(32)
        platform, login = read_login(given, await self.platforms())
        told = {
            "nonce": hash_of(nonce),
            "binding": hash_of(binding),
            "login": asdict(login),
            "target": given["target_link_uri"],
        }

        def keep(writing: Writing) -> str:
            store.sweep(writing.connection, now)
            store.make_room(writing.connection, platform, _MOST_WAITING)
            return store.put_nonce(writing.connection, "state", platform, told, now + STATE_SECONDS)

        state = await self._database.write(keep)
        return Begun(platform, login, state, binding, authorization(platform, login, state, nonce))

    async def land(self, token: str, state: str, proofs: Iterable[str]) -> Landing | Choice | Unbound:
        """Ends a launch.

        Args:
            token: that the platform has sent.
            state: that it has sent back.
            proofs: words, one of which may be the launch's binding.

        Raises:
            LtiError: the launch is not to be believed, or leads nowhere.
            ClassError: the class is closed or full, or there is no database.
        """
        now = self._clock()
        platform, told = await self._database.read(lambda c: store.find_nonce(c, "state", state, now))
        claims = await asyncio.to_thread(verified, token, platform, self._keys, now)
        nonce = claims.get("nonce")
        if not isinstance(nonce, str) or not compare_digest(hash_of(nonce), told["nonce"]):
            again = "Launch once more from the platform."
            raise LtiError("wrong_nonce", "The platform's token belongs to another launch.", again, 403)
        launch = launch_of(claims, platform)
        if not any(compare_digest(hash_of(proof), told["binding"]) for proof in proofs):
            return Unbound(platform, Login(**told["login"]), told["target"])
        await self._database.write(lambda writing: store.use_nonce(writing.connection, state))
        if launch.kind == "choice":
            return await self._offer(platform, launch)
        return await self._to_link(platform, launch)

    async def _to_link(self, platform: Platform, launch: Launch) -> Landing | Choice:
        now = self._clock()
        there = await self._database.read(lambda c: links.class_of(c, platform, launch, now) is not None)
        known = {lab.lab.name: lab for lab in await asyncio.to_thread(self._labs.all)} if not there else {}
        lab = known.get(launch.lab)
        if there or lab is not None:
            return await self._enter(platform, launch, lab)
        if launch.instructor:
            return await self._offer(platform, launch)
        raise LtiError(
            "not_opened",
            "Your instructor has not chosen a lab here yet.",
            "Open this link again when they have: they do so by opening it once themselves.",
            409,
        )

    async def _enter(self, platform: Platform, launch: Launch, lab: KnownLab | None) -> Landing:
        now = self._clock()
        new = None
        if lab is not None:
            title = launch.title or str(lab.view["title"])
            new = NewClass.of(lab, title, None, self._days, self._most_classes)

        arrival = links.Arrival(platform, launch, self._most_students, now)

        def work(writing: Writing) -> links.Place:
            if new is not None:
                of = links.tie(writing, arrival, new)
            elif (of := links.class_of(writing.connection, platform, launch, now)) is None:
                again = "Open the link once more from the platform."
                raise LtiError("class_gone", "The class of this link has just been deleted.", again, 409)
            return links.enter(writing, arrival, of)

        place = await self._database.write(work)
        return Landing(platform, place.address(platform))

    async def _offer(self, platform: Platform, launch: Launch) -> Choice:
        if launch.kind == "choice" and not launch.takes_links:
            raise LtiError(
                "no_links", "The platform does not take links here.", "Add an external tool instead."
            )
        told, ends = launch.as_json(), self._clock() + _TICKET_SECONDS
        ticket = await self._database.write(
            lambda writing: store.put_nonce(writing.connection, "ticket", platform, told, ends)
        )
        return Choice(platform, launch, ticket, await asyncio.to_thread(self._labs.all))

    async def choose(self, ticket: str, name: str) -> Landing | Reply:
        """Ends an instructor's choice of a lab.

        Raises:
            LtiError: the ticket is not known, or used already.
            ClassError: there is no such lab, or no class can be made of it.
        """
        now = self._clock()
        platform, told = await self._database.read(lambda c: store.find_nonce(c, "ticket", ticket, now))
        launch = Launch.from_json(told)
        lab = await asyncio.to_thread(self._labs.named, name)
        await self._database.write(lambda writing: store.use_nonce(writing.connection, ticket))
        if launch.kind == "link":
            return await self._enter(platform, launch, lab)
        view = lab.view
        said = {"title": view["title"], "text": view.get("summary", ""), "points": float(lab.lab.points)}
        key = await self.load_key()
        token = await asyncio.to_thread(chosen, platform, launch, key, now, lab=name, **said)
        return Reply(platform, launch.return_url, token)

    async def members(self, code: str, secret: str) -> dict[str, Any]:
        """Who is in the course of a class, as the platform tells it now; nothing of it is kept.

        Raises:
            ClassError: the code or the instructor's secret is wrong.
            LtiError: the class came by no platform, or the platform does not tell.
        """

        def look(connection: Connection) -> tuple[Platform, str, dict[str, int]]:
            of = for_instructor(connection, code, secret)
            found = links.roster_of(connection, of.id)
            if found is None or not found[1]:
                raise LtiError(
                    "no_roster",
                    "No platform tells who is in the course of this class.",
                    "Allow the tool names and roles there, and open its link once more.",
                    404,
                )
            platforms = {platform.id: platform for platform in store.all_platforms(connection)}
            return platforms[found[0]], found[1], found[2]

        platform, address, joined = await self._database.read(look)
        await self.load_key()
        people = await asyncio.to_thread(self.services.members, platform, address)
        told = [
            {
                "name": person.name,
                "instructor": person.instructor,
                **({"student": joined[person.subject]} if person.subject in joined else {}),
            }
            for person in people
        ]
        return {"members": told, "at": told_time(self._clock())}
