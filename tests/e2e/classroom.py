"""A class with students who join and hand in over REST, as their pages would."""

from __future__ import annotations

import random
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import httpx2
from playwright.sync_api import Browser, Page, expect

from tests.browser import visited
from tests.patience import PATIENCE

LABS = Path(__file__).with_name("labs")
"""The folder of the lab `wall`, for HELI2DOF_LABS."""
SLOW, FAST = (-2, -2.5), (-6, -7)
"""Pairs of poles: too slow for the goals of the first step, and fast enough."""
FIRST = (
    "Ada Björn Chen Dunja Émile Fatima Giulia Hana Ivan Jürgen Kofi Lucía Mehmet Nadia Olga Pavel Rosa Søren"
)
LAST = (
    "Adler Bianchi Conti Dubois Ekström Fuchs García Haddad "
    "Ivanova Jensen Kovač Lefèvre Mensah Novák Okafor Petrov Sato"
)


def calling(url: str) -> httpx2.Client:
    """A client of a server, to be closed; `url` ends with a slash."""
    return httpx2.Client(base_url=url, timeout=PATIENCE)


@dataclass
class Classroom:
    """A class on a running server, and its instructor's secret."""

    client: httpx2.Client
    code: str
    key: str
    title: str
    students: dict[str, dict[str, Any]] = field(default_factory=dict)

    @staticmethod
    def made(client: httpx2.Client, title: str = "Control 2, Tuesday", lab: str = "wall") -> Classroom:
        """Makes a class on the client's server."""
        made = client.post("api/v1/classes", json={"lab": lab, "title": title}).raise_for_status().json()
        return Classroom(client, made["code"], made["instructor"], title)

    @property
    def headers(self) -> dict[str, str]:
        return {"Heli2dof-Secret": self.key}

    def path(self, rest: str = "") -> str:
        return f"api/v1/classes/{self.code}{rest}"

    def told(self, rest: str = "", **how: Any) -> Any:
        """What the instructor is told."""
        return self.client.get(self.path(rest), headers=self.headers, **how).raise_for_status().json()

    def join(self, name: str, **more: str) -> int:
        """A student joins; returns their id."""
        reply = self.client.post(self.path("/join"), json={"name": name, **more}).raise_for_status().json()
        self.students[name] = reply
        return reply["id"]

    def hand_in(self, name: str, step: str, design: dict[str, Any] | None = None, **answers: Any) -> Any:
        """A student hands in; returns the answer, good or bad."""
        attempt = {"student": self.students[name]["student"], "id": str(uuid.uuid4()), "step": step}
        return self.client.post(
            self.path("/attempts"), json={**attempt, "design": design or poles(*FAST), "answers": answers}
        )


def poles(*pitch: complex, yaw: tuple[complex, complex] = (-9.25, -8.76)) -> dict[str, Any]:
    """A design body with such poles and no outer loop."""
    every = [{"re": complex(p).real, "im": complex(p).imag} for p in (*pitch, *yaw)]
    return {"preset": "quanser-2dof-manual", "poles": every, "outer": "none"}


def filled(room: Classroom, students: int, seed: int = 1) -> None:
    """Students who join, and get as far as each gets in half an hour; the same ones for a seed."""
    draw, first, last = random.Random(seed), FIRST.split(), LAST.split()

    def pair(fastest: float, most: float) -> tuple[complex, complex]:
        real, slope = draw.uniform(2, fastest), draw.uniform(0, most)
        return complex(-real, real * slope), complex(-real, -real * slope)

    for number in range(students):
        name = f"{first[number % len(first)]} {last[number % len(last)]}"
        room.join(name, email=f"student{number + 1}@example.edu")
        if draw.random() < 0.05:
            continue
        yaw = draw.uniform(-14, -8), draw.uniform(-8, -3)
        for _ in range(draw.randint(1, 4)):
            room.hand_in(name, "settle", poles(*pair(7, 2), yaw=yaw), who=draw.choice([1, 2]))
        if draw.random() < 0.35:
            continue
        good = complex(-draw.uniform(4.5, 9), draw.uniform(0, 4))
        design = poles(good, good.conjugate(), yaw=yaw)
        room.hand_in(name, "settle", design, who=2)
        for _ in range(draw.randint(0, 4)):
            room.hand_in(name, "both", design)
        if draw.random() < 0.3:
            room.hand_in(
                name, "why", design, why="Because the pitch rotor has to carry the weight all the time."
            )


def link(url: str, room: Classroom) -> str:
    """The instructor's secret link."""
    return f"{url}class#class={room.code}&key={room.key}"


@contextmanager
def wall(chromium: Browser, url: str, room: Classroom, **how: Any) -> Iterator[Page]:
    """The wall, opened by the secret link, connected."""
    with visited(chromium, **how) as visit:
        visit.page.goto(link(url, room))
        expect(visit.page.get_by_test_id("title")).to_have_text(room.title)
        yield visit.page
