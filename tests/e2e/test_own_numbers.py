"""While a hand moves something the page computes itself and asks nobody; what of that a browser shows."""

from __future__ import annotations

import json
import re
import socket
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, Route, WebSocket, expect

from heli2dof_core import PoleSet, Spec, place
from tests.browser import EMPTY, FRAME, GONE, SEEN, UNDRAWN, Visit, goto, settled, state, until_state, visited
from tests.e2e.conftest import App, running_app
from tests.e2e.test_axe import RUN, violations
from tests.e2e.test_page import PLOTS, TRACES, centre
from tests.e2e.test_page import scene as rig

AERO = "#v1&preset=quanser-aero-2&spread=0.1"
AWAY = "The server is away: remarks are of an earlier design."
UNRESTING = """const later = window.setTimeout;
window.setTimeout = (act, ms, ...more) => (ms === 200 ? 0 : later(act, ms, ...more));"""
"""However slow the machine, between two moves of the hand it does not count as resting."""
LOCAL = "() => JSON.parse(document.documentElement.dataset.state).local"
READY = "document.documentElement.dataset.kernel === 'ready'"


def ready(page: Page) -> None:
    """Waits until the page can compute itself."""
    page.wait_for_function(f"() => {READY}")


@contextmanager
def computing(chromium: Browser, url: str, *, scene: str = EMPTY) -> Iterator[Visit]:
    """The page, its first answer drawn, its kernel there."""
    with visited(chromium, scene, SEEN, UNRESTING, reduced_motion="reduce") as visit:
        goto(visit.page, url)
        ready(visit.page)
        yield visit


class Wire:
    """All that goes over a page's sockets, and what it asks.

    Not its own files, nor how windows compare clocks, nor where the scene's camera stands, which viser's client tells
    once it has drawn.
    """

    def __init__(self, page: Page) -> None:
        self.messages: list[str] = []
        page.on("websocket", self._watch)
        page.on("request", lambda request: "/static/" in request.url or self.messages.append(request.url))

    def _watch(self, ws: WebSocket) -> None:
        for way in ("framesent", "framereceived"):
            ws.on(way, lambda frame, way=way: self._keep(f"{way} {ws.url}", frame))

    def _keep(self, what: str, frame: str | bytes) -> None:
        clock = isinstance(frame, str) and re.match(r'\{"type": ?"clock"', frame)
        camera = isinstance(frame, bytes) and b"ViewerCameraMessage" in frame
        if not clock and not camera:
            self.messages.append(what)


def K_of(now: dict[str, Any], preset: str = "quanser-2dof-manual") -> Any:
    """The gain of the poles that the page shows, by the library."""
    poles = PoleSet(complex(p["re"], p["im"]) for p in now["poles"])
    return place(Spec.from_preset(preset, poles=poles)).K


@pytest.mark.parametrize(
    ("part", "scene"), [("", EMPTY), (AERO, UNDRAWN)], ids=["alone", "with cloud, track and scene"]
)
def test_a_drag_sends_nothing(chromium: Browser, app: App, part: str, scene: str):
    """No byte either way, whatever is on: the cloud, the track of the lag, the scene."""
    with visited(chromium, scene, SEEN, UNRESTING) as visit:
        page = visit.page
        wire = Wire(page)
        goto(page, app.url + part)
        ready(page)
        if part:
            expect(page.get_by_test_id("cloud-words")).to_contain_text("2000 rigs")
            page.wait_for_function("() => document.querySelectorAll('.lag-path').length > 0")
            rig(page)
        else:
            page.wait_for_load_state("networkidle")
        settled(page)  # no answer is on its way
        before = state(page)
        x, y = centre(page, "pole-3")
        page.mouse.move(x, y)
        page.mouse.down()
        wire.messages.clear()
        seen = set()
        for k in range(1, 25):
            page.mouse.move(x + k, y)
            page.wait_for_function(LOCAL)  # figures are written in turns
            now = state(page)
            assert now["local"] and not now["settled"]
            seen.add(now["poles"][3]["re"])
            if not part:
                assert alike(now["K"], K_of(now).tolist())
        assert wire.messages == []
        assert len(seen) > 2
        assert now["K"] != before["K"]
        page.mouse.up()
        settled(page)
        after = state(page)
        assert (after["local"], after["differences"], after["notice"]) == (False, 0, None)
        assert part or alike(after["K"], K_of(after).tolist())
        asked = [message for message in wire.messages if "live" in message and "framesent" in message]
        assert len(asked) == 1


