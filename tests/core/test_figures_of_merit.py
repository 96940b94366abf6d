"""Figures of merit belong to the response: held against SciPy, whatever the samples, the window and the model."""

from __future__ import annotations

from dataclasses import replace

import control
import numpy as np
import pytest

from heli2dof_core import OuterLoop, PoleSet, Scenario, Spec, close_loop, design, evaluate, plant, preset
from heli2dof_core.figures import AXIS, axis_figures
from heli2dof_core.metrics import step_metrics
from heli2dof_core.scenario import Digital, Disturbance
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import simulate_nonlinear
from tests.core.test_nonlinear_response import random_loops
from tests.figures import LinearCourse, figures, largest
from tests.strategies import STRUCTURES

LIMITS = preset().limits
AXES = ("theta", "psi")


def inner_loop(*poles, theta_0=0.0, coupling=STRUCTURES[0]):
    placed = design(plant(preset().parameters, theta_0), PoleSet(poles), coupling)
    return close_loop(placed, OuterLoop(outer="none"))


def worst_gap(own, expected, step, length, rounding=1e-6):
    """The largest difference of the figures: shares of the step, or of the time that it lasts."""
    gaps = [0.0]
    sizes = {"s": 1.0, "%": 100.0, "rad": step, "rad·s": step, "rad·s²": step * length}
    for name in expected.keys() - {"entered", "peak_time"}:
        value = getattr(own, name)
        assert (value is None) == (expected[name] is None), name
        if value is not None:
            gaps.append(abs(value - expected[name]) / sizes[AXIS[name].unit])
    if own.peak_time is not None:
        # an extremum is flat: its time is known to the root of what its height is known to
        assert own.peak_time == pytest.approx(expected["peak_time"], abs=1e-3 * length)
    elif expected["peak_time"] < 0.999 * length:
        assert expected["overshoot"] < 110 * rounding
    if own.settled:
        gaps.append(abs(own.settling_time - expected["entered"]))
    return max(gaps)


def random_linear(count, seed):
    """Loops and experiments of all kinds: steps down, starts off rest, windows from 10 ms to 40 s."""
    rng = np.random.default_rng(seed)
    for loop, _ in random_loops(count, seed):
        start = [None if rng.random() < 0.5 else rng.uniform(-0.3, 0.3) for _ in range(2)]
        rates = rng.uniform(-1, 1, 2) if rng.random() < 0.3 else (0.0, 0.0)
        reference = [None if rng.random() < 0.15 else rng.uniform(-0.5, 0.5) for _ in range(2)]
        duration = float(10 ** rng.uniform(-2, 1.6))
        yield loop, Scenario(*reference, duration=duration, samples=2, initial=(*start, *rates))


def linear_reference(loop, scenario, digits=None):
    theta_0 = loop.design.plant.theta_0
    resolved = np.array(scenario.resolved(theta_0))
    start = np.zeros(len(loop.A))
    start[:4] = resolved[2:6] - [theta_0, 0, 0, 0]
    return LinearCourse(loop.A, loop.B, resolved[:2] - [theta_0, 0], start, digits), resolved


def check_linear(loop, scenario, samples=4001, digits=None):
    """The largest difference from the modes' own figures; the verdict on settling looks as far as they last."""
    course, resolved = linear_reference(loop, scenario, digits)
    early = min(scenario.duration, 30 / np.max(np.abs(loop.poles)))  # dense where the fast poles are, too
    t = np.linspace(0, early, samples)
    if early < scenario.duration:
        t = np.concatenate([t, np.linspace(early, scenario.duration, samples)[1:]])
    deviations = course(t)
    offset = np.array([loop.design.plant.theta_0, 0.0])
    response = simulate_linear(loop, scenario)
    own, worst = step_metrics(response), 0.0
    for axis, name in enumerate(AXES):
        reference, start = resolved[[axis, 2 + axis]]
        if name not in own.axes or abs(reference - start) < 1e-3:
            continue
        metrics = own.axes[name]
        expected = figures(t, deviations[axis] + offset[axis], start, reference)
        worst = max(worst, worst_gap(metrics, expected, abs(reference - start), scenario.duration))
        leaves = course.leaves(scenario.duration, axis, start - offset[axis], reference - offset[axis])
        assert metrics.settled == (expected["entered"] is not None and not leaves)
    by_reference = loop.voltage_from_reference @ (resolved[:2] - offset)
    for motor, name in enumerate(("V_p", "V_y")):
        rest = loop.design.plant.trim[motor]
        peak = largest(t, loop.voltage_from_state[motor] @ deviations + by_reference[motor] + rest)
        worst = max(worst, abs(own.motors[name].peak - peak) / max(peak, 1e-3))
    return worst


def test_linear_figures_are_those_of_the_modes():
    worst = max(check_linear(loop, scenario) for loop, scenario in random_linear(12, seed=7))
    assert worst < 1e-6


