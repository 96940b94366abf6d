"""Labs' files: every problem with line, column, path and a hint; traps of YAML; nothing that a stranger may send."""

from __future__ import annotations

import time
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from heli2dof_core.labs import LabError, LabProblem, problems_of, read_lab
from heli2dof_core.labs.library import labs_in, read_file
from heli2dof_core.labs.nodes import DEEPEST, LONGEST, MOST_NODES, nodes_of
from heli2dof_core.labs.template import new_lab

SMALL = (Path(__file__).with_name("small.yaml")).read_text(encoding="utf-8")


def place(text: str, part: str, nth: int = 1) -> tuple[int, int]:
    """Line and column at which a part of the text begins, its nth time; both from 1."""
    at = -1
    for _ in range(nth):
        at = text.index(part, at + 1)
    return text.count("\n", 0, at) + 1, at - text.rfind("\n", 0, at)


def changed(old: str, new: str) -> str:
    assert SMALL.count(old) == 1, old
    return SMALL.replace(old, new)


def errors(text: str) -> tuple[LabProblem, ...]:
    with pytest.raises(LabError) as caught:
        read_lab(text)
    found = caught.value.problems
    assert found == tuple(p for p in problems_of(text) if p.severity == "error")
    for problem in found:
        assert problem.message and not problem.message.endswith(".")
        lines = text.splitlines() or [""]
        assert 1 <= problem.line <= len(lines) + 1
    return found


def test_a_lab_is_read():
    lab = read_lab(SMALL)
    assert (lab.name, lab.number, lab.minutes, len(lab.steps), lab.points) == ("small", 7, 20, 2, 22)
    settle, loop = lab.steps
    assert settle.start == {"poles": [-2, -2.5, -9.25, -8.76], "outer": "none"}
    assert settle.solution["poles"][:2] == [{"re": -6, "im": 4}, {"re": -6, "im": -4}]
    assert loop.start["loops"]["pitch"] == {"kp": 20, "ti": 0.5} and loop.continues
    assert [goal.name for goal in settle.goals][:2] == ["settling-time-theta", "overshoot-theta"]
    assert lab.vary == {"B_p": 0.15, "K_pp": 0.1}
    assert lab.rig == {"scenario": {"duration": 4.0}}


