"""The windows of one session: what each hears of the others, the panel beside the rig, and who leads."""

from __future__ import annotations

import asyncio
import json
import math
import struct
from collections.abc import Iterator
from contextlib import ExitStack
from typing import Any

import msgspec
import pytest
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect
from websockets.sync.connection import Connection

from app.scene.hub import LARGEST_SHOWN, MOST_WINDOWS, Room, Transport, Window, read_shown
from app.scene.panel import gain_table
from tests.app.test_scene_relay import CAMERA, encode, messages, replay, session_id, watch
from tests.loops import run
from tests.patience import until
from tests.scene_server import SceneServer, serving

K = [[51.2, -3.46, 5.46, -0.619], [-10.5, 103.7, -1.89, 18.6]]
RUN = {"type": "transport", "playing": True, "time": 0.5, "speed": 1.0, "loop": False, "at": 12.25}


def frame(
    poles: tuple[complex, ...] = (-12, -10, -9, -8), kp: float = 30.0, after: int = 0, **more: Any
) -> bytes:
    """What a page shows; the arrays behind the header are read by windows alone."""
    pi = {"kp": kp, "ti": 0.1}
    design = {
        "poles": [{"re": p.real, "im": p.imag} for p in poles],
        "loops": {"pitch": pi, "yaw": pi},
        "outer": "pi",
        "preset": "quanser-2dof-manual",
    }
    header = json.dumps({"design": design, "K": K, "after": after, **more}).encode()
    header += b" " * (-len(header) % 4)
    return struct.pack("<I", len(header)) + header + bytes(16)


@pytest.fixture(scope="module")
def server() -> Iterator[SceneServer]:
    with serving(capacity=20) as running:
        yield running


def join(server: SceneServer, name: str, *, page: bool = False) -> Connection:
    query = "?page=true" if page else ""
    return connect(f"{server.socket(session_id(name))}/hub{query}", compression=None, proxy=None)


def hears(socket: Connection, kind: str, **content: Any) -> dict[str, Any]:
    """Waits for a text message of this kind and content."""
    while True:
        message = socket.recv(timeout=20)
        if isinstance(message, str):
            told = json.loads(message)
            if told["type"] == kind and content.items() <= told.items():
                return told


def hears_frame(socket: Connection) -> bytes:
    while not isinstance(message := socket.recv(timeout=20), bytes):
        pass
    return message


def hears_nothing_more(socket: Connection) -> None:
    """What came before an answer to a question of one's own is all there is."""
    socket.send(json.dumps({"type": "clock", "sent": 1.5}))
    message = socket.recv(timeout=20)
    assert isinstance(message, str)
    assert json.loads(message)["type"] == "clock"


def test_what_the_page_shows_and_how_it_plays_reach_the_others_alone(server: SceneServer):
    with join(server, "told", page=True) as page, join(server, "told") as window:
        hears(page, "windows", others=1, leads=True)
        hears(window, "windows", others=1, leads=False)
        shown = frame()
        page.send(shown)
        assert hears_frame(window) == shown
        page.send(json.dumps(RUN))
        assert hears(window, "transport") == RUN
        hears(page, "taken")
        hears_nothing_more(page)


def test_newcomer_is_told_what_is_shown_and_how_it_plays(server: SceneServer):
    with join(server, "late", page=True) as page:
        page.send(frame(after=0))
        page.send(json.dumps(RUN))
        hears(page, "taken")
        with join(server, "late") as window:
            assert hears_frame(window) == frame()
            assert hears(window, "transport") == RUN


def test_who_flies_along_is_heard_together_and_lets_go_when_gone(server: SceneServer):
    with join(server, "pair", page=True) as page:
        with join(server, "pair") as first, join(server, "pair") as second:
            hears(page, "windows", others=2)
            first.send(json.dumps({"type": "sticks", "pitch": 1.0, "yaw": 0.25}))
            hears(page, "sticks", pitch=1.0, yaw=0.25)
            second.send(json.dumps({"type": "sticks", "pitch": 0.5, "yaw": -1.0}))
            hears(page, "sticks", pitch=1.0, yaw=-0.75)
            with pytest.raises(ConnectionClosed):
                second.send(json.dumps({"type": "sticks", "pitch": 1.5, "yaw": 0.0}))
                while True:
                    second.recv(timeout=20)
            hears(page, "sticks", pitch=1.0, yaw=0.25)
        hears(page, "sticks", pitch=0.0, yaw=0.0)
        with join(server, "pair") as late:
            hears(late, "windows")
            hears_nothing_more(late)


