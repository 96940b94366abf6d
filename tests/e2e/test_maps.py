"""Maps: what each place of the plane would give, in colour behind the poles and beside the PI loops."""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from playwright.sync_api import Browser, Page, Route, expect

from tests.browser import EMPTY, SEEN, opened, reopened, settled, state, visited
from tests.e2e.conftest import App
from tests.e2e.test_axe import violations
from tests.e2e.test_page import centre

WHOLE, OF_SERVER = 129 * 97, 17 * 13
COMPLEX = "&p=-6%2B3j,-6-3j,-4%2B2j,-4-2j&pi=20,0.4,20,0.4"
LARGE = (1280, 1000)
"""A window in which the PI loops' fields have room."""
PICTURE = """(selector) => {
  const canvas = document.querySelector(selector);
  if (!canvas?.width || canvas.hidden) return '';
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  let [sum, colors] = [0, new Set()];
  for (let i = 0; i < data.length; i += 4 * 7) {
    sum = (31 * sum + data[i] + 256 * data[i + 1] + 65536 * data[i + 2]) % 2147483647;
    if (data[i + 3] === 255) colors.add(data[i] + 256 * data[i + 1] + 65536 * data[i + 2]);
  }
  return colors.size > 8 ? String(sum) : '';
}"""
"""A checksum of a map; empty where none is painted."""
MAP, PAD = "canvas.map", "[data-testid=map-pitch-pi] canvas"


def painted(page: Page, nodes: int = WHOLE) -> str:
    """The plane's map, once it is whole."""
    page.wait_for_function(
        "(n) => document.querySelector('canvas.map')?.dataset.nodes === String(n)", arg=nodes
    )
    page.wait_for_function(f"() => ({PICTURE})('{MAP}')")
    return page.evaluate(PICTURE, MAP)


def another(page: Page, selector: str, before: str) -> str:
    """A map, once it is another than before."""
    page.wait_for_function(
        f"([selector, old]) => {{ const now = ({PICTURE})(selector); return now && now !== old; }}",
        arg=[selector, before],
    )
    return page.evaluate(PICTURE, selector)


@contextmanager
def mapped(chromium: Browser, app: App, link: str, size: tuple[int, int] = (1280, 800)) -> Iterator[Page]:
    with opened(chromium, f"{app.url}#v1{link}", size=size) as page:
        page.wait_for_function("() => document.documentElement.dataset.designs === 'ready'")
        yield page


def test_a_map_is_chosen_told_and_kept_in_the_link(chromium: Browser, app: App):
    with mapped(chromium, app, COMPLEX) as page:
        expect(page.locator(MAP)).to_be_hidden()
        page.get_by_test_id("map").click()
        settling = painted(page)
        expect(page.get_by_test_id("map-legend").get_by_role("img")).to_have_attribute(
            "aria-label", "Settling time, pitch step, nonlinear model"
        )
        expect(page.get_by_test_id("map-legend")).to_contain_text(re.compile(r"\d s"))
        box = page.get_by_test_id("splane").bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + 20, box["y"] + 60)
        expect(page.get_by_test_id("map-here")).to_have_text(re.compile(r"^(\d+\.\d\d s|not settled)$"))
        page.mouse.move(box["x"] + box["width"] - 5, box["y"] + 60)  # right of the imaginary axis
        expect(page.get_by_test_id("map-here")).to_be_hidden()
        page.get_by_test_id("map-name").select_option("V_peak")
        page.get_by_test_id("map-axis").select_option("psi")
        page.get_by_test_id("map-model").select_option("linear")
        voltage = another(page, MAP, settling)
        expect(page.get_by_test_id("map-legend")).to_contain_text("V")
        page.wait_for_function("() => location.hash.includes('map=V_peak,psi,linear')")
        reopened(page, page.url)
        painted(page)
        assert page.get_by_test_id("map-axis").input_value() == "psi"
        page.get_by_test_id("map").click()
        expect(page.locator(MAP)).to_be_hidden()
        expect(page.get_by_test_id("map-name")).to_be_hidden()
        page.wait_for_function("() => !location.hash.includes('map=')")
        assert voltage != settling