WRONG = [
    # what is changed, into what, where it is told (a part of the new text), path, a part of message and hint
    ("lab: 1\n", "lab: 2\n", "2", "lab", "out of range"),
    ("lab: 1\n", "", "name: small", "lab", "has no lab"),
    ("name: small", "name: Small Lab", "Small Lab", "name", "is no name"),
    ("title: A small lab", "title: [a, b]", "[a, b]", "title", "a list, not text"),
    ("title: A small lab", "title:", "\nnumber", "title", ""),
    ("minutes: 20", "minutes: soon", "soon", "minutes", "not a whole number"),
    ("minutes: 20", "minutes: 20.5", "20.5", "minutes", "not a whole number"),
    ("minutes: 20", "minuts: 20", "minuts", "minuts", "Did you mean minutes?"),
    (
        "preset: quanser-2dof-manual",
        "preset: quanser-2dof",
        "quanser-2dof",
        "preset",
        "Did you mean quanser-",
    ),
    ("{B_p: 15 %, K_pp: 10 %}", "{B_p: 15 V}", "15 V", "vary.B_p", "unit 'V' does not fit"),
    ("{B_p: 15 %, K_pp: 10 %}", "{B_p: 150 %}", "150 %", "vary.B_p", "out of range"),
    ("{B_p: 15 %, K_pp: 10 %}", "{B_q: 15 %}", "15 %", "vary.B_q", "could vary"),
    ("{B_p: 15 %, K_pp: 10 %}", "{K_s: 15 %}", "15 %", "vary.K_s", "not 0"),
    ("{B_p: 15 %, K_pp: 10 %}", "{coupling: 15 %}", "15 %", "vary.coupling", "could vary"),
    ("{scenario: {duration: 4 s}}", "{poles: [-1]}", "poles: [-1]", "rig.poles", "no field poles"),
    ("{scenario: {duration: 4 s}}", "{parameters: {J_p: -1}}", "-1", "rig.parameters.J_p", "out of range"),
    ("{scenario: {duration: 4 s}}", "{limits: {theta: 400 °}}", "400 °", "rig.limits.theta", "out of range"),
    ("name: settle", "name: loop", "loop", "steps[1].name", "name of two"),
    ("view: design", "view: desing", "desing", "steps[0].view", "Did you mean design?"),
    (
        "unlocked: [pitch-poles]",
        "unlocked: [pitch-pole]",
        "pitch-pole]",
        "steps[0].unlocked[0]",
        "pitch-poles",
    ),
    ("unlocked: [pitch-poles]", "unlocked: pitch-poles", "pitch-poles\n", "steps[0].unlocked", "not a list"),
    ("hidden: [remarks]", "hidden: [remark]", "remark]", "steps[0].hidden[0]", "Did you mean remarks?"),
    ("poles: [-2, -2.5, -9.25, -8.76]", "poles: [-2, -2.5]", "[-2, -2.5]", "steps[0].start.poles", "2 poles"),
    (
        "poles: [-2, -2.5, -9.25, -8.76]",
        "poles: [-2, x, -9, -8]",
        "x, -9",
        "steps[0].start.poles[1]",
        "no pole",
    ),
    (
        "poles: [-2, -2.5, -9.25, -8.76]",
        "poles: [-2 + 1j, -2.5, -9, -8]",
        "-2.5, -9, -8",
        "steps[0].start.poles[1]",
        "neither both real nor conjugates",
    ),
    ("outer: none}", "outer: pid}", "pid", "steps[0].start.outer", "Known are pi, none"),
    ("outer: none}", "outer: none, gains: 3}", "gains", "steps[0].start.gains", "no field gains"),
    (
        "figure: overshoot",
        "figure: overshot",
        "overshot",
        "steps[0].goals[1].figure",
        "Did you mean overshoot?",
    ),
    (
        "{figure: overshoot, axis: theta,",
        "{figure: overshoot,",
        "{figure: overshoot",
        "steps[0].goals[1].axis",
        "is named",
    ),
    ("max: 10 %, points: 2", "points: 2", "{figure: overshoot", "steps[0].goals[1]", "neither max nor min"),
    ("max: 10 %, points: 2", "max: 10 V, points: 2", "10 V", "steps[0].goals[1].max", "does not fit"),
    ("max: 10 %, points: 2", "max: 1 %, min: 5 %", "5 %", "steps[0].goals[1].min", "min is above max"),
    (
        "max: 10 %, points: 2",
        "max: 10 %, motor: V_p",
        "V_p}",
        "steps[0].goals[1].motor",
        "has no motor",
    ),
    ("motor: V_p, max: 24 V", "motor: V_q, max: 24 V", "V_q", "steps[0].goals[2].motor", "Did you mean"),
    (
        "motor: V_p, max: 24 V",
        "motor: V_p, max: none",
        "none, points",
        "steps[0].goals[2].max",
        "is no value",
    ),
    ("kind: cloud,", "kind: clouds,", "clouds", "steps[0].goals[3].kind", "Did you mean cloud?"),
    ("min: 90 %, spread", "min: 190 %, spread", "190 %", "steps[0].goals[3].min", "out of range"),
    ("spread: 10 %", "spread: {B_q: 10 %}", "B_q", "steps[0].goals[3].spread.B_q", "no parameter B_q"),
    ("kind: choice", "kind: choise", "choise", "steps[0].questions[0].kind", "Did you mean choice?"),
    ("answer: 2, points", "answer: 3, points", "3, points", "steps[0].questions[0].answer", "no choice 3"),
    ("answer: 2, points", "answer: two, points", "two", "steps[0].questions[0].answer", "not a whole number"),
    (
        "{quantity: slowest_pole}",
        "{quantity: slow_pole}",
        "slow_pole",
        "steps[0].questions[1].answer.quantity",
        "slowest_pole?",
    ),
    (
        "{quantity: slowest_pole}",
        "{quantity: 'K[3,1]'}",
        "'K[3,1]'",
        "steps[0].questions[1].answer.quantity",
        "K[i,j], 1 to 2",
    ),
    (
        "{quantity: slowest_pole}",
        "{quantity: overshoot}",
        "{quantity: over",
        "steps[0].questions[1].answer.axis",
        "is named",
    ),
    (
        "{quantity: slowest_pole}",
        "{quantity: slowest_pole}, unit: V",
        "V, tol",
        "steps[0].questions[1].unit",
        "not measured in V",
    ),
    (
        "{quantity: slowest_pole}",
        "{quantity: slowest_pole}, unit: furlong",
        "furlong",
        "steps[0].questions[1].unit",
        "not known",
    ),
    ("tolerance: 2 %", "tolerance: 2 V", "2 V", "steps[0].questions[1].tolerance", "no tolerance"),
    ("tolerance: 2 %", "tolerance: -2 %", "-2 %", "steps[0].questions[1].tolerance", "negative"),
    ("cost: 1}", "cost: -1}", "-1}", "steps[0].hints[0].cost", "out of range"),
    (
        "poles: [-6 ± 4j, -9.25, -8.76]",
        "poles: [-6 ± 4j, -9]",
        "[-6 ± 4j, -9]",
        "steps[0].solution.poles",
        "3 poles",
    ),
    ("continue: true", "continue: yes", "yes", "steps[1].continue", "'yes', not true or false"),
    ("steps:\n", "stepps:\n", "stepps", "stepps", "Did you mean steps?"),
    # YAML itself
    ("minutes: 20", "minutes: 20\nminutes: 30", "minutes: 30", "", "stands here twice, first in line 5"),
    ("minutes: 20", "minutes: &m 20", "&m", "", "&m is an anchor"),
    ("minutes: 20", "minutes: *m", "*m", "", "*m stands for what is elsewhere"),
    ("minutes: 20", "minutes: !!python/object:os.system 20", "!!python", "", "tag"),
    ("title: A small lab", "title: A small: lab", ": lab", "", "no YAML"),
    ("title: A small lab", 'title: "\\beta"', '"\\beta"', "", "single quotes"),
    ("title: A small lab", 'title: "\\theta"', '"\\theta"', "", "single quotes"),
    ("minutes: 20", "\tminutes: 20", "\tminutes", "", "spaces"),
    ("end: You are done.", "end: You are done.\n--- \nlab: 1", "---", "", "second document"),
    ("title: A small lab", "title: A\x07", "\x07", "", "U+0007"),
]


