"""The page in a real browser: drag a pole with the mouse, see K, the plots and the rig follow."""

from __future__ import annotations

import socket

import pytest
from playwright.sync_api import Browser, Frame, Page, Route, expect

from tests.browser import (
    EMPTY,
    GONE,
    SEEN,
    UNDRAWN,
    goto,
    later,
    opened,
    settled,
    state,
    until_state,
    view,
    visited,
)
from tests.e2e.conftest import App, running_app
from tests.e2e.test_scene import rendered

POSE = """() => {
  const data = window.__viserMutable?.nodePoseData ?? {};
  const [yoke, body] = ["/rig/yoke", "/rig/yoke/body"].map((name) => data[name]?.wxyz);
  return yoke && body ? [-2 * Math.atan2(body[2], body[0]), -2 * Math.atan2(yoke[3], yoke[0])] : null;
}"""
TRACES = """(id) => {
  const canvas = document.querySelector(`[data-testid="${id}"] canvas`);
  return canvas.toDataURL();
}"""
PLOTS = ("plot-theta", "plot-psi", "plot-V_p", "plot-V_y")


def centre(page: Page, testid: str) -> tuple[float, float]:
    box = page.get_by_test_id(testid).bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def drag(page: Page, testid: str, dx: float, dy: float = 0.0, steps: int = 12) -> None:
    """Drags with the real mouse, over several moves."""
    x, y = centre(page, testid)
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + dx, y + dy, steps=steps)
    page.mouse.up()
    settled(page)


def scene(page: Page) -> Frame:
    """The scene's frame, its rig there and drawn a few times."""
    frame = page.wait_for_selector("iframe[src]").content_frame()
    assert frame is not None
    frame.wait_for_function(f"() => ({POSE})() !== null")
    rendered(frame, 12)
    return frame


def seek(page: Page, share: float) -> None:
    """Moves the time slider to a share of its length."""
    page.get_by_test_id("time").evaluate(
        "(slider, share) => { slider.value = Number(slider.max) * share;"
        " slider.dispatchEvent(new Event('input', { bubbles: true })); }",
        share,
    )


def test_dragging_a_pole_moves_gain_plots_and_rig(page_with_scene: Page):
    page = page_with_scene
    rig = scene(page)
    seek(page, 0.1)
    rig.wait_for_function(f"() => Math.abs(({POSE})()[1]) > 0.01")
    pose, before = rig.evaluate(POSE), state(page)
    traces = {plot: page.evaluate(TRACES, plot) for plot in PLOTS}
    shown = page.get_by_test_id("k-matrix").inner_text()

    drag(page, "pole-2", 60)

    after = state(page)
    assert after["poles"][2]["re"] > before["poles"][2]["re"] + 1
    assert after["poles"][:2] == before["poles"][:2]
    assert after["K"] != before["K"]
    assert page.get_by_test_id("k-matrix").inner_text() != shown
    for plot in PLOTS:
        assert page.evaluate(TRACES, plot) != traces[plot], plot
    seek(page, 0.1)
    rig.wait_for_function(f"(old) => Math.abs(({POSE})()[1] - old) > 1e-3", arg=pose[1])


def test_gain_shown_is_the_gain_of_the_poles_shown(page: Page, app: App):
    drag(page, "pole-0", -40)
    now = state(page)
    reply = page.request.post(app.url + "api/v1/gains", data={"poles": now["poles"]}).json()
    assert reply["K"] == now["K"]
    figures = page.get_by_test_id("k-matrix-00").inner_text().replace("−", "-")
    assert float(figures) == pytest.approx(reply["K"][0][0], rel=1e-3)


def test_conjugates_move_together_and_a_real_pair_can_turn_complex(page: Page):
    first, second = (centre(page, f"pole-{i}") for i in (0, 1))
    drag(page, "pole-0", second[0] - first[0], -60, steps=25)
    poles = state(page)["poles"]
    assert poles[0]["im"] == -poles[1]["im"] != 0
    assert poles[0]["re"] == poles[1]["re"]
    drag(page, "pole-0", -20, -20)
    moved = state(page)["poles"]
    assert moved[0]["im"] == -moved[1]["im"]
    assert moved[0]["re"] == moved[1]["re"] < poles[0]["re"]


def test_poles_move_by_keyboard_as_sliders_with_a_name(page: Page):
    pole = page.get_by_role("slider", name="yaw pole 3").first
    pole.focus()
    before = state(page)["poles"][2]["re"]
    page.keyboard.press("ArrowLeft")
    settled(page)
    after = state(page)["poles"][2]["re"]
    assert after < before
    assert "rad/s" in (pole.get_attribute("aria-valuetext") or "")


