"""Labs and classes for browser tests: files, a server that has them, pages that open them."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import httpx2
import pytest
from playwright.sync_api import Browser, Page, expect

from tests.browser import EMPTY, GONE, SEEN, Visit, settled, visited
from tests.e2e.conftest import App, running_app
from tests.patience import PATIENCE

SMALL = """
lab: 1
name: small
number: 7
title: A small lab
minutes: 20
summary: One pair of poles, then PI.
preset: quanser-2dof-manual
vary: {B_p: 15 %, K_pp: 10 %}
text: |
  Poles at $s = -2$ are slow.
end: You are done.
steps:
  - name: settle
    title: Make it quick
    text: Drag pitch's pair.
    start: {poles: [-2, -2.5, -9.25, -8.76], outer: none}
    unlocked: [pitch-poles]
    hidden: [remarks]
    goals:
      - {figure: rise_time, axis: theta, max: 0.5 s, points: 4}
      - {figure: V_peak, motor: V_p, max: 24 V, points: 2, label: "The motor keeps its limit"}
      - {kind: cloud, share: stable, min: 90 %, spread: 10 %, points: 5}
    questions:
      - {name: who, kind: choice, text: "Which is slower?", choices: [yaw, pitch at first], answer: 2, points: 2}
      - {name: slowest, kind: number, text: "Its size?", unit: rad/s, answer: 7, tolerance: 2 %, points: 2}
      - {name: why, kind: text, text: "Why?", points: 2, sample: "It dies away last."}
    hints:
      - {text: "Settling takes about 4/σ.", cost: 1}
      - {text: "Free of charge: drag left."}
  - name: loop
    title: Now with PI
    continue: true
    start: {outer: pi, loops: {pitch: {kp: 20, ti: 0.5 s}}}
    unlocked: [pitch-pi]
    goals:
      - {figure: steady_state_error, axis: theta, max: 0.2 °, points: 3}
      - {figure: phase_margin, min: 30 °, points: 2}
"""
HIDING = """
lab: 1
name: hiding
title: What is not told
preset: quanser-2dof-manual
text: |
  <img src=x onerror="document.title = 'broken'"> A long formula:

  $$K = \\begin{pmatrix} k_{11} & k_{12} & k_{13} & k_{14} \\\\ k_{21} & k_{22} & k_{23} & k_{24} \\end{pmatrix}
  = \\frac{1}{\\gamma} \\begin{pmatrix} a & b & c & d \\\\ e & f & g & h \\end{pmatrix} + 1234567890$$
steps:
  - name: hidden
    title: Pair by measuring
    start: {pairing: cross}
    unlocked: [pairing, yaw-pi]
    hidden: [remarks, rga, suggestions, metrics]
    goals:
      - {figure: lambda_11, min: 0.5}
    questions:
      - {name: which, kind: choice, text: "Which are real?", choices: [a, b, c], answer: [1, 3], points: 2}
  - name: open
    title: Now with remarks
    start: {method: knv0}
    unlocked: [poles]
    goals:
      - {figure: phase_margin, min: 1 °}
"""


@pytest.fixture(scope="module")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[App]:
    """A server with two labs of its own, and classes that go with it."""
    folder = tmp_path_factory.mktemp("labs")
    (folder / "small.yaml").write_text(SMALL, "utf-8")
    (folder / "hiding.yaml").write_text(HIDING, "utf-8")
    with running_app(labs=folder, database="memory") as app:
        yield app


@contextmanager
def lab(chromium: Browser, url: str, *, clock: bool = False, **how: Any) -> Iterator[Visit]:
    """A page in a context of its own; refused calls are in the console, and no error of the page's."""
    with visited(chromium, EMPTY, SEEN, **{"reduced_motion": "reduce"} | how) as visit:
        visit.forgive("Failed to load resource")
        visit.forgive(GONE)
        visit.forgive("net::ERR_INTERNET_DISCONNECTED")
        if clock:
            visit.page.clock.install()
        visit.page.goto(url)
        yield visit


def ready(page: Page) -> None:
    """Waits until the page computes by itself."""
    page.wait_for_function("() => document.documentElement.dataset.kernel === 'ready'")
    settled(page)


def goal(page: Page, name: str, kind: str) -> None:
    expect(page.get_by_test_id(f"lab-goal-{name}")).to_have_attribute("data-kind", kind)


def solved(page: Page) -> None:
    """Sets pitch's pair, which is free in the first step, to where its goals are met."""
    for pole in (0, 1):
        field = page.get_by_test_id(f"pole-field-{pole}")
        field.fill(str(-6 - pole))
        field.press("Enter")
    settled(page)


class Class:
    """A class of the server, as its instructor has it."""

    def __init__(self, app: App, name: str = "small") -> None:
        self.app, self.api = app, f"{app.url}api/v1/classes"
        made = httpx2.post(self.api, timeout=PATIENCE, json={"lab": name, "title": "Monday, group A"})
        assert made.status_code < 300, made.text
        self.code, self.secret = made.json()["code"], made.json()["instructor"]

    def call(self, method: str, path: str = "", **how: Any) -> Any:
        headers = {"Heli2dof-Secret": self.secret}
        answer = httpx2.request(
            method, f"{self.api}/{self.code}{path}", headers=headers, timeout=PATIENCE, **how
        )
        assert answer.status_code < 300, answer.text
        return answer.json() if answer.content else None

    @property
    def students(self) -> list[dict[str, Any]]:
        return self.call("GET")["students"]

    def attempts(self, student: int) -> int:
        return self.call("GET", f"/students/{student}")["steps"]["settle"]["attempts"]

    def draft(self, student: int) -> dict[str, Any]:
        return self.call("GET", f"/students/{student}")["steps"].get("settle", {}).get("draft") or {}

    def rig(self, page: Page) -> dict[str, Any]:
        """Of the student whom the page knows."""
        answer = httpx2.post(
            f"{self.api}/{self.code}/join", json={"student": secret(page, self.code)}, timeout=PATIENCE
        )
        return answer.json()["rig"]

    @property
    def url(self) -> str:
        return f"{self.app.url}#class={self.code}"


def secret(page: Page, code: str) -> str:
    """Of the student whom the page knows."""
    return page.evaluate(f"JSON.parse(localStorage.getItem('heli2dof.class.{code}')).student")


def joined(page: Page, name: str) -> None:
    page.get_by_test_id("join-name").fill(name)
    page.get_by_test_id("join").click()
    expect(page.get_by_test_id("lab-who")).to_have_text(name)
    ready(page)


def handed_in(page: Page, words: str) -> None:
    page.get_by_test_id("lab-hand-in").click()
    expect(page.get_by_test_id("lab-verdict")).to_contain_text(words)
