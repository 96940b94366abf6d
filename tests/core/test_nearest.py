"""The nearest design that meets what is required: against closed forms, grids, and SLSQP from many starts."""

from __future__ import annotations

from dataclasses import replace
from math import log, pi, sqrt

import numpy as np
import pytest
from scipy.optimize import minimize

from heli2dof_core import InvalidInputError, Nearest, Observer, PoleSet, Spec, UncontrollableError, nearest
from heli2dof_core.errors import CancelledError
from heli2dof_core.evaluate import evaluate
from heli2dof_core.many import Measure, evaluate_many
from heli2dof_core.measured import MEASURED, Where
from heli2dof_core.nearest import HANDLES, distance
from heli2dof_core.nearest.search import least_distance
from heli2dof_core.requirements import Requirement, requirements_of
from heli2dof_core.scenario import Digital

FIRST = Spec.from_preset()
AERO = Spec.from_preset("quanser-aero-2")
SWINGING = FIRST.changed(poles=[-6 + 6j, -6 - 6j, -3 + 4j, -3 - 4j], pitch=(10, 0.3), yaw=(10, 0.3))


def values_of(spec: Spec, requirement: Requirement) -> list[float | None]:
    """The figures that a requirement is about, read from a report."""
    report = evaluate(spec, each_axis=True)
    return list(MEASURED[requirement.measure.name].read(report, requirement.measure.where))


def meets(spec: Spec, required: dict) -> bool:
    """Whether the loop is stable and every figure lies within its limits, as it is and as it is shown."""
    if not evaluate(spec).judged.stable:
        return False
    for own in requirements_of(required):
        for value in values_of(spec, own):
            if not own.meets(value):
                return False
            if value is not None and not (
                (own.max is None or value <= own.max) and (own.min is None or value >= own.min)
            ):
                return False
    return True


def apart(before: Spec, after: Spec) -> float:
    """The distance, as the documentation says it."""
    poles, squares = after.poles.values, 0.0
    for i in (0, 2):
        p, q = before.poles.values[i : i + 2]
        squares += min(
            abs(poles[i] - p) ** 2 / abs(p) ** 2 + abs(poles[i + 1] - q) ** 2 / abs(q) ** 2,
            abs(poles[i + 1] - p) ** 2 / abs(p) ** 2 + abs(poles[i] - q) ** 2 / abs(q) ** 2,
        )
    for a, b in ((before.outer.pitch, after.outer.pitch), (before.outer.yaw, after.outer.yaw)):
        squares += log(b.kp / a.kp) ** 2 + log(b.ti / a.ti) ** 2
    return sqrt(squares)


TASKS = (
    (FIRST, {"settling_time": {"max": 0.8}}),
    (FIRST, {"settling_time": {"max": 0.7}, "overshoot": {"max": 2}}),
    (FIRST, {"lag_margin": {"min": 0.25}}),
    (FIRST, {"disk_margin": {"min": 1.2}, "settling_time": {"max": 0.9}}),
    (FIRST, {"phase_margin": {"min": 1.3, "motor": "V_p"}, "V_peak": {"max": 18}}),
    (SWINGING, {"disk_margin": {"min": 0.95}, "settling_time": [{"max": 1.1, "axis": "theta"}]}),
    (AERO, {"lag_margin": {"min": 0.8}, "overshoot": {"max": 3}}),
)


@pytest.fixture(scope="module")
def answers() -> list[Nearest]:
    """Of the tasks, in their order."""
    return [nearest(spec, required) for spec, required in TASKS]


