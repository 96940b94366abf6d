"""Numbers that are swept: against matrices written down here, python-control, margins, and the simulated rig."""

from __future__ import annotations

from dataclasses import replace

import control
import numpy as np
import pytest
from scipy.optimize import linear_sum_assignment

import heli2dof_core as heli
from heli2dof_core import InvalidInputError, Observer, Spec
from heli2dof_core.evaluate import evaluate, loop_of
from heli2dof_core.export.tracks import track_csv, track_svg
from heli2dof_core.many import Measure, evaluate_many
from heli2dof_core.measured import MEASURED, Where
from heli2dof_core.plant import plant
from heli2dof_core.rotors import Rotor, Rotors
from heli2dof_core.scenario import Digital
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.tracks import known_paths, number_at, swept_paths, track
from heli2dof_core.tracks.courses import crossings_of, followed
from heli2dof_core.tracks.sweeps import gathered
from tests.core.random_specs import random_specs

COMPLEX = Spec.from_preset(poles=[-12, -10, -3 + 4j, -3 - 4j])
LAGGING = replace(COMPLEX, rotors=Rotors(Rotor(0.05), Rotor(0.08)))
OBSERVED = replace(LAGGING, observer=Observer()).changed(measured="observer")
DISK, SETTLING = Measure("disk_margin"), Measure("settling_time", Where("theta"))
PEAK = Measure("V_peak", Where(motor="V_p", model="linear"))


def apart(a, b) -> float:
    """Largest distance of two spectra, matched one to one, relative to the size of each pole."""
    distance = np.abs(a[:, None] - b[None])
    rows, columns = linear_sum_assignment(distance)
    return float(np.max(distance[rows, columns] / np.maximum(1.0, np.abs(a[rows]))))


