"""Where the paper's model ends, on the page: the lag margin, six states and the observer, with their values."""

from __future__ import annotations

import json
import re

import pytest
from playwright.sync_api import Browser, Locator, Page, WebSocketRoute, expect

from tests.browser import opened, settled, state, view
from tests.e2e.conftest import App
from tests.e2e.test_derivation import card
from tests.e2e.test_paper import opened_paper

LAG = {"rotors": {"pitch": {"tau": 0.16}, "yaw": {"tau": 0.16}}, "place_rotors": True}


def number(text: str) -> float:
    return float(text.replace("−", "-"))


def chapter(page: Page, name: str) -> Locator:
    """One of the chapters, its formulas there and their values filled in."""
    root = page.locator(f"#paper-{name}")
    root.evaluate("(e) => e.scrollIntoView()")
    root.get_by_test_id("beyond-step").first.wait_for()
    return root


def hovered(page: Page, symbol: Locator) -> float:
    symbol.scroll_into_view_if_needed()
    symbol.hover()
    expect(card(page)).to_be_visible()
    return number(page.get_by_test_id("symbol-value").inner_text())


def test_the_first_design_is_told_to_stand_at_the_edge(page: Page, app: App):
    opened_paper(page)
    margin = page.request.post(app.url + "api/v1/gains", data={}).json()["lag_margin"]
    page.locator("#paper-limit").evaluate("(e) => e.scrollIntoView()")
    expect(page.get_by_test_id("paper-lag")).to_contain_text(f"{margin:.3f} s")
    expect(page.get_by_test_id("paper-lag")).to_contain_text("at the edge")
    expect(page.get_by_test_id("paper-lag-table")).to_contain_text("0.1648")
    page.goto(page.url.split("#")[0] + "#v1&outer=none&view=derivation")
    settled(page)
    alone = page.request.post(app.url + "api/v1/gains", data={"outer": "none"}).json()
    expect(page.get_by_test_id("paper-lag")).not_to_contain_text(f"{margin:.3f} s")
    assert alone.get("lag_margin") != margin


def test_hovered_entries_of_six_states_are_the_replys(page: Page, app: App):
    opened_paper(page)
    assert page.get_by_test_id("beyond-step").count() == 0  # fetched when it is first seen
    root = chapter(page, "six")
    K = page.request.post(app.url + "api/v1/gains", data=LAG).json()["K"]
    shown = root.get_by_test_id("value-k_16")
    expect(shown).not_to_have_text("–")
    assert number(shown.inner_text()) == pytest.approx(K[0][5], rel=1e-4)
    for name, value in (("k_11", K[0][0]), ("k_26", K[1][5])):
        found = hovered(page, root.locator(f"#eq-beyond-gain [data-symbol={name}]").first)
        assert found == pytest.approx(value, rel=1e-5)
    names = page.request.post(app.url + "api/v1/walkthrough", data=LAG).json()["rotors"]["names"]
    for name in ("h_1", "b_11", "nu_p", "Delta", "d_12", "tau_p"):
        found = hovered(page, root.locator(f"#eq-beyond-gain [data-symbol={name}]").first)
        assert found == pytest.approx(names[name], rel=1e-5), name
    expect(root).to_contain_text("0.16 s for pitch’s and yaw’s rotor")


def test_every_letter_of_these_chapters_has_its_card(page: Page):
    opened_paper(page)
    for name in ("six", "observer"):
        root = chapter(page, name)
        lost = root.evaluate(
            """(e) => [...e.querySelectorAll('.eq math mi')].filter((m) => !m.closest('[data-symbol], .sym')
              && !/^(sin|cos|sign|max|φ|.?)$/u.test(m.textContent.replace(/[A-Za-zΑ-ω]/gu, (x) => x + x)))
              .map((m) => m.textContent)"""
        )
        assert lost == []


def test_the_observers_values_are_the_replys(page: Page, app: App):
    opened_paper(page)
    root = chapter(page, "observer")
    L = page.request.post(app.url + "api/v1/walkthrough", data={}).json()["observer"]["L"]
    assert hovered(page, root.locator("[data-symbol=l_31]").first) == pytest.approx(L[2][0], rel=1e-5)
    assert hovered(page, root.locator("[data-symbol=q_1]").first) == -40
    expect(root.get_by_test_id("paper-L-31")).to_have_text("1482.24")
    expect(root).to_contain_text("promises no margins")
    expect(page.get_by_test_id("paper-observer-poles")).to_contain_text("does not act on it")


def test_chapters_follow_the_structure_and_stand_among_the_contents(page: Page):
    opened_paper(page)
    root = chapter(page, "six")
    expect(root.get_by_test_id("value-k_16")).not_to_have_text("–")
    assert root.get_by_test_id("value-k_25").count() == 0  # the triangular structure's zero
    page.goto(page.url.split("#")[0] + "#v1&coupling=axis-decoupled&at=paper-six")
    expect(root.get_by_test_id("value-k_25")).not_to_have_text("–")
    contents = page.get_by_test_id("paper-contents")
    contents.get_by_role("link", name="The observer").click()
    expect(page.locator("#paper-observer h3")).to_be_in_viewport()


def test_formulas_are_those_of_six_states_where_the_rotors_are_placed(chromium: Browser, app: App):
    """The requests are changed on their way, so that this holds whatever of the page places the rotors."""

    def changed(message: str | bytes) -> str | bytes:
        request = json.loads(message)
        more = {**LAG, "observer": {"poles": [-40, -41, -42, -43]}}
        return json.dumps({**request, **more} if "poles" in request else request)

    def relayed(socket: WebSocketRoute) -> None:
        server = socket.connect_to_server()
        socket.on_message(lambda message: server.send(changed(message)))

    with opened(chromium, app.url) as page:
        page.route_web_socket(re.compile("/api/v1/live"), relayed)
        page.reload()
        settled(page)
        K = state(page)["K"]
        assert len(K[0]) == 6
        view(page, "derivation")
        page.locator("#formulas").scroll_into_view_if_needed()
        cell = page.get_by_test_id("formulas").get_by_test_id("value-k_15")
        cell.wait_for(state="attached")
        page.locator("#formulas").evaluate("(e) => e.scrollIntoView()")  # what is above has grown meanwhile
        expect(cell).not_to_have_text("–")
        assert number(cell.inner_text()) == pytest.approx(K[0][4], rel=1e-4)
        assert (
            page.get_by_test_id("formula-A").is_visible() and page.get_by_test_id("formula-RGA").count() == 0
        )
        expect(page.get_by_test_id("formulas").get_by_test_id("value-l_11")).not_to_have_text("–")


@pytest.mark.parametrize("size", [(390, 844), (820, 1180), (1280, 800)], ids=str)
def test_nothing_sticks_out_of_the_window(chromium: Browser, app: App, size: tuple[int, int]):
    with opened(chromium, app.url, size=size) as page:
        view(page, "derivation")
        page.locator("#paper").scroll_into_view_if_needed()
        page.get_by_test_id("paper-K-00").wait_for(state="attached")
        for name in ("limit", "six", "observer"):
            root = page.locator(f"#paper-{name}")
            root.evaluate("(e) => e.scrollIntoView()")
            if name != "limit":
                root.get_by_test_id("beyond-step").first.wait_for()
            assert page.evaluate("document.documentElement.scrollWidth") <= size[0]
            wide = root.evaluate(
                """(e) => [...e.querySelectorAll('article, .live, .entry, .definition, table.matrix')]
                  .filter((n) => !n.closest('.scroll') && n.getBoundingClientRect().right > innerWidth + 1)
                  .map((n) => n.className)"""
            )
            assert wide == []