@pytest.mark.parametrize("task", range(len(TASKS)))
def test_every_move_meets_everything_and_is_as_far_as_it_says(answers, task):
    (spec, required), found = TASKS[task], answers[task]
    assert not meets(spec, required) and not found.met and found.moves
    assert [own.distance for own in found.moves] == sorted(own.distance for own in found.moves)
    for move in found.moves:
        assert meets(move.spec, required) and all(move.meets)
        assert move.distance == pytest.approx(apart(spec, move.spec), rel=1e-9)
        assert distance(spec, move.spec) == move.distance <= found.within
        for own, value in zip(found.requirements, move.values, strict=True):
            assert value in values_of(move.spec, own)
        moved = (
            move.spec.poles.values[:2] != spec.poles.values[:2],
            move.spec.poles.values[2:] != spec.poles.values[2:],
            move.spec.outer.pitch != spec.outer.pitch,
            move.spec.outer.yaw != spec.outer.yaw,
        )
        assert move.handles == tuple(name for name, own in zip(HANDLES, moved, strict=True) if own)
        # nothing else is touched
        back = replace(move.spec, poles=spec.poles, outer=spec.outer)
        assert back == spec


@pytest.mark.parametrize("task", range(len(TASKS)))
def test_numbers_have_few_digits(answers, task):
    spec, move = TASKS[task][0], answers[task].moves[0]
    numbers = [part for p in move.spec.poles.values for part in (p.real, p.imag)]
    numbers += [v for own in (move.spec.outer.pitch, move.spec.outer.yaw) for v in (own.kp, own.ti)]
    before = [part for p in spec.poles.values for part in (p.real, p.imag)]
    before += [v for own in (spec.outer.pitch, spec.outer.yaw) for v in (own.kp, own.ti)]
    assert all(float(f"{v:.6g}") == v for v, own in zip(numbers, before, strict=True) if v != own)


def test_the_relative_gain_has_a_closed_form():
    """λ₁₁ − 1 = k p₃p₄/(p₁p₂): to lower it by s² both poles of pitch go farther by s, (s − 1)√2 away."""
    own = evaluate(FIRST).interaction.relative_gain
    assert own is not None
    limit = Requirement(Measure("lambda_11"), max=1.0057)
    edge = min(1.0057, limit.edges[1])
    s = sqrt((own - 1) / (edge - 1))
    found = nearest(FIRST, [limit], ["pitch-pair"])
    assert found.moves[0].distance == pytest.approx(sqrt(2) * (s - 1), rel=0.01)
    farther = [p * s for p in FIRST.poles.values[:2]]
    np.testing.assert_allclose(
        sorted(p.real for p in found.moves[0].spec.poles.values[:2]), farther, rtol=0.005
    )


def test_the_first_volts_of_a_step_have_a_closed_form():
    """The yaw motor's linear step begins with kp r beyond the trim, which is its largest voltage."""
    spec, r = FIRST, FIRST.scenario.psi
    assert r is not None
    (peak,) = values_of(spec, Requirement(Measure("V_peak", Where("psi", "V_y", "linear")), max=5.0))
    assert peak is not None
    trim = peak - spec.outer.yaw.kp * r
    required = {"V_peak": {"max": 5.0, "axis": "psi", "motor": "V_y", "model": "linear"}}
    move = nearest(spec, required, ["yaw-pi"]).moves[0]
    assert move.distance == pytest.approx(log(spec.outer.yaw.kp * r / (5.0 - trim)), rel=0.01)
    assert move.spec.outer.yaw.ti == spec.outer.yaw.ti


