"""Recordings in the browser: sample, columns, fit, identification, adopt, by keyboard and clean for axe."""

from __future__ import annotations

import re

import pytest
from playwright.sync_api import Page, expect

from tests.browser import settled, state, view
from tests.e2e.test_axe import violations


@pytest.fixture(autouse=True)
def rig(page: Page) -> None:
    view(page, "rig")


def fit(page: Page, axis: str) -> float:
    return float(page.get_by_test_id(f"recording-fit-{axis}").inner_text().split()[1].replace("−", "-"))


def test_from_a_sample_to_the_adopted_rig(page: Page):
    expect(page.get_by_test_id("recording-identify")).to_be_hidden()
    page.get_by_test_id("recording-sample").focus()
    page.keyboard.press("Enter")
    expect(page.get_by_test_id("recording-fit-theta")).to_contain_text("fit")
    wrong = fit(page, "theta")
    expect(page.get_by_test_id("recording-column-theta")).to_have_value("theta")
    expect(page.get_by_test_id("recording-save")).to_be_visible()
    page.get_by_test_id("recording-identify").focus()
    page.keyboard.press("Enter")
    found = page.get_by_test_id("recording-estimate-K_pp").locator("td").nth(2)
    expect(found).to_have_text(re.compile(r"0\.\d+"))
    assert violations(page) == []
    page.get_by_test_id("recording-adopt").click()
    settled(page)
    assert abs(state(page)["parameters"]["K_pp"] - float(found.inner_text())) < 1e-4
    expect(page.get_by_test_id("recording-overlay")).to_be_hidden()
    page.wait_for_function(
        "(before) => Number(document.querySelector('[data-testid=recording-fit-theta]').textContent"
        ".split(' ')[1]) > before",
        arg=max(wrong, 90),
    )
    page.get_by_test_id("undo").click()
    settled(page)
    assert state(page)["parameters"] == {}


def test_lag_is_looked_for_where_it_is_asked_for(page: Page):
    page.get_by_test_id("recording-sample").click()
    expect(page.get_by_test_id("recording-fit-theta")).to_contain_text("fit")
    group = page.get_by_role("group", name="Rotors and friction")
    assert group.get_by_role("checkbox").count() == 4
    assert group.get_by_role("checkbox", checked=True).count() == 0
    group.get_by_role("checkbox").first.check()
    page.get_by_test_id("recording-identify").click()
    row = page.get_by_test_id("recording-estimate-rotors.pitch.tau")
    expect(row.locator("td").nth(2)).to_have_text(re.compile(r"0\.0\d+"))
    expect(row.locator("th")).to_have_text("τp")
    assert violations(page) == []


def test_a_file_of_ones_own(page: Page):
    rows = [f"{0.01 * k},{k % 7},{k % 5},12.5,{-3.8 + 0.1 * (k % 3)}" for k in range(60)]
    page.get_by_test_id("recording-file").set_input_files(
        {"name": "lab.csv", "mimeType": "text/csv", "buffer": "\n".join(["t,a,b,c,d", *rows]).encode()}
    )
    expect(page.get_by_test_id("recording-status")).to_contain_text("lab.csv: 60 rows, 5 columns")
    expect(page.get_by_test_id("recording-identify")).to_be_hidden()
    page.get_by_test_id("recording-unit").select_option("deg")
    for role, name in (("theta", "a"), ("psi", "b"), ("V_p", "c"), ("V_y", "d")):
        page.get_by_test_id(f"recording-column-{role}").select_option(name)
    expect(page.get_by_test_id("recording-fit-theta")).to_contain_text("fit")
    references = page.locator("[data-testid=recording-driver] option[value=references]")
    expect(references).to_be_disabled()
    for role in ("theta_ref", "psi_ref"):
        page.get_by_test_id(f"recording-column-{role}").select_option("a")
    expect(references).to_be_enabled()
