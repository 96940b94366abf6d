"""The address holds the design: it opens, walks back and forward, locks, and outlives the server."""

from __future__ import annotations

import json
import socket

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import EMPTY, GONE, SEEN, goto, reopened, settled, state, until_state, visited
from tests.e2e.conftest import App, running_app
from tests.e2e.test_page import drag

LINK = (
    "#v1&preset=quanser-2dof-manual&p=-5,-4,-3+2.5j,-3-2.5j&pi=15.6,0.2,47.6,0.167&set.m=1.5"
    "&theta0=5deg&method=tits-yang&step.theta=8deg&duration=6&motion=theta"
)


def set_field(page: Page, testid: str, value: str) -> None:
    field = page.get_by_test_id(testid)
    field.fill(value)
    field.press("Enter")


def until_hash(page: Page, part: str) -> None:
    page.wait_for_function("(part) => location.hash.includes(part)", arg=part)


def clipboard(page: Page, app: App) -> None:
    page.context.grant_permissions(["clipboard-read", "clipboard-write"], origin=app.url.rstrip("/"))


def test_a_link_opens_the_whole_state(page: Page, app: App):
    reopened(page, app.url + LINK)
    now = state(page)
    assert [(p["re"], p["im"]) for p in now["poles"]] == [(-5, 0), (-4, 0), (-3, 2.5), (-3, -2.5)]
    assert now["loops"] == {"pitch": {"kp": 15.6, "ti": 0.2}, "yaw": {"kp": 47.6, "ti": 0.167}}
    assert (now["parameters"], now["method"], now["motion"]) == ({"m": 1.5}, "tits-yang", "theta")
    assert now["theta0"] == pytest.approx(0.0872664626, abs=1e-9)
    expect(page.get_by_test_id("step-theta")).to_have_value("8")
    body = {
        "poles": now["poles"],
        "parameters": {"m": 1.5},
        "method": "tits-yang",
        "operating_point": {"theta": now["theta0"]},
    }
    assert page.request.post(app.url + "api/v1/gains", data=body).json()["K"] == now["K"]
    page.reload()
    settled(page)
    assert state(page)["K"] == now["K"]
    assert len(page.url) < 500


def test_back_and_forward_walk_through_designs(page: Page):
    start = state(page)
    entries = page.evaluate("() => history.length")
    drag(page, "pole-2", 60, steps=25)
    until_hash(page, "&p=")
    dragged = state(page)
    set_field(page, "kp-pitch", "20")
    until_hash(page, "&pi=20,")
    assert page.evaluate("() => history.length") == entries + 2  # a drag of 25 moves is one entry
    page.go_back()
    until_state(page, "s.loops.pitch.kp === 30")
    assert state(page)["K"] == dragged["K"]
    page.go_back()
    until_state(page, "s.poles[2].re === -9.25")
    assert state(page)["K"] == start["K"]
    page.go_forward()
    page.go_forward()
    until_state(page, "s.loops.pitch.kp === 20")
    page.get_by_test_id("undo").click()
    until_state(page, "s.loops.pitch.kp === 30")


def test_a_jump_within_the_page_keeps_the_design(page: Page):
    set_field(page, "pole-field-0", "-14")
    until_hash(page, "p=-14,")
    page.evaluate("() => { location.hash = 'eq-14'; }")  # as a link into the paper does
    until_hash(page, "&view=derivation&at=eq-14")
    page.wait_for_function("() => scrollY > 100")
    page.reload()
    settled(page)
    assert state(page)["poles"][0]["re"] == -14
    page.wait_for_function("() => scrollY > 100")
    page.go_back()
    until_state(page, "s.view === 'design'")
    assert state(page)["poles"][0]["re"] == -14


