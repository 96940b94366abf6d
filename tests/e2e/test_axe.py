"""axe-core's rules on the page as it opens, in its schemes and sizes, and with what only appears on demand."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page

from tests.browser import opened, settled, view
from tests.e2e.conftest import App

AXE = Path(__file__).parents[2] / "node_modules" / "axe-core" / "axe.min.js"
RUN = """async () => {
  const { violations } = await axe.run(document, { iframes: false });
  const told = (node) => `${node.target.join(' ')}: ${node.failureSummary.split('\\n').slice(1).join('; ')}`;
  return violations.flatMap((rule) => rule.nodes.map((node) => `${rule.id} (${rule.impact}): ${told(node)}`));
}"""


def violations(page: Page) -> list[str]:
    """What axe finds, one line per element."""
    assert AXE.is_file(), "axe-core is fetched by `make node_modules/.installed` (npm ci)"
    # From the page's own origin, as its policy allows no inline script.
    page.route("**/axe.js", lambda route: route.fulfill(path=AXE, content_type="text/javascript"))
    page.add_script_tag(url="axe.js")
    return page.evaluate(RUN)


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_no_violation(chromium: Browser, app: App, size: tuple[int, int]):
    with opened(chromium, app.url, size=size, color_scheme="dark") as page:
        assert violations(page) == []
        page.emulate_media(color_scheme="light")
        settled(page)
        assert page.evaluate(RUN) == []
        page.get_by_test_id("requirements").click()
        page.get_by_test_id("require-settling").fill("0.4")
        page.get_by_test_id("require-overshoot").fill("5")
        page.get_by_test_id("mode-yaw-complex").click()
        settled(page)
        page.get_by_test_id("pole-1").focus()
        assert page.evaluate(RUN) == []
        page.emulate_media(color_scheme="dark")
        settled(page)
        assert page.evaluate(RUN) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_no_violation_in_the_other_views(chromium: Browser, app: App, scheme: str):
    with opened(chromium, app.url, color_scheme=scheme) as page:
        violations(page)
        for name, section, there in (
            ("explore", "explore", "[data-testid=step-ask]"),
            ("compare", "compare", "[data-testid=splits-table] td"),
            ("compare", "compare .card:last-child", "[data-testid=interaction-loop-phase] canvas"),
            ("rig", "rig", "[data-testid=rig-B_y]"),
            ("derivation", "formulas", ".symbols math"),
            ("derivation", "paper", "[data-testid=paper-K] td, [data-testid=paper-tally]"),
        ):
            view(page, name)
            page.locator(f"#{section}").scroll_into_view_if_needed()
            page.locator(f"#{section}").locator(there).first.wait_for(state="attached")
            assert page.evaluate(RUN) == [], name


def test_axe_would_find_something(page: Page):
    page.evaluate("() => document.body.append(document.createElement('button'))")
    assert any(line.startswith("button-name") for line in violations(page))