def opened(spec: Spec) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A, B and the law of [x, z, v] by the equations: u = −Kx + kp e + kp/ti ∫e, τ v̇ = u − v."""
    loop = loop_of(spec)
    A, B, K = loop.design.plant.A, loop.design.plant.B, loop.design.K
    whole, inputs, law = np.zeros((8, 8)), np.zeros((8, 2)), np.zeros((2, 8))
    whole[:4, :4], whole[:4, 6:] = A, B
    whole[4:6, :2] = -np.eye(2)
    for j, (rotor, pi) in enumerate(zip(spec.rotors.both, (spec.outer.pitch, spec.outer.yaw), strict=True)):
        whole[6 + j, 6 + j], inputs[6 + j, j] = -1 / rotor.tau, 1 / rotor.tau
        law[j, :4], law[j, 4 + j] = -K[j], pi.kp / pi.ti
        law[j, j] -= pi.kp
    return whole, inputs, law


def test_the_gain_opens_both_loops_and_goes_through_the_design():
    found = track(LAGGING, "gain", (0.0, 3.0))
    A, B, law = opened(LAGGING)
    for k, poles in zip(found.values, found.poles, strict=True):
        assert apart(poles, np.linalg.eigvals(A + k * B @ law)) < 2e-7
    assert found.at_now is not None and found.values[found.at_now] == 1.0
    assert apart(found.poles[found.at_now], loop_of(LAGGING).poles) < 1e-9
    assert (
        apart(
            found.poles[0], np.array([*np.linalg.eigvals(loop_of(LAGGING).design.plant.A), 0, 0, -20, -12.5])
        )
        < 1e-9
    )


@pytest.mark.parametrize("motor", [0, 1])
def test_the_root_locus_of_one_motor_is_python_controls(motor):
    found = track(LAGGING, f"gain.{('pitch', 'yaw')[motor]}", (0.0, 5.0))
    A, B, law = opened(LAGGING)
    other = 1 - motor
    A = A + np.outer(B[:, other], law[other])
    system = control.ss(A, B[:, [motor]], -law[[motor]], 0)
    theirs = control.root_locus_map(system, gains=found.values)
    for own, loci in zip(found.poles, theirs.loci, strict=True):
        assert apart(own, np.asarray(loci)) < 1e-5  # theirs are roots of polynomials
    zeros = control.zeros(system)
    assert apart(found.zeros, zeros[np.abs(zeros) < 1e6]) < 1e-6


def test_a_gain_crosses_where_the_margin_says_for_every_kind_of_loop():
    checked = 0
    for spec in random_specs(60, 5):
        report = evaluate(spec)
        for axis, margins in zip(("pitch", "yaw"), report.motors or (), strict=False):
            limit = margins.get("gain_margin")
            if limit is None or limit > 100.0:
                continue
            found = track(spec, f"gain.{axis}", (0.5, 1.5 * limit), 60)
            beyond = [c for c in found.crossings if c.value > 1.0]
            assert beyond and beyond[0].outwards
            assert beyond[0].value == pytest.approx(limit, rel=1e-7)
            checked += 1
    assert checked > 15


def test_the_rotors_lag_crosses_at_the_lag_margin():
    margin = loop_of(COMPLEX).lag_margin
    assert margin is not None
    found = track(COMPLEX, "rotors.tau", (0.0, 2.0 * margin), 50)
    assert found.values[0] == pytest.approx(2e-3 * margin)
    assert found.crossings[0].value == pytest.approx(margin, rel=1e-9)
    pole = found.crossings[0].pole
    assert abs(pole.real) < 1e-9 * abs(pole) and pole.imag > 0.0 and found.crossings[0].outwards


@pytest.mark.parametrize(
    "base", [COMPLEX, OBSERVED, COMPLEX.changed(method="lqr")], ids=["paper", "observer", "lqr"]
)
def test_every_number_can_be_swept_and_each_value_is_its_own_design(base):
    paths = [*swept_paths(base)]
    assert len(paths) > 60 and {*paths} <= {*known_paths()}
    for path in paths:
        found = track(base, path, points=3)
        number = number_at(base, path)
        if number.spec_at is None or found.plane == "z" or not len(found.values):
            continue
        for k in {0, len(found.values) // 2, len(found.values) - 1}:
            loop = loop_of(number.spec_at(float(found.values[k])))
            assert apart(found.poles[k], loop.connected_poles) < 2e-6, path
            assert found.stable[k] == loop.stable
        if number.now is not None and found.at_now is not None:
            assert apart(found.poles[found.at_now], loop_of(base).connected_poles) < 2e-6, path


def test_pairs_are_moved_as_they_are_told():
    def at(path, value):
        spec_at = number_at(COMPLEX, path).spec_at
        assert spec_at is not None
        return spec_at(value).poles.values

    assert at("yaw-pair.re", -5.0)[2:] == (-5 + 4j, -5 - 4j)
    assert at("yaw-pair.im", 0.0)[2:] == (-3, -3)
    assert at("pitch-pair.re", -10.0)[:2] == (-9, -11)
    assert np.allclose(at("yaw-pair.frequency", 10.0)[2:], [-6 + 8j, -6 - 8j])
    assert np.allclose(at("yaw-pair.damping", 1.25)[2:], [-2.5, -10])
    assert at("poles.1", -20.0)[:2] == (-12, -20)
    assert at("poles.factor", 2.0) == (-24, -20, -6 + 8j, -6 - 8j)
    assert number_at(COMPLEX, "yaw-pair.damping").now == pytest.approx(0.6)


def test_figures_are_those_of_each_design():
    found = track(COMPLEX, "loops.yaw.ti", (0.05, 1.0), 12, (SETTLING, DISK, PEAK), scale="log")
    number = number_at(COMPLEX, "loops.yaw.ti")
    assert number.spec_at is not None
    specs = [number.spec_at(value) for value in found.values.tolist()]
    np.testing.assert_array_equal(found.figures, evaluate_many(specs, (SETTLING, DISK, PEAK)))
    for spec, row in zip(specs, found.figures, strict=True):
        report = evaluate(spec, each_axis=True)
        settled = MEASURED["settling_time"].read(report, SETTLING.where)[0]
        assert np.isnan(row[0]) if settled is None else row[0] == settled
        own = report.sensitivity
        assert np.isnan(row[1]) if own is None else row[1] == own.disk_margin
    assert np.isfinite(found.figures[-1]).all() and np.isnan(found.figures[0, 1])


@pytest.mark.parametrize("path", ["gain", "gain.pitch", "gain.yaw"])
@pytest.mark.parametrize(
    "base", [COMPLEX, LAGGING, COMPLEX.changed(pairing="cross"), COMPLEX.changed(outer="none"),
             COMPLEX.changed(method="lqr-integral")],
    ids=["paper", "lag", "cross", "inner", "own integrals"],
)  # fmt: skip
def test_figures_along_a_gain_are_those_of_the_law_times_it(path, base):
    peak = Measure("peak", Where("theta", model="linear"))
    found = track(base, path, (0.7, 1.3), 5, (DISK, peak))
    loop, ends = loop_of(base), base.scenario.theta
    assert ends is not None
    factor = np.ones((2, 1))
    motors = {"gain": [0, 1], "gain.pitch": [0], "gain.yaw": [1]}[path]
    for k, row in zip(found.values, found.figures, strict=True):
        factor[motors] = k
        A = loop.A + loop.motors @ ((factor - 1.0) * loop.voltage_from_state)
        B = loop.B + loop.motors @ ((factor - 1.0) * loop.voltage_from_reference)
        if np.linalg.eigvals(A).real.max() >= -1e-9:
            assert np.isnan(row[0])
            continue
        t = np.linspace(0.0, base.scenario.duration, 4001)
        C = np.zeros((1, len(A)))
        C[0, 0] = 1.0
        step = control.step_response(control.ss(A, B[:, [0]], C, 0), t)
        tallest = base.theta_0 + float(np.max(np.squeeze(step.outputs))) * (ends - base.theta_0)
        assert row[1] == pytest.approx(tallest, rel=2e-4)
        opened_at_both = control.ss(A, loop.motors, -factor * loop.voltage_from_state, np.zeros((2, 2)))
        # A holds the closed loop, so that its response is T; (S − T)/2 = I/2 − T. Its diagonal μ is the largest
        # singular value under the best scaling, which leaves the determinant and makes both other entries alike
        w = np.geomspace(0.1, 100.0, 8000)
        M = 0.5 * np.eye(2)[:, :, None] - opened_at_both(1j * w)
        size = np.abs(M[0, 0]) ** 2 + np.abs(M[1, 1]) ** 2 + 2 * np.abs(M[0, 1] * M[1, 0])
        determinant = np.abs(M[0, 0] * M[1, 1] - M[0, 1] * M[1, 0])
        mu = np.sqrt(0.5 * (size + np.sqrt(np.maximum(size**2 - 4 * determinant**2, 0.0))))
        disk = 1.0 / np.max(mu)
        assert row[0] == pytest.approx(min(disk, 2.0), rel=1e-3)


def sampled(spec: Spec, digital: Digital) -> np.ndarray:
    """θ and ψ at the samples, deviations from rest, of the digital rig let go a little off; (n, 2)."""
    n = 60
    scenario = replace(
        spec.scenario, theta=None, psi=None, digital=digital, duration=n * digital.sample_time, samples=n + 1,
        initial=(spec.theta_0 + 1e-5, -2e-5, 0.0, 0.0), saturation=False, anti_windup="none", rtol=1e-12,
    )  # fmt: skip
    response = simulate_digital(loop_of(spec), spec.limits, scenario, digital)
    return np.column_stack((response.theta - spec.theta_0, response.psi))


@pytest.mark.parametrize("base", [COMPLEX, LAGGING, OBSERVED, LAGGING.changed(measured="filtered")],
                         ids=["paper", "lag", "observer", "filtered"])  # fmt: skip
@pytest.mark.parametrize("delay", [False, True])
@pytest.mark.parametrize("rates", ["true", "filtered"])
def test_the_simulated_digital_rig_obeys_the_sampled_loops_polynomial(base, delay, rates):
    """By Cayley and Hamilton every output of x(k + 1) = Φ x(k) satisfies Φ's characteristic equation."""
    digital = Digital(0.02, delay=delay, encoders=(0, 0), rates=rates)
    spec = replace(base, scenario=replace(base.scenario, digital=digital))
    found = track(spec, "scenario.digital.sample_time", (0.01, 0.03), 5)
    assert found.plane == "z" and found.at_now is not None
    course = sampled(spec, digital)
    coefficients = np.poly(found.poles[found.at_now]).real[::-1]
    order = len(coefficients) - 1
    for output in course.T:
        for k in range(3, 20):
            terms = coefficients * output[k : k + order + 1]
            assert abs(terms.sum()) < 3e-6 * np.abs(terms).sum()


