"""Launches in a real browser: in a window, and in a frame of the platform with and without cookies."""

from __future__ import annotations

from collections.abc import Iterator
from urllib.parse import urlsplit

import pytest
from playwright.sync_api import Browser, Frame, Page, expect

from tests.app.lti_course import register, settings_in
from tests.browser import EMPTY, SEEN, visited
from tests.e2e.conftest import running_app
from tests.lti_platform import Link, Platform


@pytest.fixture(scope="module")
def platform(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Platform]:
    """A platform at another site than this server: what is `localhost` for one is `127.0.0.1` for the other."""
    folder = tmp_path_factory.mktemp("lti")
    settings = settings_in(folder)
    platform = Platform("", host="localhost")
    given = {"database": f"sqlite:///{folder}/classes.db", "labs": str(folder / "labs")}
    with platform.running(), running_app(frame_ancestors=platform.address, **given) as app:
        platform.tool = app.url.rstrip("/")
        register(settings, platform, address=platform.tool)
        platform.add_link(Link("l1", custom={"lab": "small"}))
        yield platform


def is_there(frame: Frame | Page, platform: Platform) -> None:
    """Waits until somebody has landed on the page."""
    frame.wait_for_url(lambda url: url.startswith(platform.tool) and urlsplit(url).path in ("/", "/class"))


def test_in_a_window(chromium: Browser, platform: Platform) -> None:
    with visited(chromium, EMPTY, SEEN) as visit:
        visit.page.goto(platform.login_address("s1", "l1"))
        is_there(visit.page, platform)


def test_in_a_frame_by_a_cookie_of_the_frame(chromium: Browser, platform: Platform) -> None:
    with visited(chromium, EMPTY, SEEN) as visit:
        visit.page.goto(f"{platform.address}/course?user=s1&link=l1")
        is_there(visit.page.frames[1], platform)


@pytest.fixture
def held(platform: Platform) -> Iterator[None]:
    """Launches wait, so that cookies can be lost meanwhile, as where a browser keeps none for frames."""
    platform.held = True
    yield
    platform.held = False


@pytest.mark.usefixtures("held")
def test_in_a_frame_whose_platform_keeps_a_word(chromium: Browser, platform: Platform) -> None:
    with visited(chromium, EMPTY, SEEN) as visit:
        visit.page.goto(f"{platform.address}/course?user=s1&link=l1&keeps=1")
        button = visit.page.frame_locator("iframe").get_by_role("button", name="On", exact=True)
        expect(button).to_be_visible()
        visit.context.clear_cookies()
        button.click()
        is_there(visit.page.frames[1], platform)
        assert visit.page.evaluate("window.asked.slice(0, 2)") == ["lti.put_data", "lti.get_data"]


@pytest.mark.usefixtures("held")
def test_in_a_frame_without_any_help_a_window_opens(chromium: Browser, platform: Platform) -> None:
    with visited(chromium, EMPTY, SEEN) as visit:
        visit.page.goto(f"{platform.address}/course?user=s2&link=l1")
        frame = visit.page.frame_locator("iframe")
        expect(frame.get_by_role("button", name="On", exact=True)).to_be_visible()
        visit.context.clear_cookies()
        frame.get_by_role("button", name="On", exact=True).click()
        button = frame.get_by_role("link", name="Open the lab in a new window")
        expect(button).to_be_visible()
        platform.held = False
        with visit.context.expect_page() as opened:
            button.click()
        is_there(opened.value, platform)


@pytest.mark.parametrize("size", [(1280, 800), (390, 844)])
def test_an_instructor_chooses(chromium: Browser, platform: Platform, size: tuple[int, int]) -> None:
    link = platform.add_link(Link(f"free-{size[0]}", title="Free")).id
    with visited(chromium, EMPTY, SEEN, size=size) as visit:
        page = visit.page
        page.goto(platform.login_address("t1", link))
        choice = page.get_by_role("button", name="A small lab")
        expect(choice).to_be_visible()
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        visit.forgive("404")  # the instructor's page is a part of its own
        choice.click()
        page.wait_for_url(lambda url: urlsplit(url).path == "/class")
