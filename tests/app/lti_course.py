"""A course at a platform on this machine, whose people open labs of a server in this process."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from time import time
from typing import Any
from urllib.parse import parse_qsl, urlsplit
from uuid import uuid4

from starlette.testclient import TestClient

from app.classes.engines import open_engines
from app.edge.access import COOKIE
from app.lti.platforms import Platform as Registered
from app.lti.platforms import platform_of
from app.lti.store import keep_platform
from app.main import create_app
from app.ops.settings import Settings
from tests.app.a_lab import A_LAB
from tests.lti_platform import CLIENT, DEPLOYMENT, Platform

TOOL = "http://127.0.0.1:8999/lab"
"""This server's address as the platform has it; the prefix is a proxy's."""
LANDED = re.compile(rf"{TOOL}/(class)?#class=([A-Z]{{7}})&(?:me|key)=([\w-]{{32}})")


class Browser:
    """One person's browser: it keeps cookies, and follows no redirect by itself."""

    def __init__(self, client: TestClient) -> None:
        self._client, self.cookies = client, dict[str, str]()

    def ask(self, method: str, path: str, **given: Any) -> Any:
        self._client.cookies.clear()
        headers = {"Accept": "text/html", **given.pop("headers", {})}
        if self.cookies:
            headers["Cookie"] = "; ".join(f"{name}={value}" for name, value in self.cookies.items())
        reply = self._client.request(method, path, headers=headers, follow_redirects=False, **given)
        for line in reply.headers.get_list("set-cookie"):
            name, _, rest = line.partition("=")
            self.cookies[name] = rest.partition(";")[0].strip('"')
            assert "HttpOnly" in line
            if name != COOKIE:
                assert all(
                    word in line for word in ("Path=/lab/lti;", "Secure", "SameSite=none", "Partitioned")
                )
        return reply


class Course:
    """The platform, this server with the platform registered, and what people do there."""

    def __init__(self, platform: Platform, client: TestClient, settings: Settings) -> None:
        self.platform, self.client, self.settings = platform, client, settings

    def browser(self) -> Browser:
        return Browser(self.client)

    def begin(self, browser: Browser, subject: str, hint: str, **more: str) -> Any:
        """Somebody presses a link; what this server answers at first."""
        parts = urlsplit(self.platform.login_address(subject, hint))
        return browser.ask("GET", "/lti/login", params={**dict(parse_qsl(parts.query)), **more})

    def launch(self, browser: Browser, subject: str, hint: str, **claims: Any) -> dict[str, str]:
        """The form that the platform has the browser post, after it was asked."""
        reply = self.begin(browser, subject, hint)
        assert reply.status_code == 302, reply.text
        data = self.platform.launch(reply.headers["location"], **claims)
        assert data["launch_url"] == f"{TOOL}/lti/launch"
        return {"id_token": data["id_token"], "state": data["state"]}

    def open(self, browser: Browser, subject: str, hint: str, **claims: Any) -> Any:
        """Somebody opens a link; this server's last answer."""
        return browser.ask("POST", "/lti/launch", data=self.launch(browser, subject, hint, **claims))

    def land(self, subject: str, hint: str, **claims: Any) -> tuple[str, str]:
        """Code of the class and own secret of somebody who opens a link."""
        reply = self.open(self.browser(), subject, hint, **claims)
        assert reply.status_code == 303, reply.text
        return landed(reply, instructor=self.platform.people[subject].role == "Instructor")

    def hand_in(self, code: str, secret: str, poles: list[float], **answers: Any) -> dict[str, Any]:
        """A student hands in the first step."""
        body = {"student": secret, "id": str(uuid4()), "step": "settle", "design": {"poles": poles}}
        reply = self.client.post(f"/api/v1/classes/{code}/attempts", json={**body, "answers": answers})
        assert reply.status_code == 200, reply.text
        return reply.json()

    def ask(self, method: str, path: str, secret: str, **given: Any) -> Any:
        """A call with a secret."""
        return self.client.request(
            method, f"/api/v1/classes/{path}", headers={"Heli2dof-Secret": secret}, **given
        )


def landed(reply: Any, *, instructor: bool) -> tuple[str, str]:
    """Class and secret of the address to which somebody is sent."""
    found = LANDED.fullmatch(reply.headers["location"])
    assert found, reply.headers["location"]
    assert bool(found.group(1)) is instructor
    return found.group(2), found.group(3)


def settings_in(folder: Path, **more: Any) -> Settings:
    """Of a server with one lab of its own, and a database in the folder."""
    (folder / "labs").mkdir(exist_ok=True)
    (folder / "labs" / "small.yaml").write_text(A_LAB, encoding="utf-8")
    given: dict[str, Any] = {"database": f"sqlite:///{folder}/classes.db", "labs": folder / "labs", **more}
    return Settings(**given)


def register(settings: Settings, platform: Platform, **changes: Any) -> Registered:
    """Registers the platform in the server's database."""
    addresses = {"issuer": "", "auth_url": "/auth", "token_url": "/token", "keyset_url": "/keys"}
    given = {name: platform.address + path for name, path in addresses.items()}
    known = platform_of("uni", TOOL, given, client_id=CLIENT, deployments=(DEPLOYMENT,))
    engines = open_engines(settings.database_address)
    with engines.writing.begin() as connection:
        kept = keep_platform(connection, replace(known, **changes), time())
    engines.dispose()
    return kept


@contextmanager
def course_in(folder: Path, **more: Any) -> Iterator[Course]:
    """A platform and a server that know each other; `more` are settings of the server."""
    platform, settings = Platform(TOOL), settings_in(folder, **more)
    with platform.running(), TestClient(create_app(settings)) as client:
        register(settings, platform)
        platform.tool_keys.update(client.get("/lti/keys").json())
        yield Course(platform, client, settings)