def alike(one: Any, other: Any) -> bool:
    return [v for row in one for v in row] == pytest.approx([v for row in other for v in row], rel=1e-9)


def test_a_slider_sends_nothing_until_it_is_let_go(chromium: Browser, app: App):
    with visited(chromium, EMPTY, SEEN, UNRESTING) as visit:
        page = visit.page
        wire = Wire(page)
        goto(page, app.url)
        ready(page)
        page.wait_for_load_state("networkidle")
        slider = page.locator(".field:has([data-testid=kp-pitch]) input[type=range]")
        box = slider.bounding_box()
        assert box is not None
        x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
        page.mouse.move(x, y)
        page.mouse.down()
        wire.messages.clear()
        moved = set()
        for k in range(1, 15):
            page.mouse.move(x + k, y)
            now = state(page)
            moved.add(json.dumps(now["loopPoles"]))
        assert now["local"] and len(moved) > 5
        assert wire.messages == []
        page.mouse.up()
        settled(page)
        assert len([m for m in wire.messages if "live" in m and "framesent" in m]) == 1


def test_a_drag_is_drawn_in_the_frame_of_its_event(chromium: Browser, app: App):
    with computing(chromium, app.url) as visit:
        page = visit.page
        x, y = centre(page, "pole-0")
        page.mouse.move(x, y)
        page.mouse.down()
        page.evaluate(FRAME)
        changed = page.evaluate(
            f"""async ([x, y, plots]) => {{
              const traces = {TRACES};
              const svg = document.querySelector('[data-testid=splane]');
              const found = [];
              for (const dx of [-12, -25, -40]) {{
                const before = plots.map(traces);
                const at = {{ clientX: x + dx, clientY: y, bubbles: true, pointerId: 1, pointerType: 'mouse' }};
                svg.dispatchEvent(new PointerEvent('pointermove', at));
                await new Promise(requestAnimationFrame); // called behind the page's own of this frame
                found.push(plots.filter((id, i) => traces(id) === before[i]));
              }}
              return found;
            }}""",
            [x, y, PLOTS],
        )
        assert changed == [[], [], []]
        page.wait_for_function(LOCAL)
        page.mouse.up()
        settled(page)


def test_a_difference_is_told_and_the_servers_numbers_hold(chromium: Browser, app: App):
    """The page's kernel is given other poles than asked for: what then differs is named with both values."""

    def patched(route: Route) -> None:
        source = route.fetch().text()
        assert "    run();" in source
        wrong = source.replace("    run();", "    this.#numbers.floats[AT.POLES] -= 0.01;\n    run();")
        route.fulfill(body=wrong, content_type="text/javascript")

    with visited(chromium, EMPTY, SEEN, UNRESTING) as visit:
        page = visit.page
        page.route("**/static/kernel/updates.js", patched)
        goto(page, app.url)
        ready(page)
        settled(page)
        x, y = centre(page, "pole-0")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 30, y, steps=5)
        page.wait_for_function(LOCAL)
        wrong = state(page)
        assert not alike(wrong["K"], K_of(wrong).tolist())
        page.mouse.up()
        until_state(page, "s.differences === 1 && s.settled")
        told = page.get_by_test_id("notice")
        expect(told).to_contain_text(
            re.compile(r"The server’s \S+ is \S+.*; here it was \S+.*\. The server’s is shown\.")
        )
        assert alike(state(page)["K"], K_of(state(page)).tolist())
        visit.page.get_by_test_id("notice-close").click()
        expect(told).to_be_hidden()


def colour(page: Page, selector: str) -> str:
    return page.locator(selector).first.evaluate("(e) => getComputedStyle(e).color")