def test_fast_sampling_is_the_continuous_loop():
    digital = Digital(0.01, encoders=(0, 0), rates="true")
    spec = replace(COMPLEX, scenario=replace(COMPLEX.scenario, digital=digital))
    found = track(spec, "scenario.digital.sample_time", (1e-4, 0.1), 40, scale="log")
    own = found.equivalent[0]
    assert apart(own[np.isfinite(own)], loop_of(spec).poles) < 2e-2
    halves = track(spec, "scenario.digital.sample_time", (2e-4, 0.1), 2).equivalent[0]
    assert apart(halves, loop_of(spec).poles) == pytest.approx(2 * apart(own, loop_of(spec).poles), rel=0.1)
    assert number_at(COMPLEX, "scenario.digital.sample_time").now is None


def test_kept_gains_meet_other_rigs():
    found = track(COMPLEX, "parameters.m", (0.5, 3.0), 20, kept=True)
    loop = loop_of(COMPLEX)
    for m, poles in zip(found.values.tolist(), found.poles, strict=True):
        rig = plant(COMPLEX.parameters.replaced({"m": m}), COMPLEX.theta_0)
        A = np.zeros((6, 6))
        A[:4, :4] = rig.A
        A[:4] += rig.B @ loop.voltage_from_state
        A[4:, :2] = -np.eye(2)
        assert apart(poles, np.linalg.eigvals(A)) < 1e-7
    anew = track(COMPLEX, "parameters.m", (0.5, 3.0), 20)
    assert apart(anew.poles[0], found.poles[0]) > 0.1
    with pytest.raises(InvalidInputError, match="of the law"):
        track(COMPLEX, "loops.pitch.kp", kept=True)
    with pytest.raises(InvalidInputError, match="gains are kept"):
        track(COMPLEX, "parameters.m", (0.5, 3.0), 20, (DISK,), kept=True)


