"""A real tab behind nginx: its replica is killed, and it goes on with what its address holds; and the page below a path."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from time import perf_counter

from playwright.sync_api import Browser, Frame, Page

from tests.deploy.farm import DEPLOY, Farm
from tests.e2e.conftest import PATIENCE, opened, settled, state
from tests.e2e.test_scene import MESHES

DOCS = DEPLOY.parent / "docs" / "operations.md"
LIFTED = "() => window.__viserMutable?.nodePoseData['/rig/yoke/body']?.position?.[2]"
AERO = 0.295
"""Height of the Aero's pivot, m; the helicopter's is another."""
OPEN = "() => JSON.parse(document.documentElement.dataset.state).connection === 'open'"


@contextmanager
def tab(chromium: Browser, url: str) -> Iterator[tuple[Page, list[str]]]:
    """A tab with its scene, and the errors that it met."""
    context = chromium.new_context(viewport={"width": 1280, "height": 800}, ignore_https_errors=True)
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda message: message.type == "error" and errors.append(message.text))
    opened(page, url)
    yield page, errors
    context.close()


def scene(page: Page) -> Frame:
    frame = next(frame for frame in page.frames if "/scene/" in frame.url)
    frame.wait_for_function(f"() => ({MESHES})() > 0", timeout=PATIENCE)
    return frame


def placed(page: Page) -> list[float]:
    return [pole["re"] for pole in state(page)["poles"]]


def set_pole(page: Page, number: int, value: float) -> None:
    page.get_by_test_id(f"pole-field-{number}").fill(str(value))
    page.get_by_test_id(f"pole-field-{number}").press("Enter")
    settled(page)


def test_a_tab_whose_replica_is_killed_goes_on_elsewhere(farm: Farm, chromium: Browser, record_property):
    with tab(chromium, farm.url) as (page, errors):
        page.get_by_test_id("preset").select_option("quanser-aero-2")
        settled(page)
        set_pole(page, 2, -5.5)
        before = state(page)
        frame = scene(page)
        frame.wait_for_function(f"() => Math.abs(({LIFTED})() - {AERO}) < 1e-9")
        page.wait_for_function("() => location.hash.includes('5.5')")
        link = page.url
        session = page.evaluate("() => sessionStorage.getItem('heli2dof-scene')")
        victim = farm.home(session)
        sockets: list[str] = []
        page.on("websocket", lambda socket: sockets.append(socket.url))
        assert errors == []

        ended = perf_counter()
        victim.kill()
        page.wait_for_function(
            "() => JSON.parse(document.documentElement.dataset.state).connection === 'lost'"
        )
        page.wait_for_function(OPEN)
        back = perf_counter() - ended
        set_pole(page, 3, -6.5)
        asked = perf_counter() - ended
        assert farm.home(session) is not victim

        # Viser's page and the hub come back as well; the new replica has built the same rig.
        rebuilt = re.compile(rf"/scene/{session}(/hub.*)?$")
        page.wait_for_function("() => document.querySelector('[data-testid=scene-notice]').hidden !== false")
        deadline = perf_counter() + 40
        while len({url for url in sockets if rebuilt.search(url)}) < 2 and perf_counter() < deadline:
            page.wait_for_timeout(100)
        assert len({url for url in sockets if rebuilt.search(url)}) == 2, sockets
        frame.wait_for_function(f"() => Math.abs(({LIFTED})() - {AERO}) < 1e-9")
        whole = perf_counter() - ended
        after = state(page)
        assert after["preset"] == before["preset"] == "quanser-aero-2"
        assert placed(page)[1:3] == [-5.5, -6.5]
        assert all(f"session={session}" in url for url in sockets if "/api/v1/" in url)
        print(
            f"\ntab: connected after {back:.2f} s, answered after {asked:.2f} s, scene whole after {whole:.2f} s"
        )
        record_property("connected_s", round(back, 2))
        record_property("scene_s", round(whole, 2))

        # And the link alone, opened anew, shows what it showed before.
        with tab(chromium, link) as (again, none):
            assert placed(again) == [p["re"] for p in before["poles"]]
            assert state(again)["K"] == before["K"]
            assert none == []