def near_by_a_grid(spec: Spec, required: dict, handle: str) -> float:
    """Of one handle alone the nearest design that meets everything, on rings around it; infinite without one."""
    rings, spokes = np.linspace(0.0, 1.5, 37)[1:], np.linspace(0.0, 2 * pi, 32, endpoint=False)
    specs = []
    for r in rings:
        for angle in spokes:
            a, b = r * np.cos(angle), r * np.sin(angle)
            if handle.endswith("pi"):
                own = spec.outer.pitch if handle == "pitch-pi" else spec.outer.yaw
                gains = (own.kp * np.exp(a), own.ti * np.exp(b))
                pitch = handle == "pitch-pi"
                specs.append(spec.changed(pitch=gains) if pitch else spec.changed(yaw=gains))
                continue
            poles, first = list(spec.poles.values), 2 * (handle == "yaw-pair")
            p, q = poles[first : first + 2]
            real = p.real + a * abs(p), q.real + b * abs(q)
            upper = complex(p.real + a * abs(p) / sqrt(2), abs(p.imag) + b * abs(p) / sqrt(2))
            pairs = (real, (upper, upper.conjugate()))
            specs += [
                replace(spec, poles=PoleSet([*poles[:first], *own, *poles[first + 2 :]])) for own in pairs
            ]
    requirements = requirements_of(required)
    values = evaluate_many(specs, [Measure("lag_margin"), *(own.measure for own in requirements)])
    best = np.inf
    for candidate, (stable, *row) in zip(specs, values, strict=True):
        kept = not np.isnan(stable) and all(  # no lag margin, none even without limit: the loop is unstable
            own.meets(value)
            and (own.max is None or value <= own.max)
            and (own.min is None or value >= own.min)
            for own, value in zip(requirements, row, strict=True)
        )
        if kept:
            best = min(best, apart(spec, candidate))
    return best


@pytest.mark.parametrize("handle", HANDLES)
@pytest.mark.parametrize(
    ("spec", "required"),
    [
        (FIRST, {"settling_time": {"max": 0.8}}),
        (FIRST, {"disk_margin": {"min": 1.2}}),
        (FIRST, {"V_peak": {"max": 15}, "overshoot": {"max": 5}}),
        (SWINGING, {"overshoot": {"max": 1}}),
        (AERO, {"lag_margin": {"min": 0.8}}),
    ],
)
def test_no_grid_finds_anything_nearer(spec, required, handle):
    """Of one handle alone, whose plane can be searched whole; a grid may find less, and no more than 2 % better."""
    grid = near_by_a_grid(spec, required, handle)
    found = nearest(spec, required, [handle])
    own = found.moves[0].distance if found.moves else np.inf
    assert own <= 1.02 * grid or (found.met and grid > 0)
    if np.isfinite(own):
        assert meets(found.moves[0].spec, required)


@pytest.mark.parametrize(
    ("spec", "required"),
    [
        (FIRST, {"lag_margin": {"min": 0.25}}),
        (SWINGING, {"disk_margin": {"min": 0.95}}),
        (AERO, {"lag_margin": {"min": 0.8}}),
    ],
)
def test_slsqp_from_many_starts_comes_no_nearer(spec, required):
    """Over all eight numbers at once, where the figures have slopes; each pair as it stands, real or complex."""
    requirements = requirements_of(required)
    poles = spec.poles.values

    def at(z) -> Spec:
        new = []
        for i in (0, 2):
            p, (a, b) = poles[i], z[i : i + 2]
            if p.imag:
                upper = complex(p.real + a * abs(p) / sqrt(2), abs(p.imag) + b * abs(p) / sqrt(2))
                new += [upper, upper.conjugate()]
            else:
                new += [p.real + a * abs(p), poles[i + 1].real + b * abs(poles[i + 1])]
        gains = [(own.kp, own.ti) for own in (spec.outer.pitch, spec.outer.yaw)]
        pitch, yaw = (
            (kp * np.exp(a), ti * np.exp(b)) for (kp, ti), (a, b) in zip(gains, (z[4:6], z[6:]), strict=True)
        )
        return spec.changed(poles=new, pitch=pitch, yaw=yaw)

    def room(points) -> np.ndarray:
        values = evaluate_many([at(z) for z in points], [own.measure for own in requirements])
        limits = np.array([own.max if own.min is None else own.min for own in requirements])
        signs = np.array([1.0 if own.min is None else -1.0 for own in requirements])
        return np.nan_to_num(signs * (limits - values) / np.abs(limits), nan=-1.0)

    def slopes(z) -> np.ndarray:
        there = room([z, *(z + 1e-4 * np.eye(8))])
        return ((there[1:] - there[0]) / 1e-4).T

    random, best = np.random.default_rng(1), np.inf
    for start in range(10):
        found = minimize(
            lambda z: z @ z,
            0.3 * random.standard_normal(8) * (start > 0),
            jac=lambda z: 2 * z,
            bounds=[(-1.2, 1.2)] * 8,
            constraints={"type": "ineq", "fun": lambda z: room([z])[0] - 1e-6, "jac": slopes},
            method="SLSQP",
            options={"maxiter": 40},
        )
        if meets(at(found.x), required):
            best = min(best, apart(spec, at(found.x)))
    assert np.isfinite(best)
    assert nearest(spec, required).moves[0].distance <= 1.05 * best


