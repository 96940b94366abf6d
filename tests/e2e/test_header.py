"""The header at every width: its controls lie side by side, each can be hit, and the page never scrolls sideways."""

from __future__ import annotations

import pytest
from playwright.sync_api import Browser

from tests.browser import opened
from tests.e2e.conftest import App

WIDTHS = (320, 390, 600, 760, 820, 900, 1024, 1100, 1180, 1280, 1366, 1500, 1600, 1920, 4000)

LAID_OUT = """async () => {
  for (let i = 0; i < 2; i++) await new Promise(requestAnimationFrame); // the charts take the new width
  const name = (e) => e.dataset.testid || e.className || e.textContent;
  const shown = [...document.querySelectorAll('header :is(button, a, select, h1, .connection, .locked)')]
    .filter((e) => e.checkVisibility({ visibilityProperty: true }));
  const boxes = new Map(shown.map((e) => [e, e.getBoundingClientRect()]));
  const wrong = [];
  for (const [e, a] of boxes) {
    for (const [f, b] of boxes) {
      if (e === f || e.contains(f) || f.contains(e)) continue;
      const wide = Math.min(a.right, b.right) - Math.max(a.left, b.left);
      const high = Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top);
      if (wide > 1.5 && high > 1.5) wrong.push(`${name(e)} over ${name(f)}`); // joined buttons share a border
    }
    const top = document.elementFromPoint(a.left + a.width / 2, a.top + a.height / 2);
    if (!top || !(e.contains(top) || top.contains(e))) wrong.push(`${name(e)} is hit at ${top && name(top)}`);
    if (a.left < 0 || a.right > innerWidth) wrong.push(`${name(e)} is cut`);
  }
  const { scrollWidth, clientWidth } = document.documentElement;
  if (scrollWidth > clientWidth) {
    const beyond = (e) => e.checkVisibility() && e.getBoundingClientRect().right > clientWidth + 1;
    const wide = [...document.querySelectorAll('body *')].filter(beyond);
    wrong.push(`scrolls sideways by ${scrollWidth - clientWidth}: ${wide.slice(0, 6).map(name)}`);
  }
  return { wrong, count: shown.length };
}"""
LOST = """() => {
  const status = document.querySelector('.connection');
  status.className = 'connection lost';
  status.querySelector('.dot + span').textContent = 'connection lost';
  status.querySelector('.kept').hidden = false;
}"""


@pytest.mark.parametrize("link", ["", "#v1&lock=rig,poles,loops", "?projector#explore"])
def test_no_control_lies_over_another_at_any_width(chromium: Browser, app: App, link: str):
    with opened(chromium, app.url + link) as page:
        for lost in (False, True):
            if lost:
                page.evaluate(LOST)
            for width in WIDTHS:
                page.set_viewport_size({"width": width, "height": 900})
                found = page.evaluate(LAID_OUT)
                assert found["count"] >= 10, (width, found)
                assert not found["wrong"], (width, lost, found["wrong"])
