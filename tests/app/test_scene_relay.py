"""The scene over the wire: page, socket, allow-list, isolation."""

import re
import urllib.error
import urllib.parse
import urllib.request
from collections.abc import Iterator
from pathlib import Path
from time import monotonic
from typing import Any

import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from app.scene.relay import BURST, LARGEST_MESSAGE, RATE, allowed_frame
from tests.patience import until
from tests.scene_client import (
    CAMERA,
    VISER,
    answer,
    closed,
    encode,
    messages,
    put_rig,
    replay,
    session_id,
    watch,
)
from tests.scene_server import SceneServer, serving


@pytest.fixture(scope="module")
def server() -> Iterator[SceneServer]:
    with serving(capacity=40) as running:
        yield running


def test_page_runs_the_shim_before_visers_own_script(server: SceneServer):
    with urllib.request.urlopen(f"{server.http}/scene/{session_id('page')}/") as response:
        page = response.read().decode()
    shim = page.index('<script src="../../static/scene/shim.js">')
    assert shim < page.index("<script data-p=")
    assert "[data-floating-window]" in page
    assert answer(f"{server.http}/static/scene/shim.js")[0] == 200


def test_page_is_compressed_and_not_sent_twice(server: SceneServer):
    url = f"{server.http}/scene/{session_id('page')}/"
    _, headers = answer(urllib.request.Request(url, headers={"Accept-Encoding": "gzip"}))
    assert headers["content-encoding"] == "gzip"
    known = {"Accept-Encoding": "gzip", "If-None-Match": headers["etag"]}
    again = urllib.request.Request(url, headers=known)
    assert answer(again)[0] == 304


def test_page_alone_starts_no_session(server: SceneServer):
    before = len(server.sessions)
    assert answer(f"{server.http}/scene/{session_id('nobody')}/")[0] == 200
    assert len(server.sessions) == before


def test_page_without_slash_redirects_to_the_page(server: SceneServer):
    url = f"{server.http}/scene/{session_id('page')}"
    with urllib.request.urlopen(url, timeout=20) as response:
        assert response.url == url + "/"


@pytest.mark.parametrize("bad", ["short", "x" * 65, "spaces%20and%20more%20characters", "ä" * 22])
def test_what_cannot_be_a_session_is_not_found(server: SceneServer, bad: str):
    bad = urllib.parse.quote(bad, safe="%")
    assert answer(f"{server.http}/scene/{bad}/")[0] == 404
    request = urllib.request.Request(
        f"{server.http}/scene/{bad}/rig",
        data=b'{"rig": "aero"}',
        method="PUT",
        headers={"Content-Type": "application/json"},
    )
    assert answer(request)[0] == 404
    with pytest.raises(Exception, match="HTTP 403"):
        connect(f"ws://127.0.0.1:{server.port}/scene/{bad}", proxy=None)


def test_visitor_is_told_the_whole_scene(server: SceneServer):
    with watch(server, "replay") as socket:
        assert socket.subprotocol == VISER
        names = {message.get("name") for message in replay(socket)}
    assert {"/rig/yoke", "/rig/yoke/body", "/rig/yoke/body/pitch_rotor"} <= names
    assert {"/rig/yoke/body/yaw_rotor", "/ghost/yoke", "/ghost/yoke/body"} <= names


def test_another_version_of_the_client_is_sent_away_with_visers_own_words(server: SceneServer):
    with watch(server, "version", "viser-v0.0.1") as socket:
        with pytest.raises(ConnectionClosed):
            socket.recv(timeout=20)
        assert socket.close_code == 1002
        assert "0.0.1" in (socket.close_reason or "")


def test_camera_reaches_viser(server: SceneServer):
    with watch(server, "camera") as socket:
        replay(socket)
        socket.send(encode({"type": "ShareUrlRequest"}))
        socket.send(encode(CAMERA))
        viser = server.sessions.server(session_id("camera"))
        assert viser is not None
        until(viser.get_clients, "viser counts the visitor")
        assert viser.request_share_url() is None


def test_camera_is_admissible():
    assert allowed_frame(encode(CAMERA)) == encode(CAMERA)


@pytest.mark.parametrize(
    "frame",
    [
        pytest.param(encode({"type": "ShareUrlRequest"}), id="share tunnel"),
        pytest.param(encode({"type": "GuiFormDirtyMessage", "uuid": "x"}), id="made-up form"),
        pytest.param(encode(CAMERA | {"extra": 1}), id="unknown field"),
        pytest.param(encode(CAMERA | {"fov": "wide"}), id="wrong kind"),
        pytest.param(encode({k: v for k, v in CAMERA.items() if k != "far"}), id="field missing"),
        pytest.param(encode([CAMERA]), id="not a map"),
        pytest.param(encode(CAMERA)[:-3], id="cut off"),
        pytest.param(b"", id="empty"),
        pytest.param(encode(CAMERA | {"wxyz": [0.0] * LARGEST_MESSAGE}), id="large"),
    ],
)
def test_nothing_else_is_admissible(frame: bytes):
    assert allowed_frame(frame, lambda _id, updates: None) is None


@pytest.mark.parametrize(("frame", "code"), [(b"\0" * LARGEST_MESSAGE, 1009), ("text", 1003)])
def test_frames_that_no_viewer_sends_end_the_connection(server: SceneServer, frame: str | bytes, code: int):
    with watch(server, "rude") as socket:
        replay(socket)
        socket.send(frame)
        until(lambda: closed(socket), "the connection ends")
        assert socket.close_code == code


