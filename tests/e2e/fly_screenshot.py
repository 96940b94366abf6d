"""Takes the picture of a flight: python -m tests.e2e.fly_screenshot docs/fly.png [width height [dark]]."""

from __future__ import annotations

import sys
from io import BytesIO

from PIL import Image
from playwright.sync_api import Page, sync_playwright

from tests.browser import DRAWN, launched, opened, settled
from tests.e2e.conftest import running_app
from tests.e2e.flying import HEARD, fly
from tests.e2e.test_page import scene
from tests.e2e.test_scene import rendered

COLOURS = 256
TICK = 0.002
TURNS = [
    (1.0, 0.0, 1.2),
    (3.2, 0.6, 0.0),
    (4.0, 0.0, 0.0),
    (10.0, -0.6, -1.2),
    (11.2, 0.0, 0.0),
    (14.2, 0.6, 1.2),
]
"""From when on set points move how fast: s, rad/s."""
GUST, POLE, LAST = 6.0, 8.5, 15.0
"""When a gust comes, and a pole is moved; when the picture is taken, s."""


def until(page: Page, time: float) -> None:
    """Flies on to a time, however long that takes here."""
    page.evaluate(
        "(tick) => { const { flight } = window; flight.step(tick - flight.craft.tick); }", round(time / TICK)
    )


def flown(page: Page) -> None:
    """A flight with a gust and a change of the design in it, frozen amid a turn."""
    fly(page)
    page.evaluate("() => window.flight.freeze()")
    for time, *what in sorted([*TURNS, (GUST, "gust"), (POLE, "pole")], key=lambda event: event[0]):
        until(page, time)
        match what:
            case ["gust"]:
                page.get_by_test_id("gust-large").click()
            case ["pole"]:
                field = page.get_by_test_id("pole-field-2")
                field.fill("-4")
                field.press("Enter")
                settled(page)
            case rates:
                page.evaluate("(rates) => window.flight.do('turn', ...rates)", rates)
    until(page, LAST)


def main() -> None:
    target, *how = sys.argv[1:]
    width, height = (int(value) for value in how[:2]) if how else (1280, 800)
    scheme = "dark" if "dark" in how else "light"
    with (
        running_app() as app,
        sync_playwright() as playwright,
        launched(playwright.chromium) as browser,
        opened(
            browser,
            f"{app.url}#fly",
            scene=HEARD + DRAWN,
            moving=True,
            size=(width, height),
            color_scheme=scheme,
        ) as page,
    ):
        frame = scene(page)
        flown(page)
        page.evaluate("() => document.activeElement.blur()")
        rendered(frame, 5)
        taken = Image.open(BytesIO(page.screenshot(animations="disabled")))
        colours = taken.convert("RGB").quantize(COLOURS, kmeans=3, dither=Image.Dither.NONE)
        colours.save(target, optimize=True)


if __name__ == "__main__":
    main()
