"""A learning platform on this machine, made with the package lti1p3platform, for tests of `app.lti`.

What the package knows (tokens, launch messages, checks of what a tool sends) is its own; what a platform adds is
here: people, columns of grades, and HTTP.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from datetime import datetime
from html import escape
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from time import time
from typing import Any
from urllib.parse import parse_qsl, urlsplit

from cryptography.hazmat.primitives.asymmetric import rsa
from cryptography.hazmat.primitives.serialization import (
    Encoding,
    NoEncryption,
    PrivateFormat,
    PublicFormat,
)
from lti1p3platform.exceptions import LineItemNotFoundException
from lti1p3platform.ltiplatform import LTI1P3PlatformConfAbstract
from lti1p3platform.membership import Context
from lti1p3platform.message_launch import LTIAdvantageMessageLaunchAbstract
from lti1p3platform.oidc_login import OIDCLoginAbstract
from lti1p3platform.registration import Registration
from lti1p3platform.request import Request
from lti1p3platform.score import UpdateScoreStatus
from lti1p3platform.service_connector import AssignmentsGradesService, NamesRoleProvisioningService

_SEND = "document.forms[0].submit()"
_KEEP = """
const kept = new Map();
window.asked = [];
addEventListener('message', ({data, origin, source}) => {
  window.asked.push(data.subject);
  if (data.subject === 'lti.put_data') kept.set(origin + data.key, data.value);
  else if (data.subject !== 'lti.get_data') return;
  const {subject, key, message_id} = data;
  source.postMessage({subject: `${subject}.response`, message_id, key, value: kept.get(origin + key)}, origin);
});
"""
"""What a platform's page does that keeps values for tools (LTI postMessage Storage)."""
ROLE = "http://purl.imsglobal.org/vocab/lis/v2/membership#"
CLIENT, DEPLOYMENT, COURSE = "heli-client", "7", "course-1"


def key_pair() -> tuple[str, str]:
    """Private and public key, in PEM."""
    key = rsa.generate_private_key(65537, 2048)
    private = key.private_bytes(Encoding.PEM, PrivateFormat.PKCS8, NoEncryption())
    public = key.public_key().public_bytes(Encoding.PEM, PublicFormat.SubjectPublicKeyInfo)
    return private.decode(), public.decode()


@dataclass
class Person:
    """Somebody at the platform."""

    subject: str
    name: str
    role: str

    @property
    def roles(self) -> list[str]:
        return [ROLE + self.role]


@dataclass
class Link:
    """A link to the tool in a course."""

    id: str
    title: str = "Poles of a helicopter"
    custom: dict[str, str] = field(default_factory=dict)
    column: bool = True


class _Configuration(LTI1P3PlatformConfAbstract):
    def init_platform_config(self, **kwargs: Any) -> None:
        self._registration = kwargs["registration"]

    def get_registration_by_params(self, **kwargs: Any) -> Registration:
        assert self._registration is not None
        return self._registration


class _Login(OIDCLoginAbstract):
    def set_lti_message_hint(self, **kwargs: Any) -> None:
        self._lti_message_hint = kwargs["hint"]

    def get_redirect(self, url: str) -> str:
        return url


class _Request(Request):
    def build_metadata(self, request: Any) -> Any:
        return request


class _Launch(LTIAdvantageMessageLaunchAbstract):
    def render_launch_form(self, launch_data: dict[str, Any], **_kwargs: Any) -> dict[str, Any]:
        return launch_data


class _Members(NamesRoleProvisioningService):
    platform: Platform

    def get_member_data_page(
        self, page: Any = 1, limit: Any = None, role: Any = None, since: Any = None
    ) -> Any:
        people = [
            {"user_id": person.subject, "name": person.name, "roles": person.roles}
            for person in self.platform.people.values()
        ]
        size, first = self.platform.page_size, (int(page) - 1) * self.platform.page_size
        return {"content": people[first : first + size], "has_next": first + size < len(people)}

    def get_context_by_id(self) -> Context:
        return Context(COURSE, "C1", "Control")


class _Grades(AssignmentsGradesService):
    platform: Platform

    def find_lineitems(self, **asked: Any) -> Any:
        wanted = asked.get("resource_link_id")
        items = [item for item in self.platform.columns.values() if item["resourceLinkId"] == wanted]
        return {"content": items, "has_next": False}

    def find_lineitem(self, line_item_id: str) -> Any:
        if line_item_id not in self.platform.columns:
            raise LineItemNotFoundException
        return self.platform.columns[line_item_id]

    def create_lineitem(self, creation_data: Any) -> Any:
        return self.platform.add_column(creation_data["resourceLinkId"], creation_data["label"])

    def update_lineitem(self, update_data: Any) -> Any:
        raise NotImplementedError

    def delete_lineitem(self, line_item_id: str) -> None:
        raise NotImplementedError

    def update_score(self, line_item_id: str, score: Any) -> UpdateScoreStatus:
        self.find_lineitem(line_item_id)
        known = (old["taken"] for old in self.platform.scores if old["userId"] == score["userId"])
        if any(taken >= int(datetime.fromisoformat(score["timestamp"]).timestamp()) for taken in known):
            return UpdateScoreStatus.OLD_TIMESTAMP
        taken = int(time()) + self.platform.ahead
        self.platform.scores.append({**score, "column": line_item_id, "taken": taken})
        return UpdateScoreStatus.SUCCESS

    def get_results(self, line_item_id: str, **_asked: Any) -> Any:
        raise NotImplementedError


