"""The menu "Export": files of the present design, by mouse and by keyboard."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from app.contract.exports import FORMATS
from tests.browser import reopened, settled, state
from tests.e2e.conftest import App


def saved(page: Page, name: str) -> tuple[str, bytes]:
    with page.expect_download() as download:
        page.get_by_test_id(f"export-{name}").click()
    path = download.value.path()
    return download.value.suggested_filename, Path(path).read_bytes()


def test_every_format_is_saved_under_its_name(page: Page):
    page.get_by_test_id("export").click()
    offered = page.locator("[data-testid=popup] [data-testid^=export-]:is(button)")
    assert {b.get_attribute("data-testid").removeprefix("export-") for b in offered.all()} == {*FORMATS}
    for name, chosen in FORMATS.items():
        filename, content = saved(page, name)
        assert filename == chosen.filename
        assert len(content) > 1000
        expect(page.get_by_test_id("export-told")).to_have_text(f"{filename} is saved.")


def test_the_file_is_of_what_is_shown_and_names_the_link(page: Page, app: App):
    page.get_by_test_id("preset").select_option("quanser-aero-2")
    settled(page)
    page.get_by_test_id("export").click()
    file = json.loads(saved(page, "json")[1])
    assert file["gains"]["K"] == state(page)["K"]
    assert file["origin"]["preset"]["name"] == "quanser-aero-2"
    link = file["origin"]["link"]
    assert link.startswith(f"{app.url}#") and "quanser-aero-2" in link


def test_the_report_judges_what_is_required_and_keeps_back_what_the_link_hides(page: Page, app: App):
    for lock, told in (("", True), ("&lock=remarks", False)):
        reopened(page, f"{app.url}#v1&req.settling=0.8{lock}")
        page.get_by_test_id("export").click()
        text = saved(page, "report")[1].decode()
        assert "≤ 0.80 s" in text and "✓ 0.73 s" in text and "✕ 0.85 s" in text
        assert ("<h2>Findings</h2>" in text) == told


def test_the_report_opens_in_a_tab(page: Page):
    page.get_by_test_id("export").click()
    with page.context.expect_page() as opened:
        page.get_by_test_id("open-report").click()
    report = opened.value
    expect(report.locator("h1")).to_have_text("Pole placement: Quanser 2-DOF Helicopter (manual)")
    assert report.locator("svg[role=img]").count() == 5
    line = report.locator("svg .pitch").first
    assert line.evaluate("e => [getComputedStyle(e).fill, getComputedStyle(e).stroke]") == [
        "none",
        "rgb(185, 74, 44)",
    ]  # the page's policy, which the tab inherits, lets the report's style in
    assert report.evaluate(  # and its font
        "async () => (await document.fonts.load('16px \"STIX Two Math\"')).map((face) => face.status)"
    ) == ["loaded"]
    for name, row in (
        ("settling", "Settling time"),
        ("overshoot", "Overshoot"),
        ("error", "Error at the end"),
        ("coupling", "Other axis moves"),
        ("iae", "IAE, °s"),
        ("V_p", "V_p peak"),
        ("effort-V_y", "V_y effort, V²s"),
    ):
        cells = report.locator("tr", has=report.get_by_role("rowheader", name=row, exact=True)).locator("td")
        shown = [page.get_by_test_id(f"metric-{name}-{axis}").text_content() for axis in ("theta", "psi")]
        assert [cells.nth(i).text_content() for i in (0, 2)] == shown, row
    for name, row in (("margin", "Gain · phase margin"), ("delay", "Delay margin")):
        cells = report.locator("tr", has=report.get_by_role("rowheader", name=row, exact=True)).locator("td")
        shown = [page.get_by_test_id(f"metric-{name}-{axis}").text_content() for axis in ("theta", "psi")]
        assert cells.all_text_contents() == shown, row


def test_the_menu_works_by_keyboard(page: Page):
    button = page.get_by_test_id("export")
    button.focus()
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("export-python")).to_be_focused()
    page.keyboard.press("ArrowRight")
    expect(page.get_by_test_id("export-matlab")).to_be_focused()
    page.keyboard.press("ArrowDown")
    expect(page.get_by_test_id("export-c-header")).to_be_focused()
    with page.expect_download() as download:
        page.keyboard.press("Enter")
    assert download.value.suggested_filename == "heli2dof_controller.h"
    page.keyboard.press("Escape")
    expect(button).to_be_focused()
    expect(button).to_have_attribute("aria-expanded", "false")


@pytest.mark.parametrize("status", [422, 503])
def test_a_refusal_is_told(page: Page, status: int):
    problem = {"title": "No", "status": status, "detail": "It cannot be made.", "code": "x"}
    page.evaluate(
        "(body) => { window.fetch = async () => new Response(JSON.stringify(body), { status: body.status }); }",
        problem,
    )
    page.get_by_test_id("export").click()
    page.get_by_test_id("export-csv").click()
    expect(page.get_by_test_id("export-told")).to_have_text("It cannot be made.")


def test_without_a_network_the_menu_says_so(page: Page):
    page.evaluate("() => { window.fetch = () => Promise.reject(new TypeError('Failed to fetch')); }")
    page.get_by_test_id("export").click()
    page.get_by_test_id("export-python").click()
    expect(page.get_by_test_id("export-told")).to_contain_text("No connection to the server")
