"""A study's file: what it may say, and what is said of what it may not."""

from __future__ import annotations

import pickle

import pytest

from heli2dof_core import Spec
from heli2dof_core.errors import Heli2DofError
from heli2dof_core.request import spec_of
from heli2dof_core.study import StudyError, read_study
from heli2dof_core.study.designs import Grid, Listed, Random, changed, known_paths
from heli2dof_core.study.study import PART

HEAD = "study = 1\n"


def test_the_least_study_is_the_presets_design_on_its_own_rig():
    study = read_study(HEAD)
    assert (study.designs.count, study.each, study.pairs, study.parts) == (1, 1, 1, 1)
    assert study.spec(0) == spec_of({})
    assert study.columns == ("settling_time", "overshoot", "V_peak", "saturated")


def test_a_grid_has_every_value_with_every_other_the_last_ones_side_by_side():
    study = read_study(
        HEAD
        + '[designs.grid]\n"loops.pitch.kp" = [8, 12]\n"loops.yaw.ti" = { from = 0.1, to = 10, count = 3, '
        'scale = "log" }'
    )
    assert isinstance(study.designs, Grid)
    assert [[*study.changes(i).values()] for i in range(6)] == [
        [8, 0.1], [8, pytest.approx(1.0)], [8, 10.0], [12, 0.1], [12, pytest.approx(1.0)], [12, 10.0]
    ]  # fmt: skip
    assert [study.spec(i).outer.pitch.kp for i in range(6)] == [8, 8, 8, 12, 12, 12]
    assert study.spec(5).outer.yaw.ti == 10.0


def test_random_designs_are_those_of_their_places():
    text = "[designs.random]\ncount = 500\nseed = 5\n[designs.random.over]\n"
    text += (
        '"loops.pitch.kp" = { from = 5, to = 20 }\n"loops.pitch.ti" = { from = 0.1, to = 10, scale = "log" }'
    )
    study = read_study(HEAD + text)
    assert isinstance(study.designs, Random)
    found = [[*study.changes(i).values()] for i in range(500)]
    assert study.changes(321) == read_study(HEAD + text.replace("500", "322")).changes(321)
    gains, times = zip(*found, strict=True)
    assert 5 <= min(gains) < 5.5
    assert 12 < sum(gains) / 500 < 13
    assert 19.5 < max(gains) <= 20
    assert min(times) >= 0.1 and max(times) <= 10 and sum(t < 1 for t in times) in range(200, 300)
    assert read_study(HEAD + text.replace("seed = 5", "seed = 6")).changes(0) != study.changes(0)


def test_listed_designs_lie_over_the_studys_own():
    study = read_study(
        HEAD + "[design]\nloops.pitch = { kp = 9, ti = 2 }\n"
        "[[designs.list]]\nloops.pitch.ti = 3\n[[designs.list]]\npoles = [-4, -5, -6, -7]\n"
    )
    assert isinstance(study.designs, Listed)
    assert [(study.spec(i).outer.pitch.kp, study.spec(i).outer.pitch.ti) for i in range(2)] == [
        (9, 3),
        (9, 2),
    ]
    assert [p.real for p in study.spec(1).poles.values] == [-4, -5, -6, -7]


def test_a_pair_of_poles_is_one_number_or_two():
    base = {"poles": [{"re": -3, "im": 4}, {"re": -3, "im": -4}, -8, -9]}

    def poles(**changes):
        spec = changed(base, {name.replace("__", "-pair."): value for name, value in changes.items()})
        return [complex(p["re"], p["im"]) if isinstance(p, dict) else complex(p) for p in spec["poles"]]

    assert poles(pitch__re=-5)[:2] == [-5 + 4j, -5 - 4j]
    assert poles(pitch__im=0)[:2] == [-3, -3]
    assert poles(pitch__re=-5, pitch__im=1, yaw__second=-11) == [-5 + 1j, -5 - 1j, -8, -11]
    assert poles(pitch__first=-5)[:2] == [-5, -3]
    assert poles(yaw__re=-2, yaw__im=-7)[2:] == [-2 + 7j, -2 - 7j]


def test_every_number_of_a_design_can_be_set():
    for path in known_paths():
        if path != "method" and "." in path:
            changed({}, {path: 0.5})
    rotors = changed({}, {"rotor-poles.yaw": -30.0})["rotor_poles"]
    assert rotors == [Spec.from_preset().rotor_poles[0], -30.0]


def test_required_figures_are_measured_and_named_once():
    study = read_study(
        HEAD + 'measures = ["overshoot", { measure = "V_peak", motor = "V_p", model = "linear" }]\n'
        "[rigs]\ncount = 7\n[require]\novershoot = { max = 10, share = 0.5 }\n"
        'settling_time = { max = 2, axis = "psi", steps = "together" }'
    )
    assert study.columns == ("overshoot", "V_peak_V_p_linear", "settling_time_psi_together")
    assert [own.words for own in study.requirements] == [
        "Overshoot, either step, on 50 % of the rigs",
        "Settling time, yaw, both stepped",
    ]