@pytest.mark.parametrize(("old", "new", "at", "path", "words"), WRONG, ids=[f"{n[1][:40]}" for n in WRONG])
def test_a_problem_is_told_where_it_is(old, new, at, path, words):
    text = changed(old, new)
    problem = next((p for p in errors(text) if p.path == path), None)
    assert problem is not None, [str(p) for p in errors(text)]
    begins = text.index(new)
    offset = (
        text.index(at, max(0, begins - 60))
        if path != "steps[1].name"
        else text.rindex(at, 0, text.index("title: Now"))
    )
    if at == "name: small" or at.startswith("\n"):
        return  # what is missing is told at what lacks it
    assert (problem.line, problem.column) == (
        text.count("\n", 0, offset) + 1,
        offset - text.rfind("\n", 0, offset),
    )
    assert words in f"{problem.message} {problem.hint}"


def test_all_problems_are_told_at_once_in_order():
    text = (
        SMALL.replace("minutes: 20", "minutes: x")
        .replace("figure: overshoot", "figure: o")
        .replace("cost: 1", "cost: x")
    )
    found = errors(text)
    assert [p.path for p in found] == ["minutes", "steps[0].goals[1].figure", "steps[0].hints[0].cost"]
    assert list(found) == sorted(found)
    with pytest.raises(LabError, match=r"small\.yaml:5:10: minutes: .* \(2 more\)"):
        read_lab(text, "small.yaml")


@pytest.mark.parametrize(
    "word", ["no", "on", "yes", "1:30", "0x10", "1_000", "~x", "3.10", "2024-01-01", "012"]
)
def test_words_of_yaml_1_1_are_text(word):
    lab = read_lab(
        changed("title: A small lab", f"title: {word}").replace("choices: [yaw", f"choices: [{word}")
    )
    assert lab.title == word
    assert lab.steps[0].questions[0].choices[0] == word


def test_numbers_have_the_units_that_people_write():
    wanted = {"1.5 s": 1.5, "1500 ms": 1.5, "1,5 s": 1.5, "1.5": 1.5, "'1.5'": 1.5, "0.025 min": 1.5}
    for written, value in wanted.items():
        goal = (
            read_lab(changed("max: 1.5 s", f"max: {written}" if "," not in written else f"max: '{written}'"))
            .steps[0]
            .goals[0]
        )
        assert goal.max == pytest.approx(value), written


def test_what_is_too_large_or_too_deep_is_refused():
    for text in (
        "x" * (LONGEST + 1),
        "a: " + "[" * (DEEPEST + 1) + "]" * (DEEPEST + 1),
        "a: [" + "1, " * (MOST_NODES + 1) + "1]",
        "[" * 200_000,
        "{a: " * 50_000,
        "- " * 100_000,
    ):
        begin = time.perf_counter()
        with pytest.raises(LabError):
            read_lab(text)
        assert time.perf_counter() - begin < 5


def test_anchors_cannot_laugh():
    text = "a: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n"
    with pytest.raises(LabError) as caught:
        read_lab(text)
    (problem,) = caught.value.problems
    assert (problem.line, problem.column) == (1, 4)


