"""A lab's package in an LMS that knows nothing of us: launched, worked in, handed in, left, come back to."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, Frame, expect

from app.ops.settings import static_folder
from app.scorm import lab_content, scorm_package
from heli2dof_core.labs import read_lab, start_body
from tests.browser import visited
from tests.children import ROOT
from tests.e2e.test_axe import violations
from tests.scorm_lms import Course, course

LAB = read_lab((ROOT / "tests/packed.yaml").read_text("utf-8"))
SETTLED = "() => JSON.parse(document.documentElement.dataset.state ?? '{}').settled"
FRAME = "() => new Promise((drawn) => requestAnimationFrame(drawn))"


@pytest.fixture(scope="module")
def lesson(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Course]:
    content, left_out = lab_content(LAB)
    assert [each.step for each in left_out] == ["noise", "quieter", "methods"]
    package = scorm_package(LAB.name, LAB.title, content, static_folder())
    with course(package.content, Path(tmp_path_factory.mktemp("course"))) as lesson:
        yield lesson


def state(frame: Frame) -> dict[str, Any]:
    frame.evaluate(FRAME)
    frame.wait_for_function(SETTLED)
    return frame.evaluate("() => JSON.parse(document.documentElement.dataset.state)")


def kept(page: Any) -> dict[str, Any]:
    """What the LMS has."""
    return page.evaluate("() => window.kept()")


def dragged(page: Any, frame: Frame, pole: int, dx: float) -> None:
    """A pole is dragged with the mouse, in several moves."""
    box = frame.locator(f'.pole[data-index="{pole}"]').first.bounding_box()
    assert box is not None
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    page.mouse.move(x, y)
    page.mouse.down()
    for k in range(1, 5):
        page.mouse.move(x + dx * k / 4, y)
        frame.evaluate(FRAME)
    page.mouse.up()


def placed(frame: Frame, pole: int, value: str) -> None:
    """A pole is typed."""
    field = frame.locator("#poles input.number").nth(pole)
    field.fill(value)
    field.press("Enter")
    frame.evaluate(FRAME)


def goal(frame: Frame, name: str) -> Any:
    return frame.get_by_test_id(f"lab-goal-{name}")


def test_a_lab_is_done_in_an_lms_without_any_server(chromium: Browser, lesson: Course):
    asked: list[str] = []
    with visited(chromium, reduced_motion="reduce") as visit:
        page = visit.page
        page.on("request", lambda request: asked.append(request.url))
        frame = lesson.launched(page, "student=s1")
        assert page.evaluate("() => window.calls[0]") == ["Initialize", "", "true"]
        assert kept(page)["core"]["lesson_status"] == "incomplete"

        # the rig is the student's, and the start the step's
        before = state(frame)
        assert before["poles"][0] == {"re": -2, "im": 0} and before["stable"]
        expect(goal(frame, "overshoot-theta")).to_have_attribute("data-kind", "missed")

        # a pole moves, and numbers with it
        dragged(page, frame, 0, -60)
        after = state(frame)
        assert after["poles"][0]["re"] < -2 and after["K"] != before["K"]
        assert after["poles"][2:] == before["poles"][2:]

        # goals tick at once, without handing in
        placed(frame, 0, "-6")
        placed(frame, 1, "-6.5")
        expect(goal(frame, "overshoot-theta")).to_have_attribute("data-kind", "met")
        assert kept(page)["core"]["score"]["raw"] == ""

        # answers, and all is handed in
        frame.get_by_test_id("lab-q-who-2").check()
        frame.get_by_test_id("lab-q-pole-input").fill("−6,0 rad/s")
        frame.get_by_test_id("lab-hand-in").click()
        expect(frame.get_by_test_id("lab-best")).to_contain_text("12 of 14")
        expect(frame.get_by_test_id("lab-q-pole-told")).to_contain_text("right")
        told = kept(page)
        assert (told["core"]["score"]["raw"], told["core"]["lesson_status"]) == ("60", "incomplete")
        assert len(told["suspend_data"]) < 500
        assert page.evaluate("() => window.calls.at(-1)[0]") == "Commit"

        # the second step goes on with it
        frame.get_by_test_id("lab-step-2").click()
        assert state(frame)["poles"][0] == {"re": -6, "im": 0}
        frame.get_by_test_id("lab-hand-in").click()
        expect(frame.get_by_test_id("lab-best")).to_contain_text("6 of 6")
        status = kept(page)["core"]
        assert (status["score"]["raw"], status["lesson_status"]) == ("90", "passed")

        page.evaluate("() => window.leave()")
        assert page.evaluate("() => window.calls.at(-1)") == ["Finish", "", "true"]
        spent = page.evaluate("() => window.calls.find(([, element]) => element === 'cmi.core.session_time')")
        assert re.fullmatch(r"0000:0\d:\d\d\.\d\d", spent[2]) and spent[3] == "true"
        assert {url.split("/")[2] for url in asked} == {lesson.url.split("/")[2]}
        assert not [url for url in asked if "/api/" in url]


def test_who_comes_back_goes_on_where_they_left(chromium: Browser, lesson: Course):
    with visited(chromium, reduced_motion="reduce") as visit:
        page = visit.page
        frame = lesson.launched(page, "student=s2")
        placed(frame, 0, "-7.125")
        frame.get_by_test_id("lab-q-why-input").fill("It dies away last: “ψ” lags.")
        frame.get_by_test_id("lab-hint-1").click()
        expect(frame.get_by_test_id("lab-hint-1-text")).to_contain_text("4/σ")
        frame.get_by_test_id("lab-hand-in").click()
        expect(frame.get_by_test_id("lab-best")).to_be_visible()
        best = frame.get_by_test_id("lab-best").inner_text()
        frame.get_by_test_id("lab-step-2").click()
        first = state(frame)
        page.evaluate("() => window.leave()")

        again = lesson.launched(page, "student=s2")
        assert state(again)["poles"] == first["poles"]
        assert state(again)["K"] == first["K"]  # on the same rig
        again.get_by_test_id("lab-step-1").click()
        assert state(again)["poles"][0] == {"re": -7.125, "im": 0}
        expect(again.get_by_test_id("lab-q-why-input")).to_have_value("It dies away last: “ψ” lags.")
        expect(again.get_by_test_id("lab-hint-1-text")).to_contain_text("4/σ")
        assert again.get_by_test_id("lab-best").inner_text() == best


def test_two_students_have_two_rigs_of_the_lab(chromium: Browser, lesson: Course):
    gains = []
    for student in ("s1", "s3"):
        with visited(chromium, reduced_motion="reduce") as visit:
            frame = lesson.launched(visit.page, f"student={student}")
            gains.append(state(frame)["K"])
    assert gains[0] != gains[1]
    content = (lesson.folder / "content.js").read_text().removeprefix("export default ").rstrip(";\n")
    rigs = [each["rig"] for each in json.loads(content)["rigs"]]
    assert len({json.dumps(rig) for rig in rigs}) == len(rigs) == 64
    assert start_body(LAB, "settle", rigs[0])["parameters"]["B_p"] == rigs[0]["parameters"]["B_p"]


def test_without_an_lms_it_works_and_says_that_nothing_is_kept(chromium: Browser, lesson: Course):
    with visited(chromium, reduced_motion="reduce") as visit:
        frame = lesson.launched(visit.page, "none")
        expect(frame.get_by_test_id("lab-standing")).to_contain_text("nothing is kept")
        placed(frame, 0, "-6")
        frame.get_by_test_id("lab-hand-in").click()
        expect(frame.get_by_test_id("lab-best")).to_be_visible()
        assert visit.page.evaluate("() => window.calls") == []


def test_a_session_that_the_lms_does_not_open_again_is_said_to_keep_nothing(
    chromium: Browser, lesson: Course
):
    """A reload within the LMS's page: SCORM 1.2 has one session for each launch."""
    with visited(chromium, reduced_motion="reduce") as visit:
        page = visit.page
        frame = lesson.launched(page)
        expect(frame.get_by_test_id("lab-standing")).to_contain_text("Kept in your course")
        page.evaluate("() => { window.API.LMSInitialize = () => 'false'; frames[0].location.reload(); }")
        expect(page.frames[1].get_by_test_id("lab-standing")).to_contain_text("open it in your course again")


