"""Any plant: pasted, dragged, typed, pinned, linked, saved; every textbook's gain on the page."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, expect

from heli2dof_core.systems.textbook import EXAMPLES
from tests.browser import EMPTY, SEEN, opened, view, visited
from tests.core.test_any_system import PRINTED
from tests.e2e.conftest import App
from tests.e2e.test_axe import RUN, violations

SPRING = "A = [0 1; -k/m -b/m];\nB = [0; 1/m];\nC = [1 0];\nk = 3, m = 2, b = 1\np = [-1+2i, -1-2i];"


def plant_of(page: Page) -> Page:
    if not page.get_by_test_id("plant-text").is_visible():
        view(page, "plant")
    page.get_by_test_id("plant-text").scroll_into_view_if_needed()
    page.get_by_test_id("plant-K").locator("td").nth(1).wait_for()
    return page


def shows(page: Page, name: str, *cells: str) -> None:
    expect(page.get_by_test_id(f"plant-{name}").locator("tbody td")).to_have_text(list(cells))


def typed(page: Page, text: str) -> None:
    page.get_by_test_id("plant-text").fill(text)


@pytest.fixture
def plant(page: Page) -> Page:
    return plant_of(page)


def test_the_textbooks_gains_stand_on_the_page(plant: Page):
    for name, printed in PRINTED.items():
        plant.get_by_test_id("plant-examples").select_option(name)
        expect(plant.get_by_test_id("plant-text")).to_have_value(EXAMPLES[name].text)
        plant.wait_for_function(
            """(printed) => {
              const cells = [...document.querySelectorAll('[data-testid=plant-K] tbody td')];
              const found = cells.map((cell) => Number(cell.textContent.replace('−', '-')));
              return cells.length === printed.length &&
                printed.every((v, i) => Math.abs(found[i] - v) <= 1e-3 * Math.abs(v));
            }""",
            arg=printed,
        )


def test_a_pole_is_moved_by_mouse_and_keys(plant: Page):
    typed(plant, SPRING)
    expect(plant.get_by_test_id("plant-poles")).to_have_value("−1 ± 2j")
    shows(plant, "K", "7.0000", "3.0000")
    handle = plant.get_by_test_id("plant-pole-0")
    handle.focus()
    plant.keyboard.press("ArrowLeft")
    expect(plant.get_by_test_id("plant-poles")).not_to_have_value("−1 ± 2j")
    expect(plant.get_by_test_id("plant-K").locator("tbody td").first).not_to_have_text("7.0000")
    at = plant.get_by_test_id("plant-mark-0").bounding_box()
    before = plant.get_by_test_id("plant-poles").input_value()
    x, y = at["x"] + at["width"] / 2, at["y"] + at["height"] / 2
    plant.mouse.move(x, y)
    plant.mouse.down()
    plant.mouse.move(x - 30, y - 10, steps=5)
    plant.mouse.up()
    expect(plant.get_by_test_id("plant-poles")).not_to_have_value(before)
    plant.get_by_test_id("plant-poles").fill("-3, -4")
    plant.get_by_test_id("plant-poles").press("Enter")
    shows(plant, "K", "21.000", "13.000")  # m p₁p₂ − k, −m (p₁ + p₂) − b


def test_what_is_wrong_is_told_where_it_is(chromium: Browser, app: App):
    with visited(chromium, EMPTY, SEEN) as visit:
        visit.forgive("422 (Unprocessable")
        visit.page.goto(app.url)
        wrong_texts(plant_of(visit.page))


def wrong_texts(plant: Page) -> None:
    typed(plant, "A = [0 1; -2 -3]\nB = [0; 2x]")
    expect(plant.get_by_test_id("plant-trouble")).to_contain_text("line 2, column 10")
    expect(plant.get_by_test_id("plant-trouble")).to_contain_text("2*x")
    typed(plant, "A = [-1 0; 0 -2]\nB = [1; 0]")
    expect(plant.get_by_test_id("plant-verdict")).to_contain_text("not the modes s = −2")
    expect(plant.get_by_test_id("plant-findings").locator("[data-code=uncontrollable]")).to_be_visible()
    plant.get_by_test_id("plant-poles").fill("-1, -2, -3")
    plant.get_by_test_id("plant-poles").press("Enter")
    expect(plant.locator("#plant-poles-error")).to_contain_text("3")


def test_letters_observer_methods_and_formulas(plant: Page):
    typed(plant, SPRING)
    expect(plant.get_by_test_id("plant-letter-m")).to_have_value("2")
    expect(plant.get_by_test_id("plant-closed").locator("math").first).to_be_visible()
    plant.get_by_test_id("plant-letter-m").fill("4")
    plant.get_by_test_id("plant-letter-m").press("Enter")
    expect(plant.get_by_test_id("plant-text")).to_have_value(re.compile("m = 4"))
    shows(plant, "K", "17.000", "7.0000")
    plant.get_by_test_id("plant-observer").check()
    expect(plant.get_by_test_id("plant-L")).to_be_visible()
    plant.get_by_test_id("plant-observer-poles").fill("-8, -9")
    plant.get_by_test_id("plant-observer-poles").press("Enter")
    shows(plant, "L", "16.750", "67.063")
    plant.get_by_test_id("plant-method").select_option("lqr")
    plant.get_by_test_id("plant-R").fill("0.01")
    plant.get_by_test_id("plant-R").press("Enter")
    expect(plant.get_by_test_id("plant-plane").locator(".loop-poles path")).to_have_count(2)
    expect(plant.get_by_test_id("plant-Q_z")).to_be_hidden()
    plant.get_by_test_id("plant-method").select_option("lqr-integral")
    expect(plant.get_by_test_id("plant-plane").locator(".loop-poles path")).to_have_count(3)
    shows(plant, "K_z", "10.000")  # the root of Q_z over R
    entered(plant, "Q_z", "4")
    shows(plant, "K_z", "20.000")
    entered(plant, "Q_z", "0")
    expect(plant.locator("#plant-Q_z-error")).to_contain_text("from")


def entered(page: Page, field: str, text: str) -> None:
    page.get_by_test_id(f"plant-{field}").fill(text)
    page.get_by_test_id(f"plant-{field}").press("Enter")


def test_undo_goes_back_in_the_plant_and_in_nothing_else(plant: Page):
    undo, redo = plant.get_by_test_id("undo"), plant.get_by_test_id("redo")
    poles, text = plant.get_by_test_id("plant-poles"), plant.get_by_test_id("plant-text")
    first = text.input_value()
    handle = plant.get_by_test_id("plant-pole-0")
    handle.click()  # moves nothing
    expect(undo).to_be_disabled()
    commented = SPRING + "  % a spring"
    typed(plant, commented.replace("m = 2", "m = 3"))
    expect(plant.get_by_test_id("plant-letter-m")).to_have_value("3")
    typed(plant, commented)  # and is one step with what was typed before
    expect(poles).to_have_value("−1 ± 2j")
    expect(plant.get_by_test_id("plant-letter-m")).to_have_value("2")
    entered(plant, "poles", "-3, -4")
    entered(plant, "x0", "[2; -1]")
    at = handle.bounding_box()
    plant.mouse.move(at["x"] + at["width"] / 2, at["y"] + at["height"] / 2)
    plant.mouse.down()
    plant.mouse.move(at["x"] + 20, at["y"] + at["height"] / 2, steps=6)
    plant.mouse.up()
    expect(poles).not_to_have_value("−3, −4")
    dragged = poles.input_value()
    view(plant, "design")
    expect(undo).to_be_disabled()
    view(plant, "plant")
    plant.keyboard.press("Control+z")
    expect(poles).to_have_value("−3, −4")
    expect(plant.get_by_test_id("plant-x0")).to_have_value("2 −1")
    undo.click()
    expect(plant.get_by_test_id("plant-x0")).to_have_value("1 0")
    undo.click()
    expect(poles).to_have_value("−1 ± 2j")
    expect(text).to_have_value(commented)
    shows(plant, "K", "7.0000", "3.0000")
    undo.click()
    expect(text).to_have_value(first)
    expect(undo).to_be_disabled()
    x0 = plant.get_by_test_id("plant-x0")
    for field, value in ((text, commented), (poles, "−3, −4"), (x0, "2 −1"), (poles, dragged)):
        plant.keyboard.press("Control+Shift+Z")
        expect(field).to_have_value(value)
    plant.wait_for_function("() => !location.hash.includes('p:-3,-4')")
    expect(text).to_have_value(commented)
    expect(redo).to_be_disabled()
    plant.go_back()
    expect(poles).to_have_value("−3, −4")


def test_a_response_begins_where_one_says(plant: Page):
    typed(plant, "A = [0 1; 0 0]; B = [0; 1]; C = [1 0]; p = [-1 -2]")
    shows(plant, "K", "2.0000", "3.0000")
    entered(plant, "x0", "0 -5")
    expect(plant.get_by_test_id("plant-time-view")).to_have_value("initial")
    plant.get_by_test_id("plant-y").locator("[tabindex]").focus()
    plant.keyboard.press("ArrowLeft")  # to the middle
    for _ in range(12):
        plant.keyboard.press("Shift+ArrowLeft")
    expect(plant.get_by_test_id("plant-y").locator(".value").nth(1)).to_have_text(re.compile("−5"))
    entered(plant, "x0", "1 2 3")
    expect(plant.locator("#plant-x0-error")).to_contain_text("3")
    entered(plant, "x0", "")
    expect(plant.get_by_test_id("plant-x0")).to_have_value("1 0")


def test_pins_are_in_the_link_and_outlast_a_reload(chromium: Browser, app: App, plant: Page):
    typed(plant, SPRING)
    shows(plant, "K", "7.0000", "3.0000")
    plant.get_by_test_id("plant-pin").click()
    entered(plant, "poles", "-3, -4")
    shows(plant, "K", "21.000", "13.000")
    plant.wait_for_function("() => /p:-3,-4.*&plant\\.pin=0~p:-1\\+2j,-1-2j$/.test(location.hash)")
    with opened(chromium, plant.url) as other:
        pins = plant_of(other).get_by_test_id("plant-pins")
        expect(pins.locator("tbody tr")).to_have_count(1)
        expect(pins).to_contain_text("7.000 3.000")
        other.get_by_test_id("plant-use-A").click()
        shows(other, "K", "7.0000", "3.0000")
        other.keyboard.press("Control+z")
        shows(other, "K", "21.000", "13.000")
        other.reload()
        expect(plant_of(other).get_by_test_id("plant-pins")).to_contain_text("7.000 3.000")
        other.get_by_test_id("plant-remove-A").click()
        other.wait_for_function("() => !location.hash.includes('pin')")
        expect(pins).to_be_hidden()


def test_pins_links_and_files(chromium: Browser, app: App, plant: Page, tmp_path: Path):
    typed(plant, SPRING)
    expect(plant.get_by_test_id("plant-poles")).to_have_value("−1 ± 2j")
    shows(plant, "K", "7.0000", "3.0000")
    plant.get_by_test_id("plant-pin").click()
    plant.get_by_test_id("plant-poles").fill("-3, -4")
    plant.get_by_test_id("plant-poles").press("Enter")
    shows(plant, "K", "21.000", "13.000")
    expect(plant.get_by_test_id("plant-pins").locator("tbody tr")).to_have_count(1)
    expect(plant.get_by_test_id("plant-pins")).to_contain_text("7.000 3.000")
    plant.wait_for_function("() => location.hash.includes('p:-3,-4')")
    with plant.expect_download() as saved:
        plant.get_by_test_id("plant-export-json").click()
    file = tmp_path / "design.json"
    saved.value.save_as(file)
    told = json.loads(file.read_text())
    assert (
        told["K"] == [[pytest.approx(21), pytest.approx(13)]] and "#v1&plant=A:0,1" in told["origin"]["link"]
    )
    with opened(chromium, told["origin"]["link"]) as other:
        plant_of(other)
        expect(other.get_by_test_id("plant-poles")).to_have_value("−3, −4")
        expect(other.get_by_test_id("plant-letter-m")).to_have_value("2")
    plant.get_by_role("button", name="Use pin A").click()
    expect(plant.get_by_test_id("plant-poles")).to_have_value("−1 ± 2j")


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_axe_finds_nothing(chromium: Browser, app: App, size: tuple[int, int]):
    with opened(chromium, app.url, size=size, color_scheme="dark") as page:
        plant_of(page)
        page.get_by_test_id("plant-observer").wait_for()
        page.get_by_test_id("plant-closed").locator("math").first.wait_for()
        page.get_by_test_id("plant-pin").click()
        assert violations(page) == []
        page.emulate_media(color_scheme="light")
        assert page.evaluate(RUN) == []
