"""The examples of flights: a policy in the environment, a script for the command line."""

from __future__ import annotations

import json
import re

import pytest

import heli2dof_core as heli
from tests.children import ROOT, python

pytestmark = pytest.mark.slow


def test_the_policy_flies_better_than_chance_and_keeps_its_flight(tmp_path):
    file = tmp_path / "my.flight.json"
    said = python("-m", "examples.policy", str(file))
    worth = {name: float(value) for name, value in re.findall(r"(\w+): (-[\d.]+) rad² s", said)}
    assert 20 * worth["PD"] > worth["chance"] and worth["PD"] > -1.5
    log = heli.FlightLog.read(json.loads(file.read_text(encoding="utf-8")))
    assert heli.simulate_flight(log).apart == 0.0


def test_the_script_is_flown_without_a_jump():
    text = (ROOT / "examples" / "gust.txt").read_text(encoding="utf-8")
    log = heli.fly_script({}, heli.read_script(text))
    course = heli.simulate_flight(log)
    assert [change.time for change in course.takeovers] == pytest.approx([4.0, 6.3])
    assert all(change.bumpless for change in course.takeovers) and not course.ended
