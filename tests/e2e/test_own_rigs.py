"""Rigs of one's own: kept, in the menu, renamed, removed and back, saved and opened, told in links, in two tabs."""

from __future__ import annotations

import json
from pathlib import Path

from playwright.sync_api import Browser, Page, expect

from tests.browser import EMPTY, SEEN, opened, settled, state, view, visited
from tests.e2e.conftest import App
from tests.e2e.test_axe import violations


def kept(page: Page, name: str, K_pp: str) -> None:
    if not page.get_by_test_id("own-name").is_visible():
        view(page, "rig")
    page.get_by_test_id("rig-K_pp").fill(K_pp)
    page.get_by_test_id("rig-K_pp").press("Enter")
    page.get_by_test_id("own-name").fill(name)
    page.get_by_test_id("own-name").press("Enter")
    expect(page.get_by_test_id("own-told")).to_contain_text(f"{name} is kept")
    settled(page)


def test_kept_used_renamed_removed_and_back(page: Page):
    menu = page.get_by_test_id("preset")
    kept(page, "Lab 3", "0.25")
    expect(menu).to_have_value("own:Lab 3")
    page.get_by_test_id("rig-K_pp").fill("0.3")
    page.get_by_test_id("rig-K_pp").press("Enter")
    expect(menu.locator("option:checked")).to_have_text("Lab 3 (changed)")
    menu.select_option("quanser-aero-2")
    settled(page)
    assert "rig" not in state(page)
    menu.select_option("own:Lab 3")
    settled(page)
    assert (state(page)["preset"], state(page)["parameters"]) == ("quanser-2dof-manual", {"K_pp": 0.25})
    field = page.get_by_test_id("own-rename-Lab 3")
    field.fill("Lab 4")
    field.press("Enter")
    expect(menu).to_have_value("own:Lab 4")
    page.get_by_test_id("own-undo").click()
    expect(menu).to_have_value("own:Lab 3")
    page.get_by_test_id("own-remove-Lab 3").click()
    expect(page.get_by_test_id("own-list").locator("li")).to_have_count(0)
    expect(menu.locator("option:checked")).to_have_text("Lab 3 (not kept)")
    assert violations(page) == []
    page.get_by_test_id("own-undo").click()
    expect(menu.locator("option:checked")).to_have_text("Lab 3")
    page.reload()
    expect(page.locator("[data-testid=preset] optgroup option")).to_have_text(["Lab 3"])


def test_saved_and_opened(page: Page, tmp_path: Path):
    kept(page, "Lab 3", "0.25")
    with page.expect_download() as download:
        page.get_by_test_id("own-save-Lab 3").click()
    assert download.value.suggested_filename == "lab-3.heli2dof-rig.json"
    path = tmp_path / "rig.json"
    download.value.save_as(path)
    rig = json.loads(path.read_text("utf-8"))
    assert rig["parameters"]["K_pp"] == 0.25 and len(rig["parameters"]) == 12
    told = page.get_by_test_id("own-told")
    page.get_by_test_id("own-file").set_input_files(path)
    expect(told).to_have_text("Lab 3 2 is opened and kept.")
    path.write_text("K_pp = 1", "utf-8")
    page.get_by_test_id("own-file").set_input_files(path)
    expect(told).to_contain_text("no JSON")
    expect(page.get_by_test_id("own-list").locator("li")).to_have_count(2)


def test_files_are_judged_field_by_field(chromium: Browser, app: App, tmp_path: Path):
    rig = {
        "kind": "heli2dof-rig",
        "version": 1,
        "name": "Lab 3",
        "preset": "quanser-2dof-manual",
        "parameters": {"K_pp": 0.25},
        "limits": {"V_p": 20},
        "rotors": {"pitch": {}, "yaw": {"tau": 0.1}},
        "friction": {"pitch": {}, "yaw": {}},
        "operating_point": {"theta": 0},
    }
    path = tmp_path / "rig.json"
    with visited(chromium, EMPTY, SEEN, reduced_motion="reduce") as visit:
        visit.forgive("422")
        page = visit.page
        page.goto(app.url)
        view(page, "rig")
        told = page.get_by_test_id("own-told")
        for change, words in (
            ({"parameters": {**rig["parameters"], "m": -1}}, "parameters.m"),
            ({"rotors": {**rig["rotors"], "yaw": {"tau": "slow"}}}, "rotors.yaw.tau"),
            ({"limits": {**rig["limits"], "V_p": 0}}, "limits.V_p"),
            ({"colour": "red"}, "colour"),
            ({"preset": "none"}, "preset"),
            ({"operating_point": {"theta": 3}}, "operating_point.theta"),
        ):
            path.write_text(json.dumps({**rig, **change}), "utf-8")
            page.get_by_test_id("own-file").set_input_files(path)
            expect(told).to_contain_text(words)
        path.write_text(json.dumps(rig), "utf-8")
        page.get_by_test_id("own-file").set_input_files(path)
        expect(told).to_have_text("Lab 3 is opened and kept.")
        settled(page)
        assert state(page)["rotors"] == {"yaw": {"tau": 0.1}}


def test_a_link_carries_name_and_values(page: Page, chromium: Browser, app: App):
    kept(page, "Labor größer 3", "0.25")
    page.wait_for_function("() => location.hash.includes('rig=')")
    with opened(chromium, page.url) as other:
        settled(other)
        assert (state(other)["rig"], state(other)["parameters"]) == ("Labor größer 3", {"K_pp": 0.25})
        expect(other.get_by_test_id("preset").locator("option:checked")).to_have_text(
            "Labor größer 3 (not kept)"
        )
        assert state(other)["notice"] is None


def test_two_tabs_keep_the_same(page: Page):
    other = page.context.new_page()
    other.goto(page.url)
    expect(other.get_by_test_id("own-name")).to_have_count(1)
    kept(page, "first", "0.25")
    options = other.locator("[data-testid=preset] optgroup option")
    expect(options).to_have_text(["first"])
    kept(other, "second", "0.26")
    expect(page.locator("[data-testid=preset] optgroup option")).to_have_text(["first", "second"])


def test_a_browser_that_keeps_nothing_says_so(page: Page):
    page.evaluate(
        "() => { Storage.prototype.setItem = () => { throw new DOMException('full', 'QuotaExceededError'); }; }"
    )
    kept(page, "Lab 3", "0.25")
    expect(page.get_by_test_id("own-refused")).to_contain_text("save it as a file")
    expect(page.get_by_test_id("preset")).to_have_value("own:Lab 3")