class Platform:
    """The platform and its HTTP server.

    Attributes:
        scores: that tools have sent, in their order.
        columns: of grades, by their number.
        away: whether it answers nothing but 503.
        ahead: seconds by which its clock goes before that of the tests.
        held: whether launches wait for a button, instead of being posted at once.
        asked: paths that were asked for.
    """

    def __init__(self, tool: str, host: str = "127.0.0.1") -> None:
        self.private, self.public = key_pair()
        self.people = {
            person.subject: person
            for person in (
                Person("t1", "Theresa Teacher", "Instructor"),
                Person("s1", "Ada Student", "Learner"),
                Person("s2", "Bo Student", "Learner"),
            )
        }
        self.tool = tool
        self.tool_keys: dict[str, Any] = {"keys": []}
        self.scores: list[dict[str, Any]] = []
        self.columns: dict[str, dict[str, Any]] = {}
        self.links: dict[str, Link] = {}
        self.page_size = 2
        self.away = self.held = False
        self.ahead = 0
        self.asked: list[str] = []
        self.changed = threading.Condition()
        self.server = ThreadingHTTPServer(("127.0.0.1", 0), self._handler())
        self.address = f"http://{host}:{self.server.server_port}"

    @contextmanager
    def running(self) -> Iterator[Platform]:
        """Serves while the context lasts."""
        thread = threading.Thread(target=self.server.serve_forever, kwargs={"poll_interval": 0.02})
        thread.start()
        try:
            yield self
        finally:
            self.server.shutdown()
            thread.join()
            self.server.server_close()

    def configuration(self) -> _Configuration:
        registration = (
            Registration()
            .set_iss(self.address)
            .set_client_id(CLIENT)
            .set_deployment_id(DEPLOYMENT)
            .set_launch_url(f"{self.tool}/lti/launch")
            .set_deeplink_launch_url(f"{self.tool}/lti/launch")
            .set_oidc_login_url(f"{self.tool}/lti/login")
            .set_tool_key_set(self.tool_keys)  # type: ignore[arg-type]
            .set_platform_public_key(self.public)
            .set_platform_private_key(self.private)
        )
        return _Configuration(registration=registration)

    def add_column(self, link: str, label: str) -> dict[str, Any]:
        number = str(len(self.columns) + 1)
        address = f"{self.address}/lineitems/{number}/lineitem?type_id=3"
        self.columns[number] = {"id": address, "resourceLinkId": link, "label": label, "scoreMaximum": 10}
        return self.columns[number]

    def add_link(self, link: Link) -> Link:
        self.links[link.id] = link
        if link.column:
            self.add_column(link.id, link.title)
        return link

    def login_address(self, subject: str, hint: str) -> str:
        """Where somebody's browser goes first who opens a link (its id is the hint) or chooses one (`choice`)."""
        login = _Login(None, self.configuration())
        login.set_lti_message_hint(hint=hint)
        return str(login.initiate_login(subject))

    def launch(self, authorization: str, **claims: Any) -> dict[str, Any]:
        """What the platform posts when a browser has come by this address; `claims` are added to the token's."""
        given = dict(parse_qsl(urlsplit(authorization).query))
        launch = _Launch(_Request({"get_data": given, "form_data": {}}), self.configuration())
        person, hint = self.people[given["login_hint"]], given["lti_message_hint"]
        launch.set_user_data(person.subject, person.roles, full_name=person.name or None)
        launch.set_launch_context_claim(COURSE, context_title="Control")
        launch.set_nrps(f"{self.address}/members")
        if hint == "choice":
            launch.set_dl(f"{self.address}/chosen", extra_data="opaque")  # type: ignore[arg-type]
        else:
            link = self.links[hint]
            launch.set_resource_link_claim(link.id, title=link.title)
            launch.set_custom_parameters_claim(link.custom)
            column = next(
                (item["id"] for item in self.columns.values() if item["resourceLinkId"] == hint), None
            )
            launch.set_ags(f"{self.address}/lineitems", column)
        launch.set_extra_claims(claims)
        return launch.lti_launch()

    def chosen(self, token: str) -> list[dict[str, Any]]:
        """The content items of a deep linking response, once the package has found it good."""
        return self.configuration().validate_deeplinking_resp({"JWT": token})

    def wait_for_scores(self, count: int, seconds: float) -> list[dict[str, Any]]:
        """The scores, once there are so many."""
        with self.changed:
            assert self.changed.wait_for(lambda: len(self.scores) >= count, seconds), self.scores
            return list(self.scores)

    def _handler(self) -> type[BaseHTTPRequestHandler]:
        platform = self

        class Handler(BaseHTTPRequestHandler):
            def log_message(self, *_: Any) -> None:
                """Says nothing."""

            def do_GET(self) -> None:
                self._answer("GET")

            def do_POST(self) -> None:
                self._answer("POST")

            def _answer(self, method: str) -> None:
                body = self.rfile.read(int(self.headers.get("Content-Length") or 0))
                status, kind, value, more = platform.answer(
                    method, self.path, dict(self.headers.items()), body
                )
                content = (value if kind == "text/html" else json.dumps(value)).encode()
                self.send_response(status)
                for name, text in {"Content-Type": kind, "Content-Length": str(len(content)), **more}.items():
                    self.send_header(name, text)
                self.end_headers()
                self.wfile.write(content)

        return Handler

    def answer(
        self, method: str, path: str, headers: dict[str, str], body: bytes
    ) -> tuple[int, str, Any, dict[str, str]]:
        """Status, kind, body and further headers of an answer."""
        parts = urlsplit(path)
        with self.changed:
            self.asked.append(f"{method} {path}")
            self.changed.notify_all()
        if self.away:
            return 503, "application/json", {}, {"Retry-After": "1"}
        if parts.path in ("/course", "/auth"):
            return 200, "text/html", self._page(parts.path, path, dict(parse_qsl(parts.query))), {}
        if parts.path == "/keys":
            return 200, "application/json", self.configuration().get_jwks(), {}
        if parts.path == "/token":
            form = dict(parse_qsl(body.decode()))
            return 200, "application/json", self.configuration().get_access_token(form), {}
        return self._service(method, path, headers, body)

    def _service(
        self, method: str, path: str, headers: dict[str, str], body: bytes
    ) -> tuple[int, str, Any, dict[str, str]]:
        parts = urlsplit(path)
        request = _Request({
            "method": method,
            "headers": headers,
            "get_data": dict(parse_qsl(parts.query)),
            "form_data": {},
            "json": json.loads(body) if body else None,
        })  # fmt: skip
        if parts.path == "/members":
            return self._members(request)
        if parts.path.startswith("/lineitems"):
            return self._grades(method, parts.path, request)
        return 404, "application/json", {}, {}

    def _page(self, page: str, path: str, asked: dict[str, str]) -> str:
        """A course with the tool in a frame, `keeps` whose frame's values are kept; or the form of a launch."""
        if page == "/auth":
            data = self.launch(f"{self.address}{path}")
            fields = "".join(f'<input name="{name}" value="{data[name]}">' for name in ("id_token", "state"))
            fields += "<button>On</button></form>" if self.held else f"</form><script>{_SEND}</script>"
            return f'<form method="post" action="{data["launch_url"]}">{fields}'
        address = self.login_address(asked["user"], asked["link"])
        script = f"<script>{_KEEP}</script>" if "keeps" in asked else ""
        if script:
            address += "&lti_storage_target=_parent"
        return f'<!doctype html>{script}<iframe src="{escape(address)}" width="1000" height="700"></iframe>'

    def _members(self, request: Request) -> tuple[int, str, Any, dict[str, str]]:
        members = _Members(request, self.configuration(), f"{self.address}/members")
        members.platform = self
        reply = members.handle_resp(members.handle_get_members)
        page = int(request.get_data.get("page", 1))
        more = {}
        if reply.code == 200 and page * self.page_size < len(self.people):
            more["Link"] = f'<{self.address}/members?page={page + 1}>; rel="next"'
        return reply.code, reply.media_type, reply.result, more

    def _grades(self, method: str, path: str, request: Request) -> tuple[int, str, Any, dict[str, str]]:
        grades = _Grades(request, self.configuration(), f"{self.address}/lineitems")
        grades.platform = self
        words = path.strip("/").split("/")
        if len(words) == 4 and words[3] == "scores":
            reply = grades.handle_resp(grades.handle_update_score, line_item_id=words[1])
        elif method == "POST":
            reply = grades.handle_resp(grades.handle_create_lineitem)
        else:
            reply = grades.handle_resp(grades.handle_get_lineitems)
        result = (
            reply.result["content"]
            if isinstance(reply.result, dict) and "content" in reply.result
            else reply.result
        )
        with self.changed:
            self.changed.notify_all()
        return reply.code, reply.media_type, result, {}
