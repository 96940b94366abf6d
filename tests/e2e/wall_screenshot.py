"""Takes the picture of a class at work: python -m tests.e2e.wall_screenshot docs/wall.png [width height [dark]]."""

from __future__ import annotations

import sys
from io import BytesIO

from PIL import Image
from playwright.sync_api import expect, sync_playwright

from tests.browser import FRAME, launched
from tests.e2e.classroom import LABS, Classroom, calling, filled, wall
from tests.e2e.conftest import running_app

STUDENTS, COLOURS = 40, 200


def main() -> None:
    target, *how = sys.argv[1:]
    width, height = (int(value) for value in how[:2]) if how else (1280, 800)
    scheme = "dark" if "dark" in how else "light"
    with (
        running_app(labs=LABS, database="memory") as app,
        calling(app.url) as client,
        sync_playwright() as playwright,
        launched(playwright.chromium) as browser,
    ):
        room = Classroom.made(client, "Control 2, Tuesday group")
        filled(room, STUDENTS)
        with wall(browser, app.url, room, size=(width, height), color_scheme=scheme) as page:
            expect(page.locator("[data-testid=wall-rows] tr")).to_have_count(STUDENTS)
            page.locator(".everyone g").nth(7).dispatch_event("pointerenter")
            page.evaluate(FRAME)
            taken = Image.open(BytesIO(page.screenshot(animations="disabled")))
            taken.convert("RGB").quantize(COLOURS).save(target, optimize=True)


if __name__ == "__main__":
    main()
