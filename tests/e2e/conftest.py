"""The whole app on a free port, and a real browser."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import httpx2
import pytest
from playwright.sync_api import Browser, Page, expect

from tests.scene_server import until

ROOT = Path(__file__).parents[2]

PATIENCE = 90_000
"""Milliseconds; software rendering on two cores is slow."""
expect.set_options(timeout=20_000)  # ms; a busy machine draws a frame now and then


@dataclass(frozen=True)
class App:
    """The running app."""

    port: int

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/"


@contextmanager
def running_app(port: int = 0, **environment: str) -> Iterator[App]:
    """The app as `heli2dof serve` starts it, in a process of its own, ready to compute.

    Its environment has HELI2DOF_… of these names.
    """
    variables = {f"HELI2DOF_{name.upper()}": value for name, value in environment.items()}
    command = [sys.executable, "-m", "app", "serve", "--port", str(port)]
    process = subprocess.Popen(
        command, cwd=ROOT, env=os.environ | variables, stdout=subprocess.PIPE, text=True
    )
    try:
        assert process.stdout is not None
        announcement = process.stdout.readline()
        found = re.search(r"ready: http://127.0.0.1:(\d+)$", announcement)
        assert found, announcement
        app = App(int(found[1]))
        until(lambda: httpx2.get(app.url + "healthz").status_code == 200, "the app is ready", 60)
        yield app
    finally:
        process.terminate()
        status = process.wait(30)
        process.stdout.close()
    assert status == 0


@pytest.fixture(scope="session")
def app() -> Iterator[App]:
    with running_app() as app:
        yield app


@contextmanager
def page_of(chromium: Browser, app: App, *, scene: bool) -> Iterator[Page]:
    """The page at 1280×800, its first answer drawn; fails on any error in its console."""
    context = chromium.new_context(viewport={"width": 1280, "height": 800})
    page = context.new_page()
    errors: list[str] = []
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda message: message.type == "error" and errors.append(message.text))
    opened(page, app.url, scene=UNDRAWN if scene else EMPTY)
    yield page
    context.close()
    assert errors == []


@pytest.fixture
def page(chromium: Browser, app: App) -> Iterator[Page]:
    """The page, its scene's frame empty."""
    with page_of(chromium, app, scene=False) as page:
        yield page


@pytest.fixture
def page_with_scene(chromium: Browser, app: App) -> Iterator[Page]:
    """The page with its scene, which has everything but pixels."""
    with page_of(chromium, app, scene=True) as page:
        yield page


EMPTY = """Object.defineProperty(HTMLIFrameElement.prototype, "src", {
  get() { return this.wanted ?? ""; }, set(address) { this.wanted = address; }, configurable: true });"""
"""Leaves the scene's frame empty: viser's client takes seconds to start."""
UNDRAWN = """for (const call of ["drawArrays", "drawElements", "drawArraysInstanced", "drawElementsInstanced"]) {
  const draw = WebGL2RenderingContext.prototype[call];
  WebGL2RenderingContext.prototype[call] = function (...all) { if (window.drawn) draw.apply(this, all); };
}"""
"""Leaves out the drawing alone, most of the work without a graphics card, until the frame's `drawn` is set."""
DRAWN = ""
SEEN = "try { localStorage.setItem('heli2dof.tour', 'done') } catch { /* a frame without storage */ }"


def opened(page: Page, url: str, *, tour: bool = False, scene: str = EMPTY) -> None:
    """Opens the page and waits for its first answer.

    As at a first visit where `tour` is wanted; the scene is EMPTY, UNDRAWN or DRAWN.
    """
    page.set_default_timeout(PATIENCE)
    page.add_init_script(scene)
    if not tour:
        page.add_init_script(SEEN)
    page.goto(url)
    settled(page)


def settled(page: Page) -> None:
    """Waits until what is shown answers what was asked last; the page says so in the frame after an edit."""
    page.evaluate("() => new Promise((drawn) => requestAnimationFrame(drawn))")
    page.wait_for_function("() => JSON.parse(document.documentElement.dataset.state ?? '{}').settled")


def state(page: Page) -> dict:
    """What the page says of itself, after the frame that draws the last edit."""
    return page.evaluate(
        "async () => { await new Promise(requestAnimationFrame);"
        " return JSON.parse(document.documentElement.dataset.state); }"
    )
