"""The derivation as a reading view: its symbols tell what they are, its diagrams and formulas follow the design."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Browser, Locator, Page, expect

from tests.browser import opened, settled, state, view
from tests.e2e.conftest import App
from tests.e2e.test_paper import follows, opened_paper


def symbol(page: Page, step: str, name: str) -> Locator:
    found = page.locator(f"#{step} .form.derived:not(.chosen) [data-symbol={name}]").first
    found.scroll_into_view_if_needed()
    return found


def card(page: Page) -> Locator:
    return page.get_by_test_id("symbol-card")


def scrolled_to(page: Page, anchor: str) -> None:
    page.locator(f"#{anchor}").evaluate("(e) => e.scrollIntoView()")


def test_a_symbol_under_the_pointer_shows_name_value_and_unit(page: Page):
    opened_paper(page)
    symbol(page, "eq-14", "K_pp").hover()
    expect(card(page)).to_be_visible()
    expect(card(page)).to_contain_text("thrust torque about pitch per volt of the pitch motor")
    expect(page.get_by_test_id("symbol-value")).to_have_text("0.204")
    expect(page.get_by_test_id("symbol-unit")).to_have_text("N·m/V")
    card(page).hover()  # it stays while it is read
    expect(card(page)).to_be_visible()
    page.keyboard.press("Escape")
    expect(card(page)).to_be_hidden()

    symbol(page, "eq-2", "kinetic").hover()
    expect(card(page)).to_contain_text("kinetic energy")
    symbol(page, "eq-transformation", "T").hover()
    expect(card(page)).to_contain_text("transformation")
    assert page.get_by_test_id("symbol-value").locator("td").count() == 16
    page.mouse.move(2, 2)
    expect(card(page)).to_be_hidden()


def test_values_of_symbols_are_those_of_the_design(page: Page):
    opened_paper(page)
    view(page, "design")
    field = page.get_by_test_id("pole-field-0")
    field.fill("-15")
    field.press("Enter")
    settled(page)
    view(page, "derivation")
    scrolled_to(page, "eq-21-22")
    follows(page)
    symbol(page, "eq-21-22", "p_1").hover()
    expect(page.get_by_test_id("symbol-value")).to_contain_text("−15")
    expect(page.get_by_test_id("symbol-unit")).to_have_text("rad/s")


def test_arrow_keys_walk_through_the_symbols_of_a_formula(page: Page):
    opened_paper(page)
    box = page.locator("#eq-15 .form.derived .scroll")
    box.focus()
    assert page.locator(f"#{box.get_attribute('aria-describedby')}").inner_text()
    page.keyboard.press("ArrowRight")
    expect(page.locator("[data-symbol]:focus")).to_have_attribute("aria-describedby", "symbol-card")
    expect(card(page)).to_contain_text("effective inertia about pitch")
    names = []
    for _ in range(4):
        names.append(page.evaluate("() => document.activeElement.dataset.symbol"))
        page.keyboard.press("ArrowRight")
    assert names[:2] == ["alpha", "J_p"] and set(names[2:]) == {"l", "m"}
    page.keyboard.press("End")
    last = box.locator("[data-symbol]").last
    expect(last).to_be_focused()
    expect(card(page)).to_be_visible()
    page.keyboard.press("Escape")
    expect(card(page)).to_be_hidden()
    expect(box).to_be_focused()


def test_a_tap_shows_the_card_and_a_tap_elsewhere_closes_it(chromium: Browser, app: App):
    with opened(chromium, app.url, size=(390, 844), has_touch=True) as page:
        view(page, "derivation")
        page.locator("#paper").scroll_into_view_if_needed()
        page.get_by_test_id("paper-alpha").wait_for(state="attached")
        scrolled_to(page, "eq-15")
        expect(page.get_by_test_id("paper-alpha")).to_have_text(re.compile(r"^0\.08"))
        symbol(page, "eq-15", "alpha").tap()
        expect(card(page)).to_be_visible()
        box = card(page).bounding_box()
        assert box is not None and box["x"] >= 0 and box["x"] + box["width"] <= 390
        page.locator("#eq-15 h4").tap()
        expect(card(page)).to_be_hidden()
        for diagram in ("fig-2-drawing", "fig-3-drawing"):
            drawn = page.get_by_test_id(diagram).bounding_box()
            assert drawn is not None and 300 < drawn["width"] <= 390


def test_every_parameter_in_a_formula_has_its_card(page: Page):
    """No letter of a derived formula of the linear part is left without a meaning."""
    opened_paper(page)
    lost = page.evaluate(
        """() => ['linear', 'feedback', 'interaction']
          .flatMap((name) => [...document.querySelectorAll(`.eq[data-chapter=${name}] .form.derived math mi`)])
          .filter((e) => !e.closest('[data-symbol]') && !['sin', 'cos', 'det'].includes(e.textContent))
          .map((e) => e.closest('.eq').id + ' ' + e.textContent)"""
    )
    assert lost == []


def test_block_diagrams_show_the_present_values_and_what_is_paired(page: Page):
    opened_paper(page)
    K = state(page)["K"]
    shown = page.get_by_test_id("fig-2-K-11").text_content() or ""
    assert float(shown.replace("−", "-")) == pytest.approx(K[1][1], rel=1e-3)
    expect(page.get_by_test_id("fig-3-kp-p")).to_have_text("30 V/rad")
    expect(page.get_by_test_id("fig-3-ti-y")).to_have_text("0.1 s")
    expect(page.get_by_test_id("fig-3-lambda")).to_have_text("1.0069")
    described = page.get_by_test_id("fig-3-drawing").locator("desc")
    expect(described).to_contain_text("Pitch’s output is the command v p")

    page.goto(page.url.split("#")[0] + "#v1&decoupler=true&at=fig-3")
    expect(page.get_by_test_id("fig-3-D-00")).to_be_attached()
    expect(described).to_contain_text("decoupler")
    page.goto(page.url.split("#")[0] + "#v1&pairing=cross&at=fig-3")
    expect(described).to_contain_text("Crosswise")
    page.goto(page.url.split("#")[0] + "#v1&outer=none&at=fig-3")
    expect(described).to_contain_text("Without outer loops")
    scrolled_to(page, "fig-2")
    expect(page.get_by_test_id("fig-2-before-00")).to_be_attached()


def test_the_chosen_structure_has_its_own_formulas(page: Page):
    opened_paper(page)
    chosen = page.locator("#eq-23 .form.chosen")
    expect(chosen).to_be_hidden()
    page.goto(page.url.split("#")[0] + "#v1&coupling=axis-decoupled&at=eq-23")
    expect(chosen).to_be_visible()
    assert chosen.locator("[data-symbol=K_py]").count() > 0
    assert chosen.locator("[data-symbol=p_1]").count() == 0  # the array is free of the poles there
    assert page.locator("#eq-23 .form.derived:not(.chosen) [data-symbol=p_1]").count() > 0


def test_errata_stand_at_their_steps_and_every_step_has_its_sentence(page: Page, app: App):
    paper = page.request.get(app.url + "api/v1/paper").json()
    opened_paper(page)
    for erratum in paper["errata"]:
        step = next(e for e in paper["equations"] if erratum["name"] in e["errata"])
        own = page.locator(f"article[data-number='{step['number']}'] #erratum-{erratum['name']}")
        assert own.count() == 1
        assert own.locator(".proof").is_visible()
    sentences = page.locator("[data-testid=paper-equation] .plainly").all_inner_texts()
    assert len(sentences) == len(paper["equations"]) and all(sentences)


def test_contents_follow_the_reader_and_a_link_to_a_step_keeps_the_design(page: Page):
    opened_paper(page)
    contents = page.get_by_test_id("paper-contents")
    scrolled_to(page, "eq-gain-in-z")
    current = contents.locator("[aria-current=location]")
    expect(current).to_have_attribute("href", "#eq-gain-in-z")
    expect(current).to_be_in_viewport()
    contents.get_by_role("link", name="The closed loop, checked").click()
    expect(page.locator("#eq-closed-loop")).to_be_in_viewport()
    expect(current).to_have_attribute("href", "#eq-closed-loop")
    page.wait_for_function(
        "() => location.hash.includes('at=eq-closed-loop') || location.hash === '#eq-closed-loop'"
    )


def test_figures_4_and_5_are_saved_as_numbers_and_as_picture(page: Page, app: App):
    figure = page.request.get(app.url + "api/v1/paper").json()["figures"][0]
    opened_paper(page)
    page.get_by_test_id("save-fig-4").click()
    with page.expect_download() as numbers:
        page.get_by_test_id("save-fig-4-CSV").click()
    header, *rows = numbers.value.path().read_text().strip().splitlines()
    assert header.count("[deg]") == len(figure["curves"]) and "t [s]" in header
    assert len(rows) == len(figure["t"])
    with page.expect_download() as picture:
        page.get_by_test_id("save-fig-4-PNG").click()
    assert picture.value.suggested_filename == "fig-4.png"
    assert picture.value.path().read_bytes().startswith(b"\x89PNG")
