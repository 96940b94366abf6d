"""Who may come in, and what a browser may do with what it gets."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from urllib.parse import urljoin

import pytest
from starlette.testclient import TestClient, WebSocketDenialResponse
from starlette.websockets import WebSocketDisconnect

from app.edge import policies
from app.edge.origins import is_own
from app.main import create_app
from app.ops.settings import Settings
from app.scene.page import ViewerPage
from heli2dof_core.export.report_style import STYLE
from tests.scene_client import session_id

SOCKETS = [
    "/api/v1/live",
    "/api/v1/robustness",
    "/api/v1/recordings/identify",
    f"/scene/{session_id('a')}",
    f"/scene/{session_id('a')}/hub",
]


@contextmanager
def app_with(base_url: str = "http://lab.example", **settings) -> Iterator[TestClient]:
    """A client of an app of its own, whose lifespan need not run: nothing here computes."""
    yield TestClient(create_app(Settings(**settings)), base_url=base_url, follow_redirects=False)


def directives(policy: str) -> dict[str, set[str]]:
    return {words[0]: set(words[1:]) for words in (part.split() for part in policy.split(";"))}


# Headers


@pytest.mark.parametrize(
    ("path", "status"),
    [
        ("/", 200),
        ("/docs", 200),
        ("/api/v1/presets", 200),
        ("/static/main.js", 200),
        ("/livez", 200),
        ("/metrics", 200),
        (f"/scene/{session_id('a')}/", 200),
        ("/scene/short/", 404),
        ("/nothing", 404),
    ],
)
def test_every_answer_carries_the_safe_headers(client, path: str, status: int):
    reply = client.get(path)
    assert reply.status_code == status
    assert reply.headers["x-content-type-options"] == "nosniff"
    assert reply.headers["referrer-policy"] == "no-referrer"
    assert reply.headers["cross-origin-resource-policy"] == "same-origin"
    assert "camera=()" in reply.headers["permissions-policy"]
    assert "server" not in reply.headers
    policy = directives(reply.headers["content-security-policy"])
    assert policy["default-src"] == {"'none'"}
    assert "frame-ancestors" in policy


@pytest.mark.parametrize("path", ["/", "/docs"])
def test_pages_load_from_their_own_origin_and_run_nothing_inline(client, path: str):
    reply = client.get(path)
    policy = directives(reply.headers["content-security-policy"])
    report = (
        {policies.hash_source(STYLE.encode())} if path == "/" else set()
    )  # opened from a blob, it inherits this
    kernels = {"'wasm-unsafe-eval'"} if path == "/" else set()
    assert policy["script-src"] - kernels == policy["connect-src"] == {"'self'"}
    assert policy["style-src"] == {"'self'"} | report
    assert "unsafe" not in str(policy).replace("'wasm-unsafe-eval'", "", len(kernels))
    assert not re.search(r"<script(?![^>]*\ssrc=)|<style|\son\w+=|\sstyle=", reply.text)
    assert not re.search(r'(src|href)="(https?:)?//', reply.text)


def test_the_worker_runs_the_pages_modules_and_connects_to_nothing(client):
    policy = directives(client.get("/static/kernel/rigs_worker.js").headers["content-security-policy"])
    assert policy["script-src"] == {"'self'", "'wasm-unsafe-eval'"}
    others = {name: sources for name, sources in policy.items() if name != "script-src"}
    assert set.union(*others.values()) == {"'none'"} and "connect-src" not in policy
    module = client.get("/static/kernel/module.js").headers["content-security-policy"]
    assert module == policies.NOTHING


def test_the_scenes_page_runs_its_own_scripts_by_their_hashes_alone(client):
    reply = client.get(f"/scene/{session_id('a')}/")
    scripts = directives(reply.headers["content-security-policy"])["script-src"]
    loader = re.search(r"<script data-p=[^>]*>(.*?)</script>", reply.text, re.DOTALL)
    assert loader and policies.hash_source(loader[1].encode()) in scripts
    hashes = {source for source in scripts if source.startswith("'sha256-")}
    assert scripts - hashes == {"'self'", "'wasm-unsafe-eval'"}
    assert len(hashes) == 2


def test_who_may_frame_the_pages_is_a_setting():
    with app_with(frame_ancestors=("'self'", "https://moodle.example")) as client:
        for path in ("/", "/docs", f"/scene/{session_id('a')}/"):
            policy = directives(client.get(path).headers["content-security-policy"])
            assert policy["frame-ancestors"] == {"'self'", "https://moodle.example"}
        api = directives(client.get("/api/v1/presets").headers["content-security-policy"])
        assert api["frame-ancestors"] == {"'none'"}


def test_a_page_over_tls_has_its_browsing_context_to_itself():
    with app_with("https://lab.example") as client:
        assert client.get("/").headers["cross-origin-opener-policy"] == "same-origin"


def test_files_to_take_away_are_attachments(client):
    for call in ("motion?format=html", "export/report"):
        reply = client.post(f"/api/v1/{call}", json={"scenario": {"duration": 0.5}})
        assert reply.status_code == 200
        assert reply.headers["content-disposition"].startswith("attachment")
        assert reply.headers["content-security-policy"] == policies.NOTHING


def test_viser_with_another_page_is_noticed_at_the_start(monkeypatch: pytest.MonkeyPatch):
    from app.scene import viser_scripts

    with pytest.raises(RuntimeError, match=r"is this viser 1\.1\.1"):
        viser_scripts.inline_scripts("<title>Viser</title><script>1</script>")
    assert len(ViewerPage.load().policy) < 1000


# Origins


@pytest.mark.parametrize("path", SOCKETS)
def test_foreign_pages_open_no_socket(path: str):
    with app_with() as client:
        for origin in (
            "https://evil.example",
            "null",
            "http://lab.example.evil.example",
            "http://lab.example:81",
        ):
            with (
                pytest.raises(WebSocketDenialResponse) as refused,
                client.websocket_connect(path, headers={"Origin": origin}),
            ):
                pass
            assert refused.value.status_code == 403
            assert refused.value.json()["code"] == "foreign_origin"


@pytest.mark.parametrize(
    "origin", [None, "http://lab.example", "http://LAB.example:80", "https://lab.example"]
)
def test_own_pages_and_tools_open_sockets(client, origin: str | None):
    """Over TLS at a proxy that says nothing the server sees ws and the page https."""
    headers = {"Host": "lab.example"} | ({"Origin": origin} if origin else {})
    with client.websocket_connect("/api/v1/live", headers=headers) as socket:
        socket.send_json({"seq": 3})
        assert socket.receive_json()["seq"] == 3


def test_listed_origins_open_sockets_and_call_the_api():
    with app_with(cors_origins=("https://tools.example",)) as client:
        origin = {"Origin": "https://tools.example"}
        with client.websocket_connect("/api/v1/recordings/identify", headers=origin) as socket:
            socket.send_json({"cancel": True})
            assert socket.receive_json() == {"cancelled": True}
        asked = {
            **origin,
            "Access-Control-Request-Method": "POST",
            "Access-Control-Request-Headers": "content-type",
        }
        allowed = client.options("/api/v1/gains", headers=asked)
        assert allowed.headers["access-control-allow-origin"] == "https://tools.example"
        assert "access-control-allow-credentials" not in allowed.headers
        other = client.get("/api/v1/presets", headers={"Origin": "https://evil.example"})
        assert "access-control-allow-origin" not in other.headers


def test_without_the_setting_there_is_no_cors(client):
    asked = {"Origin": "https://tools.example", "Access-Control-Request-Method": "POST"}
    reply = client.options("/api/v1/gains", headers=asked)
    assert reply.status_code == 405
    assert not [name for name in reply.headers if name.startswith("access-control")]


@pytest.mark.parametrize(
    ("origin", "host", "scheme", "own"),
    [
        ("http://a.example", "a.example", "ws", True),
        ("http://a.example:80", "a.example", "ws", True),
        ("https://a.example", "a.example:443", "wss", True),
        ("https://a.example:8443", "a.example:8443", "ws", True),
        ("http://[::1]:8000", "[::1]:8000", "ws", True),
        ("http://a.example", "a.example", "wss", False),
        ("http://a.example:8001", "a.example:8000", "ws", False),
        ("http://b.example", "a.example", "ws", False),
        ("http://a.example@b.example", "b.example", "ws", False),
        ("http://a.example/", "a.example", "ws", False),
        ("ftp://a.example", "a.example", "ws", False),
        ("null", "a.example", "ws", False),
        ("", "a.example", "ws", False),
        ("http://a.example:x", "a.example:x", "ws", False),
        ("http://", "", "ws", False),
    ],
)
def test_own_origins_are_told_by_host_and_port(origin: str, host: str, scheme: str, own: bool):
    assert is_own(origin, host, scheme) is own


def forwarded(address: str, **settings) -> TestClient:
    app = create_app(Settings(**settings))
    return TestClient(app, base_url="http://inner:8000", client=(address, 5000))


PROXIED = {"X-Forwarded-Host": "lab.example", "X-Forwarded-Proto": "https", "Origin": "https://lab.example"}


def test_behind_a_known_proxy_the_origin_is_compared_with_what_the_client_asked_for():
    with forwarded("10.0.0.7", trusted_proxies=("10.0.0.0/8",)).websocket_connect(
        "/api/v1/live", headers=PROXIED
    ):
        pass
    unencrypted = PROXIED | {"Origin": "http://lab.example"}
    client = forwarded("10.0.0.7", trusted_proxies=("10.0.0.0/8",))
    with (
        pytest.raises(WebSocketDenialResponse),
        client.websocket_connect("/api/v1/live", headers=unencrypted),
    ):
        pass


def test_what_strangers_say_of_proxies_is_not_believed():
    client = forwarded("192.0.2.7", trusted_proxies=("10.0.0.0/8",))
    with pytest.raises(WebSocketDenialResponse), client.websocket_connect("/api/v1/live", headers=PROXIED):
        pass


def test_known_hosts_alone_are_answered_where_they_are_listed():
    with app_with(allowed_hosts=("lab.example", "*.uni.example")) as client:
        for host, status in [
            ("lab.example:8000", 200),
            ("a.uni.example", 200),
            ("uni.example", 421),
            ("evil", 421),
        ]:
            assert client.get("/livez", headers={"Host": host}).status_code == status


# A path prefix


@pytest.mark.parametrize("stripped", [False, True])
def test_everything_is_found_below_a_prefix_whether_the_proxy_strips_it_or_not(stripped: bool):
    with app_with(root_path="/lab/one") as client:
        for path in (
            "/",
            "/docs",
            "/static/main.js",
            "/api/v1/presets",
            f"/scene/{session_id('a')}/",
            "/livez",
        ):
            assert client.get(path if stripped else f"/lab/one{path}").status_code == 200, path
        assert client.get("/static/no.js").status_code == 404


@pytest.mark.parametrize("stripped", [False, True])
def test_the_motions_former_address_leads_to_the_new_one_below_a_prefix(stripped: bool):
    old = "/lab/one/api/v1/recording?format=viser"
    asked = old.removeprefix("/lab/one") if stripped else old
    with app_with(root_path="/lab/one") as client:
        moved = client.post(asked, json={})
        assert moved.status_code == 308
        leads_to = urljoin(f"http://lab.example{old}", moved.headers["location"])
        assert leads_to == "http://lab.example/lab/one/api/v1/motion?format=viser"
        # Method and body arrive: the refusal is of the body that was sent.
        wrong = client.post(asked, json={"poles": [-1, -2]}, follow_redirects=True)
        assert [reply.status_code for reply in (*wrong.history, wrong)] == [308, 422]
        assert wrong.json()["field"] == "poles"


def test_sockets_that_the_server_does_not_know_are_refused():
    with (
        app_with() as client,
        pytest.raises(WebSocketDisconnect),
        client.websocket_connect("/api/v1/nothing"),
    ):
        pass