def test_without_the_server_a_drag_goes_on_and_says_what_is_old(chromium: Browser):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with visited(chromium, EMPTY, SEEN) as visit:
        page = visit.page
        with running_app(port) as app:
            goto(page, app.url)
            ready(page)
        page.wait_for_function(
            "() => JSON.parse(document.documentElement.dataset.state).connection === 'lost'"
        )
        shown, words = colour(page, ".pairing-words"), page.get_by_test_id("pairing-words").inner_text()
        place_of = page.locator("#strip").bounding_box()
        traces = {plot: page.evaluate(TRACES, plot) for plot in PLOTS}
        x, y = centre(page, "pole-2")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 60, y, steps=8)
        page.mouse.up()
        now = state(page)
        assert now["local"] and not now["settled"] and now["connection"] == "lost"
        assert now["poles"][2]["re"] > -9
        assert alike(now["K"], K_of(now).tolist())
        assert {plot for plot in PLOTS if page.evaluate(TRACES, plot) == traces[plot]} == set()
        expect(page.get_by_test_id("stale")).to_be_hidden()  # the figures are of this design
        expect(page.locator("#strip .list [data-code=server_away]")).to_contain_text(AWAY)
        page.wait_for_function(
            "(old) => getComputedStyle(document.querySelector('.pairing-words')).color !== old", arg=shown
        )
        assert page.get_by_test_id("pairing-words").inner_text()[:20] == words[:20]
        assert page.locator("#strip").bounding_box() == place_of
        assert page.get_by_test_id("connection").inner_text().startswith("connection lost")
        with running_app(port):
            settled(page)
            after = state(page)
            assert not after["local"] and after["differences"] == 0
            assert alike(after["K"], now["K"])
            expect(page.locator("#strip [data-code=server_away]")).to_have_count(0)
            assert colour(page, ".pairing-words") == shown
        visit.forgive(GONE)


def test_what_is_old_can_be_read(chromium: Browser, app: App):
    """Grey words keep their contrast, in both schemes."""
    with computing(chromium, app.url + "#v1&p=-1,-1.1,-9,-9.1&kp.pitch=200") as visit:
        page = visit.page
        before = colour(page, "#strip .list li")
        page.evaluate("() => document.documentElement.classList.add('earlier')")
        page.wait_for_function(
            "(old) => getComputedStyle(document.querySelector('#strip .list li')).color !== old", arg=before
        )
        assert violations(page) == []
        page.emulate_media(color_scheme="dark")
        page.evaluate(FRAME)
        assert page.evaluate(RUN) == []


@pytest.mark.parametrize(
    "missing",
    [
        "delete window.WebAssembly",
        "WebAssembly.compile = WebAssembly.compileStreaming = () => Promise.reject(new Error('none'))",
    ],
    ids=["missing", "refused"],
)
def test_without_webassembly_the_server_is_asked_as_ever(chromium: Browser, app: App, missing: str):
    with visited(chromium, EMPTY, SEEN, missing) as visit:
        page = visit.page
        wire = Wire(page)
        goto(page, app.url)
        expect(page.get_by_test_id("recording-sample")).to_be_attached()
        assert not page.evaluate(READY)
        wire.messages.clear()
        x, y = centre(page, "pole-0")
        page.mouse.move(x, y)
        page.mouse.down()
        for k in range(1, 6):
            page.mouse.move(x - 6 * k, y)
            settled(page)
            assert not state(page)["local"]
        assert len([m for m in wire.messages if "framesent" in m and "live" in m]) >= 5
        page.mouse.up()


def test_what_the_kernel_does_not_serve_goes_to_the_server(chromium: Browser, app: App):
    with computing(chromium, app.url + "#v1&method=knv0") as visit:
        page = visit.page
        x, y = centre(page, "pole-0")
        page.mouse.move(x, y)
        page.mouse.down()
        for k in range(1, 4):
            page.mouse.move(x - 8 * k, y)
            settled(page)
            assert state(page)["dragging"] and not state(page)["local"]
        page.mouse.up()