class Made:
    """Poles as a function of one number that is written down here."""

    plane = "s"

    def __init__(self, spectrum):
        self.spectrum = spectrum

    def poles(self, values):
        rows = np.array([self.spectrum(v) for v in values.tolist()], dtype=complex).reshape(len(values), -1)
        return rows, np.all(rows.real < 0, axis=1)

    def figures(self, values, measures, check):
        raise NotImplementedError


def nothing():
    return None


def test_a_pole_that_looks_over_the_border_between_two_values_is_seen():
    sweep = Made(lambda v: (1e-4 - (v - 0.503) ** 2 + 2j, 1e-4 - (v - 0.503) ** 2 - 2j, -5.0))
    course = followed(sweep, np.linspace(0.0, 1.0, 11), nothing)
    found = crossings_of(sweep, course, nothing)
    assert [(round(value, 9), outwards) for value, _, outwards in found] == [(0.493, True), (0.513, False)]
    assert all(pole == pytest.approx(2j, abs=1e-9) for _, pole, _ in found)


def test_poles_that_meet_leave_at_right_angles_and_poles_that_pass_keep_their_way():
    meet = Made(lambda v: np.roots([1.0, 4.0, 4.0 * v]))
    course = followed(meet, np.linspace(0.0, 2.0, 21), nothing)
    assert np.min(np.abs(course.values - 1.0)) < 1e-3  # where both are −2
    assert len(course.values) > 25
    passing = Made(lambda v: (-1.0 + 3.0 * v - 5.0, -1.0 - 3.0 * v + 1j, -1.0 - 3.0 * v - 1j))
    course = followed(passing, np.linspace(0.0, 1.0, 9), nothing)
    straight = [course.poles[:, j] for j in range(3)]
    for own in straight:
        assert np.max(np.abs(np.diff(own.imag))) < 1e-12


