"""Goals that are flown: made again from the log, with the design that is handed in, and told why where not."""

from __future__ import annotations

from copy import deepcopy

import pytest

from heli2dof_core.flight import FlightLog, checksum
from heli2dof_core.flight.task_flights import fly_task
from heli2dof_core.flight.tasks import TASKS
from heli2dof_core.labs import LabError, mark, problems_of, read_lab, student_rig, student_view
from heli2dof_core.labs.bodies import body_of_flat
from heli2dof_core.labs.flights import tried_flight
from heli2dof_core.labs.rigs import solution_flat, start_flat

LAB = """
lab: 1
name: flown
title: Flown
vary: {B_p: 15 %, K_pp: 10 %}
steps:
  - name: calm
    title: Calm
    view: fly
    start: {poles: [-1 ± 0.5j, -1.2 ± 0.5j], outer: none}
    unlocked: [poles]
    goals:
      - {kind: flight, task: hold, figure: flight_error_rms, axis: both, max: 1.5 °, points: 3}
      - {figure: disk_margin, min: 0.5}
    solution: {poles: [-6 ± 3j, -6 ± 3j]}
"""
GOAL = "{kind: flight, task: hold, figure: flight_error_rms, axis: both, max: 1.5 °, points: 3}"
SEED = 5
LOCKED = {"poles": [-6, -7, -8, -9], "parameters": {"K_pp": 0.3}}


class Attempt:
    """The solution of the lab on a student's rig, and its flight."""

    def __init__(self, text: str = LAB) -> None:
        self.lab = read_lab(text)
        self.step = self.lab.steps[0]
        self.rig = student_rig(self.lab, SEED)
        self.body = body_of_flat(solution_flat(self.lab, self.step, self.rig, SEED))
        self.start = body_of_flat(start_flat(self.lab, self.step, self.rig))

    def told(self, flight, body=None):
        """The flight's goal and the attempt, marked."""
        own = self.body if body is None else body
        found = mark(self.lab, self.step.name, self.rig, own, {}, seed=SEED, flight=flight)
        return found.goals[0], found


@pytest.fixture(scope="module")
def attempt() -> Attempt:
    return Attempt()


@pytest.fixture(scope="module")
def log(attempt) -> dict:
    return tried_flight(attempt.step, attempt.body)


def signed(log: dict, **changes) -> dict:
    """The log with changes and a checksum that fits: somebody took pains."""
    own = {name: value for name, value in {**deepcopy(log), **changes}.items() if name != "checksum"}
    return {**own, "checksum": checksum(own)}


def test_a_flight_is_made_again_and_judged(attempt, log):
    goal, found = attempt.told(log)
    assert (goal.met, found.points, found.of) == (True, 4.0, 4.0)
    assert 0 < goal.value < 0.0262 and goal.value_text.endswith("°") and goal.required_text == "≤ 1.50°"
    assert found.flight["checksum"] == log["checksum"]
    assert found.flight["values"]["flight_error_rms"]["psi"] <= goal.value + 1e-15
    assert "events" not in found.as_dict()["flight"]
    soft, _ = attempt.told(tried_flight(attempt.step, attempt.start), attempt.start)
    assert soft.met is False and soft.value > goal.value


def test_without_a_flight_the_goal_says_what_to_do_and_others_count(attempt):
    goal, found = attempt.told(None)
    assert (goal.met, goal.value_text, found.points) == (False, "not flown", 1.0)
    assert "Fly it" in goal.message and found.flight is None and "flight" not in found.as_dict()


