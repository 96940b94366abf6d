"""Several windows of one session: in step with the page, moved by a panel of their own; and the motion taken away."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from datetime import UTC, datetime, timedelta
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Download, Page

from tests.browser import GONE, SEEN, UNDRAWN, goto, opened, settled, state, visited
from tests.e2e.conftest import App, running_app
from tests.e2e.test_scene import ANGLES
from tests.patience import until


@pytest.fixture
def page(chromium: Browser, app: App) -> Iterator[Page]:
    """The page without its scene, which plays by itself as at everybody's."""
    with opened(chromium, app.url, moving=True) as page:
        yield page


WATCHED = """selector => {
  // When time 0 was, by the wall, as each change shows it at a quarter of the speed; seconds.
  window.starts = [];
  const node = document.querySelector(selector);
  new MutationObserver(() => {
    const t = parseFloat(node.textContent);
    if (t > 0.1 && t < 2.8) window.starts.push((performance.timeOrigin + performance.now()) / 1000 - 4 * t);
  }).observe(node, { childList: true, characterData: true, subtree: true });
}"""
SEEN_PLAYING = "() => window.starts.length >= 12"


@contextmanager
def window_of(page: Page, app: App, viewport: tuple[int, int] = (640, 420)) -> Iterator[Page]:
    """The rig in a window of its own, playing what the page shows; fails on any error in it."""
    session = page.evaluate("() => sessionStorage.getItem('heli2dof-scene')")
    window = page.context.new_page()
    window.add_init_script(UNDRAWN)
    window.set_viewport_size({"width": viewport[0], "height": viewport[1]})
    window.goto(f"{app.url}scene/{session}/")
    drawn(window)
    yield window
    window.close()


def drawn(window: Page) -> None:
    window.wait_for_selector("[data-testid=window-words]", state="hidden")
    window.wait_for_function("() => window.__viserMutable?.nodePoseData['/rig/yoke/body']?.wxyz")


def stands_at(window: Page, theta: float, psi: float, within: float = 1e-3) -> None:
    window.wait_for_function(
        f"([theta, psi, within]) => {{ const a = ({ANGLES})();"
        " return Math.hypot(a.theta - theta, a.psi - psi) < within; }",
        arg=[theta, psi, within],
    )


def seek(page: Page, time: float) -> None:
    page.get_by_test_id("time").evaluate(
        "(input, t) => { input.value = t; input.dispatchEvent(new Event('input')); }", time
    )


def poles(page: Page) -> list[float]:
    return [pole["re"] for pole in state(page)["poles"]]


def field(window: Page, label: str) -> Callable[[], float]:
    """The value that viser's panel shows beside a label."""
    return lambda: float(panel_input(window, label).input_value())


def panel_input(window: Page, label: str):
    row = window.locator("[data-floating-window], [data-dock-region]").get_by_text(label, exact=True)
    return row.locator("xpath=ancestor::*[.//input[@type='text' or @inputmode]][1]//input").last


def shows(window: Page, label: str, value: float) -> None:
    """Waits until the panel shows a value; a window that was rebuilt has another panel, so that each look is new."""
    reading = field(window, label)
    until(lambda: abs(reading() - value) < 1e-6, f"{label} does not become {value}")


def test_window_stands_where_the_page_stands(page: Page, app: App):
    with window_of(page, app) as window:
        seek(page, 0.0)
        stands_at(window, 0.0, 0.0)
        seek(page, 3.0)
        reference = state(page)["scenario"]["reference"]
        stands_at(window, reference["theta"], reference["psi"], 0.02)


def test_window_plays_in_step(page: Page, app: App):
    with window_of(page, app, (420, 320)) as window:
        page.get_by_test_id("speed").select_option("0.25")  # a motion of twelve seconds
        window.evaluate(WATCHED, "[data-testid=window-time]")
        page.evaluate(WATCHED, "[data-testid=clock]")
        known = 0.0  # by how much either may be wrong about the server's clock, when time runs from now on
        for either in (page, window):
            either.wait_for_function("() => document.documentElement.dataset.clockError < 0.1")
            known += float(either.evaluate("() => document.documentElement.dataset.clockError"))
        page.get_by_test_id("replay").click()
        starts = []
        for either in (page, window):
            either.wait_for_function(SEEN_PLAYING)
            starts.append(min(either.evaluate("() => window.starts")))  # the least late of what was drawn
        # A window puts up with being 0.12 s behind before it catches up; what is read has two digits.
        assert abs(starts[0] - starts[1]) < 0.12 + 0.04 + known


def test_panel_moves_the_page_and_the_page_the_panel(page: Page, app: App):
    with window_of(page, app) as window:
        shows(window, "p₁", poles(page)[0])
        panel_input(window, "p₁").fill("-6.5")
        panel_input(window, "p₁").press("Enter")
        page.wait_for_function(
            "() => JSON.parse(document.documentElement.dataset.state).poles[0].re === -6.5"
        )
        settled(page)
        gain = f"{state(page)['K'][0][0]:.4g}"
        window.wait_for_selector(f"td:has-text('{gain}')")
        page.get_by_test_id("pole-field-3").fill("-7.25")
        page.get_by_test_id("pole-field-3").press("Enter")
        shows(window, "p₄", -7.25)
        page.get_by_test_id("undo").click()
        page.get_by_test_id("undo").click()
        shows(window, "p₁", -12)