def test_the_valley_moves_with_the_other_pair_and_not_with_its_own(chromium: Browser, app: App):
    with mapped(chromium, app, f"{COMPLEX}&map=V_peak,both,pitch-pair") as page:
        before = painted(page)
        x, y = centre(page, "pole-0")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 30, y - 20, steps=4)
        page.mouse.up()
        settled(page)
        assert painted(page) == before, "its own place is no other map"
        x, y = centre(page, "pole-2")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 25, y, steps=5)
        moving = another(page, MAP, before)
        page.mouse.up()
        assert painted(page) not in ("", before)
        assert moving != before


def test_a_real_pair_has_a_plane_of_its_own_in_which_its_point_is_dragged(chromium: Browser, app: App):
    with mapped(chromium, app, "&map=overshoot") as page:
        painted(page)
        pad = page.get_by_test_id("map-pair")
        expect(pad).to_be_visible()
        page.wait_for_function(f"() => ({PICTURE})('[data-testid=map-pair] canvas')")
        box = pad.bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.4 * box["height"])
        page.mouse.down()
        page.mouse.move(box["x"] + 0.55 * box["width"], box["y"] + 0.5 * box["height"], steps=3)
        page.mouse.up()
        settled(page)
        first, second, *others = state(page)["poles"]
        assert first["im"] == second["im"] == 0 and first["re"] != -12 and second["re"] != -10
        assert [p["re"] for p in others] == [-9.25, -8.76]
        page.get_by_test_id("undo").click()
        settled(page)
        assert [p["re"] for p in state(page)["poles"]][:2] == [-12, -10], "a drag is one step of undo"


def test_what_is_said_of_a_pole_stands_under_the_map_and_the_pairs_plane_beside_the_poles(
    chromium: Browser, app: App
):
    with mapped(chromium, app, "&p=-12,-10,-9%2B1j,-9-1j&map=settling_time") as page:
        painted(page)
        plane = page.get_by_test_id("splane").bounding_box()
        assert plane is not None
        bottom = plane["y"] + plane["height"]
        note = page.get_by_test_id("lag-words").bounding_box()
        assert note is not None and note["y"] >= bottom - 1
        pad = page.get_by_test_id("map-pair").bounding_box()
        assert pad is not None and pad["y"] + pad["height"] < bottom
        for k in range(4):
            x, y = centre(page, f"pole-{k}")
            assert not (pad["x"] < x < pad["x"] + pad["width"] and pad["y"] < y < pad["y"] + pad["height"])
        page.mouse.move(*centre(page, "pole-2"))
        readout = page.get_by_test_id("readout")
        expect(readout).to_contain_text("−9.00 ± 1.00j rad/s", use_inner_text=True)
        box = readout.bounding_box()
        assert box is not None and box["y"] >= bottom - 1 and box["height"] < 30


def test_the_point_of_a_loop_is_dragged_over_its_map_and_keys_move_it(chromium: Browser, app: App):
    with mapped(chromium, app, f"{COMPLEX}&map=settling_time", size=LARGE) as page:
        page.wait_for_function(f"() => ({PICTURE})('{PAD}')")
        other = page.evaluate(PICTURE, "[data-testid=map-yaw-pi] canvas")
        before = state(page)["loops"]
        box = page.get_by_test_id("map-pitch-pi").bounding_box()
        assert box is not None
        page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.4 * box["height"])
        page.mouse.down()
        page.mouse.move(box["x"] + 0.75 * box["width"], box["y"] + 0.3 * box["height"], steps=4)
        page.mouse.up()
        settled(page)
        after = state(page)["loops"]
        assert after["yaw"] == before["yaw"]
        assert after["pitch"]["kp"] > before["pitch"]["kp"] and after["pitch"]["ti"] != before["pitch"]["ti"]
        another(page, "[data-testid=map-yaw-pi] canvas", other)
        page.get_by_test_id("kp-pitch-slider").focus()
        page.keyboard.press("ArrowRight")
        settled(page)
        assert state(page)["loops"]["pitch"]["kp"] > after["pitch"]["kp"]
        expect(page.get_by_test_id("kp-pitch")).to_be_visible()


