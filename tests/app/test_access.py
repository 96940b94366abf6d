"""The access token: who gets in, by what, and what the others get."""

from __future__ import annotations

import json
from collections.abc import Iterator

import pytest
from pydantic import SecretStr
from starlette.testclient import TestClient, WebSocketDenialResponse

from app.edge.access import COOKIE
from app.ops.settings import Settings
from tests.app.test_security import SOCKETS, app_with, directives

TOKEN = "a-token-of-a-class-2026"


@pytest.fixture(scope="module")
def guarded() -> Iterator[TestClient]:
    with app_with(access_token=SecretStr(TOKEN)) as client:
        yield client


@pytest.mark.parametrize(
    "path", ["/", "/docs", "/openapi.json", "/metrics", "/api/v1/presets", "/static/main.js", "/nothing"]
)
def test_without_the_token_tools_get_a_problem_and_people_a_form(guarded: TestClient, path: str):
    reply = guarded.get(path)
    assert reply.status_code == 401
    assert reply.headers["www-authenticate"].startswith("Bearer")
    assert reply.headers["content-type"] == "application/problem+json"
    assert reply.json()["code"] == "unauthorized"
    page = guarded.get(path, headers={"Accept": "text/html,*/*;q=0.8"})
    assert page.status_code == 401
    assert '<form method="post">' in page.text and TOKEN not in page.text
    policy = directives(page.headers["content-security-policy"])
    assert policy["form-action"] == {"'self'"} and "script-src" not in policy


@pytest.mark.parametrize("path", ["/livez", "/favicon.ico", "/static/css/login.css", "/static/favicon.svg"])
def test_health_and_the_forms_own_files_are_open(guarded: TestClient, path: str):
    assert guarded.get(path).status_code == 200


def test_readiness_is_open(guarded: TestClient):
    assert guarded.get("/healthz").json()["code"] == "starting"


@pytest.mark.parametrize(
    "path", ["/static/../api/v1/presets", "/livez/", "//livez", "/static/css/login.css/../main.js"]
)
def test_open_addresses_open_no_others(guarded: TestClient, path: str):
    guarded.headers["Accept"] = "*/*"
    assert guarded.get(path).status_code == 401


@pytest.mark.parametrize("header", [f"Bearer {TOKEN}", f"bearer {TOKEN}"])
def test_tools_send_the_token_in_a_header(guarded: TestClient, header: str):
    assert guarded.get("/api/v1/presets", headers={"Authorization": header}).status_code == 200
    with guarded.websocket_connect(
        "/api/v1/recordings/identify", headers={"Authorization": header}
    ) as socket:
        socket.send_json({"cancel": True})
        assert socket.receive_json() == {"cancelled": True}


@pytest.mark.parametrize(
    "wrong", ["Bearer x", f"Bearer {TOKEN}x", f"Basic {TOKEN}", f"{TOKEN}", "Bearer ", "Bearer \xff"]
)
def test_wrong_tokens_are_refused(guarded: TestClient, wrong: str):
    header = {"Authorization": wrong.encode("latin-1")}
    assert guarded.get("/api/v1/presets", headers=header).status_code == 401


@pytest.mark.parametrize("path", SOCKETS)
def test_sockets_want_the_token_too(guarded: TestClient, path: str):
    for cookie in ("", f"{COOKIE}=", f"{COOKIE}={TOKEN}"):
        with (
            pytest.raises(WebSocketDenialResponse) as refused,
            guarded.websocket_connect(path, headers={"Cookie": cookie}),
        ):
            pass
        assert refused.value.status_code == 401


def cookie_of(reply) -> tuple[str, str]:
    """The cookie as a browser sends it back, and its attributes."""
    pair, _, attributes = reply.headers["set-cookie"].partition("; ")
    return pair, attributes


@pytest.mark.parametrize(
    ("asked", "goes_to"),
    [("/", "./"), ("/docs", "./docs"), ("/?poles=-1,-2&lang=de", "./?poles=-1%2C-2&lang=de")],
)
def test_the_form_leads_back_to_where_one_was_with_a_cookie(asked: str, goes_to: str):
    with app_with(access_token=SecretStr(TOKEN)) as client:
        wrong = client.post(asked, data={"token": "guess"})
        assert wrong.status_code == 401
        assert 'role="alert"' in wrong.text and "guess" not in wrong.text
        assert "set-cookie" not in wrong.headers
        right = client.post(asked, data={"token": f" {TOKEN} "})
        assert (right.status_code, right.headers["location"]) == (303, goes_to)
        pair, attributes = cookie_of(right)
        assert TOKEN not in pair
        assert {"HttpOnly", "Path=/", "SameSite=lax"} <= set(attributes.split("; "))
        client.cookies.clear()
        assert client.get("/", headers={"Cookie": pair}).status_code == 200
        with client.websocket_connect("/api/v1/recordings/identify", headers={"Cookie": pair}) as socket:
            socket.send_json({"cancel": True})
            assert socket.receive_json() == {"cancelled": True}


def test_a_link_with_the_token_ends_at_an_address_without_it():
    with app_with(access_token=SecretStr(TOKEN)) as client:
        headers = {"Accept": "text/html"}
        reply = client.get(f"/?poles=-1&token={TOKEN}", headers=headers)
        assert (reply.status_code, reply.headers["location"]) == (303, "./?poles=-1")
        pair, _ = cookie_of(reply)
        again = client.get(f"/?token={TOKEN}", headers={**headers, "Cookie": pair})
        assert again.status_code == 303
        assert client.get("/?token=wrong", headers={"Accept": "text/html", "Cookie": ""}).status_code == 401


def test_the_cookie_suits_tls_and_the_frames_of_others():
    with app_with("https://lab.example", access_token=SecretStr(TOKEN)) as client:
        _, attributes = cookie_of(client.post("/", data={"token": TOKEN}))
        assert "Secure" in attributes and "SameSite=lax" in attributes
    framed = {"access_token": SecretStr(TOKEN), "frame_ancestors": ("https://moodle.example",)}
    with app_with("https://lab.example", **framed) as client:
        _, attributes = cookie_of(client.post("/", data={"token": TOKEN}))
        assert {"Secure", "SameSite=none", "Partitioned", "HttpOnly"} <= set(attributes.split("; "))


def test_two_servers_with_one_token_take_each_others_cookies_and_no_others():
    pairs = []
    for token in (TOKEN, TOKEN, "another-token-of-2026"):
        with app_with(access_token=SecretStr(token)) as client:
            pairs.append(cookie_of(client.post("/", data={"token": token}))[0])
    assert pairs[0] == pairs[1] != pairs[2]


def test_a_large_form_is_given_up(guarded: TestClient):
    reply = guarded.post("/", data={"token": "x" * 100_000})
    assert reply.status_code == 401


def test_the_token_is_told_by_no_representation():
    settings = Settings(access_token=SecretStr(TOKEN))
    assert TOKEN not in repr(settings) and TOKEN not in json.dumps(settings.model_dump(mode="json"))
