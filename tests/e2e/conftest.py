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
from playwright.sync_api import Browser, Page

from tests.browser import UNDRAWN, opened
from tests.patience import until

ROOT = Path(__file__).parents[2]


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
