"""A step that is flown, in a real browser: led to the view Fly, judged by the page, handed in, also after a while
without a network."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from playwright.sync_api import Browser, Page, expect

from heli2dof_core.flight import FlightLog, simulate_flight
from heli2dof_core.flight.scores import score
from heli2dof_core.labs import read_lab
from heli2dof_core.labs.flights import tried_flight
from tests.browser import settled, state, view
from tests.e2e.conftest import App, running_app
from tests.e2e.lab_pages import Class, goal, handed_in, joined, lab, ready
from tests.e2e.test_axe import violations
from tests.labs.test_flight_goals import LAB

STEP = read_lab(LAB).steps[0]
GOAL = "flight-error-rms-both"


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[App]:
    folder = tmp_path_factory.mktemp("labs")
    (folder / "flown.yaml").write_text(LAB, "utf-8")
    with running_app(labs=folder, database="memory") as app:
        yield app


def seen(page: Page, name: str) -> None:
    """Waits until a view is seen, to which nobody went by its link."""
    page.wait_for_function("(name) => document.documentElement.dataset.view === name", arg=name)


def moved(page: Page, *poles: float) -> None:
    """Sets real and imaginary parts of both pairs."""
    for n, pole in enumerate(poles):
        field = page.get_by_test_id(f"pole-field-{n}")
        field.fill(str(pole))
        field.press("Enter")
    settled(page)


def body_of(page: Page, name: str) -> dict[str, Any]:
    """The design that the page has kept, as a flight's log has it: nothing that is empty."""
    kept = json.loads(page.evaluate("(name) => localStorage.getItem(name)", f"heli2dof.{name}"))
    own = kept["steps"]["calm"]["design"] if "steps" in kept else kept["design"]
    return {part: value for part, value in own.items() if value not in (None, {})}


def fly(page: Page, body: dict[str, Any]) -> dict[str, Any]:
    """The task is flown to its end with this design, as the view Fly tells it."""
    log = tried_flight(STEP, body)
    assert log is not None
    values = score(simulate_flight(FlightLog.read(log))).values
    page.evaluate(
        "(detail) => document.dispatchEvent(new CustomEvent('flown', {detail}))",
        {"log": log, "values": dict(values)},
    )
    return log


def test_a_task_is_flown_judged_and_handed_in_with_the_design_that_flew(chromium: Browser, server: App):
    with lab(chromium, f"{server.url}#lab=flown") as visit:
        page = visit.page
        ready(page)
        seen(page, "fly")
        line = page.get_by_test_id("lab-flight")
        expect(line).to_have_text("Not flown yet.")
        goal(page, GOAL, "missed")
        view(page, "design")
        handed_in(page, "of 4 points")
        expect(page.get_by_test_id(f"lab-goal-{GOAL}")).to_contain_text("Fly it")
        page.get_by_test_id("lab-fly").click()
        seen(page, "fly")
        moved(page, -6, 4, -7, 3)
        log = fly(page, body_of(page, "lab.flown"))
        expect(line).to_contain_text(log["checksum"])
        goal(page, GOAL, "met")
        told = page.get_by_test_id(f"lab-goal-{GOAL}").locator(".lab-value")
        by_page = told.inner_text()
        assert by_page.endswith("°")
        handed_in(page, "Handed in: 4 of 4 points")
        expect(told).to_have_attribute("title", "as the server marked it")
        assert told.inner_text() == by_page
        assert violations(page) == []
        # another design has not flown yet; the one that has counts again
        moved(page, -6.1)
        expect(line).to_have_text("Your flight was with another design: fly it with this one.")
        goal(page, GOAL, "missed")
        page.get_by_test_id("undo").click()
        expect(line).to_contain_text(log["checksum"])
        # whoever comes back finds it
        page.reload()
        ready(page)
        expect(page.get_by_test_id("lab-flight")).to_contain_text(log["checksum"])
        assert (
            "best" in json.loads(page.evaluate("localStorage.getItem('heli2dof.lab.flown')"))["steps"]["calm"]
        )
        assert [round(abs(pole["im"]), 1) for pole in state(page)["poles"]] == [4, 4, 3, 3]


def test_a_flight_waits_for_the_network_with_its_attempt(chromium: Browser, server: App):
    room = Class(server, "flown")
    with lab(chromium, room.url) as visit:
        page = visit.page
        joined(page, "Ada")
        moved(page, -6, 4, -7, 3)
        (student,) = room.students
        log = fly(page, body_of(page, f"draft.{room.code}.{student['id']}"))
        page.context.set_offline(True)
        handed_in(page, "Kept here")
        page.context.set_offline(False)
        expect(page.get_by_test_id("lab-best")).to_contain_text("4 of 4 points")
        kept = room.call("GET", f"/students/{student['id']}")["steps"]["calm"]
        assert kept["goals"] == [True, True] and log["checksum"] in json.dumps(kept)