PIECES = st.sampled_from(
    [
        "lab: 1\n",
        "name: a\n",
        "steps:\n",
        "  - name: x\n",
        "    goals:\n",
        "- {figure: overshoot}",
        "{",
        "}",
        "[",
        "]",
        ": ",
        "- ",
        "\n",
        " ",
        "\t",
        "|",
        ">",
        "'",
        '"',
        "&a",
        "*a",
        "!!int",
        "#",
        "%",
        "@",
        "null",
        "1e999",
        "-3±4j",
        "°",
        "\u2028",
        "\ud800",
        "\x00",
        "---",
        "...",
    ]
)


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.one_of(st.text(max_size=400), st.lists(PIECES, max_size=60).map("".join)))
def test_whatever_is_read_raises_nothing_but_lab_errors(text):
    try:
        read_lab(text)
    except LabError as error:
        assert error.problems
        assert all(p.line >= 1 and p.column >= 1 for p in error.problems)


@settings(max_examples=300, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(st.data())
def test_a_lab_with_a_few_characters_changed_is_read_or_refused(data):
    text = SMALL
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(text) - 1))
        length = data.draw(st.integers(0, 12))
        text = text[:at] + data.draw(st.one_of(PIECES, st.text(max_size=4))) + text[at + length :]
    try:
        read_lab(text)
    except LabError as error:
        assert all(p.message and p.line >= 1 and p.column >= 1 for p in error.problems)


def test_a_broken_file_of_a_folder_is_told_and_the_others_are_there(tmp_path, caplog):
    (tmp_path / "good.yaml").write_text(new_lab("good"), encoding="utf-8")
    (tmp_path / "first.yml").write_text(
        new_lab("first").replace("minutes:", "number: 1\nminutes:"), encoding="utf-8"
    )
    (tmp_path / "broken.yaml").write_text(SMALL.replace("max: 1.5 s", "max: 1.5 V"), encoding="utf-8")
    (tmp_path / "latin.yaml").write_bytes("title: Höhe".encode("latin-1"))
    (tmp_path / "other.yaml").write_text(new_lab("another"), encoding="utf-8")
    (tmp_path / "notes.txt").write_text("no lab", encoding="utf-8")
    assert [*labs_in(tmp_path)] == ["first", "good"]
    told = "\n".join(caplog.messages)
    assert "broken.yaml" in told and "24:" in told and "latin.yaml" in told and "other.yaml" in told
    assert "notes" not in told


def test_a_file_has_the_name_of_its_lab(tmp_path):
    file = tmp_path / "other.yaml"
    file.write_text(new_lab("another"), encoding="utf-8")
    with pytest.raises(LabError) as caught:
        read_file(file)
    (problem,) = caught.value.problems
    assert (problem.line, problem.column, problem.path) == (*place(new_lab("another"), "another"), "name")


UNWISE = [
    ("vary: {B_p: 15 %, K_pp: 10 %}\n", "", "steps", "same rig"),
    ("max: 1.5 s", "max: 1.504 s", "steps[0].goals[0].max", "more digits"),
    ("max: 1.5 s", "max: 0.1 s", "steps[0].goals[0]", "the solution has"),
    (
        "unlocked: [pitch-poles]",
        "unlocked: [yaw-poles]",
        "steps[0].solution",
        "changes what is locked: pitch-poles",
    ),
    ("unlocked: [pitch-poles]", "unlocked: [remarks]", "steps[0].unlocked", "all is locked"),
    ("cost: 1}", "cost: 100}", "steps[0].hints", "the hints cost 100 points"),
    ("    solution: {poles: [-6 ± 4j, -9.25, -8.76]}\n", "", "steps[0]", "has no solution"),
    ("$s = -2$", "$\\\\frac{1}$", "text", "is not understood"),
    ("{quantity: slowest_pole}", "{quantity: 'L[1,1]'}", "steps[0].questions[1].answer", "no such value"),
    (
        "{quantity: slowest_pole}",
        "{quantity: friction.pitch.coulomb}",
        "steps[0].questions[1].tolerance",
        "is 0",
    ),
    ("max: 1.5 s, points: 4", "max: 100 s, points: 4", "steps[0].start", "reaches every goal already"),
]


@pytest.mark.parametrize(("old", "new", "path", "words"), UNWISE, ids=[f"{n[3]}" for n in UNWISE])
def test_what_is_unwise_is_told(old, new, path, words):
    text = changed(old, new)
    if "already" in words:
        text = text.replace("max: 10 %", "max: 400 %")
    told = [p for p in problems_of(text) if p.path == path and words in p.message]
    assert len(told) == 1, [str(p) for p in problems_of(text)]
    assert told[0].severity == "warning" and told[0].hint
    read_lab(text)


def test_the_examples_have_no_problems():
    assert problems_of(SMALL) == ()
    assert problems_of(new_lab("mine")) == ()


def test_marks_of_yaml_count_characters():
    text = "ä: 'θψ'\nβ: [1, ö"
    with pytest.raises(LabError) as caught:
        nodes_of(text)
    assert caught.value.problems[0].line == 2
    assert nodes_of("θ̇: 1\nä: {b: ü, c: 2}").fields["ä"][1].fields["c"][0].column == 11
