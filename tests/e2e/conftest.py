"""The whole app on a free port, and a real browser."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory

import httpx2
import pytest
from playwright.sync_api import Browser, Page

from tests.browser import UNDRAWN, opened
from tests.children import SERVE, served
from tests.e2e.classroom import LABS, Classroom, calling
from tests.patience import PATIENCE, until


@dataclass(frozen=True)
class App:
    """The running app."""

    port: int

    @property
    def url(self) -> str:
        return f"http://127.0.0.1:{self.port}/"


@contextmanager
def running_app(port: int = 0, **settings: object) -> Iterator[App]:
    """The app as `heli2dof serve` starts it, in a process of its own, ready to compute.

    It has these settings; slow work may take as long as a test waits for it.
    """
    settings = {"slow_seconds": PATIENCE} | settings
    command = (*SERVE, "--port", str(port))
    with TemporaryDirectory() as folder, served(Path(folder), command, **settings) as server:
        until(lambda: server.answers, "the app is ready")
        yield App(server.port)
        server.process.terminate()
        assert server.process.wait(PATIENCE) == 0, server.log.read_text()


@pytest.fixture(scope="session")
def app() -> Iterator[App]:
    with running_app() as app:
        yield app


@pytest.fixture
def page(chromium: Browser, app: App) -> Iterator[Page]:
    """The page, its scene's frame empty; nothing plays by itself."""
    with opened(chromium, app.url) as page:
        yield page


@pytest.fixture
def page_with_scene(chromium: Browser, app: App) -> Iterator[Page]:
    """The page with its scene, which has everything but pixels, and plays."""
    with opened(chromium, app.url, scene=UNDRAWN, moving=True) as page:
        yield page


@pytest.fixture(scope="session")
def lab_server() -> Iterator[App]:
    """The app with the lab `wall` of these tests, and a database of its own."""
    with running_app(labs=LABS, database="memory") as app:
        yield app


@pytest.fixture(scope="session")
def rest(lab_server: App) -> Iterator[httpx2.Client]:
    """Calls to that server."""
    with calling(lab_server.url) as client:
        yield client


@pytest.fixture
def room(rest: httpx2.Client) -> Classroom:
    """A class there, with nobody in it."""
    return Classroom.made(rest)
