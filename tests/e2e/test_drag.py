"""The s-plane under hand: mouse, fingers and keys as a browser delivers them."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, CDPSession, Page, expect

from tests.browser import opened, settled, state
from tests.e2e.conftest import App

Point = tuple[float, float]


def centre(page: Page, testid: str) -> Point:
    box = page.get_by_test_id(testid).bounding_box()
    assert box is not None
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def poles(page: Page) -> list[dict[str, float]]:
    settled(page)
    return state(page)["poles"]


def press(page: Page, *keys: str) -> list[dict[str, float]]:
    for key in keys:
        page.keyboard.press(key)
    return poles(page)


def scale(page: Page) -> float:
    """Pixels per rad/s, by two poles of the start."""
    return (centre(page, "pole-1")[0] - centre(page, "pole-0")[0]) / 2


class Fingers:
    """Touches as the browser gets them from a screen."""

    def __init__(self, cdp: CDPSession) -> None:
        self.cdp = cdp

    def send(self, kind: str, *points: Point) -> None:
        touches: list[dict[str, Any]] = [{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(points)]
        self.cdp.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": touches})

    def glide(self, starts: list[Point], ends: list[Point], steps: int = 12) -> None:
        for k in range(1, len(starts) + 1):  # fingers land one after the other
            self.send("touchStart", *starts[:k])
        for k in range(1, steps + 1):
            part = k / steps
            pairs = zip(starts, ends, strict=True)
            self.send("touchMove", *[(a + part * (c - a), b + part * (d - b)) for (a, b), (c, d) in pairs])
        self.send("touchEnd")


@pytest.fixture
def phone(chromium: Browser, app: App) -> Iterator[tuple[Page, Fingers]]:
    with opened(chromium, app.url, size=(390, 844), has_touch=True) as page:
        yield page, Fingers(page.context.new_cdp_session(page))


def test_a_finger_drags_a_pole_and_its_meaning_is_read_beside_it(phone: tuple[Page, Fingers]):
    page, fingers = phone
    x, y = centre(page, "pole-0")
    before = poles(page)
    fingers.send("touchStart", (x - 14, y + 18))  # beside the mark: fingers are wide
    for k in range(1, 9):
        fingers.send("touchMove", (x - 14 - 5 * k, y + 18))
    expect(page.get_by_test_id("readout")).to_contain_text(
        re.compile("pitch pole 1.*ζ 1.00.*alone: settles in.*with PI: goes to.*with PI: settles in", re.S)
    )
    assert state(page)["dragging"] is True
    scale = scale_of(before, page)  # once the finger has left, the view may be another
    fingers.send("touchEnd")
    after = poles(page)
    assert after[0]["re"] == pytest.approx(before[0]["re"] - 40 / scale, abs=0.3)
    assert after[1:] == before[1:]
    assert state(page)["dragging"] is False


def scale_of(before: list[dict[str, float]], page: Page) -> float:
    """Pixels per rad/s, by two poles that did not move."""
    return (centre(page, "pole-3")[0] - centre(page, "pole-1")[0]) / (before[3]["re"] - before[1]["re"])


def test_a_vertical_drag_of_a_complex_pole_by_finger_does_not_scroll_the_page(phone: tuple[Page, Fingers]):
    page, fingers = phone
    page.get_by_test_id("mode-pitch-complex").click()
    page.get_by_test_id("splane").scroll_into_view_if_needed()
    before, scrolled = poles(page), page.evaluate("scrollY")
    x, y = centre(page, "pole-0")
    fingers.glide([(x, y)], [(x, y - 30)])
    after = poles(page)
    assert after[0]["im"] > before[0]["im"] + 0.5
    assert after[1]["im"] == -after[0]["im"]
    assert page.evaluate("scrollY") == scrolled


def test_two_fingers_zoom_and_pan_and_move_no_pole(phone: tuple[Page, Fingers]):
    page, fingers = phone
    box = page.get_by_test_id("splane").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] * 0.8
    page.get_by_test_id("fit").tap()
    before, one = poles(page), scale(page)
    fingers.glide([(x - 30, y), (x + 30, y)], [(x - 90, y), (x + 90, y)])
    assert scale(page) == pytest.approx(3 * one, rel=0.02)
    left = centre(page, "pole-0")[0]
    fingers.glide([(x - 30, y), (x + 30, y)], [(x + 20, y), (x + 80, y)])
    assert scale(page) == pytest.approx(3 * one, rel=0.02)
    assert centre(page, "pole-0")[0] == pytest.approx(left + 50, abs=2)
    assert poles(page) == before
    page.get_by_test_id("fit").tap()
    assert scale(page) == pytest.approx(one, rel=0.02)


def test_a_pinch_that_begins_on_a_pole_zooms_as_well(phone: tuple[Page, Fingers]):
    page, fingers = phone
    before, one = poles(page), scale(page)
    x, y = centre(page, "pole-0")
    fingers.glide([(x, y), (x + 80, y + 40)], [(x - 20, y), (x + 140, y + 80)])
    assert scale(page) > 1.5 * one
    assert poles(page) == before
    assert state(page)["dragging"] is False


def test_one_finger_beside_the_poles_leaves_the_plane_alone(phone: tuple[Page, Fingers]):
    page, fingers = phone
    before, one = poles(page), scale(page)
    box = page.get_by_test_id("splane").bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] * 0.9
    fingers.glide([(x, y)], [(x, y - 60)])
    assert poles(page) == before
    assert scale(page) == pytest.approx(one)


def test_the_mouse_pans_and_zooms_and_fit_brings_the_view_back(page: Page):
    box = page.get_by_test_id("splane").bounding_box()
    assert box is not None
    x, y, one, start = box["x"] + 60, box["y"] + 60, scale(page), centre(page, "pole-0")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 45, y + 20, steps=5)
    page.mouse.up()
    expect(page.get_by_test_id("pole-mark-0")).to_be_visible()
    moved = centre(page, "pole-0")
    assert (moved[0] - start[0], moved[1] - start[1]) == pytest.approx((45, 20), abs=1)
    page.mouse.move(*moved)
    page.mouse.wheel(0, -300)
    right = "document.querySelector('[data-testid=pole-1]').getBoundingClientRect().right"
    page.wait_for_function(f"(x) => {right} > x", arg=moved[0] + 2.4 * one + 28)
    assert centre(page, "pole-0") == pytest.approx(moved, abs=1)  # what is under the pointer stays there
    page.get_by_test_id("fit").click()
    assert centre(page, "pole-0") == pytest.approx(start, abs=1)


def test_keys_move_fine_and_coarse_and_the_slider_says_where(page: Page):
    pole = page.get_by_role("slider", name="pitch pole 1", exact=True)
    assert pole.get_attribute("aria-valuetext") == "pitch pole 1: −12.0 rad/s"
    pole.focus()
    start = poles(page)[0]["re"]
    step = press(page, "ArrowRight")[0]["re"] - start
    assert step > 0
    assert press(page, "Shift+ArrowRight")[0]["re"] - start - step == pytest.approx(step / 10, rel=1e-3)
    press(page, "ArrowLeft", "Shift+ArrowLeft")
    assert press(page, "PageDown")[0]["re"] - start == pytest.approx(-10 * step, rel=1e-3)
    assert pole.get_attribute("aria-valuenow") == str(state(page)["poles"][0]["re"]).removesuffix(".0")


def test_by_keys_alone_a_pair_meets_turns_complex_and_real_again(page: Page):
    page.get_by_test_id("pole-2").focus()
    for _ in range(20):
        now = press(page, "ArrowRight")
        if now[2]["re"] == now[3]["re"]:
            break
    assert now[2]["re"] == now[3]["re"] == -8.76
    risen = press(page, "ArrowUp", "ArrowUp")
    assert risen[2]["im"] == -risen[3]["im"] > 0
    assert page.get_by_test_id("pole-2").get_attribute("aria-valuetext") == (
        f"yaw pole 3: −8.8 + {risen[2]['im']:.1f}j rad/s"
    )
    assert all(p["im"] == 0 for p in press(page, "ArrowDown", "ArrowDown"))


@pytest.mark.parametrize(
    ("undo", "redo"),
    [("Control+z", "Control+Shift+z"), ("Control+z", "Control+y"), ("Meta+z", "Meta+Shift+z")],
)
def test_undo_and_redo_by_keys_take_whole_gestures(page: Page, undo: str, redo: str):
    start = poles(page)
    x, y = centre(page, "pole-0")
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x - 50, y, steps=10)
    page.mouse.up()
    dragged = poles(page)
    assert dragged != start
    page.keyboard.down("ArrowLeft")  # held: one gesture, however often it repeats
    page.keyboard.down("ArrowLeft")
    page.keyboard.up("ArrowLeft")
    stepped = poles(page)
    assert press(page, undo) == dragged
    assert press(page, undo) == start
    assert press(page, redo) == dragged
    assert press(page, redo) == stepped
    page.get_by_test_id("undo").click()
    assert poles(page) == dragged
    page.get_by_test_id("redo").click()
    assert poles(page) == stepped


def test_a_complex_pair_dragged_onto_the_axis_turns_real(page: Page):
    page.get_by_test_id("mode-yaw-complex").click()
    assert poles(page)[2]["im"] > 0
    x, y = centre(page, "pole-2")
    middle = centre(page, "pole-0")[1]
    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x, middle + 2, steps=10)
    page.mouse.up()
    found = poles(page)
    assert found[2]["im"] == found[3]["im"] == 0
    assert found[2]["re"] == found[3]["re"]


def test_where_marks_overlap_the_one_on_top_is_taken(page: Page):
    for index, value in ((0, "-9"), (1, "-9.1"), (2, "-9"), (3, "-9.1")):
        field = page.get_by_test_id(f"pole-field-{index}")
        field.fill(value)
        field.press("Enter")
    poles(page)
    page.get_by_test_id("fit").click()
    page.get_by_test_id("pole-0").focus()
    for key, index in (("3", 2), ("2", 1), ("4", 3), ("1", 0)):
        press(page, key)
        expect(page.get_by_test_id(f"pole-{index}")).to_be_focused()
        x, y = centre(page, "pole-0")
        before = poles(page)
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 60, y, steps=6)
        page.mouse.up()
        after = poles(page)
        assert [i for i in range(4) if after[i] != before[i]] == [index]
        press(page, "Control+z")


def test_requirements_judge_the_response_and_hatch_the_plane_as_a_guide(page: Page):
    assert page.get_by_test_id("forbidden-settling").count() == 0
    page.get_by_test_id("mode-yaw-complex").click()
    page.get_by_test_id("requirements").click()
    settling, overshoot = page.get_by_test_id("require-settling"), page.get_by_test_id("require-overshoot")
    settling.fill("0.38")
    overshoot.fill("0.01")
    for name in ("settling", "overshoot"):
        expect(page.get_by_test_id(f"forbidden-{name}")).to_have_count(1)
    found = poles(page)
    zeta = -found[2]["re"] / abs(complex(found[2]["re"], found[2]["im"]))
    assert 4 / -found[1]["re"] > 0.38 > 4 / -found[0]["re"] and zeta > 0.94
    verdicts_are_those_of_the_table(page)
    page.get_by_test_id("pole-1").focus()
    expect(page.get_by_test_id("readout")).to_contain_text("guide: alone slower than asked")
    expect(page.get_by_test_id("readout")).not_to_contain_text(re.compile("[✓✕]"))
    text = page.get_by_test_id("pole-1").get_attribute("aria-valuetext")
    assert text == "pitch pole 2: −10.0 rad/s, guide: alone slower than asked"
    x = page.get_by_test_id("forbidden-settling").bounding_box()["x"]
    assert centre(page, "pole-0")[0] < x < centre(page, "pole-1")[0]
    press(page, "Control+z")  # takes back the pair's mode, not the requirements
    assert settling.input_value() == "0.38"
    verdicts_are_those_of_the_table(page)
    settling.fill("0.78")  # between the two steps: the placed poles alone meet it, yaw's response does not
    overshoot.fill("")
    verdicts_are_those_of_the_table(page)
    expect(page.get_by_test_id("requirements-verdict")).to_have_text("✕ yaw")
    settling.fill("")
    overshoot.fill("")
    for name in ("settling", "overshoot"):
        expect(page.get_by_test_id(f"forbidden-{name}")).to_have_count(0)
    expect(page.get_by_test_id("verdict-pitch")).to_be_hidden()


def verdicts_are_those_of_the_table(page: Page) -> None:
    """One verdict at the pairs, at the requirements and in the table."""
    settled(page)
    crossed = []
    for pair, axis in (("pitch", "theta"), ("yaw", "psi")):
        cells = [
            page.get_by_test_id(f"metric-{name}-{axis}").text_content() for name in ("settling", "overshoot")
        ]
        missed = any(cell.startswith("✕") for cell in cells)
        expect(page.get_by_test_id(f"verdict-{pair}")).to_contain_text("✕" if missed else "✓")
        if cells[0].startswith("✕"):
            expect(page.get_by_test_id(f"verdict-{pair}")).to_contain_text(f"settles in {cells[0][2:]}")
        crossed += [pair] * missed
    expect(page.get_by_test_id("requirements-verdict")).to_have_text(
        f"✕ {', '.join(crossed)}" if crossed else "✓ met"
    )


def test_a_touched_pole_shows_where_the_pi_loops_take_it(page: Page):
    page.get_by_test_id("pole-0").focus()
    expect(page.get_by_test_id("readout")).to_contain_text("with PI: goes to −9.84 rad/s")
    end = page.get_by_test_id("loop-path").evaluate(
        "(e) => { const p = e.getPointAtLength(e.getTotalLength()); return [p.x, p.y]; }"
    )
    target = page.locator("[data-testid=loop-poles] .target")
    expect(target).to_have_count(1)
    x, y = map(float, re.findall(r"[-\d.]+", target.get_attribute("transform")))
    assert end == pytest.approx([x, y], abs=0.2)
    page.get_by_test_id("outer-none").click()
    settled(page)
    expect(page.get_by_test_id("loop-path")).to_have_attribute("d", "")
    page.get_by_test_id("pole-0").focus()
    expect(page.get_by_test_id("readout")).not_to_contain_text("with PI")


@pytest.mark.parametrize(
    ("field", "text", "expected"),
    [(0, "-3+2j", (-3, 2)), (1, "−4 ± 1,5i", (-4, 1.5)), (3, "-2-j", (-2, -1))],
)
def test_a_complex_pole_is_typed_as_people_write_it(page: Page, field: int, text: str, expected: tuple):
    other = field ^ 1
    typed = page.get_by_test_id(f"pole-field-{field}")
    typed.fill(text)
    typed.press("Enter")
    settled(page)
    found = poles(page)
    assert (found[field]["re"], found[field]["im"]) == expected
    assert (found[other]["re"], found[other]["im"]) == (expected[0], -expected[1])
    shown = page.get_by_test_id(f"pole-field-{field & 2}")
    assert shown.input_value() == f"−{-expected[0]}"  # the true minus, as everywhere


def test_a_requirement_that_is_no_number_is_told_and_changes_nothing(page: Page):
    page.get_by_test_id("requirements").click()
    field = page.get_by_test_id("require-settling")
    field.fill("0")
    expect(page.locator("#require-settling-error")).to_have_text("must be positive")
    expect(page.get_by_test_id("forbidden-settling")).to_have_count(0)
    field.fill("2")
    field.fill("soon")
    expect(page.locator("#require-settling-error")).to_have_text("enter a number")
    expect(page.get_by_test_id("forbidden-settling")).to_have_count(1)
    field.press("Tab")
    expect(field).to_have_value("2")