def test_sessions_have_their_own_rigs(server: SceneServer):
    assert put_rig(server, "apart-a", '{"rig": "aero"}')[0] == 204
    with watch(server, "apart-a") as aero, watch(server, "apart-b") as helicopter:
        pivots = []
        for socket in (aero, helicopter):
            told = replay(socket)
            pivots += [
                message["position"][2]
                for message in told
                if message["type"] == "SetPositionMessage" and message["name"] == "/rig/yoke/body"
            ]
    assert pivots == pytest.approx([0.295, 0.364])


def test_rig_changes_for_those_who_watch_and_only_when_it_differs(server: SceneServer):
    with watch(server, "change") as socket:
        replay(socket)
        assert put_rig(server, "change", '{"rig": "helicopter"}')[0] == 204
        assert put_rig(server, "change", '{"rig": "aero"}')[0] == 204
        told: list[dict[str, Any]] = []
        while not any(m.get("name") == "/ghost/yoke/body/shape" for m in told):
            told += messages(socket.recv(timeout=20))
    created = [m for m in told if m["type"] == "FrameMessage" and m["name"] == "/rig/yoke/body"]
    assert len(created) == 1


@pytest.mark.parametrize("body", ['{"rig": "submarine"}', "{}", '{"rig": "aero", "x": 1}', "no"])
def test_unknown_rigs_are_refused(server: SceneServer, body: str):
    assert put_rig(server, "refused", body)[0] == 422


def test_everything_works_under_a_path_prefix():
    with serving(prefix="/lab/one") as mounted:
        url = f"{mounted.http}/scene/{session_id('prefix')}"
        with urllib.request.urlopen(url, timeout=20) as response:
            page, address = response.read().decode(), response.url
        (shim,) = re.findall(r'<script src="([^"]+)">', page)
        assert answer(urllib.parse.urljoin(address, shim))[0] == 200
        assert put_rig(mounted, "prefix", '{"rig": "aero"}')[0] == 204
        with watch(mounted, "prefix") as socket:
            assert replay(socket)


HOSTILE = [
    {"type": "ShareUrlRequest"},
    {"type": "ShareUrlDisconnect"},
    {
        "type": "FileTransferStartUpload",
        "transfer_uuid": "x",
        "filename": "x",
        "mime_type": "x",
        "part_count": 1,
    },
    {"type": "FileTransferPart", "transfer_uuid": "x", "part": 0, "content": b"x" * 1000},
    {"type": "GuiFormDirtyMessage", "uuid": "x"},
    {"type": "ScenePointerMessage", "event_type": "click"},
    {"type": "RunJavascriptMessage", "source": "alert(1)"},
    {"type": "GuiUpdateMessage", "uuid": "made-up", "updates": {"value": 1.0}},
    {"type": "GuiUpdateMessage", "uuid": "made-up", "updates": {"__class__": "x"}},
]


def viser_types() -> dict[str, type]:
    """Every message that viser knows, by its name on the wire."""
    from viser import _messages

    return {
        name: kind
        for name, kind in vars(_messages).items()
        if isinstance(kind, type) and issubclass(kind, _messages.Message) and kind is not _messages.Message
    }


def heard_by(server: SceneServer, name: str) -> list[tuple[str, float]]:
    """What a session's viser takes in from now on, and when."""
    viser = server.sessions.server(session_id(name))
    assert viser is not None
    heard: list[tuple[str, float]] = []
    for kind in viser_types().values():
        viser._websock_server.register_handler(
            kind, lambda _id, told: heard.append((type(told).__name__, monotonic()))
        )
    return heard


def test_of_all_of_visers_messages_two_pass():
    told = sorted(viser_types())
    assert "ShareUrlRequest" in told and len(told) > 80
    allowed = [name for name in told if allowed_frame(encode(CAMERA | {"type": name}))]
    assert allowed == ["ViewerCameraMessage"]
    update = {"uuid": "x", "updates": {"value": 1}}
    by_panel = [name for name in told if allowed_frame(encode({"type": name, **update}), lambda _id, u: u)]
    assert by_panel == ["GuiUpdateMessage"]


@pytest.mark.parametrize("message", HOSTILE, ids=lambda message: message["type"])
def test_hostile_messages_do_not_reach_viser(server: SceneServer, message: dict[str, Any]):
    with watch(server, "hostile") as socket:
        replay(socket)
        heard = heard_by(server, "hostile")
        socket.send(encode(message))
        socket.send(encode(CAMERA))
        until(lambda: heard, "the camera arrives")
        assert {kind for kind, _ in heard} == {"ViewerCameraMessage"}


def test_floods_are_slowed_and_others_are_not(server: SceneServer):
    """Of a thousand messages at once a burst passes, the rest at the pace of a viewer."""
    with watch(server, "flood") as flood, watch(server, "calm") as calm:
        replay(flood)
        replay(calm)
        heard, other = heard_by(server, "flood"), heard_by(server, "calm")
        began = monotonic()
        sent = int(BURST) + 120
        for _ in range(sent):
            flood.send(encode(CAMERA))
        calm.send(encode(CAMERA))
        until(lambda: other, "the calm one is heard")
        assert len(heard) < sent  # long before the flood is
        until(lambda: len(heard) == sent, "all arrive in the end")
        assert heard[-1][1] - began >= 120 / RATE * 0.9


def test_viser_listens_on_the_loopback_alone(server: SceneServer):
    assert put_rig(server, "loopback", '{"rig": "aero"}')[0] == 204
    viser = server.sessions.server(session_id("loopback"))
    assert viser is not None
    suffix = f":{viser.get_port():04X}"
    listening = []
    for table in ("tcp", "tcp6"):
        rows = [line.split() for line in Path(f"/proc/net/{table}").read_text().splitlines()[1:]]
        listening += [row[1] for row in rows if row[3] == "0A" and row[1].endswith(suffix)]
    assert listening == [f"0100007F{suffix}"]
