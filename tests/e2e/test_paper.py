"""The section on the paper in a real browser: it shows the whole reply, and its live numbers follow the design."""

from __future__ import annotations

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import opened, settled, state, view
from tests.e2e.conftest import App


def opened_paper(page: Page) -> None:
    view(page, "derivation")
    page.locator("#paper").evaluate("(e) => e.scrollIntoView()")
    page.get_by_test_id("paper-K-00").wait_for()
    follows(page)


def follows(page: Page) -> None:
    """Waits until the K beside Eqs. 21 and 22 is the K of the page's state."""
    page.wait_for_function(
        """() => {
          const { K } = JSON.parse(document.documentElement.dataset.state);
          const shown = (i, j) => Number(document.querySelector(`[data-testid=paper-K-${i}${j}]`)
            .textContent.replace('\u2212', '-'));
          return K.every((row, i) => row.every((v, j) => Math.abs(shown(i, j) - v) <= 1e-5 * Math.abs(v) + 1e-9));
        }"""
    )


def test_everything_of_the_reply_is_shown(page: Page, app: App):
    paper = page.request.get(app.url + "api/v1/paper").json()
    assert page.get_by_test_id("paper-equation").count() == 0  # fetched when it is first seen
    opened_paper(page)

    shown = page.get_by_test_id("paper-equation").evaluate_all("all => all.map((e) => e.dataset.number)")
    assert sorted(shown) == sorted(e["number"] for e in paper["equations"])
    for erratum in paper["errata"]:
        assert page.locator(f"#erratum-{erratum['name']}").get_attribute("data-holds") == "true"
    assert page.get_by_test_id("erratum").count() == len(paper["errata"]) == 12
    for standing, list_id in (("confirmed", "errata"), ("unclear", "unclear")):
        listed = page.get_by_test_id(list_id).locator("a").evaluate_all("all => all.map((a) => a.hash)")
        assert listed == [f"#erratum-{e['name']}" for e in paper["errata"] if e["standing"] == standing]
    symbols = page.locator("[data-testid=symbol-list] dt").all_text_contents()
    assert len(symbols) == len(paper["symbols"]) and not [text for text in symbols if "(" in text]
    for i, j in [(i, j) for i in (1, 2) for j in (1, 2, 3, 4)]:
        assert "reproduced" in page.get_by_test_id(f"paper-number-k_{i}{j}").inner_text()
    assert page.locator("[data-verdict]").count() == len(paper["numbers"])
    reproduced = sum(n["verdict"] == "reproduced" for n in paper["numbers"])
    differ = sum(n["verdict"] == "differs" for n in paper["numbers"])
    tally = page.get_by_test_id("paper-tally").inner_text()
    assert (
        f"{reproduced} of {reproduced + differ}" in tally and "8 errata" in tally and "4 more places" in tally
    )
    assert "−6.128" in page.get_by_test_id("paper-consequence").inner_text()
    for figure in (
        *("fig-1-side", "fig-1-top", "fig-2-drawing", "fig-3-drawing", "fig-4-plot", "fig-5-plot"),
        "paper-plane",
    ):
        box = page.get_by_test_id(figure).bounding_box()
        assert box is not None and box["width"] > 200 and box["height"] > 90, figure
    assert page.get_by_test_id("paper").locator("math").count() > 60
    assert "could not be read" not in page.get_by_test_id("paper").inner_text()


def test_every_link_into_the_section_leads_somewhere(page: Page):
    opened_paper(page)
    lost = page.evaluate(
        """() => [...document.querySelectorAll('#paper a[href^="#"]')].map((a) => a.getAttribute('href'))
          .filter((href) => !document.getElementById(href.slice(1)))"""
    )
    assert lost == []
    assert page.evaluate(
        "() => new Set([...document.querySelectorAll('[id]')].map((e) => e.id)).size"
        " === document.querySelectorAll('[id]').length"
    )


def test_live_numbers_follow_the_design(page: Page):
    opened_paper(page)
    before = page.get_by_test_id("paper-K-00").inner_text()
    assert page.get_by_test_id("paper-d_10").inner_text() == "120"
    view(page, "design")
    field = page.get_by_test_id("pole-field-0")
    field.fill("-15")
    field.press("Enter")
    settled(page)
    view(page, "derivation")
    page.locator("#paper").scroll_into_view_if_needed()
    page.get_by_test_id("paper-d_10").get_by_text("150").wait_for()
    follows(page)
    assert page.get_by_test_id("paper-K-00").inner_text() != before
    assert "−15.00" in page.get_by_test_id("paper-rig").inner_text()


def test_worked_example_and_parameters_are_those_of_the_rig(page: Page):
    opened_paper(page)
    thrust = page.get_by_test_id("paper-worked-K")
    expect(thrust).to_contain_text("0.20413 N·m/V")
    expect(thrust).to_contain_text("not listed")
    page.get_by_test_id("preset").select_option("quanser-2dof-design-file")
    settled(page)
    expect(thrust).not_to_contain_text("not listed")
    expect(page.get_by_test_id("paper-parameters")).to_contain_text("0.2041334")
    assert state(page)["preset"] == "quanser-2dof-design-file"


def test_another_method_says_that_it_has_no_such_steps(page: Page):
    opened_paper(page)
    view(page, "design")
    page.get_by_test_id("method").select_option("tits-yang")
    settled(page)
    view(page, "derivation")
    page.locator("#paper").scroll_into_view_if_needed()
    for anchor in ("#eq-transformation", "#eq-desired-polynomials", "#eq-gain-in-z", "#eq-closed-loop"):
        page.locator(f"{anchor} .refused-words", has_text="full-rank method").first.wait_for()
    assert page.get_by_test_id("paper-T").is_hidden()
    for there in ("A", "B", "controllability_matrix", "K", "G_0", "rga"):  # these need no canonical form
        assert page.get_by_test_id(f"paper-{there}").is_visible()
    assert "Tits" in page.locator("#eq-21-22 .live").inner_text()
    assert page.get_by_test_id("paper-V_p").inner_text() not in ("", "–")
    follows(page)


@pytest.mark.parametrize("width", [390, 1280, 1920])
def test_nothing_scrolls_the_page_sideways(chromium: Browser, app: App, width: int):
    with opened(chromium, app.url, size=(width, 844)) as page:
        opened_paper(page)
        for anchor in ("#paper", "#eq-17", "#paper-numbers", "#paper-errata", "#paper-consequence"):
            page.locator(anchor).scroll_into_view_if_needed()
            assert page.evaluate("() => document.scrollingElement.scrollWidth - innerWidth") <= 0, anchor
