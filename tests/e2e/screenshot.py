"""Takes the README's picture: python -m tests.e2e.screenshot docs/screenshot.png [width height]."""

from __future__ import annotations

import os
import sys

from playwright.sync_api import sync_playwright

from tests.conftest import FLAGS
from tests.e2e.conftest import DRAWN, opened, running_app, settled
from tests.e2e.test_page import scene, seek


def main() -> None:
    target, *size = sys.argv[1:]
    width, height = (int(value) for value in size) if size else (1280, 800)
    with running_app() as app, sync_playwright() as playwright:
        path = os.environ.get("CHROMIUM") or "/usr/bin/chromium"
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        page = browser.new_page(viewport={"width": width, "height": height})
        opened(page, app.url, scene=DRAWN)
        frame = scene(page)
        seek(page, 0.12)
        settled(page)
        drawn = "window.__viserTestpoints.rendererInfo.render.frame"
        frame.wait_for_function(f"(start) => {drawn} > start + 5", arg=frame.evaluate(drawn))
        page.screenshot(path=target)
        browser.close()


if __name__ == "__main__":
    main()
