"""Each student's rig is their own, the same everywhere; what is locked is the step's, whatever is handed in."""

from __future__ import annotations

import json
import re
from pathlib import Path

import numpy as np
import pytest

from heli2dof_core import Heli2DofError, InvalidInputError, spec_of
from heli2dof_core.labs import LOCKS, Lab, mark, read_lab, start_body, student_rig, student_view, true_rig
from heli2dof_core.labs.bodies import body_of_flat, flat_body, merged
from heli2dof_core.labs.locks import covers, locked
from heli2dof_core.labs.rigs import solution_flat
from tests.children import ROOT
from tests.core.random_specs import random_specs

SMALL = (Path(__file__).with_name("small.yaml")).read_text(encoding="utf-8")


@pytest.fixture(scope="module")
def lab() -> Lab:
    return read_lab(SMALL)


def test_500_students_have_500_rigs_within_what_varies(lab):
    rigs = [student_rig(lab, seed) for seed in range(500)]
    assert len({json.dumps(rig, sort_keys=True) for rig in rigs}) == 500
    for name, middle, share in (("B_p", 0.8, 0.15), ("K_pp", 0.204, 0.1)):
        values = np.array([rig["parameters"][name] for rig in rigs])
        assert len(set(values)) == 500
        low, high = middle * (1 - share), middle * (1 + share)
        assert low <= values.min() < low + 0.01 * middle and high - 0.01 * middle < values.max() <= high
        counts, _ = np.histogram(values, 10, (low, high))
        assert counts.min() > 20 and counts.max() < 85  # uniform: some 50 each
    both = np.array([[rig["parameters"][name] for name in ("B_p", "K_pp")] for rig in rigs])
    assert abs(np.corrcoef(both.T)[0, 1]) < 0.15


def test_a_seed_gives_the_same_rig_for_ever(lab):
    """Numbers that were drawn when this was written: a class of yesterday opens tomorrow."""
    assert student_rig(lab, 3) == {
        "preset": "quanser-2dof-manual",
        "scenario": {"duration": 4.0},
        "parameters": {"B_p": 0.808568888, "K_pp": 0.198204898},
    }
    assert student_rig(lab, 2**62)["parameters"] == {"B_p": FAR[0], "K_pp": FAR[1]}


FAR = (0.817649655, 0.20753983)


def test_a_further_parameter_that_varies_leaves_the_others():
    more = read_lab(
        SMALL.replace("{B_p: 15 %,", "{J_p: 5 %, rotors.pitch.tau: 20 %, B_p: 15 %,").replace(
            "rig: {", "rig: {rotors: {pitch: {tau: 0.1}}, "
        )
    )
    own = student_rig(more, 3)
    assert own["parameters"]["B_p"] == 0.808568888 and own["parameters"]["K_pp"] == 0.198204898
    assert 0.08 <= own["rotors"]["pitch"]["tau"] <= 0.12 and own["parameters"]["J_p"] != 0.0384


def test_a_hidden_rig_is_told_to_nobody():
    lab = read_lab(SMALL.replace("lab: 1\n", "lab: 1\ntrue_rig: hidden\n"))
    assert student_rig(lab, 3) == student_rig(lab, 4) == {"preset": lab.preset, "scenario": {"duration": 4.0}}
    assert true_rig(lab, 3)["parameters"]["B_p"] == 0.808568888
    assert student_view(lab)["hidden_rig"]


def test_a_start_is_the_steps_on_the_students_rig(lab):
    rig = student_rig(lab, 8)
    first = spec_of(start_body(lab, "settle", rig))
    assert [p.real for p in first.poles.values] == [-2, -2.5, -9.25, -8.76]
    assert first.outer.outer == "none" and first.scenario.duration == 4
    assert first.parameters.B_p == rig["parameters"]["B_p"]
    second = spec_of(start_body(lab, "loop", rig))
    assert second.poles == first.poles and (second.outer.pitch.kp, second.outer.pitch.ti) == (20, 0.5)


def test_a_step_that_continues_takes_what_was_the_students(lab):
    rig = student_rig(lab, 8)
    own = merged(start_body(lab, "settle", rig), {"poles": [-7, -8, -1, -1], "parameters": {"B_p": 9.0}})
    found = spec_of(start_body(lab, "loop", rig, own))
    assert [p.real for p in found.poles.values] == [-7, -8, -9.25, -8.76]  # yaw's are locked
    assert found.parameters.B_p == rig["parameters"]["B_p"]
    assert (found.outer.outer, found.outer.pitch.kp) == ("pi", 20)


@pytest.mark.parametrize("seed", range(4))
def test_what_is_locked_is_taken_from_the_start(lab, seed):
    """Of any design that is handed in, the free parts alone are the student's."""
    rng = np.random.default_rng(seed)
    rig = student_rig(lab, seed)
    start = flat_body(start_body(lab, "settle", rig))
    for spec in random_specs(10, seed=100 + seed):
        given = body_of_flat(flat_of_spec(spec))
        judged = flat_body(mark(lab, "settle", rig, given, {}, seed=seed).body)
        assert judged["poles.pitch"] == flat_body(given)["poles.pitch"]
        for path in {*start, *judged} - {"poles.pitch", "scenario.samples"}:
            assert judged.get(path) == start.get(path), path
    assert rng is not None