def test_keys_and_links_lead_to_views_and_back_leaves_them(page: Page, app: App):
    for key, name in (("c", "compare"), ("R", "rig"), ("m", "derivation"), ("e", "explore"), ("d", "design")):
        page.keyboard.press("g")
        page.keyboard.press(key)
        until_state(page, f"s.view === '{name}'")
        expect(page.get_by_test_id(f"view-{name}")).to_have_attribute("aria-current", "page")
        assert page.locator("[aria-current=page]").count() == 1
        expect(page.get_by_test_id("splane")).to_be_visible()  # at hand wherever one reads
    page.go_back()
    until_state(page, "s.view === 'explore'")
    page.reload()
    settled(page)
    assert state(page)["view"] == "explore"
    reopened(page, app.url + "#compare")
    assert state(page)["view"] == "compare"
    page.get_by_test_id("preset").focus()
    page.keyboard.press("g")  # in a field it is a letter
    page.keyboard.press("d")
    assert state(page)["view"] == "compare"


def test_copy_link_gives_the_link(page: Page, app: App):
    clipboard(page, app)
    set_field(page, "pole-field-0", "-14")
    until_hash(page, "p=-14,")
    page.get_by_test_id("copy-link").click()
    expect(page.get_by_test_id("copy-link")).to_have_text("Copied")
    expect(page.get_by_test_id("link-copied")).to_contain_text("in the clipboard")
    assert page.evaluate("() => navigator.clipboard.readText()") == page.url
    expect(page.get_by_test_id("copy-link")).to_have_text("Copy link")


def test_a_link_for_a_class_locks_what_was_ticked(page: Page, app: App):
    page.get_by_test_id("share").click()
    for name in ("preset", "loops", "poles"):
        page.get_by_test_id(f"lock-{name}").check()
    link = page.get_by_test_id("share-link").input_value()
    assert link.endswith("&lock=preset,poles,loops")
    page.keyboard.press("Escape")
    expect(page.get_by_test_id("popup")).to_be_hidden()
    expect(page.get_by_test_id("share")).to_be_focused()
    reopened(page, link)
    expect(page.get_by_test_id("locked")).to_have_text("locked: rig, poles, outer loops")
    for testid in (
        "preset",
        "pole-field-0",
        "kp-pitch",
        "ti-yaw-slider",
        "pairing",
        "suggest-pi",
        "outer-none",
    ):
        control = page.get_by_test_id(testid)
        expect(control).to_be_disabled()
        assert "Locked by the link" in (control.get_attribute("title") or ""), testid
    before = state(page)
    drag(page, "pole-0", -50)
    page.get_by_test_id("pole-1").focus()
    page.keyboard.press("ArrowLeft")
    assert state(page)["poles"] == before["poles"]
    page.get_by_test_id("method").select_option("tits-yang")
    until_state(page, "s.method === 'tits-yang'")


def test_a_link_restores_requirements(page: Page, app: App):
    page.get_by_test_id("requirements").click()
    page.get_by_test_id("require-settling").fill("0.4")
    until_hash(page, "req.settling=0.4")
    link = page.url
    reopened(page, link)
    expect(page.get_by_test_id("require-settling")).to_have_value("0.4")
    expect(page.get_by_test_id("require-overshoot")).to_have_value("")
    expect(page.get_by_test_id("requirements-verdict")).to_have_text("✕ pitch, yaw")
    assert page.get_by_test_id("forbidden-settling").count() == 1
    page.get_by_test_id("require-settling").fill("")
    page.wait_for_function("() => !location.hash.includes('req.')")
    expect(page.get_by_test_id("requirements-verdict")).to_have_text("")


def test_without_locks_each_control_is_as_its_panel_has_it(page: Page, app: App):
    link = app.url + "#v1&preset=quanser-2dof-manual&outer=none"
    reopened(page, link + "&lock=loops")
    expect(page.get_by_test_id("outer-pi")).to_be_disabled()
    page.evaluate("(hash) => { location.hash = hash }", link.split("#")[1])
    expect(page.get_by_test_id("locked")).to_be_hidden()
    settled(page)
    expect(page.get_by_test_id("outer-pi")).to_be_enabled()
    for testid in ("kp-pitch", "pairing"):  # of no use without outer loops
        expect(page.get_by_test_id(testid)).to_be_disabled()


