"""A real tab behind nginx: its replica is killed and it goes on elsewhere; and the page below a path, over TLS."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path
from time import perf_counter

import pytest
from playwright.sync_api import Browser, Frame, Page, Route, expect

from tests.browser import SEEN, UNDRAWN, goto, opened, settled, state, visited
from tests.deploy.farm import DEPLOY, Farm, free_port, nginx
from tests.e2e.test_scene import MESHES, PARTS

DOCS = DEPLOY.parent / "docs" / "operations.md"
LIFTED = "() => window.__viserMutable?.nodePoseData['/rig/yoke/body']?.position?.[2]"
AERO = 0.295
"""Height of the Aero's pivot, m; the helicopter's is another."""
OPEN = "() => JSON.parse(document.documentElement.dataset.state).connection === 'open'"


def scene(page: Page) -> Frame:
    frame = page.wait_for_selector("iframe[src]").content_frame()
    assert frame is not None
    frame.wait_for_function(f"() => ({MESHES})() > 0")
    return frame


def placed(page: Page) -> list[float]:
    return [pole["re"] for pole in state(page)["poles"]]


def set_pole(page: Page, number: int, value: float) -> None:
    page.get_by_test_id(f"pole-field-{number}").fill(str(value))
    page.get_by_test_id(f"pole-field-{number}").press("Enter")
    settled(page)


def test_a_tab_whose_replica_is_killed_goes_on_elsewhere(farm: Farm, chromium: Browser, record_property):
    """Also where the first request to the new replica is lost."""
    with visited(chromium, UNDRAWN, SEEN) as visit:
        page = visit.page
        goto(page, farm.url)
        page.get_by_test_id("preset").select_option("quanser-aero-2")
        settled(page)
        set_pole(page, 2, -5.5)
        before = state(page)
        frame = scene(page)
        frame.wait_for_function(f"() => Math.abs(({LIFTED})() - {AERO}) < 1e-9")
        page.wait_for_function("() => location.hash.includes('-5.5')")
        link = page.url
        session = page.evaluate("() => sessionStorage.getItem('heli2dof-scene')")
        victim = farm.home(session)
        sockets: list[str] = []
        page.on("websocket", lambda socket: sockets.append(socket.url))
        assert visit.errors == []
        told: list[str] = []

        def lose_the_first(route: Route) -> None:
            told.append(route.request.url)
            if len(told) == 1:
                route.abort()
            else:
                route.continue_()

        page.route(f"**/scene/{session}/rig", lose_the_first)
        ended = perf_counter()
        with page.expect_websocket(lambda socket: "/api/v1/live" in socket.url):
            victim.kill()
        page.wait_for_function(OPEN)
        back = perf_counter() - ended
        set_pole(page, 3, -6.5)
        asked = perf_counter() - ended
        assert farm.home(session) is not victim

        # Viser's page and the hub come back as well; the new replica has built the same rig.
        rebuilt = re.compile(rf"/scene/{session}(/hub.*)?$")
        while len({url for url in sockets if rebuilt.search(url)}) < 2:
            page.wait_for_event("websocket")
        frame.wait_for_function(f"() => Math.abs(({LIFTED})() - {AERO}) < 1e-9")
        whole = perf_counter() - ended
        assert len(told) >= 2  # the request that was lost is made again
        after = state(page)
        assert after["preset"] == before["preset"] == "quanser-aero-2"
        assert placed(page)[2:] == [-5.5, -6.5]
        assert all(f"session={session}" in url for url in sockets if "/api/v1/" in url)
        print(
            f"\ntab: connected after {back:.2f} s, answered after {asked:.2f} s, scene whole after {whole:.2f} s"
        )
        record_property("connected_s", round(back, 2))
        record_property("scene_s", round(whole, 2))

        # And the link alone, opened anew, shows what it showed before.
        visit.errors.clear()  # the console tells of what the killed replica did not answer
        with opened(chromium, link) as again:
            assert placed(again) == [p["re"] for p in before["poles"]]
            assert state(again)["K"] == before["K"]


def snippet(heading: str, **replaced: str) -> str:
    """The configuration that docs/operations.md gives below a heading, with other addresses."""
    text = DOCS.read_text().split(f"\n## {heading}\n", 1)[1]
    found = re.search(r"```nginx\n(.*?)```", text, re.S)
    assert found is not None
    conf = found[1]
    for old, new in replaced.items():
        assert old in conf, f"{old} in\n{conf}"
        conf = conf.replace(old, new)
    return conf


@pytest.fixture
def below_a_path(farm: Farm, tmp_path: Path) -> Iterator[str]:
    """The address of a site that serves the app below /lab/, over TLS, as the documentation says."""
    certificate, key = tmp_path / "certificate.pem", tmp_path / "key.pem"
    new = ["openssl", "req", "-x509", "-newkey", "rsa:2048", "-nodes", "-days", "1", "-subj", "/CN=localhost"]
    subprocess.run([*new, "-out", certificate, "-keyout", key], check=True, capture_output=True)
    port = free_port()
    tls = snippet(
        "TLS",
        **{
            "listen 8443 ssl": f"listen 127.0.0.1:{port} ssl",
            "/etc/heli2dof/tls/fullchain.pem": str(certificate),
            "/etc/heli2dof/tls/key.pem": str(key),
        },
    )
    lab = snippet("Below a path", **{"http://127.0.0.1:8000/": farm.url})
    folders = "".join(
        f"{kind}_temp_path {kind};" for kind in ("proxy", "fastcgi", "uwsgi", "scgi", "client_body")
    )
    conf = tmp_path / "site.conf"
    conf.write_text(
        f"pid site.pid;\nevents {{}}\nhttp {{ access_log off; {folders}\nserver {{\n{tls}\n{lab}\n}} }}\n"
    )
    with nginx(tmp_path, conf, port):
        yield f"https://127.0.0.1:{port}/lab/"


def test_the_page_works_below_a_path_over_tls(below_a_path: str, chromium: Browser):
    with visited(chromium, UNDRAWN, SEEN, ignore_https_errors=True) as visit:
        page = visit.page
        sockets: list[str] = []
        asked: list[str] = []
        page.on("websocket", lambda socket: sockets.append(socket.url))
        page.on("request", lambda request: asked.append(request.url))
        goto(page, below_a_path)
        set_pole(page, 2, -5.5)
        assert placed(page)[2] == -5.5
        frame = scene(page)
        frame.wait_for_function(f"() => ({MESHES})() >= {PARTS}")
        page.wait_for_function("() => location.hash.includes('-5.5')")

        page.get_by_test_id("export").click()
        with page.expect_download() as download:
            page.get_by_test_id("export-json").click()
        assert json.loads(Path(download.value.path()).read_bytes())["gains"]["K"] == state(page)["K"]
        page.keyboard.press("Escape")
        page.get_by_test_id("scene-menu").click()
        with page.expect_download() as motion:
            page.get_by_test_id("save-motion-viser").click()
        assert Path(motion.value.path()).stat().st_size > 1000
        session = page.evaluate("() => sessionStorage.getItem('heli2dof-scene')")
        assert page.get_by_test_id("window-link").input_value() == f"{below_a_path}scene/{session}/"

        page.goto(f"{below_a_path}docs")
        expect(page.locator(".swagger-ui .opblock").first).to_be_visible()
        secure = below_a_path.replace("https:", "wss:")
        assert {url.split("?")[0].removeprefix(secure) for url in sockets} >= {
            "api/v1/live",
            f"scene/{session}",
            f"scene/{session}/hub",
        }
        own = [url for url in asked + sockets if not url.startswith(("data:", "blob:"))]
        assert [url for url in own if not url.startswith((below_a_path, secure))] == []
