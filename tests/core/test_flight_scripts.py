"""Scripts of flights: what they say, what they refuse, and the flight that they make."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

import heli2dof_core as heli
from heli2dof_core.flight.events import WORDS
from heli2dof_core.kernels.flight_layout import STATE

DESIGN = {"preset": "quanser-2dof-manual"}
SCRIPT = """
# a flight
0     reference theta=10° psi=0.5
1     gust 0.05 psi=-0.1 seconds=400ms   # named or not
1.5   design {"poles": [-4, -5, -6, -7]} # as JSON
2     hands 1
2     sticks V_y=-2000mV V_p=9
2.2   hands 0
2.2   turn 0 10°/s
3     thrust 90% 1
3.1   hung 20g 15cm
"""


def test_a_script_is_the_flight_that_it_says():
    script = heli.read_script(SCRIPT)
    log = heli.fly_script(DESIGN, script, 4.0)
    rig = heli.Rig(heli.spec_of(DESIGN))
    tick = rig.controller.tick
    events = [(round(event[0] * tick, 9), *event[1:]) for event in log.events if event[1] != "design"]
    assert events == [
        (0.0, "reference", pytest.approx(pi / 18), 0.5),
        (1.0, "gust", 0.05, -0.1, 200.0),
        (2.0, "hands", 1.0),
        (2.0, "sticks", 9.0, -2.0),
        (2.2, "hands", 0.0),
        (2.2, "turn", 0.0, pytest.approx(pi / 18)),
        (3.0, "thrust", 0.9, 1.0),
        (3.1, "hung", 0.02, 0.15),
    ]
    course = heli.simulate_flight(heli.FlightLog.read(log.body()))
    assert course.apart == 0.0 and len(course.t) == log.ticks == 2000
    assert [change.time for change in course.takeovers] == pytest.approx([1.5, 2.2])
    flying = course.log.events[2][2]
    assert heli.spec_of(flying).poles == heli.Spec.from_preset(poles=[-4, -5, -6, -7]).poles
    rig.do("reference", pi / 18, 0.5)
    np.testing.assert_array_equal(course.rows[:500], rig.fly(1.0).rows)


def test_json_says_the_same_and_lines_need_no_order():
    text = "2 push 0.1 0\n0 reference 0.1 0.2\n1 gust 0 0.05 0.5"
    rows = '[[2, "push", 0.1, 0], [0, "reference", 0.1, 0.2], [1, "gust", 0, 0.05, 0.5]]'
    first, second = (heli.fly_script(DESIGN, heli.read_script(own), 3.0) for own in (text, rows))
    assert first == second
    assert [event[1] for event in first.events] == ["reference", "gust", "push"]


def test_the_course_is_taken_as_it_is_flown():
    stretches = []
    log = heli.fly_script(DESIGN, take=lambda _t, rows: stretches.append(rows))
    rows = np.concatenate(stretches)
    assert len(rows) == log.ticks == 2500  # 5 s without a script
    np.testing.assert_array_equal(rows, heli.simulate_flight(log).rows)
    theta = heli.spec_of({}).scenario.resolved(heli.spec_of({}).theta_0)[0]
    assert abs(rows[0, STATE] - theta) > 0.1 and abs(rows[-1, STATE] - theta) < 1e-3  # the experiment's step


def test_a_change_of_the_preset_leaves_nothing_of_the_old_body():
    script = heli.read_script('0.5 design {"preset": "quanser-aero"}')
    log = heli.fly_script({**DESIGN, "poles": [-4, -5, -6, -7]}, script, 1.0)
    assert heli.spec_of(log.events[-1][2]).poles == heli.Spec.from_preset("quanser-aero").poles


@pytest.mark.parametrize(
    ("text", "field", "words"),
    [
        ("x", "line 1, column 1", "the time is 'x'"),
        ("\n1 reference", "line 2, column 12", "needs theta, psi"),
        ("1 reference 1", "line 1, column 14", "needs psi"),
        ("1 reference theta=1 theta=2", "line 1, column 21", "takes theta, psi"),
        ("1 reference 1 2 3", "line 1, column 17", "takes theta, psi"),
        ("1 reference psi=0 theta = 10V", "line 1, column 27", "not a number"),
        ("  1  fly 1", "line 1, column 6", "no word"),
        ("1", "line 1, column 2", "no word"),
        ("-1 push 0 0", "line 1, column 4", "from 0 to 660"),
        ("1 design", "line 1, column 9", "what changes"),
        ("1 design poles", "line 1, column 10", "no change"),
        ("1 design 3", "line 1, column 10", "no change"),
        ("1 design poles=", "line 1, column 16", "missing"),
        ("1 design poles=-1,x", "line 1, column 16", "no number"),
        ("1 design lead=yaw lead=pitch", "line 1, column 19", "twice"),
        ("1 design loops=1 loops.pitch.kp=2", "line 1, column 18", "twice"),
        ('1 design {"poles": [1,]}', "line 1, column 23", "JSON"),
        ("1 design {} x", "line 1, column 13", "behind the design"),
        ('1 design {"poles": [1]}', "line 1, column 3.poles", ""),
        ("1 design polse=1", "line 1, column 3.polse", "no field"),
        ("1 push 1000 0", "line 1, column 3", "from -100 to 100"),
        ("[1", "script", "no JSON"),
        ("[[1]]", "script[0]", "a time, a word"),
        ('[[0, "reference", 0, 0], [1, "push", 0]]', "script[1]", "theta, psi"),
        ('[[0, "push", "a", 0]]', "script[0]", "finite"),
        ('[[0, "design", 3]]', "script[0]", "object"),
        ("660 push 0 0", "seconds", "goes on until"),
    ],
)
def test_what_cannot_be_flown_is_refused_by_line_and_column(text, field, words):
    with pytest.raises(heli.InvalidInputError) as refused:
        heli.fly_script(DESIGN, heli.read_script(text))
    assert words in str(refused.value) and refused.value.field == field


@pytest.mark.parametrize(
    ("text", "body"),
    [
        (
            "poles=-4,−5,-3±2j loops.pitch.kp=9 loops.yaw.kp=8  # slower",
            {
                "poles": [-4.0, -5.0, {"re": -3.0, "im": 2.0}, {"re": -3.0, "im": -2.0}],
                "loops": {"pitch": {"kp": 9.0}, "yaw": {"kp": 8.0}},
            },
        ),
        ("poles=[-4, -5, -6, -7]", {"poles": [-4, -5, -6, -7]}),
        ("method=lqr place_rotors=true#", {"method": "lqr", "place_rotors": True}),
        (
            'coupling="axis-decoupled" limits={"V_p": 20}',
            {"coupling": "axis-decoupled", "limits": {"V_p": 20}},
        ),
    ],
)
def test_a_design_is_told_by_what_changes_of_it(text, body):
    (line,) = heli.read_script(f"1 design {text}")
    assert line.values == (body,)


@pytest.mark.parametrize("seconds", [0.0, -1.0, 661.0, float("nan")])
def test_a_length_that_no_flight_has_is_refused(seconds):
    with pytest.raises(heli.InvalidInputError, match="660"):
        heli.fly_script(DESIGN, (), seconds)


@pytest.mark.parametrize("word", WORDS)
def test_every_word_of_a_log_is_one_of_scripts(word):
    values = [1.0 for _ in WORDS[word].values]
    (line,) = heli.read_script(f"0 {word} {' '.join(map(str, values))}")
    assert line.word == word and list(line.values) == values
