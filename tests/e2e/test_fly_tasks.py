"""Tasks in the air in a real browser: flown, scored and kept as the best; what does not count says why."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, expect

from heli2dof_core.flight import FlightLog, simulate_flight
from heli2dof_core.flight.scores import score
from heli2dof_core.flight.task_flights import require_task
from heli2dof_core.flight.tasks import TASKS
from tests.browser import EMPTY, opened
from tests.e2e.conftest import App
from tests.e2e.flying import HEARD, fly, waits

FLOWN = "addEventListener('flown', (e) => { window.flown = e.detail; }, true);"
LANDED = re.compile(r"^\d+\.\d\d s ★+")
MARK = TASKS["land"].marks[0]


@pytest.fixture
def page(chromium: Browser, app: App) -> Iterator[Page]:
    """The view Fly with the task of landing chosen, before its first flight."""
    with opened(chromium, f"{app.url}#fly", scene=HEARD + FLOWN + EMPTY) as page:
        page.get_by_test_id("fly-task").select_option("land")
        yield page


def land(page: Page) -> None:
    """Begins, and sends the set points to the mark."""
    fly(page)
    page.evaluate(
        "([share, psi]) => window.flight.do('reference', 0.14 * share, psi)", [MARK.theta, MARK.psi]
    )


def test_a_task_is_flown_scored_and_kept_as_the_best(page: Page):
    land(page)
    expect(page.get_by_test_id("task-asked")).to_contain_text("ψ 60")
    waits(page, "state.mode === 'ended'")
    result = page.get_by_test_id("task-result")
    expect(result).to_have_text(LANDED)
    told = page.evaluate("() => window.flown")
    course = simulate_flight(FlightLog.read(told["log"]))
    require_task(course)
    own = score(course)
    assert own.done and told["values"]["flight_time"] == pytest.approx(own.value("flight_time"), abs=1e-9)
    assert told["values"]["flight_effort"] == pytest.approx(own.value("flight_effort"), rel=1e-9)
    assert (result.text_content() or "").count("★") == own.stars
    page.get_by_test_id("fly-task").select_option("hold")
    expect(result).to_have_text("")
    page.get_by_test_id("fly-task").select_option("land")
    expect(result).to_contain_text("Your best: ")


@pytest.mark.parametrize(
    ("done", "why"),
    [
        ("do('push', 0.05, 0)", "Something else acted on the rig"),
        ("setSpeed(0.5)", "It was slowed"),
        ("rewind(1)", "It was rewound"),
    ],
)
def test_what_is_no_flight_of_the_task_is_practice(page: Page, done: str, why: str):
    land(page)
    page.evaluate(f"() => {{ window.flight.{done}; }}")
    if "push" in done:
        page.evaluate("() => window.flight.do('push', 0, 0)")
    if "rewind" in done:
        page.evaluate(
            "([share, psi]) => window.flight.do('reference', 0.14 * share, psi)", [MARK.theta, MARK.psi]
        )
    waits(page, "state.mode === 'ended'")
    result = page.get_by_test_id("task-result")
    expect(result).to_contain_text("Practice: ")
    expect(result).to_contain_text(why)
    assert page.evaluate("() => window.flown ?? null") is None
