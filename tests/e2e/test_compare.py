"""The comparisons below the instrument, and what they and the pairing's button do to the design."""

from __future__ import annotations

from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import later, opened, settled, state, until_state, view
from tests.e2e.conftest import App

POLES = [-12.0, -10.0, -9.25, -8.76]
METHODS = 11
"""Four full-rank structures and seven other methods."""


def choose(page: Page, preset: str) -> None:
    page.get_by_test_id("preset").select_option(preset)
    until_state(page, f"s.preset === '{preset}'")


def seen(page: Page, card: str) -> None:
    """Scrolls to a card of the comparison and waits until it is filled and up to date."""
    if not page.get_by_test_id(card).is_visible():
        view(page, "compare")
    page.get_by_test_id(card).scroll_into_view_if_needed()
    page.wait_for_function(
        """(id) => {
          const card = document.querySelector(`[data-testid=${id}]`);
          return !card.hasAttribute("aria-busy") && card.querySelector(".status").hidden;
        }""",
        arg=card,
    )


def figure(page: Page, testid: str) -> float:
    return float(page.get_by_test_id(testid).inner_text().replace("−", "-"))


def key(row: dict) -> str:
    if row["method"] != "full-rank":
        return row["method"]
    lead = f"/{row['lead']}" if row["coupling"] == "triangular" else ""
    return f"full-rank/{row['coupling']}{lead}"


def test_the_table_shows_what_the_server_compares(page: Page, app: App):
    seen(page, "compare")
    asked = {"poles": POLES, "tuning": "placed"}
    answer = page.request.post(app.url + "api/v1/compare", data=asked).json()
    assert len(answer["rows"]) == METHODS
    assert page.locator('[data-testid^="compare-row-"]').count() == METHODS
    for row in answer["rows"]:
        if "unavailable" not in row:
            assert figure(page, f"compare-{key(row)}-norm") == pytest.approx(row["norm"], rel=1e-3)
    expect(page.get_by_test_id("claim")).to_have_text(answer["claim"])
    assert page.get_by_test_id("compare-lqr-error").inner_text() == "own poles"


def test_methods_are_compared_as_placed_or_with_loops_of_their_own(page: Page, app: App):
    seen(page, "compare")
    rule = page.get_by_test_id("tuning-rule")
    expect(rule).to_contain_text("Each method as placed")
    placed = page.get_by_test_id("compare-tits-yang-rise-theta").inner_text()
    page.get_by_test_id("use-tits-yang").click()
    until_state(page, "s.settled && s.method === 'tits-yang' && s.outer === 'none'")
    page.get_by_test_id("tuning-tuned").check(force=True)
    expect(rule).to_contain_text("by one rule, with the same target")
    expect(page.get_by_test_id("compare-tits-yang-rise-theta")).not_to_have_text(placed)
    expect(page.get_by_test_id("use-tits-yang")).to_have_text("Use")
    page.get_by_test_id("use-tits-yang").click()
    until_state(page, "s.settled && s.outer === 'pi'")
    own = page.request.post(app.url + "api/v1/suggest", data={"poles": POLES, "method": "tits-yang"}).json()
    assert state(page)["loops"] == own["loops"]
    expect(page.get_by_test_id("use-tits-yang")).to_have_text("In use")
    page.get_by_test_id("tuning-kept").check(force=True)
    expect(rule).to_have_class("rule warning")
    expect(rule).to_contain_text("chosen for other poles")


def test_a_row_opens_to_its_gain(page: Page, app: App):
    seen(page, "compare")
    page.get_by_test_id("open-tits-yang").click()
    reply = page.request.post(app.url + "api/v1/gains", data={"poles": POLES, "method": "tits-yang"}).json()
    for i in range(2):
        for j in range(4):
            shown = figure(page, f"compare-k-tits-yang-{i}{j}")
            assert shown == pytest.approx(reply["K"][i][j], rel=1e-2, abs=1e-3)


def test_ackermann_tells_why_it_has_no_gain_and_has_one_on_another_rig(page: Page):
    seen(page, "compare")
    row = page.get_by_test_id("compare-row-ackermann")
    assert "one input that reaches every state" in row.inner_text()
    assert page.get_by_test_id("use-ackermann").count() == 0
    choose(page, "quanser-aero-2")
    seen(page, "compare")
    page.get_by_test_id("use-ackermann").wait_for()
    assert figure(page, "compare-ackermann-norm") > 1000


def test_using_a_method_changes_the_gain_and_undo_brings_it_back(page: Page, app: App):
    seen(page, "compare")
    before = state(page)["K"]
    use = page.get_by_test_id("use-tits-yang")
    use.click()
    until_state(page, "s.method === 'tits-yang'")
    reply = page.request.post(app.url + "api/v1/gains", data={"poles": POLES, "method": "tits-yang"}).json()
    assert state(page)["K"] == reply["K"] != before
    expect(use).to_have_text("In use")
    view(page, "design")
    expect(page.get_by_test_id("method")).to_have_value("tits-yang")
    seen(page, "compare")
    page.get_by_test_id("undo").click()
    until_state(page, "s.method === 'full-rank'")
    assert state(page)["K"] == before
    expect(use).to_have_text("Use")
    expect(page.get_by_test_id("compare-row-full-rank/triangular/pitch")).to_have_class("current")