def test_buttons_of_the_panel_play_the_page(page: Page, app: App):
    with window_of(page, app) as window:
        page.get_by_test_id("loop").check()  # it does not end before it is looked at
        seek(page, 1.0)
        window.get_by_text("Replay", exact=True).click()
        page.wait_for_selector("[data-testid=play][aria-pressed=true]")
        window.get_by_text("Pause", exact=True).click()
        page.wait_for_selector("[data-testid=play][aria-pressed=false]")


def test_panel_works_on_where_the_page_has_gone(page: Page, app: App):
    with window_of(page, app) as window:
        shows(window, "p₁", -12)
        page.goto("about:blank")
        before = window.locator("table td").nth(1).inner_text()
        panel_input(window, "p₁").fill("-5")
        panel_input(window, "p₁").press("Enter")
        window.wait_for_function(
            "before => document.querySelectorAll('table td')[1].innerText !== before", arg=before
        )


def test_two_sessions_stay_apart(page: Page, app: App, chromium: Browser):
    with visited(chromium, UNDRAWN) as visit:
        other = visit.page
        other.goto(f"{app.url}scene/{'a-session-of-its-own'.ljust(24, '_')}/")
        drawn(other)
        with window_of(page, app) as window:
            shows(other, "p₁", -12)
            panel_input(window, "p₁").fill("-6.5")
            panel_input(window, "p₁").press("Enter")
            page.wait_for_function(
                "() => JSON.parse(document.documentElement.dataset.state).poles[0].re === -6.5"
            )
            settled(page)  # a new response plays from its start
            seek(page, 0.0)
            stands_at(window, 0.0, 0.0)
            panel_input(other, "p₂").fill("-4.5")
            panel_input(other, "p₂").press("Enter")
            shows(other, "p₁", -12)
            assert poles(page)[1] == -10


@pytest.mark.parametrize("kind", ["html", "viser"])
def test_motion_is_taken_away(page: Page, kind: str, tmp_path: Path):
    download = saved(page, kind)
    path = tmp_path / download.suggested_filename
    download.save_as(path)
    assert path.suffix == f".{kind}"
    assert path.stat().st_size > 20_000


def test_motion_plays_offline(page: Page, tmp_path: Path, chromium: Browser):
    reference = state(page)["scenario"]["reference"]
    path = tmp_path / "motion.html"
    saved(page, "html").save_as(path)
    with visited(chromium, UNDRAWN, size=(500, 400), offline=True) as visit:
        reader = visit.page
        asked: list[str] = []
        reader.on("request", lambda request: asked.append(request.url))
        began = datetime(2026, 1, 1, tzinfo=UTC)
        reader.clock.install(time=began)
        reader.clock.pause_at(began + timedelta(hours=1))  # viser plays by itself, by a clock that now stands
        reader.goto(path.as_uri())
        assert "poles −12, −10, −9.25, −8.76" in reader.title()
        seen: list[dict[str, float]] = []

        def plays() -> bool:
            reader.clock.run_for(100)
            seen.append(reader.evaluate(ANGLES))
            return seen[-1]["theta"] != 0

        until(plays, "it plays")
        for _ in range(30):
            plays()
        assert 0 < seen[-31]["psi"] < 0.5 * reference["psi"]
        assert max(a["theta"] for a in seen) > 1.05 * reference["theta"]  # with its overshoot
        assert seen[-1] == pytest.approx(reference, abs=1e-3)
        assert [url for url in asked if not url.startswith(("file:", "data:", "blob:"))] == []


def saved(page: Page, kind: str) -> Download:
    page.get_by_test_id("scene-menu").click()
    with page.expect_download() as waiting:
        page.get_by_test_id(f"save-motion-{kind}").click()
    page.keyboard.press("Escape")
    return waiting.value


def test_menu_gives_the_link_of_the_window(page: Page):
    page.get_by_test_id("scene-menu").click()
    session = page.evaluate("() => sessionStorage.getItem('heli2dof-scene')")
    assert page.get_by_test_id("window-link").input_value().endswith(f"/scene/{session}/")
    with page.context.expect_page() as opened:
        page.get_by_test_id("open-window").click()
    assert opened.value.url.endswith(f"/scene/{session}/")


def test_window_is_rebuilt_after_the_server_was_started_anew(chromium: Browser):
    with visited(chromium, UNDRAWN, SEEN) as visit:
        page = visit.page
        with running_app() as first:
            goto(page, first.url)
            page.get_by_test_id("preset").select_option("quanser-aero-2")
            settled(page)
            session = page.evaluate("() => sessionStorage.getItem('heli2dof-scene')")
            window = visit.context.new_page()
            window.goto(f"{first.url}scene/{session}/")
            drawn(window)
            window.evaluate("() => { window.kept = true; }")
        lifted = "() => window.__viserMutable.nodePoseData['/rig/yoke/body']?.position?.[2]"
        with running_app(first.port):
            page.wait_for_function(
                "() => JSON.parse(document.documentElement.dataset.state).connection === 'open'"
            )
            page.get_by_test_id("pole-field-2").fill("-5.5")
            page.get_by_test_id("pole-field-2").press("Enter")
            shows(window, "p₃", -5.5)
            window.wait_for_function(f"() => Math.abs(({lifted})() - 0.295) < 1e-9")  # the Aero's, again
            settled(page)
            seek(page, 0.0)
            stands_at(window, 0.0, 0.0)
            assert window.evaluate("() => window.kept")  # by itself, without a reload
        visit.forgive(GONE)
