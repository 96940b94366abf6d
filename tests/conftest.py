"""Settings and fixtures that all tests share."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterator
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, settings

from heli2dof_core import Design, PoleSet, Spec, place, preset
from heli2dof_core.engine import warm_up

if TYPE_CHECKING:
    from playwright.sync_api import Browser

FLAGS = ["--no-sandbox", "--enable-unsafe-swiftshader", "--disable-background-networking"]

settings.register_profile("ci", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("local", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("ci" if os.environ.get("CI") else "local")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """No two tests may share an id: pytest-xdist would run the first alone, and nobody would see it."""
    times = Counter(item.nodeid for item in items)
    if times.total() > len(times):
        twice = ", ".join(name for name in times if times[name] > 1)
        raise pytest.UsageError(f"several tests have one id: {twice}")


@pytest.fixture(scope="session", autouse=True)
def compiled_kernels() -> None:
    """Nonlinear responses are many here; the interpreted kernels have a test of their own."""
    warm_up()


@pytest.fixture(scope="session")
def spec() -> Spec:
    """The default rig and the paper's example."""
    return Spec.from_preset(preset())


@pytest.fixture(scope="session")
def design(spec: Spec) -> Design:
    return place(spec)


@pytest.fixture(scope="session")
def complex_poles() -> PoleSet:
    return PoleSet([-3 + 4j, -3 - 4j, -5 + 2j, -5 - 2j])


@pytest.fixture(scope="session")
def chromium() -> Iterator[Browser]:
    """The one browser of a worker: Playwright allows one loop in a thread."""
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        path = os.environ.get("CHROMIUM") or "/usr/bin/chromium"
        browser = playwright.chromium.launch(executable_path=path, args=FLAGS)
        yield browser
        browser.close()
