"""Findings where they concern, and the way from the summary to them; one broken view among others."""

from __future__ import annotations

from playwright.sync_api import Browser, Page, Route, expect

from tests.browser import EMPTY, SEEN, goto, reopened, settled, state, visited
from tests.e2e.conftest import App
from tests.e2e.test_rig import entered, until

SLOW = "#v1&p=-1,-1.5,-2,-2.5"
AMPLE = "#v1&pi=12,0.08,12,0.08"
"""Bears rotors twice as slow as an Aero's, and nothing is to be said of it."""


def test_slow_poles_under_pi_are_told_at_the_loops_and_lead_to_the_remedy(page: Page, app: App):
    reopened(page, app.url + SLOW)
    assert "pi_unstable" in state(page)["findings"]
    expect(page.get_by_test_id("remark-loops")).to_have_text("✕ unstable")
    finding = page.locator("#strip .list [data-code=pi_unstable] button")
    expect(finding).to_contain_text("Lower the gains")
    finding.focus()
    page.keyboard.press("Enter")
    suggest = page.get_by_test_id("suggest-pi")
    expect(suggest).to_be_focused()
    expect(suggest).to_have_class("pointed")
    page.keyboard.press("Enter")
    until(page, "s.stable")
    expect(page.get_by_test_id("remark-loops")).to_be_empty()


def test_saturation_leads_to_its_plot_and_a_slow_sample_time_opens_its_field(page: Page):
    entered(page, "step-psi", "90")
    until(page, "s.findings.includes('saturation_V_y')")
    expect(page.get_by_test_id("remark-V_y")).to_contain_text("▲ at limit")
    more = page.locator("#strip .more")
    if more.is_visible():
        more.click()
        page.locator("#strip .all [data-code=saturation_V_y] button").click()
    else:
        page.locator("#strip .list [data-code=saturation_V_y] button").click()
    expect(page.locator("[data-testid=plot-V_y] .plot-body")).to_be_focused()
    page.get_by_test_id("experiment").click()
    page.get_by_test_id("experiment-digital").check()
    entered(page, "experiment-sample-time", "50")
    until(page, "s.findings.includes('slow_sampling')")
    page.get_by_test_id("experiment-close").click()
    page.locator("#strip .list [data-code=slow_sampling] button").click()
    expect(page.get_by_test_id("experiment-sample-time")).to_be_focused()


def test_a_missed_requirement_is_in_the_summary_and_leads_to_its_pole(page: Page):
    page.get_by_test_id("requirements").click()
    page.get_by_test_id("require-settling").fill("0.78")
    finding = page.locator("#strip .list [data-code=requirement_missed] button")
    expect(finding).to_contain_text("Requirement missed: the yaw step settles in 0.85 s.")
    finding.click()
    expect(page.get_by_test_id("pole-3")).to_be_focused()
    page.get_by_test_id("require-settling").fill("2")
    expect(finding).to_have_count(0)


def test_a_design_that_needs_quick_rotors_is_told_so_and_stays_green(page: Page):
    note = page.locator("#strip .list [data-code=lives_by_fast_rotors] button")
    expect(note).to_contain_text("once both rotors lag by 0.165 s; an Aero's lag by 0.16 s")
    expect(page.get_by_test_id("verdict")).to_have_class("verdict stable")
    note.click()
    expect(page.get_by_test_id("show-lag")).to_be_focused()


def test_an_unwise_design_is_not_green(page: Page, app: App):
    reopened(page, app.url + AMPLE)
    expect(page.get_by_test_id("findings")).to_contain_text("No warnings.")
    entered(page, "pole-field-0", "-900")
    until(page, "s.findings.includes('high_gain') && s.findings.includes('short_delay_margin')")
    expect(page.get_by_test_id("verdict")).to_have_class("verdict stable uneasy")
    expect(page.get_by_test_id("remark-loops")).to_have_text("▲ slow")
    assert {"slow_pole", "not_settled"} <= set(state(page)["findings"])


