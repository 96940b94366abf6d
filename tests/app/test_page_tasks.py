"""Tasks as the page flies and scores them beside the core's."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from heli2dof_core.flight import FlightLog, simulate_flight
from heli2dof_core.flight.scores import score
from heli2dof_core.flight.task_flights import flown_by_design, require_task
from heli2dof_core.flight.tasks import TASKS
from tests.app.test_page_kernel import SERVED
from tests.children import ROOT

PRESET = "quanser-2dof-manual"


def flown(**question: Any) -> Any:
    node = str(Path(sys.executable).with_name("node"))
    preset = SERVED[PRESET]
    text = json.dumps({"preset": preset, "part": {}, "hands": False} | question) + "\n"
    script = ROOT / "tests" / "page" / "task_flights.mjs"
    done = subprocess.run(
        [node, script], input=text, capture_output=True, text=True, encoding="utf-8", check=True
    )
    return json.loads(done.stdout)


def near(own: Any, other: Any) -> None:
    assert set(own) == set(other)
    for name, value in own.items():
        assert value == pytest.approx(other[name], rel=1e-9, abs=1e-12), name


@pytest.mark.parametrize(
    ("task", "seed", "hands"), [(name, 17, False) for name in TASKS] + [("hold", 4_000_000_000, True)]
)
def test_the_servers_score_is_the_pages(task, seed, hands):
    told = flown(task=task, seed=seed, hands=hands)
    course = simulate_flight(FlightLog.read(told["log"]))
    require_task(course)
    own = score(course)
    near(told["values"], dict(own.values))
    assert told["stars"] == own.stars
    if hands:
        assert own.value("by_hand") == pytest.approx(100 / 60 / 30, rel=0.02)
    alone = score(simulate_flight(flown_by_design(task, {"preset": PRESET}, seed)))
    for name in ("path_error", "flight_effort"):
        assert told["alone"][name] == pytest.approx(alone.value(name), rel=1e-6)