def test_a_link_locks_what_the_fields_move(chromium: Browser, app: App):
    with mapped(chromium, app, f"{COMPLEX}&map=settling_time&lock=loops", size=LARGE) as page:
        page.wait_for_function(f"() => ({PICTURE})('{PAD}')")
        before = state(page)["loops"]
        box = page.get_by_test_id("map-pitch-pi").bounding_box()
        assert box is not None
        page.mouse.click(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
        assert state(page)["loops"] == before


def test_the_server_maps_what_the_page_cannot(chromium: Browser, app: App):
    with mapped(chromium, app, f"{COMPLEX}&map=overshoot&method=tits-yang") as page:
        painted(page, OF_SERVER)


def test_a_low_window_has_the_loops_fields_too_when_they_are_wanted(chromium: Browser, app: App):
    with mapped(chromium, app, COMPLEX) as page:
        field, button = page.get_by_test_id("map-pitch-pi"), page.get_by_test_id("map-fields")
        expect(button).to_be_hidden()
        high = "() => document.documentElement.scrollHeight"
        before = page.evaluate(high)
        page.get_by_test_id("map").click()
        painted(page)
        expect(field).to_be_hidden()
        assert page.evaluate(high) == before
        expect(button).to_have_attribute("aria-pressed", "false")
        button.click()
        page.wait_for_function(f"() => ({PICTURE})('{PAD}')")
        expect(field.locator(".pad-here")).to_have_text(re.compile(r"^\d+\.\d\d–\d+\.\d\d s$"))
        button.click()
        expect(field).to_be_hidden()
        page.get_by_test_id("map").click()
        expect(button).to_be_hidden()


def test_the_server_is_seen_to_compute_and_to_refuse_and_is_asked_again(chromium: Browser, app: App):
    with visited(chromium, EMPTY, SEEN) as visit:
        page, held = visit.page, []
        visit.forgive("503")

        def answer(route: Route) -> None:
            if held:
                route.continue_()
            else:
                held.append(route)

        page.route("**/api/v1/map*", answer)
        page.goto(f"{app.url}#v1{COMPLEX}&map=overshoot&method=tits-yang")
        settled(page)
        words, again = page.get_by_test_id("map-state"), page.get_by_test_id("map-again")
        expect(words).to_have_text("Map: computing on the server…")
        expect(again).to_be_hidden()
        expect(page.locator(MAP)).to_be_hidden()
        page.wait_for_function("() => document.documentElement.dataset.designs === 'ready'")
        held[0].fulfill(
            status=503,
            content_type="application/problem+json",
            body='{"status": 503, "title": "busy", "detail": "The server has too much to do."}',
        )
        expect(words).to_have_text(re.compile("^No map: .*too much to do"))
        assert not violations(page)
        again.click()
        painted(page, OF_SERVER)
        expect(words).to_have_text("")
        expect(again).to_be_hidden()


def test_without_a_map_of_the_plane_the_fields_have_a_legend(chromium: Browser, app: App):
    with mapped(chromium, app, f"{COMPLEX}&map=settling_time&method=lqr") as page:
        page.wait_for_function(f"() => ({PICTURE})('{PAD}')")
        legend = page.get_by_test_id("map-legend")
        expect(legend).to_contain_text(re.compile(r"\d s"))
        expect(legend.get_by_role("img")).to_have_attribute("aria-label", "Settling time")
        expect(page.get_by_test_id("save-map")).to_be_hidden()


def test_a_map_is_saved(chromium: Browser, app: App, tmp_path: Path):
    with mapped(chromium, app, f"{COMPLEX}&map=overshoot") as page:
        painted(page)
        for kind, beginning in (("svg", "<svg"), ("csv", "")):
            page.get_by_test_id("save-map").click()
            with page.expect_download() as download:
                page.get_by_test_id(f"save-map-{kind}").click()
            file = tmp_path / download.value.suggested_filename
            download.value.save_as(file)
            assert beginning in file.read_text("utf-8")[:200]
            page.keyboard.press("Escape")
        table = [row for row in csv.reader(file.read_text("utf-8").splitlines()) if row and row[0][:1] != "#"]
        assert len(table) == 1 + 64 * 48