def test_a_review_writes_nothing(chromium: Browser, lesson: Course):
    with visited(chromium, reduced_motion="reduce") as visit:
        frame = lesson.launched(visit.page, "mode=review")
        expect(frame.get_by_test_id("lab-standing")).to_contain_text("review")
        frame.get_by_test_id("lab-hand-in").click()
        expect(frame.get_by_test_id("lab-best")).to_be_visible()
        written = visit.page.evaluate("() => window.calls.filter(([name]) => name === 'SetValue')")
        assert written == []


def test_what_only_a_server_knows_is_said_and_nothing_fails(chromium: Browser, lesson: Course):
    with visited(chromium, reduced_motion="reduce") as visit:
        frame = lesson.launched(visit.page)
        expect(frame.locator(".left-out")).to_contain_text("need a server")
        expect(frame.locator(".left-out")).to_contain_text("With noise")
        expect(frame.locator(".practice")).to_contain_text("marks itself")
        expect(frame.get_by_test_id("verdict")).to_contain_text("Stable")
        assert frame.locator(".notice:visible").count() == 0


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", [(1280, 800), (820, 1180), (390, 844)], ids=lambda size: f"{size[0]}")
def test_it_fits_its_frame_and_is_accessible(
    chromium: Browser, lesson: Course, size: tuple[int, int], scheme: str
):
    with visited(chromium, size=size, reduced_motion="reduce", color_scheme=scheme) as visit:
        page = visit.page
        page.goto(lesson.url.replace("lms.html", "index.html"))
        page.wait_for_function(SETTLED)
        state(page.main_frame)
        wide = "() => document.documentElement.scrollWidth - document.documentElement.clientWidth"
        assert page.evaluate(wide) <= 0
        assert violations(page) == []


def test_opened_from_a_folder_it_says_what_to_do(chromium: Browser, lesson: Course):
    with visited(chromium) as visit:
        visit.forgive("CORS")
        visit.forgive("net::ERR_FAILED")
        visit.page.goto((lesson.folder / "index.html").as_uri())
        expect(visit.page.get_by_role("alert")).to_contain_text("opened from a folder")
        assert visit.page.locator(".instrument").is_hidden()