def test_parts_hold_all_pairs_once_and_travel():
    study = read_study(HEAD + '[designs.grid]\n"loops.pitch.kp" = [8, 10, 12]\n[rigs]\ncount = 1700')
    pairs = []
    for number in range(study.parts):
        task = pickle.loads(pickle.dumps(study.task(number)))
        own = [(s.design, rig) for s in task.segments for rig in range(s.first, s.last)]
        assert len(own) == study.size(number) <= PART
        pairs += own
    assert pairs == [(design, rig) for design in range(3) for rig in range(1701)]


def test_numbers_do_not_depend_on_title_or_limits():
    text = 'title = "A"\n[rigs]\ncount = 9\n[require]\nsettling_time = { max = 2 }'
    own = read_study(HEAD + text)
    assert (
        own.fingerprint == read_study(HEAD + text.replace("A", "B").replace("max = 2", "max = 3")).fingerprint
    )
    for other in (
        text.replace("count = 9", "count = 10"),
        text.replace("settling_time", "rise_time"),
        text.replace("count = 9", "count = 9\nseed = 1"),
        text.replace("[rigs]", "unstable = true\n[rigs]"),
        text + '\n[designs.grid]\n"loops.pitch.kp" = [8]',
    ):
        assert read_study(HEAD + other).fingerprint != own.fingerprint


REFUSED = [
    ("", "study", "study = 1"),
    ("study = 2", "study", "study = 1"),
    (HEAD + "desing = {}", "desing", "Did you mean design?"),
    (HEAD + "title = 3", "title", ""),
    (HEAD + 'unstable = "yes"', "unstable", ""),
    (HEAD + "[design]\npoels = []", "design.poels", "Known are"),
    (HEAD + "[design]\nloops.pitch.kp = -1e9", "design.loops.pitch.kp", ""),
    (HEAD + "[design]\nscenario.digital = {}\n[rigs]\ncount = 3", "design.scenario.digital", "Leave it out."),
    (HEAD + "[rigs]\nseed = 3", "rigs.count", "count = 1000"),
    (HEAD + "[rigs]\ncount = 0", "rigs.count", ""),
    (HEAD + "[rigs]\ncount = 3\nspread = { J_q = 0.1 }", "rigs.spread.J_q", "Known are"),
    (HEAD + "[rigs]\ncount = 3\nspread = { tau_p = 0.1 }", "rigs.spread.tau_p", "time constant"),
    (HEAD + '[rigs]\ncount = 3\ndistribution = "cauchy"', "rigs.distribution", ""),
    (HEAD + "measures = []", "measures", ""),
    (HEAD + 'measures = ["settling"]', "measures.0.measure", "Known are"),
    (HEAD + 'measures = ["share_stable"]', "measures.0", "stable is kept anyway"),
    (HEAD + "[require]\novershoot = { max = 10, share = 0.9 }", "require.overshoot.share", "Add [rigs]"),
    (HEAD + "[require]\novershoot = {}", "require.overshoot.max", ""),
    (HEAD + "[designs]\nlist = []", "designs.list", ""),
    (HEAD + "[designs.grid]\n", "designs.grid", ""),
    (HEAD + "[[designs.list]]\nloops.pitch.kq = 1", "designs.list.0.loops.pitch.kq", ""),
    (HEAD + '[designs.grid]\n"loops.pitch.kq" = [1]', "designs.grid.loops.pitch.kq", "loops.pitch.kp"),
    (HEAD + '[designs.grid]\n"loops.pitch.kp" = []', "designs.grid.loops.pitch.kp", ""),
    (HEAD + '[designs.grid]\n"loops.pitch.kp" = [1, "a"]', "designs.grid.loops.pitch.kp", ""),
    (
        HEAD + '[designs.grid]\n"loops.pitch.kp" = { from = 1, to = 2 }',
        "designs.grid.loops.pitch.kp.count",
        "",
    ),
    (
        HEAD + '[designs.grid]\n"loops.pitch.kp" = { from = 1, count = 2 }',
        "designs.grid.loops.pitch.kp.to",
        "",
    ),
    (
        HEAD + '[designs.grid]\n"pitch-pair.re" = { from = -9, to = 1, count = 3, scale = "log" }',
        "designs.grid.pitch-pair.re.scale",
        "",
    ),
    (HEAD + "[designs.random]\ncount = 3", "designs.random.over", ""),
    (
        HEAD + '[designs.random]\nover = { "loops.pitch.kp" = { from = 1, to = 2 } }',
        "designs.random.count",
        "",
    ),
    (HEAD + "[designs]\ngrid = {}\nrandom = {}", "designs", "Keep one"),
    (
        HEAD
        + '[designs.grid]\n"loops.pitch.kp" = { from = 5, to = 9, count = 99999 }\n[rigs]\ncount = 1000000',
        "designs",
        "several studies",
    ),
]


@pytest.mark.parametrize(("text", "field", "hint"), REFUSED, ids=[text[:60] for text, _, _ in REFUSED])
def test_what_is_wrong_is_told_with_its_field(text, field, hint):
    with pytest.raises(Heli2DofError) as refused:
        read_study(text)
    assert refused.value.field == field
    assert hint in f"{refused.value} {refused.value.hint}"


def test_what_is_no_toml_is_told_with_its_line():
    with pytest.raises(StudyError, match="line 2"):
        read_study("study = 1\nrigs = {{}\n")