def test_figures_of_another_design_are_dimmed_where_the_present_one_cannot_be_computed(page: Page):
    dimmed = "(e) => Number(getComputedStyle(e).opacity) < 0.6"
    places = ("[data-testid=metrics]", "[data-testid=k-matrix]", "#plots", "[data-testid=loop-poles]")
    page.get_by_test_id("method").select_option("ackermann")
    problem = "JSON.parse(document.documentElement.dataset.state).problem"
    page.wait_for_function(f"() => {problem} === 'method_unavailable'")
    for place in places:
        assert page.locator(f"{place}, :has(> {place})").evaluate_all(f"all => all.some({dimmed})"), place
    expect(page.get_by_test_id("verdict")).to_contain_text("last computed design")
    page.get_by_test_id("method").select_option("full-rank/triangular/pitch")
    until(page, "s.problem === null && s.settled")
    for place in places:
        assert not page.locator(f"{place}, :has(> {place})").evaluate_all(f"all => all.some({dimmed})"), place


# The page's first frame comes before its first design: what fails there must still be told afterwards.
LATE_PRESETS = """(() => {
  const { fetch } = window;
  window.fetch = async (...asked) => {
    if (String(asked[0]).includes('/presets')) await new Promise((on) => setTimeout(on, 500));
    return fetch(...asked);
  };
})()"""


def test_a_view_that_throws_stops_no_other_and_is_told_of_quietly(chromium: Browser, app: App):
    with visited(chromium, EMPTY, SEEN, LATE_PRESETS) as visit:
        page = visit.page
        page.route(
            "**/static/panels/metrics.js",
            lambda route: route.fulfill(
                content_type="text/javascript",
                body=route.fetch()
                .text()
                .replace("  render(", "  render() { throw new Error('out of order'); }\n  never(", 1),
            ),
        )
        goto(page, app.url)
        expect(page.get_by_test_id("fault")).to_contain_text("out of order")
        entered(page, "pole-field-0", "-20")
        until(page, "s.poles[0].re === -20")
        expect(page.get_by_test_id("verdict")).to_contain_text("Stable")
        settled(page)
        assert len([text for text in visit.errors if "out of order" in text]) == 1
        visit.errors.clear()
        page.get_by_test_id("fault-close").click()
        expect(page.get_by_test_id("fault")).to_be_hidden()


def test_a_place_whose_room_is_still_loading_is_led_to_when_it_is_there(chromium: Browser, app: App):
    held: list[Route] = []
    with visited(chromium, EMPTY, SEEN) as visit:
        visit.page.route("**/static/machine/lag_paths.js", lambda route: held.append(route))  # noqa: PLW0108 (Playwright writes to a handler)
        with visit.page.expect_request("**/static/machine/lag_paths.js"):
            goto(visit.page, app.url)
        note = visit.page.locator("#strip .list [data-code=lives_by_fast_rotors] button")
        note.click()
        expect(note).to_be_focused()
        held[0].continue_()
        expect(visit.page.get_by_test_id("show-lag")).to_be_focused()


def test_a_link_for_a_class_keeps_back_why_and_not_whether(page: Page, app: App):
    """What is to be found out is not told: remarks; what is asked for is: stability, requirements, refusals."""
    link = "#v1&p=-4,-5,-2,-3&req.settling=1"
    reopened(page, app.url + link)
    expect(page.get_by_test_id("remark-loops")).not_to_be_empty()
    reopened(page, app.url + f"{link}&lock=remarks")
    expect(page.get_by_test_id("verdict")).to_contain_text("Unstable")
    told = page.locator("#strip .all li")
    expect(told).to_have_count(1)
    expect(told).to_have_attribute("data-code", "requirement_missed")
    for spot in ("loops", "V_p", "V_y", "theta"):
        expect(page.get_by_test_id(f"remark-{spot}")).to_be_empty()
    reopened(page, app.url + "#v1&lock=remarks")
    expect(page.get_by_test_id("findings")).to_contain_text("Remarks on this design are hidden by the link")
    page.get_by_test_id("method").select_option("ackermann")
    expect(page.get_by_test_id("findings")).to_contain_text("Choose a method for several inputs.")
    page.get_by_test_id("share").click()
    expect(page.get_by_test_id("lock-remarks")).to_be_checked()