def test_where_none_is_near_it_says_what_is_out_of_reach():
    found = nearest(FIRST, {"overshoot": {"max": 10}, "settling_time": {"max": 0.1}})
    assert not found.met and not found.moves and found.out_of_reach == (1,)
    assert "out of reach: Settling time, either step ≤ 0.10 s" in found.summary()
    assert found.closest is not None and found.closest.meets == (True, False)
    both = nearest(FIRST, {"settling_time": {"max": 0.7}, "V_peak": {"max": 14}})
    assert not both.moves and both.out_of_reach == () and "each requirement alone" in both.summary()
    assert both.closest is not None and not all(both.closest.meets)


def test_what_is_met_needs_no_move():
    found = nearest(FIRST, {"settling_time": {"max": 3}})
    assert found.met and not found.moves and found.now.meets == (True,) and found.tried == 1
    assert found.summary() == "met as it is"


def test_an_unstable_loop_moves_until_it_is_stable():
    spec = FIRST.changed(poles=[-3, -2, -3, -2])
    assert not evaluate(spec).judged.stable
    found = nearest(spec, {"lag_margin": {"min": 0.02}})
    assert found.moves and meets(found.moves[0].spec, {"lag_margin": {"min": 0.02}})
    stable = nearest(spec, [])  # nothing is required but that
    assert not stable.met and evaluate(stable.moves[0].spec).judged.stable
    assert stable.moves[0].distance <= found.moves[0].distance


@pytest.mark.parametrize(
    ("spec", "required", "free", "may"),
    [
        (replace(AERO, place_rotors=True), {"overshoot": {"max": 1}}, ["poles"], {"pitch-pair", "yaw-pair"}),
        (
            FIRST.changed(measured="observer", observer=Observer()),
            {"disk_margin": {"min": 0.8}},
            ["loops"],
            None,
        ),
        (FIRST.changed(outer="none"), {"settling_time": {"max": 0.4}}, ["poles", "loops"], set(HANDLES[:2])),
        (FIRST.changed(method="lqr"), {"lag_margin": {"min": 0.3}}, ["poles", "loops"], set(HANDLES[2:])),
        (FIRST.changed(method="knv0"), {"lag_margin": {"min": 0.2}}, ["pitch-pair"], {"pitch-pair"}),
        (
            replace(FIRST, scenario=replace(FIRST.scenario, digital=Digital())),
            {"settling_time": {"max": 0.8}},
            ["yaw-pair"],
            {"yaw-pair"},
        ),
        (Spec.from_preset("quanser-aero"), {"lag_margin": {"min": 0.6}}, ["pitch-pi"], {"pitch-pi"}),
    ],
)
def test_other_structures_methods_and_controllers(spec, required, free, may):
    found = nearest(spec, required, free)
    assert found.met or found.moves or found.closest
    for move in found.moves:
        assert meets(move.spec, required)
        assert set(move.handles) <= (may or set(HANDLES[2:]))
    assert set(found.free) <= (may or set(HANDLES[2:]))