def test_two_tabs_do_not_disturb_each_other(page_with_scene: Page, app: App, chromium: Browser):
    page = page_with_scene
    with opened(chromium, app.url, scene=UNDRAWN, moving=True) as other:
        assert page.locator("iframe").get_attribute("src") != other.locator("iframe").get_attribute("src")
        mine, theirs = scene(page), scene(other)
        for tab in (page, other):
            seek(tab, 1.0)
        for rig in (mine, theirs):
            rig.wait_for_function(f"() => Math.abs(({POSE})()[0] - Math.PI / 18) < 5e-3")
        before, pose = state(page), mine.evaluate(POSE)

        drag(other, "pole-1", 30)
        seek(other, 0.05)
        theirs.wait_for_function(f"() => Math.abs(({POSE})()[0]) < 0.1")

        assert state(page) == before
        assert mine.evaluate(POSE) == pytest.approx(pose, abs=1e-6)


def test_inner_loop_alone_has_the_placed_poles_and_pi_moves_them(page: Page):
    assert len(state(page)["loopPoles"]) == 6
    page.get_by_test_id("outer-none").click()
    page.wait_for_function("() => JSON.parse(document.documentElement.dataset.state).outer === 'none'")
    settled(page)
    found = sorted(p["re"] for p in state(page)["loopPoles"])
    assert found == pytest.approx([-12, -10, -9.25, -8.76], abs=1e-6)


def test_unstable_pi_is_told_and_the_suggestion_mends_it(page: Page):
    for index, value in enumerate((-3, -2, -3, -2)):
        field = page.get_by_test_id(f"pole-field-{index}")
        field.fill(str(value))
        field.press("Enter")
    page.wait_for_function("() => JSON.parse(document.documentElement.dataset.state).stable === false")
    assert "pi_unstable" in state(page)["findings"]
    assert "unstable" in page.get_by_test_id("findings").inner_text()
    page.get_by_test_id("suggest-pi").click()
    page.wait_for_function("() => JSON.parse(document.documentElement.dataset.state).stable === true")
    settled(page)  # words are the server's
    assert "pi_unstable" not in state(page)["findings"]
    page.get_by_test_id("reset").click()
    page.wait_for_function("() => JSON.parse(document.documentElement.dataset.state).poles[0].re === -12")


def test_other_preset_changes_the_rig_and_tells_of_its_pairing(page_with_scene: Page):
    page = page_with_scene
    rig = scene(page)
    height = "() => window.__viserMutable.nodePoseData['/rig/yoke/body']?.position[2]"
    old = rig.evaluate(height)
    page.get_by_test_id("preset").select_option("quanser-aero")
    page.wait_for_function(
        "() => JSON.parse(document.documentElement.dataset.state).preset === 'quanser-aero'"
    )
    settled(page)
    assert state(page)["findings"] == ["pairing_cross"]
    assert "cross" in page.get_by_test_id("findings").inner_text()
    rig.wait_for_function(f"(old) => Math.abs(({height})() - old) > 1e-3", arg=old)


def test_formulas_are_typeset(page: Page):
    view(page, "derivation")
    formulas = page.get_by_test_id("formulas")
    formulas.locator("math").first.wait_for()
    assert formulas.locator("math").count() >= 12
    assert formulas.locator("mfrac").first.bounding_box()["height"] > 10


def test_bad_number_is_told_at_its_field_and_nothing_else_changes(page: Page):
    before = state(page)
    field = page.get_by_test_id("kp-pitch")
    field.fill("-1e9")
    expect(field).to_have_attribute("aria-invalid", "true")
    expect(page.locator("#kp-pitch-error")).not_to_be_empty()
    field.press("Enter")
    expect(field).to_have_value("30")
    assert state(page)["K"] == before["K"]


def test_playing_ends_at_the_end_in_real_time(page_with_scene: Page):
    page = page_with_scene
    scene(page)
    page.get_by_test_id("duration").fill("1")
    page.get_by_test_id("duration").press("Enter")
    until_state(page, "s.scenario.duration === 1")
    played, longest = page.evaluate(
        """async () => {
          const of = (id) => document.querySelector(`[data-testid=${id}]`);
          let [before, played, longest] = [await new Promise(requestAnimationFrame), 0, 0];
          of("replay").click();
          while (Number(of("time").value) < 0.999) {
            const now = await new Promise(requestAnimationFrame);
            const step = Math.min((now - before) / 1000, 1); // after a longer stall it goes on where it was
            [before, played, longest] = [now, played + step, Math.max(longest, step)];
          }
          return [played, longest];
        }"""
    )
    assert played + longest > 0.99 and played < 1.0 + 3 * longest
    assert page.get_by_test_id("hud-theta").inner_text().startswith("10.0")


def test_who_moves_time_after_a_change_keeps_it(chromium: Browser, app: App):
    """What plays by itself half a second after a change does not take the slider out of a hand."""
    with opened(chromium, app.url, moving=True) as page:
        clock = page.get_by_test_id("clock")
        for pole, share in (("-6", 0.4), ("-7", 0.6)):
            with later(page):
                page.get_by_test_id("pole-field-2").fill(pole)
                page.get_by_test_id("pole-field-2").press("Enter")
                settled(page)
                seek(page, share)
                held = clock.inner_text()
            assert clock.inner_text() == held
            expect(page.get_by_test_id("play")).to_have_attribute("aria-pressed", "false")


