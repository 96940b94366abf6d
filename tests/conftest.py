"""Settings, fixtures and the last lines of a run, which all tests share."""

from __future__ import annotations

import os
import re
from collections import Counter
from collections.abc import Generator, Iterator
from typing import TYPE_CHECKING

import pytest
from hypothesis import HealthCheck, settings

from heli2dof_core import Design, PoleSet, Spec, place, preset
from heli2dof_core.engine import warm_up

if TYPE_CHECKING:
    from playwright.sync_api import Browser

os.environ.setdefault("HELI2DOF_DATABASE", "memory")  # no test writes to a user's own
os.environ.setdefault("HELI2DOF_WORKERS", "0")  # an app within a test's process has its slow work there, too

settings.register_profile("ci", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("local", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("ci" if os.environ.get("CI") else "local")

MARKED = {"e2e": "browser", "deploy": "deploy"}
"""Folders whose tests all have a marker."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Marks tests by their folder. No two may share an id: pytest-xdist would run the first alone, unseen."""
    times = Counter(item.nodeid for item in items)
    if times.total() > len(times):
        twice = ", ".join(name for name in times if times[name] > 1)
        raise pytest.UsageError(f"several tests have one id: {twice}")
    for item in items:
        if (marker := MARKED.get(item.path.parent.name)) is not None:
            item.add_marker(marker)


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Pictures the pages that are open while a test fails."""
    report = yield
    browser: Browser | None = getattr(item, "funcargs", {}).get("chromium")
    if report.failed and browser is not None:
        from tests.browser import pictured

        report.sections += [("Pictures", line) for context in browser.contexts for line in pictured(context)]
    return report


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> Generator[None, None, None]:
    """What failed comes last: for each its id, the message's first line, and where its pictures are."""
    yield
    for report in terminalreporter.stats.get("failed", []) + terminalreporter.stats.get("error", []):
        crash = getattr(report.longrepr, "reprcrash", None)
        message = crash.message if crash else str(report.longrepr)
        terminalreporter.write_line(f"✕ {report.nodeid} ({report.when})", red=True)
        terminalreporter.write_line(f"  {message.splitlines()[0][:200] if message else ''}")
        told = "\n".join(text for _, text in report.sections)
        for picture in dict.fromkeys(re.findall(r"^picture: (.+)$", told, re.M)):
            terminalreporter.write_line(f"  {picture}")


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

    from tests.browser import launched

    with sync_playwright() as playwright, launched(playwright.chromium) as browser:
        yield browser