def test_another_split_of_the_same_poles_is_one_step(page: Page):
    seen(page, "splits")
    before = state(page)
    assert page.locator("tr[data-testid^='split-']").count() == 6
    expect(page.get_by_test_id("use-split-0")).to_have_text("In use")
    page.get_by_test_id("use-split-5").click()
    until_state(page, "s.poles[0].re === -9.25")
    after = state(page)
    assert [p["re"] for p in after["poles"]] == [-9.25, -8.76, -12, -10]
    assert after["K"] != before["K"]
    expect(page.get_by_test_id("use-split-5")).to_have_text("In use")
    page.get_by_test_id("undo").click()
    until_state(page, "s.poles[0].re === -12")
    assert state(page)["K"] == before["K"]


def test_pairing_as_advised_gives_a_stable_loop_in_one_step(page: Page):
    choose(page, "quanser-aero")
    before = state(page)
    page.get_by_test_id("pair-advised").click()
    until_state(page, "s.pairing === 'cross'")
    after = state(page)
    assert after["stable"] is True
    assert after["loops"] != before["loops"]
    expect(page.get_by_test_id("verdict")).to_contain_text("Stable")
    expect(page.get_by_test_id("pair-advised")).to_be_hidden()
    assert "Crosswise pairing is right" in page.get_by_test_id("pairing-words").inner_text()
    page.get_by_test_id("undo").click()
    until_state(page, "s.pairing === 'diagonal'")
    assert state(page)["loops"] == before["loops"]


def test_dominance_is_told_in_words_and_follows_the_rig(page: Page):
    seen(page, "interaction")
    words = page.get_by_test_id("dominance-words")
    expect(words).to_contain_text("is diagonally dominant everywhere, by rows and by columns")
    assert figure(page, "interaction-gains-0") == pytest.approx(state(page)["rga"][0][0], abs=1e-3)
    assert page.locator("[data-testid=interaction] canvas").count() == 2
    choose(page, "quanser-aero")
    seen(page, "interaction")
    expect(words).to_contain_text("nowhere diagonally dominant")


def test_a_pole_at_zero_leaves_no_interaction_to_show_and_says_so(page: Page):
    field = page.get_by_test_id("pole-field-0")
    field.fill("0")
    field.press("Enter")
    until_state(page, "s.poles[0].re === 0")
    seen(page, "interaction")
    expect(page.get_by_test_id("dominance-words")).to_contain_text("no steady state")
    expect(page.get_by_test_id("interaction-gains")).to_be_hidden()
    view(page, "design")
    assert "there is no steady state" in page.get_by_test_id("pairing-words").inner_text()


def test_own_poles_of_a_method_leave_the_placed_ones_dimmed(page: Page):
    page.get_by_test_id("method").select_option("lqr")
    until_state(page, "s.method === 'lqr'")
    assert "own_poles" in state(page)["findings"]
    assert "unused" in (page.locator("#splane").get_attribute("class") or "")
    page.get_by_test_id("method").select_option("full-rank/axis-decoupled")
    until_state(page, "s.method === 'full-rank'")
    assert state(page)["coupling"] == "axis-decoupled"
    assert "unused" not in (page.locator("#splane").get_attribute("class") or "")


def test_decoupler_and_operating_point_are_sent(page: Page):
    before = state(page)
    page.get_by_test_id("decoupler").check()
    until_state(page, "s.decoupler === true")
    assert state(page)["loopPoles"] != before["loopPoles"]
    field = page.get_by_test_id("theta0")
    field.fill("20")
    field.press("Enter")
    until_state(page, "Math.abs(s.theta0 - Math.PI / 9) < 1e-9")
    assert state(page)["K"] != before["K"]


def test_nothing_is_asked_until_it_is_seen_nor_during_a_drag(page: Page):
    asked: list[str] = []
    page.on("request", lambda r: r.method == "POST" and asked.append(urlsplit(r.url).path.rsplit("/", 1)[-1]))

    def of_cards() -> list[str]:
        """The track of the rotors' lag is in sight, and asked for wherever a hand has come to rest."""
        return [name for name in asked if name != "lag"]

    field = page.get_by_test_id("pole-field-0")
    field.fill("-14")
    field.press("Enter")
    until_state(page, "s.poles[0].re === -14")
    assert of_cards() == []
    page.set_viewport_size({"width": 1280, "height": 1400})
    seen(page, "compare")
    assert "compare" in asked
    # both in view: the card's upper edge at the bottom, the s-plane above
    page.evaluate(
        "(e) => scrollBy(0, e.getBoundingClientRect().top - innerHeight + 80)",
        page.get_by_test_id("compare").element_handle(),
    )
    settled(page)
    box = page.get_by_test_id("pole-3").bounding_box()
    assert box is not None and box["y"] > 0
    asked.clear()
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    with later(page):
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x + 30, y, steps=5)
    assert state(page)["dragging"] and of_cards() == []
    page.mouse.up()
    seen(page, "compare")
    assert "compare" in asked


@pytest.mark.parametrize("width", [390, 1280])
def test_the_page_does_not_scroll_sideways(chromium: Browser, app: App, width: int):
    with opened(chromium, app.url, size=(width, 800)) as page:
        for card in ("compare", "splits", "interaction"):
            seen(page, card)
        assert page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth") <= 0