def test_the_same_task_has_the_same_answer_on_any_number_of_threads():
    required = {"disk_margin": {"min": 1.2}, "settling_time": {"max": 0.9}}
    first, again = nearest(FIRST, required), nearest(FIRST, required, threads=2)
    assert [move.spec for move in first.moves] == [move.spec for move in again.moves]
    assert first.tried == again.tried


def test_it_can_be_called_off():
    calls = 0

    def check() -> None:
        nonlocal calls
        calls += 1
        if calls > 20:
            raise CancelledError("cancelled")

    with pytest.raises(CancelledError):
        nearest(FIRST, {"settling_time": {"max": 0.5}}, check=check)
    assert calls == 21


@pytest.mark.parametrize(
    ("spec", "required", "free", "field"),
    [
        (FIRST, {"settling_time": {"max": 0.8}}, ["poles", "rotors"], "free.1"),
        (FIRST.changed(method="lqr"), {"settling_time": {"max": 0.8}}, ["poles"], "free"),
        (FIRST.changed(method="lqr-integral"), {"settling_time": {"max": 0.8}}, ["poles", "loops"], "free"),
        (FIRST.changed(outer="none"), {"settling_time": {"max": 0.8}}, ["loops"], "free"),
        (
            FIRST.changed(reference=(0.1, None)),
            {"overshoot": {"max": 1, "axis": "psi"}},
            ["poles"],
            "require.overshoot",
        ),
        (FIRST, {"share_stable": {"min": 0.9}}, ["poles"], "require.share_stable"),
        (FIRST, {"overshoot": {"max": 1, "share": 0.9}}, ["poles"], "require.overshoot"),
    ],
)
def test_what_cannot_be_asked_is_refused(spec, required, free, field):
    with pytest.raises(InvalidInputError) as refused:
        nearest(spec, required, free)
    assert refused.value.field == field and refused.value.hint


def test_a_rig_that_cannot_be_controlled_is_refused():
    parameters = {"K_pp": 0.1, "K_yy": 0.1, "K_py": 0.1, "K_yp": 0.1}
    with pytest.raises(UncontrollableError):
        nearest(FIRST.changed(parameters=parameters), {"settling_time": {"max": 0.8}})


def test_the_point_nearest_to_the_origin_under_linear_limits():
    """Known corners, and random ones against SLSQP."""
    for rows, ends, corner in (
        ([[1.0, 0.0], [0.0, 2.0]], [3.0, 8.0], [3, 4]),
        ([[1.0, 1.0]], [2.0], [1, 1]),
        ([[1.0, 1.0]], [-2.0], [0, 0]),
    ):
        known = least_distance(np.array(rows), np.array(ends))
        assert known is not None
        np.testing.assert_allclose(known, corner, atol=1e-12)
    assert least_distance(np.array([[1.0, 0.0], [-1.0, 0.0]]), np.array([1.0, 1.0])) is None
    random = np.random.default_rng(3)
    for _ in range(20):
        a, inside = random.standard_normal((5, 4)), random.standard_normal(4)
        b = a @ inside - random.random(5)
        own = least_distance(a, b)
        other = minimize(
            lambda z: z @ z,
            inside,
            jac=lambda z: 2 * z,
            method="SLSQP",
            constraints={"type": "ineq", "fun": lambda z, a=a, b=b: a @ z - b, "jac": lambda z, a=a: a},
        )
        assert own is not None
        assert np.min(a @ own - b) > -1e-9
        assert own @ own == pytest.approx(other.fun, rel=1e-5)


def test_tables_and_words_say_what_moves():
    found = nearest(FIRST, {"settling_time": {"max": 0.8}}, ["yaw-pi"])
    required, moves = found.tables()
    assert required.rows == (("Settling time, either step", "≤ 0.80 s", "0.85 s", "0.80 s"),)
    assert moves.rows[0][2] == found.moves[0].words and found.moves[0].words.startswith("yaw PI to kp 30.")
    assert repr(found).startswith("<Nearest: 2.5") and "% away" in repr(found)
