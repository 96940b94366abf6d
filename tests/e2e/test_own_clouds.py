"""The cloud of uncertain rigs that the page computes: its dots follow the hand, and no message goes anywhere."""

from __future__ import annotations

import re
import socket

import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import EMPTY, GONE, SEEN, Visit, goto, state, until_state, visited
from tests.e2e.conftest import App, running_app
from tests.e2e.test_own_numbers import UNRESTING, Wire, computing, ready
from tests.e2e.test_page import TRACES, centre

UNCERTAIN = "#v1&spread=0.1"
ALL = re.compile(r"^2000 rigs: \d+ % stable, \d+ % within limits$")
DOTS = """() => {
  const canvas = document.querySelector('canvas.cloud');
  if (!canvas.width) return { unstable: 0, stable: 0, sum: 0 };
  const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const found = { unstable: 0, stable: 0, sum: 0 };
  for (let i = 0; i < data.length; i += 4) {
    if (!data[i + 3]) continue;
    found[data[i] > data[i + 2] + 30 ? 'unstable' : 'stable'] += 1;
    found.sum = (31 * found.sum + i + data[i + 3]) % 2147483647;
  }
  return found;
}"""
"""Pixels of either color, and a checksum of where they are."""


def cloudy(page: Page) -> None:
    """Waits until the page computes its clouds itself, and has done so."""
    page.wait_for_function("() => document.documentElement.dataset.rigs === 'ready'")
    expect(page.get_by_test_id("cloud-words")).to_have_text(ALL)


def changed(page: Page, before: dict[str, int]) -> dict[str, int]:
    """The dots, once they are others."""
    page.wait_for_function(f"(sum) => ({DOTS})().sum !== sum", arg=before["sum"])
    return page.evaluate(DOTS)


def test_dots_follow_the_hand_without_a_message(chromium: Browser, app: App):
    with visited(chromium, EMPTY, SEEN, UNRESTING) as visit:
        page = visit.page
        wire = Wire(page)
        goto(page, app.url + UNCERTAIN)
        ready(page)
        cloudy(page)
        page.wait_for_load_state("networkidle")
        assert page.get_by_test_id("spread").input_value() == "0.1"
        dots = page.evaluate(DOTS)
        assert dots["stable"] > 500 and dots["unstable"] == 0
        x, y = centre(page, "pole-3")
        page.mouse.move(x, y)
        page.mouse.down()
        wire.messages.clear()
        for k in range(1, 7):
            page.mouse.move(x + 5 * k, y)
            dots = changed(page, dots)
        assert state(page)["local"] and wire.messages == []
        expect(page.get_by_test_id("cloud-words")).to_have_text(ALL)  # the hand holds still
        page.mouse.move(x + 225, y, steps=4)
        page.wait_for_function(f"() => ({DOTS})().unstable > 20")
        expect(page.get_by_test_id("cloud-words")).to_have_text(re.compile(r"^2000 rigs: \d\d? % stable"))
        assert wire.messages == []
        page.mouse.up()
        until_state(page, "s.settled")
        assert not [message for message in wire.messages if "robustness" in message]


def test_a_wider_spread_widens_the_band(chromium: Browser, app: App):
    with computing(chromium, app.url + UNCERTAIN) as visit:
        page = visit.page
        cloudy(page)
        before = page.evaluate(TRACES, "plot-theta")
        page.get_by_test_id("spread").select_option("0.2")
        page.wait_for_function(f"(old) => ({TRACES})('plot-theta') !== old", arg=before)


def test_without_the_server_the_cloud_goes_on(chromium: Browser):
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    with visited(chromium, EMPTY, SEEN) as visit:
        page = visit.page
        with running_app(port) as app:
            goto(page, app.url)
            ready(page)
            page.wait_for_function("() => document.documentElement.dataset.rigs === 'ready'")
        until_state(page, "s.connection === 'lost'")
        page.get_by_test_id("spread").select_option("0.1")
        cloudy(page)
        dots = page.evaluate(DOTS)
        x, y = centre(page, "pole-2")
        page.mouse.move(x, y)
        page.mouse.down()
        for k in range(1, 4):
            page.mouse.move(x + 15 * k, y)
            dots = changed(page, dots)
        page.mouse.up()
        expect(page.get_by_test_id("cloud-words")).to_have_text(ALL)
        visit.forgive(GONE)


@pytest.mark.parametrize(
    "missing",
    [
        "delete window.Worker",
        "window.Worker = class extends Worker { constructor(url) { super(url); } };",
    ],
    ids=["none", "none of modules"],
)
def test_without_workers_the_server_makes_the_cloud(chromium: Browser, app: App, missing: str):
    with visited(chromium, EMPTY, SEEN, missing) as visit:
        page = visit.page
        wire = Wire(page)
        goto(page, app.url + UNCERTAIN)
        ready(page)
        expect(page.get_by_test_id("cloud-words")).to_have_text(ALL)
        assert [message for message in wire.messages if "robustness" in message]
        assert page.evaluate("() => document.documentElement.dataset.rigs") is None
        assert page.evaluate(DOTS)["stable"] > 500


def test_what_the_kernel_does_not_serve_comes_from_the_server(chromium: Browser, app: App):
    with computing(chromium, app.url + UNCERTAIN + "&method=knv0") as visit:
        page = visit.page
        expect(page.get_by_test_id("cloud-words")).to_have_text(ALL)
        page.wait_for_function("() => document.documentElement.dataset.rigs === 'ready'")
        dots = page.evaluate(DOTS)
        x, y = centre(page, "pole-0")
        page.mouse.move(x, y)
        page.mouse.down()
        page.mouse.move(x - 25, y, steps=3)
        dots = changed(page, dots)
        page.mouse.up()
        expect(page.get_by_test_id("cloud-words")).to_have_text(ALL)
        assert dots["stable"] > 100


def test_a_worker_that_fails_leaves_the_cloud_to_the_server(chromium: Browser, app: App):
    broken: list[str] = []

    def patched(visit: Visit) -> None:
        def answer(route):
            source = route.fetch().text()
            assert "const rigs = new ManyRigs" in source
            broken.append(source)
            wrong = source.replace(
                "(task) => rigs.cloud(task)", "() => { throw new Error('out of memory'); }"
            )
            assert wrong != source
            route.fulfill(body=wrong, content_type="text/javascript")

        visit.context.route("**/static/kernel/rigs_worker.js", answer)

    with visited(chromium, EMPTY, SEEN) as visit:
        patched(visit)
        page = visit.page
        wire = Wire(page)
        goto(page, app.url + UNCERTAIN)
        ready(page)
        cloudy(page)
        assert broken and [message for message in wire.messages if "robustness" in message]