def test_where_there_is_no_loop_the_track_is_left_out():
    rig = COMPLEX.changed(parameters={"K_py": 0.0, "K_yp": 0.0})
    found = track(rig, "parameters.K_pp", (-0.2, 0.2), 11)  # at 0 the pitch motor does nothing
    assert 0.0 not in found.values and len(found.starts) == 2
    assert found.values[found.starts[1] - 1] < 0.0 < found.values[found.starts[1]]
    with pytest.raises(heli.UncontrollableError):
        track(rig.changed(parameters={"K_yy": 0.0}), "parameters.B_p", (0.1, 1.0), 5)


@pytest.mark.parametrize(
    ("path", "options", "field"),
    [
        ("loops.pitch", {}, "track.path"),
        ("poles.2", {}, "track.path"),
        ("weights.inputs.V_p", {}, "track.path"),
        ("gain", {"over": (1.0, 1.0)}, "track.over"),
        ("loops.pitch.ti", {"over": (-1.0, 1.0)}, "track.over"),
        ("gain", {"points": 1}, "track.points"),
        ("gain", {"scale": "log"}, "track.scale"),
        ("gain", {"measures": [DISK] * 13}, "track.measures"),
    ],
)
def test_refusals_name_the_field(path, options, field):
    with pytest.raises(InvalidInputError) as refused:
        track(COMPLEX, path, **options)
    assert refused.value.field == field


def test_no_law_is_like_an_observer_that_knows_half_of_the_voltage():
    with pytest.raises(InvalidInputError, match="observer"):
        track(OBSERVED, "gain", measures=(DISK,))
    with pytest.raises(InvalidInputError, match="decoupler"):
        track(COMPLEX.changed(decoupler=True), "gain.pitch", measures=(DISK,))


@pytest.mark.parametrize("path", ["gain", "gain.pitch", "gain.yaw"])
@pytest.mark.parametrize("changes", [{}, {"decoupler": True}, {"method": "lqr"}], ids=str)
def test_an_open_loop_with_poles_on_the_border_crosses_nowhere(changes, path):
    found = track(Spec.from_preset().changed(**changes), path, (0.0, 1.0), 40)
    assert not found.stable[0] and found.stable[1:].all() and found.crossings == ()
    assert found.on_border.tolist() == [True] + [False] * (len(found.values) - 1)
    assert "stable except at 0, where poles lie on the border" in found.summary()


def test_a_double_pole_at_0_is_one_and_all_others_stay():
    rows = np.array([[-9, 7e-8, -7e-8], [-9, -1e-3, -2e-3], [-9, 5e-8j, -5e-8j], [-9, 1e-8, -3]], complex)
    whole = gathered(rows)
    assert np.all(np.abs(whole[[0, 2], 1:]) < 1e-20) and np.array_equal(whole[[1, 3]], rows[[1, 3]])


def test_what_is_beyond_the_border_is_not_on_it():
    found = track(LAGGING, "rotors.tau", (0.01, 0.4), 40)
    assert not found.stable.all() and not found.on_border.any() and "stable in part" in found.summary()


def test_it_shows_itself_and_can_be_taken_away():
    found = heli.track(LAGGING, "rotors.tau", (0.01, 0.4), 40, (DISK, SETTLING))
    assert "crosses at" in found.summary() and found.tables()[0].title.startswith("poles on")
    lines = track_csv(found, LAGGING).splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")]
    assert len(rows) == 1 + len(found.values) and {len(row) for row in rows[1:]} == {2 + 16 + 2}
    assert float(rows[3][0]) == found.values[2] and float(rows[3][2]) == found.poles[2, 0].real
    picture = track_svg(found, LAGGING)
    assert picture.count("<polyline") >= 8 and "unstable" in picture and "Disk margin" in picture