def test_other_sessions_hear_nothing(server: SceneServer):
    with join(server, "mine", page=True) as page, join(server, "theirs", page=True) as other:
        hears(other, "windows", others=0)
        page.send(frame())
        page.send(json.dumps(RUN))
        hears(page, "taken")
        hears_nothing_more(other)


def test_page_leads_before_older_windows_and_a_window_without_one(server: SceneServer):
    with join(server, "leads") as window:
        hears(window, "windows", others=0, leads=True)
        with join(server, "leads", page=True) as page:
            hears(page, "windows", others=1, leads=True)
            hears(window, "windows", others=1, leads=False)
        hears(window, "windows", others=0, leads=True)


def test_clock_answers_with_the_servers_time(server: SceneServer):
    with join(server, "clock", page=True) as page:
        page.send(json.dumps({"type": "clock", "sent": 3.5}))
        first = hears(page, "clock", sent=3.5)["now"]
        page.send(json.dumps({"type": "clock", "sent": 4.5}))
        assert 0 <= hears(page, "clock", sent=4.5)["now"] - first < 20


@pytest.mark.parametrize(
    ("message", "code"),
    [
        pytest.param("{", 1008, id="no JSON"),
        pytest.param(json.dumps({"type": "panel", "edits": {}}), 1008, id="what only the server says"),
        pytest.param(json.dumps(RUN | {"time": -1}), 1008, id="out of range"),
        pytest.param(json.dumps(RUN | {"extra": 1}), 1008, id="unknown field"),
        pytest.param(json.dumps(RUN | {"speed": "fast"}), 1008, id="wrong kind"),
        pytest.param(" " * 2000, 1009, id="long text"),
        pytest.param(bytes(LARGEST_SHOWN + 1), 1009, id="large frame"),
        pytest.param(b"\xff\xff\xff\x00{}", 1008, id="cut off"),
        pytest.param(frame(K=[[1.0]]), 1008, id="no gain"),
        pytest.param(frame(poles=(-1, -2)), 1008, id="two poles"),
    ],
)
def test_what_no_window_sends_ends_the_connection(server: SceneServer, message: str | bytes, code: int):
    with join(server, "rude", page=True) as page:
        page.send(message)
        with pytest.raises(ConnectionClosed):
            while True:
                page.recv(timeout=20)
        assert page.close_code == code


def test_room_is_full_at_some_point_and_says_so(server: SceneServer):
    with ExitStack() as crowd:
        sockets = [crowd.enter_context(join(server, "crowd", page=True)) for _ in range(MOST_WINDOWS)]
        hears(sockets[-1], "windows", others=MOST_WINDOWS - 1)
        with join(server, "crowd", page=True) as late:
            with pytest.raises(ConnectionClosed):
                late.recv(timeout=20)
            assert late.close_code == 1013
            assert f"{MOST_WINDOWS} windows" in (late.close_reason or "")
        for socket in sockets:  # the first first: who has not read what those before it said is slow to close
            socket.close()


def test_page_in_a_room_keeps_no_rig_running(server: SceneServer):
    with join(server, "no-rig", page=True) as page:
        hears(page, "windows")
        assert server.sessions.server(session_id("no-rig")) is None


def test_session_is_freed_after_its_last_window():
    with serving(idle_seconds=0.3) as server:
        with join(server, "brief") as window, join(server, "brief", page=True) as page:
            page.send(frame())
            hears_frame(window)
            assert len(server.sessions) == 1
        until(lambda: len(server.sessions) == 0, "the session is stopped after its last window")


# The panel, as viser's client sees it.


class Panel:
    """A viser client that knows the panel's elements by name."""

    def __init__(self, socket: Connection) -> None:
        self.socket = socket
        self.elements: dict[str, dict[str, Any]] = {}
        for message in replay(socket):
            if "uuid" in message and "props" in message:
                label = message["props"].get("label") or message["type"]
                self.elements.setdefault(label, message)
        socket.send(encode(CAMERA))

    def set(self, label: str, value: Any, name: str = "value") -> None:
        uuid = self.elements[label]["uuid"]
        self.socket.send(encode({"type": "GuiUpdateMessage", "uuid": uuid, "updates": {name: value}}))

    def hears(self, label: str, name: str, wanted: Any) -> None:
        """Waits until the element is told this property."""
        uuid = self.elements[label]["uuid"]
        while True:
            for message in messages(self.socket.recv(timeout=20)):
                if message.get("uuid") == uuid and message.get("updates", {}).get(name) == wanted:
                    return