@pytest.mark.parametrize(
    ("change", "word"),
    [
        (lambda log: {**log, "seed": log["seed"] + 1}, "checksum"),
        (lambda log: signed(log, seed=log["seed"] + 1), "not what the task"),
        (lambda log: signed(log, events=log["events"][:1]), ""),
        (lambda log: signed(log, task="", checks=[]), "another task"),
        (lambda log: signed(log, ticks=5_900_000, checks=[]), "longer than its task"),
        (lambda log: signed(log, ticks=log["ticks"] // 2, checks=[], events=log["events"][:1]), ""),
        (lambda log: signed(log, design={**log["design"], "poles": [-6, -7, -8, -9]}), "another design"),
        (lambda log: signed(log, design={**log["design"], "parameters": {"B_p": 0.1}}), "another design"),
        (
            lambda log: signed(log, events=[*log["events"], [log["ticks"], "design", LOCKED]]),
            "another design",
        ),
        (lambda log: {"flight": 1}, ""),
        (lambda log: {}, ""),
    ],
)
def test_what_was_changed_or_is_not_the_students_own_does_not_count(attempt, log, change, word):
    goal, found = attempt.told(change(log))
    assert (goal.met, goal.value_text, found.points) == (False, "not counted", 1.0)
    assert word in goal.message and found.flight is None


def test_one_check_that_differs_in_one_bit_is_told(attempt, log):
    checks = deepcopy(log["checks"])
    checks[3][1] += 1e-8
    goal, _ = attempt.told(signed(log, checks=checks))
    assert goal.met is False and "own state" in goal.message


def test_set_points_and_length_of_the_experiment_are_not_the_design(attempt, log):
    body = deepcopy(attempt.body)
    body["scenario"] |= {"duration": 9.0, "reference": {"theta": 0.1, "psi": 0.2}}
    flown = deepcopy(log["design"])
    flown["scenario"] = {k: v for k, v in flown["scenario"].items() if k not in ("reference", "duration")}
    assert attempt.told(log, body)[0].met
    goal, _ = attempt.told(signed(log, design=flown, checks=[]))
    assert goal.value_text != "not counted"


def test_changes_in_the_air_count_only_where_they_are_allowed_and_within_the_locks(attempt):
    free = Attempt(LAB.replace(GOAL, GOAL.replace("points", "changes: allowed, points")))
    rig = tried_flight(free.step, free.start)
    half = rig["ticks"] // 50
    before = [event for event in rig["events"] if event[0] <= half]
    after = [event for event in rig["events"] if event[0] > half]
    changed = signed(rig, events=[*before, [half, "design", free.body], *after], checks=[])
    allowed, _ = free.told(changed)
    assert allowed.value_text != "not counted" and allowed.value > 0
    assert attempt.told(changed)[0].value_text == "not counted"
    locked = {**free.body, "parameters": {**free.body.get("parameters", {}), "K_pp": 0.3}}
    goal, _ = free.told(signed(rig, events=[*before, [half, "design", locked], *after], checks=[]))
    assert goal.value_text == "not counted" and "parameters" in goal.message


def test_whose_hands_it_was_is_seen(monkeypatch):
    by_hand = Attempt(LAB.replace(GOAL, GOAL.replace("max: 1.5 °", "max: 20 °, hands: on")))
    off = Attempt(LAB.replace(GOAL, GOAL.replace("max: 1.5 °", "max: 20 °, hands: off")))
    held = tried_flight(by_hand.step, by_hand.body)
    alone = tried_flight(off.step, off.body)
    assert by_hand.told(held)[0].met and off.told(alone)[0].met
    assert by_hand.told(alone)[0].value_text == "not by hand"
    assert off.told(held)[0].value_text == "by hand"
    # A hand is later than a computer, about either axis; the later, the worse.
    monkeypatch.setattr("heli2dof_core.labs.by_hand.REACTION", 0.5)
    slower = tried_flight(by_hand.step, by_hand.body)
    design, hand, late = (
        own.told(flight)[1].flight["values"]["flight_error_rms"]
        for own, flight in ((off, alone), (by_hand, held), (by_hand, slower))
    )
    for axis in ("theta", "psi"):
        assert 1.5 * design[axis] < hand[axis] < late[axis] / 1.2


def test_a_hand_that_does_nothing_meets_nothing():
    lab = Attempt(LAB.replace(GOAL, GOAL.replace("max: 1.5 °", "max: 20 °, hands: on")))
    still = fly_task("hold", lab.body, 0, hand=lambda rig: None, every=1.0).body()
    assert lab.told(still)[0].met is False


def test_gusts_are_those_of_the_goal_where_it_names_them():
    named = Attempt(LAB.replace(GOAL, GOAL.replace("points", "seed: 7, points")))
    log = tried_flight(named.step, named.body)
    assert log["seed"] == 7 and named.told(log)[0].met
    other = fly_task("hold", named.body, 8).body()
    assert named.told(other)[0].value_text == "not counted" and "other gusts" in named.told(other)[0].message


@pytest.mark.parametrize(
    ("goal", "path", "words"),
    [
        ("{kind: flight, task: fall, figure: flight_error_rms, axis: psi, max: 1 °}", "task", "fall"),
        ("{kind: flight, task: hold, figure: overshoot, axis: psi, max: 1}", "figure", "overshoot"),
        ("{kind: flight, task: hold, figure: flight_error_rms, max: 1 °}", "axis", "of an axis"),
        ("{kind: flight, task: hold, figure: flight_error_rms, axis: psi}", "goals[0]", "neither"),
        ("{kind: flight, task: hold, figure: flight_error_rms, axis: psi, max: 1 V}", "max", "does not fit"),
        ("{kind: flight, task: hold, figure: by_hand, axis: psi, max: 50 %}", "axis", "has no axis"),
        ("{kind: flight, task: hold, figure: by_hand, hands: both, max: 50 %}", "hands", "both"),
    ],
)
def test_what_is_wrong_with_a_goal_is_told_where_it_stands(goal, path, words):
    (problem,) = [p for p in problems_of(LAB.replace(GOAL, goal)) if p.severity == "error"]
    assert path in problem.path and words in problem.message


def test_goals_of_one_step_are_of_one_flight_and_no_hidden_rig_is_flown():
    other = GOAL.replace("hold", next(name for name in TASKS if name != "hold"))
    two = LAB.replace(GOAL, f"{GOAL}\n      - {GOAL.replace('max: 1.5', 'max: 2.5')}\n      - {other}")
    (problem,) = [p for p in problems_of(two) if p.severity == "error" and "differ" in p.message]
    assert "task" in problem.message
    with pytest.raises(LabError, match="hidden rig"):
        read_lab(LAB.replace("steps:", "true_rig: hidden\nsteps:"))


def test_what_a_page_is_told_is_enough_to_fly_and_to_judge(attempt):
    (goal, _) = student_view(attempt.lab)["steps"][0]["goals"]
    assert goal["kind"] == "flight" and goal["task"] == "hold" and goal["axis"] == "both"
    assert goal["label"].startswith(TASKS["hold"].title) and "both axes" in goal["label"]
    assert student_view(attempt.lab)["steps"][0]["view"] == "fly"


def test_the_model_of_a_hand_takes_the_controller_off_and_keeps_the_limits(attempt):
    hands = Attempt(LAB.replace(GOAL, GOAL.replace("points", "hands: on, points")))
    log = FlightLog.read(tried_flight(hands.step, hands.body))
    sticks = [event for event in log.events if event[1] == "sticks"]
    assert [event[2] for event in log.events if event[1] == "hands"] == [1.0]
    assert len(sticks) >= 20 * TASKS["hold"].duration - 1
    assert max(abs(event[2]) for event in sticks) <= 24 and max(abs(event[3]) for event in sticks) <= 15