def test_a_bad_part_is_told_and_the_rest_restored(page: Page, app: App):
    reopened(page, app.url + "#v1&p=-1,-2&duration=7&preset=quanser-2dof-manual")
    notice = page.get_by_test_id("notice")
    expect(notice).to_have_text(
        "Not taken from this link: p (four poles are needed, not 2). The rest is restored."
    )
    assert state(page)["scenario"]["duration"] == 7
    page.get_by_test_id("notice-close").click()
    expect(notice).to_be_hidden()
    page.evaluate("() => { location.hash = '#v9&p=1'; }")
    expect(notice).to_contain_text("made by a newer heli2dof")
    assert state(page)["scenario"]["duration"] == 7


@pytest.mark.parametrize("own", [True, False], ids=["own numbers", "none"])
def test_a_restarted_server_loses_nothing_and_gets_the_newest_edit_only(chromium: Browser, own: bool):
    """Whether the page has numbers of its own meanwhile, or its browser has no WebAssembly."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with visited(chromium, EMPTY, SEEN, "" if own else "delete window.WebAssembly") as visit:
        page = visit.page
        sent: list[list[dict]] = []  # by connection

        def watch(ws) -> None:
            if "live" in ws.url:
                own: list[dict] = []
                sent.append(own)
                ws.on("framesent", lambda frame: own.append(json.loads(frame)))

        page.on("websocket", watch)
        with running_app(port) as app:
            goto(page, app.url + (LINK.replace("&method=tits-yang", "") if own else LINK))
            old = state(page)
            if own:
                page.wait_for_function("() => document.documentElement.dataset.kernel === 'ready'")
        until = "() => JSON.parse(document.documentElement.dataset.state).connection === 'lost'"
        page.wait_for_function(until)
        expect(page.get_by_test_id("connection")).to_contain_text("your changes are kept")
        expect(page.get_by_test_id("stale")).to_be_hidden()  # what is shown is still the design's own
        sent.clear()
        for value in ("-15", "-16", "-17"):
            set_field(page, "pole-field-0", value)
        drag_without_answer(page, "pole-1", -30)
        now = state(page)
        assert now["settled"] is False
        assert now["poles"][0]["re"] == -17 and now["poles"][1]["re"] < -4
        if own:
            expect(page.get_by_test_id("stale")).to_be_hidden()
            assert now["local"] and now["K"] != old["K"]
        else:
            expect(page.get_by_test_id("stale")).to_contain_text("last answer")
            assert now["K"] == old["K"]  # what is shown is the last answer
        with running_app(port) as app:
            settled(page)
            after = state(page)
            # the newest alone, and once: again only where a first connection to the new server was lost, too
            asked = [[request["poles"] for request in own] for own in sent if own]
            assert asked and all(own == [now["poles"]] for own in asked)
            assert after["connection"] == "open"
            assert after["K"] != old["K"]
            expect(page.get_by_test_id("stale")).to_be_hidden()
            page.reload()
            settled(page)
            again = state(page)
            keys = ("poles", "loops", "parameters", "theta0", "method", "scenario", "motion", "K")
            assert {k: again[k] for k in keys} == {k: after[k] for k in keys}
        visit.forgive(GONE)


def drag_without_answer(page: Page, testid: str, dx: float) -> None:
    # an edit may have brought another view: it is drawn in the next frame
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    box = page.get_by_test_id(testid).bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + dx, y, steps=6)
    page.mouse.up()


def test_half_a_disturbance_opens_and_a_field_that_there_is_not_is_told(page: Page, app: App):
    reopened(
        page, app.url + "#v1&scenario.disturbance.V_p=2&scenario.disturbance.at=1&scenario.digital.delay=true"
    )
    expect(page.get_by_test_id("notice")).to_contain_text(
        "scenario.disturbance.at (no field of an experiment)"
    )
    expect(page.get_by_test_id("fault")).to_be_hidden()
    expect(page.get_by_test_id("experiment-words")).to_have_text(
        "digital rig, 2 ms, one sample late · disturbance 2 V (pitch) at 0 s"
    )
    assert state(page)["problem"] is None