@pytest.mark.slow
def test_fast_poles_do_not_blur_the_slow_ones():
    """To −10⁵ beside −1, windows from 10 ms to 600 s."""
    for poles in ([-1e5, -5e4, -1.0, -2.0], [-3e3 + 4e3j, -3e3 - 4e3j, -1.0, -30.0]):
        for duration in (0.01, 1.0, 600.0):
            scenario = Scenario(0.1, 0.2, duration=duration, samples=2)
            course, resolved = linear_reference(inner_loop(*poles), scenario, digits=40)
            own = step_metrics(simulate_linear(inner_loop(*poles), scenario)).axes
            rise = np.linspace(0, min(duration, 30.0), 60_001)
            for axis, name in enumerate(AXES):
                error = resolved[axis] - course(np.array([duration]))[axis, 0]
                assert own[name].steady_state_error == pytest.approx(error, abs=1e-7)
                if axis == 1:
                    expected = figures(rise, course(rise)[1], 0.0, 0.2)
                    for figure in ("rise_time", "settling_time"):
                        key = "entered" if figure == "settling_time" else figure
                        value = getattr(own[name], figure)
                        assert value == (None if value is None else pytest.approx(expected[key], abs=1e-5))
            fast = np.abs(poles[0])
            early = np.linspace(0, min(duration, 20 / fast * np.sqrt(3)), 4001)
            pitch = figures(early, course(early)[0], 0.0, 0.1)
            assert own["theta"].overshoot == pytest.approx(pitch["overshoot"], abs=2e-4)
            assert own["theta"].rise_time == pytest.approx(pitch["rise_time"], abs=1e-9)


SAME = ("rise_time", "settling_time", "settled", "overshoot", "undershoot", "peak", "peak_time")


def alike(one, other, abs_=1e-6, names=SAME):
    assert one.axes.keys() == other.axes.keys()
    for name, axis in one.axes.items():
        for figure in names:
            assert getattr(axis, figure) == pytest.approx(getattr(other.axes[name], figure), abs=abs_), figure
    for name, motor in one.motors.items():
        assert motor.peak == pytest.approx(other.motors[name].peak, rel=1e-6)


@pytest.mark.parametrize("digital", [None, Digital()], ids=["continuous", "digital"])
def test_figures_do_not_depend_on_samples_or_duration(digital):
    spec = Spec.from_preset(reference=(0.2, 0.3))
    courses = {}
    for duration, samples in ((5.0, 501), (5.0, 2), (5.0, 20_001), (3.1, 7), (40.0, 90)):
        scenario = replace(spec.scenario, duration=duration, samples=samples, digital=digital)
        report = evaluate(replace(spec, scenario=scenario))
        courses[duration, samples] = report.step
        for model, step in report.step.items():
            alike(step.metrics, courses[5.0, 501][model].metrics)
            if duration == 5.0:
                ours, theirs = step.metrics, courses[5.0, 501][model].metrics
                assert vars(ours.axes["theta"]) == pytest.approx(
                    vars(theirs.axes["theta"]), rel=1e-6, abs=1e-12
                )
                assert vars(ours.motors["V_p"]) == pytest.approx(vars(theirs.motors["V_p"]), rel=1e-6)


def test_a_coarse_picture_of_an_oscillation_does_not_hide_it():
    """Sampled once per period a lightly damped response looks as if it rested."""
    loop = inner_loop(-0.02 + 10.47j, -0.02 - 10.47j, -8, -9)
    scenario = Scenario(theta=0.05, duration=600.0, samples=1001)
    own = step_metrics(simulate_linear(loop, scenario)).axes["theta"]
    zeta = 0.02 / np.hypot(0.02, 10.47)
    assert own.overshoot == pytest.approx(100 * np.exp(-np.pi * zeta / np.sqrt(1 - zeta**2)), abs=1e-4)
    assert own.peak_time == pytest.approx(np.pi / 10.47, abs=1e-6)


@pytest.mark.parametrize(
    ("duration", "settles"), [(60.0, None), (60.1, None), (77.9, None), (78.0, 77.947693), (100.0, 77.947693)]
)
def test_a_last_crossing_is_no_settling(duration, settles):
    """Within the band when the window ends, but on its way out again; the value is that of the modes."""
    loop = inner_loop(-0.05 + 5j, -0.05 - 5j, -8, -9)
    response = simulate_linear(loop, Scenario(theta=0.05, duration=duration))
    own = step_metrics(response)
    axis = own.axes["theta"]
    assert axis.settling_time == (None if settles is None else pytest.approx(settles, abs=1e-5))
    assert axis.settled == (settles is not None)
    assert ("not settled" in own.summary()) == (settles is None)


