"""The view Fly in a real browser: a flight begins, is changed, frozen, taken back, kept, opened and watched."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import EMPTY, SEEN, UNDRAWN, goto, opened, reopened, settled, state, view, visited
from tests.e2e.conftest import App
from tests.e2e.flying import HEARD, did, fly, waits
from tests.e2e.test_axe import RUN, violations
from tests.e2e.test_scene import ANGLES
from tests.e2e.test_windows import window_of

COPIED = """if (navigator.clipboard)
  navigator.clipboard.writeText = async (text) => { window.copied = text; };"""
CHANGED = re.compile(r"^p₃ changed at \d+\.\d s: V_y would have jumped by \d+\.\d V; it did not\.$")


@pytest.fixture
def page(chromium: Browser, app: App) -> Iterator[Page]:
    """The view Fly, its scene's frame empty, before the first flight."""
    with opened(chromium, f"{app.url}#fly", scene=HEARD + COPIED + EMPTY) as page:
        yield page


def mode(page: Page, wanted: str) -> None:
    page.wait_for_function("(mode) => window.flight?.state.mode === mode", arg=wanted)


def move_third_pole(page: Page, to: float) -> None:
    field = page.get_by_test_id("pole-field-2")
    field.fill(str(to))
    field.press("Enter")


def away(page: Page) -> None:
    """It flies, with set points elsewhere than it hovered at first."""
    fly(page)
    page.evaluate("() => window.flight.do('reference', 0.17, 0.35)")


def flown(page: Page, seconds: float = 1.0) -> None:
    """A flight with a change in the air, ended."""
    away(page)
    move_third_pole(page, -4)
    page.wait_for_function("() => window.flight.craft.takeovers.length === 1")
    waits(page, "craft.time > arg", seconds)
    page.get_by_test_id("fly-end").click()
    mode(page, "ended")


def keep(page: Page, what: str) -> None:
    page.get_by_test_id("fly-keep").click()
    page.get_by_test_id(f"fly-{what}").click()


def test_enter_begins_a_flight_and_space_freezes_it(page: Page):
    page.get_by_test_id("fly").wait_for()
    page.locator("body").press("Enter")
    mode(page, "flying")
    expect(page.get_by_test_id("fly-status")).to_have_text("Flying.")
    expect(page.get_by_test_id("fly")).to_be_hidden()
    page.get_by_test_id("stick-yaw").focus()
    page.keyboard.press("Space")
    mode(page, "frozen")
    expect(page.get_by_test_id("fly-status")).to_contain_text("Frozen at")
    frozen = page.evaluate("() => window.flight.craft.tick")
    page.get_by_test_id("fly-step").click()
    assert page.evaluate("() => window.flight.craft.tick") == frozen + 1
    page.get_by_test_id("fly-freeze").click()
    mode(page, "flying")


def test_r_takes_off_from_a_link_too(page: Page):
    page.get_by_test_id("fly").wait_for()
    page.get_by_test_id("view-fly").focus()
    page.keyboard.press("r")
    mode(page, "flying")


def test_it_hovers_where_it_stands_until_a_hand_moves_it(page: Page):
    asked = state(page)["scenario"]["reference"]
    assert asked["theta"] and asked["psi"], "an experiment that steps"
    fly(page)
    waits(page, "craft.time > 1")
    assert (
        page.evaluate("() => [...window.flight.craft.reference, window.flight.craft.theta]")
        == [pytest.approx(0, abs=1e-12)] * 3
    )
    log = page.evaluate("() => window.flight.log()")
    assert log["events"] == [[0, "reference", 0, 0]]
    assert log["design"]["scenario"]["reference"] == asked, "a link tells the experiment as it is"


def test_a_change_in_the_air_is_told_with_the_jump_that_did_not_come(page: Page):
    away(page)
    waits(page, "craft.time > 1.5")  # at rest there
    move_third_pole(page, -4)
    expect(page.get_by_test_id("fly-changes").locator("li")).to_have_text([CHANGED])
    jump = page.evaluate("() => window.flight.craft.takeovers[0].jump.map(Math.abs)")
    assert max(jump) <= 1e-9
    page.get_by_test_id("undo").click()
    expect(page.get_by_test_id("fly-changes").locator("li")).to_have_text([CHANGED, CHANGED])


def test_another_rig_ends_the_flight_and_another_view_holds_it(page: Page):
    fly(page)
    view(page, "design")
    mode(page, "frozen")
    tick = page.evaluate("() => window.flight.craft.tick")
    view(page, "fly")
    assert page.evaluate("() => window.flight.craft.tick") == tick
    page.get_by_test_id("preset").select_option(index=1)
    mode(page, "ended")
    expect(page.get_by_test_id("fly-why")).to_have_text("Another rig was chosen.")


def test_who_looks_back_flies_on_from_there(page: Page):
    fly(page)
    waits(page, "craft.time > 2")
    page.get_by_test_id("fly-past").evaluate(
        "(slider) => { slider.value = '-1'; slider.dispatchEvent(new Event('input')); }"
    )
    mode(page, "frozen")
    now = page.evaluate("() => window.flight.craft.time")
    shown = float(page.get_by_test_id("fly-time").inner_text().removesuffix(" s"))
    assert abs(shown - (now - 1)) < 0.11
    page.get_by_test_id("fly-past").evaluate("(slider) => slider.dispatchEvent(new Event('change'))")
    waits(page, "Math.abs(craft.time - arg) < 0.11", now - 1)


