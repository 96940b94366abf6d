"""Every shipped lab can be solved on every student's rig: `HELI2DOF_LAB_RIGS=500` tries as many."""

from __future__ import annotations

import os

import pytest

from heli2dof_core.labs import problems_of, read_lab, shipped_labs, student_rig
from heli2dof_core.labs.library import SHIPPED
from heli2dof_core.labs.template import TEMPLATE
from tests.labs.reach import Free, over_rigs, reached
from tests.labs.test_reading import SMALL

RIGS = int(os.environ.get("HELI2DOF_LAB_RIGS", "4"))
LABS = {**shipped_labs(), "my-lab": read_lab(TEMPLATE.read_text("utf-8"))}


@pytest.mark.slow
@pytest.mark.parametrize("name", LABS)
def test_every_goal_is_within_reach_of_every_student(name):
    lab = LABS[name]
    missed = [
        f"{own.step}, seed {own.seed}: {own.missed}" for own in over_rigs(lab, range(RIGS)) if own.missed
    ]
    assert not missed


@pytest.mark.parametrize("name", LABS)
def test_shipped_labs_have_no_problems_and_rigs_of_their_own(name):
    lab = LABS[name]
    file = SHIPPED / f"{name}.yaml"
    assert problems_of((file if file.exists() else TEMPLATE).read_text(encoding="utf-8")) == ()
    rigs = [repr(student_rig(lab, seed)) for seed in range(500)]
    assert len(set(rigs)) == (1 if lab.hidden_rig else 500)


def test_a_search_finds_what_the_solution_misses():
    plain = SMALL.replace("      - {kind: cloud, share: stable, min: 90 %, spread: 10 %, points: 3}\n", "")
    assert plain != SMALL  # clouds take most of the time
    lab = read_lab(plain.replace("[-6 ± 4j, -9.25, -8.76]}", "[-2 ± 4j, -9.25, -8.76]}"))
    found = reached(lab, lab.steps[0], 3)
    assert not found.at_once and not found.missed
    never = read_lab(plain.replace("max: 1.5 s", "max: 1 ms"))
    found = reached(never, never.steps[0], 3, tries=1)
    assert not found.at_once and found.missed


def test_a_vector_is_its_design():
    flat = {
        "preset": "quanser-2dof-manual",
        "poles.pitch": [{"re": -3.0, "im": 4.0}, {"re": -3.0, "im": -4.0}],
        "poles.yaw": [-2.0, -5.0],
        "loops.pitch.kp": 3.0,
        "loops.pitch.ti": 0.5,
    }
    free = Free(flat, ["poles.pitch", "poles.yaw", "loops.pitch"])
    body = free.body(free.vector())
    assert body["poles"] == [{"re": -3.0, "im": 4.0}, {"re": -3.0, "im": -4.0}, -5.0, -2.0]
    assert body["loops"]["pitch"] == pytest.approx({"kp": 3.0, "ti": 0.5})
    assert len(Free(flat, ["poles.yaw"]).vector()) == 2