def test_no_request_leaves_the_server(chromium: Browser, app: App):
    with visited(chromium, UNDRAWN, SEEN) as visit:
        page = visit.page
        strangers: list[str] = []
        page.on("request", lambda r: r.url.startswith((app.url, "blob:", "data:")) or strangers.append(r.url))
        page.on("websocket", lambda s: f"127.0.0.1:{app.port}/" in s.url or strangers.append(s.url))
        goto(page, app.url)
        scene(page)
        page.goto(app.url + "docs")
        page.locator("#operations-design-gains_api_v1_gains_post").wait_for()
        assert strangers == []


@pytest.mark.parametrize("size", [(1280, 800), (1920, 1080)])
def test_the_main_loop_needs_no_scrolling(chromium: Browser, app: App, size: tuple[int, int]):
    with opened(chromium, app.url, size=size) as page:
        if size[0] < 1600:
            page.get_by_test_id("rga-opener").click()
        for testid in (
            "splane",
            *PLOTS,
            "scene",
            "k-matrix-03",
            "rga-matrix-11",
            "suggest-pi",
            "kp-yaw",
            "ti-yaw",
        ):
            box = page.get_by_test_id(testid).bounding_box()
            assert box is not None, testid
            assert box["x"] >= 0 and box["x"] + box["width"] <= size[0], testid
            assert box["y"] >= 0 and box["y"] + box["height"] <= size[1], testid
        assert page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth") <= 0


def test_rooms_that_did_not_come_are_fetched_again(chromium: Browser, app: App):
    with visited(chromium, EMPTY, SEEN) as visit:
        tries: list[str] = []

        def first_lost(route: Route) -> None:
            tries.append(route.request.url)
            route.abort() if len(tries) == 1 else route.continue_()

        visit.page.route("**/static/compare/index.js", first_lost)
        goto(visit.page, app.url)
        expect(visit.page.get_by_test_id("recording-sample")).to_be_attached()
        assert len(tries) == 2
        visit.forgive("net::ERR_FAILED")


def test_lost_server_is_told_edits_continue_and_are_sent_when_it_returns(chromium: Browser):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with visited(chromium, EMPTY, SEEN) as visit:
        page = visit.page
        lost = "() => JSON.parse(document.documentElement.dataset.state).connection !== 'open'"
        with running_app(port) as app:
            goto(page, app.url)
        page.wait_for_function(lost)
        field = page.get_by_test_id("pole-field-0")
        field.fill("-15")
        field.press("Enter")
        assert state(page)["settled"] is False
        with running_app(port):
            settled(page)
            assert state(page)["poles"][0]["re"] == -15
            assert state(page)["connection"] == "open"
        visit.forgive(GONE)


def test_a_drag_updates_many_times_a_second(page: Page, record_property):
    """Reports updates a second and pointer-to-plots latency; judges only that the drag is live."""
    page.evaluate("() => heli2dofStats.reset()")
    x, y = centre(page, "pole-0")
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(60):
        page.mouse.move(x - 40 + 40 * abs((k % 20) - 10) / 10, y)
    page.mouse.up()
    settled(page)
    summary = page.evaluate("() => heli2dofStats.summary()")
    for name in ("updates", "perSecond", "median", "p95"):
        record_property(name, summary[name])
    print(f"\na drag: {summary}")
    assert summary["updates"] >= 10


def test_uncertain_rigs_show_as_a_cloud_of_poles_and_a_band(page: Page):
    before = {plot: page.evaluate(TRACES, plot) for plot in ("plot-theta", "plot-V_p")}
    cloud = "() => [...document.querySelector('canvas.cloud').getContext('2d')"
    cloud += ".getImageData(0, 0, 500, 500).data].filter((v, i) => i % 4 === 3 && v > 0).length"
    page.get_by_test_id("spread").select_option("0.1")
    expect(page.get_by_test_id("cloud-words")).to_contain_text("2000 rigs: 100 % stable")
    assert page.evaluate(cloud) > 500
    assert page.evaluate(TRACES, "plot-theta") != before["plot-theta"]
    assert page.evaluate(TRACES, "plot-V_p") == before["plot-V_p"]
    drag(page, "pole-2", 60)
    expect(page.get_by_test_id("cloud-words")).to_contain_text("rigs")
    page.get_by_test_id("spread").select_option("0")
    page.wait_for_function(f"() => ({cloud})() === 0")
    expect(page.get_by_test_id("cloud-words")).to_be_empty()


def test_the_disk_margin_stands_behind_the_margins(page: Page, app: App):
    reply = page.request.post(app.url + "api/v1/evaluate", data={}).json()["sensitivity"]
    told = page.get_by_test_id("metric-margin-theta").get_attribute("title") or ""
    assert f"disk margin {reply['disk_margin']:.2f}" in told and "both motors" in told