def flat_of_spec(spec):
    from heli2dof_core.labs.bodies import flat_of

    return flat_of(spec, "quanser-2dof-manual")


def test_a_difference_in_what_is_locked_is_told(lab):
    rig = student_rig(lab, 1)
    start = start_body(lab, "settle", rig)
    forged = merged(
        start,
        {
            "parameters": {"K_pp": 1.0},
            "limits": {"V_p": 100},
            "scenario": {"saturation": False},
            "loops": {"yaw": {"kp": 3}},
            "poles": [-6, -7, -1, -2],
        },
    )
    marked = mark(lab, "settle", rig, forged, {})
    assert marked.ignored == ("preset", "parameters", "yaw-poles", "yaw-pi", "scenario")
    assert (
        mark(lab, "settle", rig, {"poles": [-6, -7, -9.25, -8.76]}, {}).ignored == ()
    )  # nothing else is named
    assert mark(lab, "settle", rig, json.loads(json.dumps(start)), {}).ignored == ()


def test_where_a_lab_frees_it_the_rig_is_the_students():
    lab = read_lab(SMALL.replace("unlocked: [pitch-poles]", "unlocked: [pitch-poles, preset, scenario]"))
    rig = student_rig(lab, 1)
    own = merged(
        start_body(lab, "settle", rig), {"parameters": {"B_p": 0.5}, "scenario": {"digital": {"delay": True}}}
    )
    judged = spec_of(mark(lab, "settle", rig, own, {}).body)
    assert judged.parameters.B_p == 0.5 and judged.scenario.digital.delay
    back = merged(own, {"scenario": {"digital": None}})
    assert spec_of(mark(lab, "settle", rig, back, {}).body).scenario.digital is None


def test_a_body_stands_for_its_spec():
    for spec in random_specs(40, seed=9):
        flat = flat_of_spec(spec)
        again = spec_of(json.loads(json.dumps(body_of_flat(flat))))
        if spec.limits.theta is None:  # an Aero's, which no helicopter's body says
            continue
        told = {path: value for path, value in flat_of_spec(again).items() if not path.startswith("weights")}
        assert told == flat
        assert (again.poles, again.scenario, again.outer, again.rotors, again.friction) == (
            spec.poles,
            spec.scenario,
            spec.outer,
            spec.rotors,
            spec.friction,
        )


def test_what_is_no_design_is_refused(lab):
    rig = student_rig(lab, 1)
    for wrong in ({"poles": [-1, -2]}, {"poles": [{"re": -1, "im": 2}, -2, -3, -4]}, {"outer": "pid"}):
        with pytest.raises(Heli2DofError):
            mark(lab, "settle", rig, wrong, {})
    for name, hints in (("other", ()), ("settle", (3,)), ("settle", (0,))):
        with pytest.raises(InvalidInputError):
            mark(lab, name, rig, {}, {}, hints=hints)


def test_a_solution_is_over_the_one_before(lab):
    rig = student_rig(lab, 1)
    flat = solution_flat(lab, lab.step("loop"), rig)
    assert flat["poles.pitch"] == [{"re": -6, "im": 4}, {"re": -6, "im": -4}]
    assert (flat["loops.pitch.kp"], flat["outer"]) == (30, "pi")


def test_locks_hold_all_of_a_design():
    """Whatever a body says is held by a lock; the lock of a whole holds what its parts hold."""
    for spec in random_specs(5, seed=2):
        for path in flat_of_spec(spec):
            assert covers(tuple(LOCKS), path), path
    for whole, parts in {
        "poles": ("pitch-poles", "yaw-poles", "rotor-poles"),
        "method": ("structure", "place-rotors"),
        "loops": ("outer", "pairing", "decoupler", "pitch-pi", "yaw-pi"),
        "observer": ("observer-poles",),
        "scenario": ("steps-size", "digital", "measured", "noise", "anti-windup", "duration", "disturbance"),
    }.items():
        for part in parts:
            assert all(covers((whole,), path) for path in LOCKS[part]), (whole, part)
            assert not {whole, part} & {*locked([part])}
            assert part not in locked([whole])
    assert {"preset", "yaw-poles", "loops", "scenario"} <= {*locked(["pitch-poles"])}


def test_locks_are_the_pages():
    """By the same names, in links and in labs."""
    parts = ROOT / "static" / "labs" / "parts.js"
    if not parts.exists():
        pytest.skip("the page has no labs yet")
    names = set()
    for file in (ROOT / "static" / "model" / "locks.js", parts):
        names |= {
            name.strip("'")
            for name in re.findall(r"^  ('?[a-z-]+'?): (?:\{|part\()", file.read_text(), re.MULTILINE)
        }
    assert names == {*LOCKS}