@pytest.fixture
def panel(server: SceneServer, request: pytest.FixtureRequest) -> Iterator[tuple[Connection, Panel]]:
    name = request.node.name[:40]
    with join(server, name, page=True) as page, join(server, name) as window:
        hears(window, "windows")
        with watch(server, name) as socket:
            panel = Panel(socket)
            viser = server.sessions.server(session_id(name))
            assert viser is not None
            until(viser.get_clients, "viser counts the visitor")
            yield page, panel


def test_panel_moves_the_page(panel: tuple[Connection, Panel]):
    page, viser = panel
    viser.set("p₁", -7)
    assert hears(page, "panel")["edits"] == {"pitch.first": -7.0}
    viser.set("Play", "Replay")
    assert hears(page, "panel")["edits"] == {"play": "Replay"}
    viser.set("Speed", "½×")
    assert hears(page, "panel") == {"type": "panel", "edits": {"speed": 0.5}, "count": 3}


def test_what_is_set_is_held_to_its_range_and_kind(panel: tuple[Connection, Panel]):
    page, viser = panel
    for value in (math.nan, math.inf, "fast", True, [1.0], None, {"a": 1}):
        viser.set("p₁", value)
    viser.set("p₁", 500, name="max")
    viser.set("Loop", 1)
    viser.set("Speed", "9×")
    viser.set("Play", "Explode")
    viser.socket.send(encode({"type": "GuiUpdateMessage", "uuid": "made-up", "updates": {"value": 1}}))
    viser.set("p₁", -1e300)
    assert hears(page, "panel") == {"type": "panel", "edits": {"pitch.first": -20.0}, "count": 1}


def test_page_moves_the_panel(panel: tuple[Connection, Panel]):
    page, viser = panel
    page.send(frame(poles=(-3 + 2j, -3 - 2j, -9.5, -8)))
    viser.hears("p₃", "value", -9.5)
    page.send(frame(poles=(-40, -10, -9.5, -8)))
    viser.hears("p₁", "min", -60)


def test_panel_is_not_put_back_by_a_design_that_does_not_know_it(panel: tuple[Connection, Panel]):
    page, viser = panel
    viser.set("p₁", -7)
    count = hears(page, "panel")["count"]
    page.send(frame(poles=(-12, -10, -9.5, -8)))  # was under way
    hears(page, "taken")
    page.send(frame(poles=(-7, -10, -9.25, -8), after=count))
    viser.hears("p₃", "value", -9.25)  # the first that it hears of p₃


def test_gain_is_shown_in_figures():
    table = gain_table(((51.1719, -3.4561, 5.4583, -0.61943), (-10.54, 103.71, -1.8899, 18.578)))
    assert "51.17" in table
    assert "−0.6194" in table
    assert table.count("<td ") == 8


# What waits for a slow window.


def test_of_what_waits_only_the_newest_stays():
    sent: list[str | bytes] = []

    class Socket:
        async def send_text(self, message: str) -> None:
            sent.append(message)

        async def send_bytes(self, message: bytes) -> None:
            sent.append(message)

    async def scenario() -> None:
        room, page, window = Room(), Window(page=True), Window(page=False)
        room.join(page)
        room.join(window)
        for k in range(1000):
            room.show(frame(after=k), page)
            room.set_transport(msgspec.convert({**RUN, "at": float(k)}, Transport), page)
            room.edit({"pitch.first": -float(k), f"name{k % 3}": k})
        for member in (window, page):
            sending = asyncio.create_task(member.send_pending(Socket()))  # pyright: ignore
            before = -1
            while before < len(sent):  # a turn in which nothing is sent is the last
                before = len(sent)
                for _ in range(5):
                    await asyncio.sleep(0)
            sending.cancel()

    run(scenario())
    frames = [message for message in sent if isinstance(message, bytes)]
    assert [read_shown(f).after for f in frames] == [999]
    panel = [json.loads(m) for m in sent if isinstance(m, str) and json.loads(m)["type"] == "panel"]
    assert panel == [
        {
            "type": "panel",
            "count": 1000,
            "edits": {"pitch.first": -999.0, "name0": 999, "name1": 997, "name2": 998},
        }
    ]
    assert len(sent) == 5  # and the windows' count twice, and one transport