def test_a_link_flies_the_flight_again_to_the_same_states(page: Page, app: App):
    flown(page)
    log = page.evaluate("() => window.flight.log()")
    keep(page, "link")
    expect(page.get_by_test_id("fly-kept")).to_have_text("Copied.")
    link = page.evaluate("() => window.copied")
    assert len(link) < 4000
    reopened(page, link)
    mode(page, "replaying")
    assert state(page)["view"] == "fly"
    assert state(page)["poles"][2] != {"re": -4, "im": 0}, "the design with which it began"
    mode(page, "ended")
    assert page.evaluate("() => window.flight.state.apart") <= 1e-9
    assert page.evaluate("() => window.flight.craft.tick") == log["ticks"]
    expect(page.get_by_test_id("fly-changes").locator("li")).to_have_text([re.compile("^p₃ changed at")])
    expect(page.get_by_test_id("fly")).to_have_text("Fly it yourself")
    packed = link.split("flight-")[1]
    other = "B" if packed[40] == "A" else "A"
    reopened(page, f"{app.url}#flight-{packed[:40]}{other}{packed[41:]}")
    expect(page.get_by_test_id("fly-problem")).to_have_text(re.compile("damaged"))


def test_a_file_flies_again_and_an_edited_one_is_told(page: Page, tmp_path: Path):
    flown(page)
    page.get_by_test_id("fly-keep").click()
    with page.expect_download() as download:
        page.get_by_test_id("fly-save").click()
    file = tmp_path / "kept.flight.json"
    download.value.save_as(file)
    log = json.loads(file.read_text())
    page.get_by_test_id("fly-file").set_input_files(file)
    mode(page, "replaying")
    mode(page, "ended")
    assert page.evaluate("() => window.flight.state.apart") <= 1e-9
    log["checks"][-1][1] += 1e-6
    file.write_text(json.dumps(log))
    page.get_by_test_id("fly-file").set_input_files(file)
    expect(page.get_by_test_id("fly-kept")).to_have_text(re.compile("damaged or edited"))


def test_the_server_flies_it_alike_and_makes_a_recording_of_it(page: Page):
    flown(page, 2.0)
    keep(page, "check")
    told = page.get_by_test_id("fly-kept")
    expect(told).to_have_text(re.compile(r"differs by at most .* rad\. SHA-256 [0-9a-f]{16}…$"))
    apart = re.search(r"at most (\S+) rad", told.inner_text())
    assert apart and float(apart[1].replace("−", "-").replace("·10", "e")) <= 1e-9
    page.get_by_test_id("fly-recording").click()
    page.wait_for_function("() => document.documentElement.dataset.view === 'rig'")
    expect(page.get_by_test_id("recording-status")).to_contain_text("rows")


def test_a_window_watches_the_flight_and_flies_along(chromium: Browser, app: App):
    with visited(chromium, SEEN, HEARD, UNDRAWN) as visit:
        page = visit.page
        goto(page, f"{app.url}#fly")
        page.get_by_test_id("show-scene").uncheck()  # one scene is enough for one processor
        with window_of(page, app) as window:
            fly(page)
            window.get_by_test_id("partner").wait_for()
            did(page)
            window.bring_to_front()
            window.keyboard.down("ArrowRight")
            page.wait_for_function("() => window.did.some(([word, , yaw]) => word === 'turn' && yaw > 0)")
            page.wait_for_function("() => window.flight.craft.psi > 0.5")
            window.keyboard.up("ArrowRight")
            page.wait_for_function("() => window.did.at(-1)[0] === 'turn' && window.did.at(-1)[2] === 0")
            page.evaluate("() => window.flight.freeze()")
            psi = page.evaluate("() => window.flight.craft.psi")
            window.wait_for_function(f"(psi) => Math.abs(({ANGLES})().psi - psi) < 0.02", arg=psi)
            page.evaluate("() => window.flight.go()")
            window.get_by_role("button", name="Nose down").focus()
            window.keyboard.down("Space")
            page.wait_for_function("() => window.did.at(-1)[1] < 0")
            window.keyboard.up("Space")
            page.wait_for_function("() => window.did.at(-1)[1] === 0")
            window.keyboard.down("ArrowLeft")
            page.wait_for_function("() => window.did.at(-1)[2] < 0")
        page.wait_for_function("() => window.did.at(-1)[2] === 0")  # who has gone holds nothing


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_violation(chromium: Browser, app: App, scheme: str):
    with opened(chromium, f"{app.url}#fly", scene=HEARD + EMPTY, color_scheme=scheme) as page:
        page.get_by_test_id("fly").wait_for()
        assert violations(page) == []
        flown(page)
        assert page.evaluate(RUN) == []
        page.get_by_test_id("fly-keep").click()
        assert page.evaluate(RUN) == []


@pytest.mark.parametrize("size", [(1280, 800), (1600, 1000), (820, 1180), (390, 844)])
def test_nothing_scrolls_where_there_is_room_and_nothing_sideways_anywhere(
    chromium: Browser, app: App, size: tuple[int, int]
):
    with opened(chromium, f"{app.url}#fly", scene=HEARD + EMPTY, size=size) as page:
        fly(page)
        settled(page)
        box = page.evaluate(
            "() => [document.documentElement.scrollWidth - innerWidth,"
            " document.documentElement.scrollHeight - innerHeight]"
        )
        assert box[0] <= 0
        if size[0] > 1179:
            assert box[1] <= 0
        scene, bar = (page.locator(name).bounding_box() for name in ("#scene", ".fly-bar"))
        assert scene and bar and scene["height"] >= 240
        assert scene["y"] + scene["height"] <= bar["y"] + 1
