"""The browser of the tests: pages in fresh contexts, watched for errors, pictured where their test fails."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from playwright.sync_api import Browser, BrowserContext, BrowserType, Error, Page, expect

from tests import late
from tests.patience import PATIENCE

FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking"]
MOST = 1e3 * PATIENCE
"""Milliseconds that any wait may last. What it waits for is an event of the page; nothing waits for time alone."""
expect.set_options(timeout=MOST)
PICTURES = Path(__file__).parents[1] / "test-results"

EMPTY = """Object.defineProperty(HTMLIFrameElement.prototype, "src", {
  get() { return this.wanted ?? ""; }, set(address) { this.wanted = address; }, configurable: true });"""
"""Leaves the scene's frame empty: viser's client takes a second to start."""
UNDRAWN = """for (const call of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"]) {
  const draw = WebGL2RenderingContext.prototype[call];
  WebGL2RenderingContext.prototype[call] = function (...all) { if (window.drawn) draw.apply(this, all); };
}"""
"""Leaves out the drawing alone, most of the work without a graphics card, until the frame's `drawn` is set."""
DRAWN = ""
GONE = "net::ERR_CONNECTION_"
"""What the console says while a server is away."""
SEEN = "try { localStorage.setItem('heli2dof.view', 'design') } catch { /* a frame without storage */ }"
FRAME = "() => new Promise((drawn) => requestAnimationFrame(drawn))"


def launched(kind: BrowserType, *flags: str) -> Browser:
    """The browser that CHROMIUM names, or Debian's."""
    path = os.environ.get("CHROMIUM") or "/usr/bin/chromium"
    return kind.launch(executable_path=path, args=list(flags or FLAGS))


@dataclass
class Visit:
    """A context of its own, its first page, and the errors that its pages have told so far."""

    context: BrowserContext
    page: Page
    errors: list[str] = field(default_factory=list)
    forgiven: list[str] = field(default_factory=list)

    def forgive(self, kind: str) -> None:
        """Passes over the errors that a test expects, by a part of their words, also those still to come."""
        self.forgiven.append(kind)

    @property
    def unexpected(self) -> list[str]:
        return [error for error in self.errors if not any(kind in error for kind in self.forgiven)]

    def watch(self, page: Page) -> None:
        page.on("pageerror", lambda error: self.errors.append(str(error)))
        page.on("console", lambda message: message.type == "error" and self.errors.append(message.text))


@contextmanager
def visited(
    chromium: Browser, *scripts: str, size: tuple[int, int] = (1280, 800), **how: Any
) -> Iterator[Visit]:
    """An empty page in a context of its own, which runs the scripts before each of its pages' own.

    Fails on any error in the console of any of its pages, unless the test forgives it. Where the test
    fails meanwhile, each page is pictured.
    """
    context = chromium.new_context(viewport={"width": size[0], "height": size[1]}, **how)
    context.set_default_timeout(MOST)
    for script in (*late.scripts(), *filter(None, scripts)):
        context.add_init_script(script)
    page = context.new_page()
    visit = Visit(context, page)
    context.on("page", visit.watch)
    visit.watch(page)
    try:
        yield visit
    except BaseException:
        pictured(context)
        context.close()
        raise
    context.close()
    assert visit.unexpected == []


@contextmanager
def opened(
    chromium: Browser,
    url: str,
    *,
    scene: str = EMPTY,
    first: bool = False,
    moving: bool = False,
    size: tuple[int, int] = (1280, 800),
    **how: Any,
) -> Iterator[Page]:
    """The app's page, its first answer drawn.

    Args:
        chromium: the worker's browser.
        url: with the design's part, if any.
        scene: EMPTY, UNDRAWN or DRAWN.
        first: whether it is a first visit, which begins with the first minute.
        moving: whether a new response plays by itself, as it does unless one asks for reduced motion.
        size: of the window, CSS pixels.
        how: of the context, as Playwright names it.
    """
    how = {"reduced_motion": "no-preference" if moving else "reduce"} | how
    with visited(chromium, scene, "" if first else SEEN, size=size, **how) as visit:
        visit.page.goto(url)
        settled(visit.page)
        yield visit.page


def settled(page: Page) -> None:
    """Waits until what is shown answers what was asked last; the page says so in the frame after an edit."""
    page.evaluate(FRAME)
    page.wait_for_function("() => JSON.parse(document.documentElement.dataset.state ?? '{}').settled")


def view(page: Page, name: str) -> None:
    """Goes to one of the page's views, by its link."""
    page.get_by_test_id(f"view-{name}").click()
    page.wait_for_function("(name) => document.documentElement.dataset.view === name", arg=name)


def state(page: Page) -> dict[str, Any]:
    """What the page says of itself, after the frame that draws the last edit."""
    return page.evaluate(
        "async () => { await new Promise(requestAnimationFrame);"
        " return JSON.parse(document.documentElement.dataset.state); }"
    )


def goto(page: Page, url: str) -> None:
    """Opens an address in a page that is there, and waits for its first answer."""
    page.goto(url)
    settled(page)


def reopened(page: Page, url: str) -> None:
    """Opens an address anew: where only the part behind # is another, a browser loads nothing by itself."""
    page.goto("about:blank")
    goto(page, url)


@contextmanager
def later(page: Page, seconds: float = 10.0) -> Iterator[None]:
    """At its end the page's clock stands so much later: what waited for its time within has come, or never comes."""
    page.clock.install()
    yield
    page.clock.fast_forward(1e3 * seconds)
    page.evaluate(FRAME)


def until_state(page: Page, condition: str) -> None:
    """Waits for a condition on the page's state `s`, and until the answer to it is shown."""
    page.wait_for_function(
        f"() => {{ const s = JSON.parse(document.documentElement.dataset.state); return {condition}; }}"
    )
    settled(page)


def pictured(context: BrowserContext) -> list[str]:
    """Pictures each page of a context whose test fails; returns the lines that say where, printed as well."""
    test = os.environ.get("PYTEST_CURRENT_TEST", "").partition(" ")[0].rpartition("/")[2]
    slug = re.sub(r"[^\w.-]+", "-", test)[:80]
    told = []
    for number, page in enumerate(context.pages):
        with suppress(Error):  # it may have crashed
            PICTURES.mkdir(exist_ok=True)
            picture = PICTURES / f"{slug}-{os.getpid()}-{number}.png"
            page.screenshot(path=picture, timeout=5_000)
            told.append(f"picture: {picture.relative_to(PICTURES.parent)}")
            print(told[-1])
    return told
