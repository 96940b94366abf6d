"""Identification that convinces: both fits, what is held out, whiteness, free inertias, the recording beside."""

from __future__ import annotations

import re

from playwright.sync_api import Page, expect

from tests.browser import settled, state, view
from tests.e2e.test_axe import violations
from tests.patience import until


def sampled(page: Page) -> None:
    view(page, "rig")
    page.get_by_test_id("recording-sample").click()
    expect(page.get_by_test_id("recording-fit-theta")).to_contain_text("fit")


def share(page: Page, part: str, cell: int) -> float:
    text = page.get_by_test_id(f"recording-part-{part}").locator("td").nth(cell).inner_text()
    return -100.0 if "below" in text else float(text.split()[0].replace("−", "-"))


def test_before_and_found_with_what_is_held_out(page: Page):
    sampled(page)
    expect(page.get_by_test_id("recording-synthetic")).to_contain_text("no real one was measured")
    expect(page.get_by_test_id("recording-hold")).to_be_checked()
    page.get_by_test_id("recording-identify").press("Enter")
    expect(page.get_by_test_id("recording-part-held-psi")).to_be_visible()
    expect(page.get_by_test_id("recording-found")).to_be_focused()
    for part in ("fitted-theta", "fitted-psi", "held-theta", "held-psi"):
        assert share(page, part, 2) > max(95, share(page, part, 1)), part
    for axis in ("theta", "psi"):
        expect(page.get_by_test_id(f"recording-whiteness-{axis}")).to_contain_text("hite")
        assert page.get_by_test_id(f"recording-fitted-{axis}").locator("canvas").count() == 3
    row = page.get_by_test_id("recording-estimate-K_pp")
    width, noise = (
        float(row.locator("td").nth(i).inner_text().removeprefix("± ").replace("−", "-")) for i in (3, 5)
    )
    assert width > 3 * noise, "what the model may leave out is more than the noise of this recording"
    plots = page.get_by_test_id("recording-fitted-theta")

    def read() -> bool:
        """Moves the cursor by a key; a chart that takes a new size meanwhile has none."""
        plots.get_by_role("group").first.press("ArrowRight")
        return bool(re.match(r"^−?\d+\.\d\d°$", plots.locator("figcaption .value").first.inner_text()))

    until(read, "a value is read by keys")
    assert violations(page) == []
    page.get_by_test_id("recording-hold").uncheck()
    page.get_by_test_id("recording-identify").click()
    expect(page.get_by_test_id("recording-part-held-psi")).to_have_count(0)
    expect(page.get_by_test_id("recording-part-fitted-psi")).to_be_visible()


def test_inertias_are_free_where_they_are_wanted(page: Page):
    sampled(page)
    expect(page.get_by_test_id("recording-scaled")).to_be_hidden()
    page.get_by_test_id("recording-free-J_y").check()
    expect(page.get_by_test_id("recording-scaled")).to_be_visible()
    page.get_by_test_id("recording-identify").click()
    expect(page.get_by_test_id("recording-estimate-J_y")).to_be_visible()
    expect(page.locator(".recording-remarks .warning")).to_contain_text(["J_y is known to"])


def test_the_recording_beside_the_design(page: Page):
    legend = page.get_by_test_id("legend").get_by_text("recorded")
    expect(legend).to_be_hidden()
    sampled(page)
    ink = """() => {
      const canvas = document.querySelector('[data-testid=plot-theta] .u-wrap canvas');
      const [r, g, b] = [0x3f, 0x6b, 0x12];
      const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
      let count = 0;
      for (let i = 0; i < data.length; i += 4)
        count += Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 12;
      return count;
    }"""
    assert page.evaluate(ink) == 0
    page.get_by_test_id("beside-plots").check()
    view(page, "design")
    expect(legend).to_be_visible()
    view(page, "rig")
    expect(page.get_by_test_id("beside-words")).to_contain_text("are the plots’ 0 s.")
    page.wait_for_function(f"() => ({ink})() > 100")
    page.get_by_test_id("beside-from").fill("99")
    page.get_by_test_id("beside-from").press("Enter")
    expect(page.get_by_test_id("beside-words")).to_contain_text("choose an earlier one")
    page.wait_for_function(f"() => ({ink})() === 0")
    page.get_by_test_id("beside-step").select_option(index=2)
    page.wait_for_function(f"() => ({ink})() > 100")
    assert violations(page) == []


def test_what_was_found_is_kept_as_a_rig(page: Page):
    sampled(page)
    page.get_by_test_id("recording-identify").click()
    page.get_by_test_id("recording-keep").click()
    settled(page)
    expect(page.get_by_test_id("recording-kept")).to_contain_text("heli2dof-recording is kept")
    assert state(page)["rig"] == "heli2dof-recording"
    assert len(state(page)["parameters"]) == 6
    expect(page.get_by_test_id("preset")).to_have_value("own:heli2dof-recording")
