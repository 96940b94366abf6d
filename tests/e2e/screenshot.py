"""Takes the README's picture: python -m tests.e2e.screenshot docs/screenshot.png [width height]."""

from __future__ import annotations

import sys

from playwright.sync_api import sync_playwright

from tests.browser import DRAWN, launched, opened, settled
from tests.e2e.conftest import running_app
from tests.e2e.test_page import scene, seek
from tests.e2e.test_scene import rendered

SEEN = "#v1&view=explore&outer=none&p=-6+6.5j,-6-6.5j,-9.25,-8.76"
"""The first minute, its first step done."""


def main() -> None:
    target, *size = sys.argv[1:]
    width, height = (int(value) for value in size) if size else (1280, 800)
    with (
        running_app() as app,
        sync_playwright() as playwright,
        launched(playwright.chromium) as browser,
        opened(browser, app.url + SEEN, scene=DRAWN, moving=True, size=(width, height)) as page,
    ):
        frame = scene(page)
        seek(page, 0.45)
        settled(page)
        rendered(frame, 5)
        page.screenshot(path=target)


if __name__ == "__main__":
    main()