def test_the_rig_is_followed_beyond_its_window():
    """Where it has come into the band only just: the same settling time as in a long window, or none."""
    spec = Spec.from_preset(reference=(0.2, None))
    for digital in (None, Digital()):
        long = replace(spec, scenario=replace(spec.scenario, duration=10.0, digital=digital))
        settles = evaluate(long).step["nonlinear"].metrics.axes["theta"].settling_time
        for duration, settled in ((settles + 0.02, True), (settles - 0.02, False)):
            scenario = replace(spec.scenario, duration=duration, digital=digital)
            own = evaluate(replace(spec, scenario=scenario)).step["nonlinear"].metrics.axes["theta"]
            assert own.settled == settled
            assert own.settling_time == (pytest.approx(settles, abs=1e-6) if settled else None)


def test_what_overshoots_nothing_has_no_peak_time():
    loop = inner_loop(-4, -5, -6, -7)
    for duration in (4.0, 5.0, 10.0, 20.0):
        for simulated in (
            simulate_linear(loop, Scenario(theta=0.1, duration=duration)),
            simulate_nonlinear(loop, LIMITS, Scenario(psi=0.1, duration=duration)),
        ):
            (own,) = step_metrics(simulated).axes.values()
            assert own.overshoot == 0 and own.peak_time is None


def test_undershoot_is_python_controls():
    """A start that moves away from the reference: as `step_info` counts it, in percent of the step."""
    loop = close_loop(design(plant(preset().parameters), PoleSet([-12, -10, -9.25, -8.76])))
    scenario = Scenario(theta=0.1, duration=4.0, samples=20_001, initial=(0.0, 0.0, -1.0, 0.0))
    response = simulate_linear(loop, scenario)
    own = step_metrics(response).axes["theta"]
    info = control.step_info(response.angles[0], response.t, final_output=0.1)
    assert own.undershoot == pytest.approx(info["Undershoot"], abs=1e-4) and own.undershoot > 10
    assert own.overshoot == pytest.approx(info["Overshoot"], abs=1e-4)


def test_what_was_given_up_is_not_said_to_grow():
    """The figures end where the simulation did, and the reply is finite."""
    report = evaluate(Spec.from_preset(poles=[-30000] * 4, reference=(0.05, None), duration=60.0))
    codes = {f.code for f in report.findings}
    assert "integration_stopped" in codes and "diverges" not in codes
    rig = report.step["nonlinear"]
    assert np.all(np.isfinite(rig.response.states)) and not rig.metrics.axes["theta"].settled
    message = next(f.message for f in report.findings if f.code == "integration_stopped")
    assert "stopped early, at t = " in message


@pytest.mark.parametrize(
    ("model", "digital"), [("linear", None), ("nonlinear", None), ("nonlinear", Digital())]
)
def test_what_grows_is_measured_until_it_leaves(model, digital):
    """Whatever the samples are."""
    spec = Spec.from_preset(poles=[5, 4, 3, 2], outer="none", reference=(0.2, 0.3))
    free = replace(spec.scenario, saturation=False, travel_stops=False, digital=digital)
    found = [evaluate(replace(spec, scenario=replace(free, samples=n))).step[model] for n in (2, 5001)]
    for step in found:
        assert [f.code for f in step.response.findings] == ["diverges"]
        own = step.metrics.axes["theta"]
        assert not own.settled
        assert own.peak_time is None or model != "linear"  # unbounded yaw may drive pitch there and back
        if own.peak_time is None:
            assert own.steady_state_error == pytest.approx(0.2 - own.peak)
    one, other = (vars(step.metrics.axes["theta"]) for step in found)
    assert one == pytest.approx(other, rel=1e-9)


@pytest.mark.parametrize("digital", [None, Digital()], ids=["continuous", "digital"])
def test_a_disturbance_does_not_count_into_a_step(digital):
    spec = Spec.from_preset(reference=(0.2, None))
    calm = replace(spec, scenario=replace(spec.scenario, digital=digital, duration=4.0))
    disturbed = replace(calm, scenario=replace(calm.scenario, disturbance=Disturbance(V_p=8.0, time=2.0)))
    own, pushed = (evaluate(each).step["nonlinear"] for each in (calm, disturbed))
    assert (
        pushed.metrics.axes == own.metrics.axes and pushed.metrics.coupling_peak == own.metrics.coupling_peak
    )
    assert np.max(pushed.response.theta) > np.max(own.response.theta) + 0.005  # it is seen, though
    assert pushed.metrics.motors["V_p"].effort > 1.5 * own.metrics.motors["V_p"].effort
    assert "disturbance_left_out" in {f.code for f in pushed.response.findings}
    assert "disturbance_left_out" not in {f.code for f in own.response.findings}


def test_a_kernels_row_has_the_registrys_columns():
    row = [float(k) for k in range(len(AXIS) - 1)]
    assert axis_figures([*row, 1.0]) == {**dict(zip(AXIS, row, strict=False)), "settled": True}
