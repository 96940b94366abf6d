"""Recordings that the digital rig makes, with rotors, friction and estimators, and where stretches of them begin."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heli2dof_core import loop_of
from heli2dof_core.compiled import accelerations
from heli2dof_core.errors import CancelledError
from heli2dof_core.export import FORMATS
from heli2dof_core.recordings.beginnings import beginnings
from heli2dof_core.recordings.files import read_table
from heli2dof_core.recordings.guess import guess_columns
from heli2dof_core.recordings.overlay import driven_by_references, driven_by_voltages, driven_in_segments
from heli2dof_core.recordings.recording import Recording, recording_of
from heli2dof_core.recordings.samples import sample_recording
from heli2dof_core.request import spec_of
from heli2dof_core.rotors import AxisFriction, Friction
from heli2dof_core.scenario import Digital
from heli2dof_core.simulation.augmented import sampled_estimator
from heli2dof_core.simulation.digital import settings_of, simulate_digital, standing_voltages
from heli2dof_core.simulation.nonlinear import NonlinearLoop
from heli2dof_core.simulation.recorded import RTOL, run_recorder, turning
from heli2dof_core.simulation.sampled import run_sampled
from tests.bench.actuated import Actuated, made

LAG = {"pitch": {"tau": 0.16}, "yaw": {"tau": 0.12}}
CURVED = {"pitch": {"tau": 0.1, "curve": "quadratic", "dead_zone": 0.5}, "yaw": {"tau": 0.12}}
PI = {"kp": 4, "ti": 1.5}
CALM = {"poles": [-2.5, -3, -3.5, -4], "loops": {"pitch": PI, "yaw": PI}}
RUBS = {"pitch": {"coulomb": 0.02}, "yaw": {"coulomb": 0.02, "static": 0.03}}
KINDS = {
    "lag": {**CALM, "rotors": LAG},
    "lag of one, friction": {**CALM, "rotors": {"yaw": {"tau": 0.12}}, "friction": RUBS},
    "curved, placed, observed": {
        "rotors": CURVED,
        "place_rotors": True,
        "scenario": {"measured": "observer"},
    },
    "filtered": {"scenario": {"measured": "filtered"}},
}
CONTROLLERS = {
    "the rig's own": Digital(sample_time=0.004),
    "late": Digital(sample_time=0.01, delay=True, encoders=(0, 0), rates="true"),
}


def two(spec, theta=0.1, psi=0.3, count=301):
    return np.tile([spec.theta_0 + theta, psi], (count, 1))


@pytest.mark.parametrize("controller", CONTROLLERS)
@pytest.mark.parametrize("kind", KINDS)
def test_under_constant_references_it_is_the_step_response(kind, controller):
    spec, digital = spec_of(KINDS[kind]), CONTROLLERS[controller]
    references, h = two(spec), digital.sample_time
    scenario = replace(
        spec.scenario,
        theta=references[0, 0],
        psi=references[0, 1],
        duration=300 * h,
        samples=301,
        rtol=RTOL,
    )
    loop = loop_of(replace(spec, scenario=scenario))
    run = run_recorder(loop, spec.limits, digital, references)
    step = simulate_digital(loop, spec.limits, scenario, digital)
    assert run.done == 301
    np.testing.assert_allclose(run.states[:, :2].T, step.angles, atol=1e-5)
    np.testing.assert_allclose(run.voltages[:-1].T, step.voltages[:, :-1], atol=2e-3)
    if step.rotors is not None:
        np.testing.assert_allclose(run.states[:-1, 6:8].T, step.rotors[:, :-1], atol=2e-3)


def test_the_papers_size_runs_alike_in_both_ways():
    """Changing references, encoders, noise, delay; one reads the kernels' lines, the other has them compiled."""
    spec = spec_of({})
    loop, digital = loop_of(spec), Digital(sample_time=0.004, delay=True, noise=1e-3, seed=4)
    references = two(spec)
    references[100:] += [0.1, -0.2]
    references[200:] -= [0.3, 0.1]
    run = run_recorder(loop, spec.limits, digital, references)
    system = NonlinearLoop.of(loop, spec.limits, replace(spec.scenario, theta=0.0, psi=0.0))
    offsets = system.offset + references @ loop.voltage_from_reference.T
    noise = 1e-3 * np.random.default_rng(4).standard_normal((301, 2))
    done, measured, states, voltages = run_sampled(
        loop,
        system,
        system.start.copy(),
        settings=settings_of(digital, standing_voltages(loop, system)),
        noise=noise,
        references=references,
        offsets=offsets,
        rtol=RTOL,
        wanted=lambda: None,
    )
    assert done == 301
    np.testing.assert_array_equal(measured, run.measured)
    np.testing.assert_allclose(states, run.states, rtol=0, atol=1e-11)
    np.testing.assert_allclose(voltages, run.voltages, rtol=0, atol=1e-9)


@pytest.mark.parametrize("kind", ["lag", "curved, placed, observed"])
def test_between_samples_the_rig_is_scipys(kind):
    """Rotors and axes under the voltages that a run says; the observer's estimate by its own equation."""
    spec = spec_of(KINDS[kind])
    loop, digital = loop_of(spec), replace(CONTROLLERS["late"], delay=False)
    references = two(spec)
    references[100:] += [0.05, -0.2]
    run = run_recorder(loop, spec.limits, digital, references)
    machine, numbers = loop.actuators, [*spec.parameters.as_dict().values()]
    assert np.ptp(run.voltages[:, 1]) > 1.0

    def rates(t, y, V):
        v = y[4:]
        beyond = np.maximum(np.abs(v) - machine.dead_zone, 0.0)
        thrust = np.where(machine.square > 0, machine.square * np.sign(v) * beyond**2, v)
        return [y[2], y[3], *accelerations()(y[0], y[2], y[3], *thrust, *numbers), *((V - v) / machine.tau)]

    own = run.states[:, [0, 1, 2, 3, 6, 7]]
    for k in range(0, 300, 7):
        end = solve_ivp(
            rates, (0, 0.01), own[k], args=(run.voltages[k],), rtol=1e-10, atol=1e-12, max_step=0.002
        )
        np.testing.assert_allclose(own[k + 1], end.y[:, -1], atol=2e-6)
    if loop.estimator is not None:
        rows, w = sampled_estimator(loop, 0.01), run.states[:, 8:14]
        known = np.hstack((w, run.measured, run.voltages)) @ rows[:, :10].T + rows[:, 10]
        np.testing.assert_allclose(w[1:], known[:-1], atol=1e-9)


def test_who_does_not_wait_for_it_ends_it():
    def leave():
        raise CancelledError("gone")

    spec = spec_of(KINDS["lag"])
    about = {"rig": spec.parameters, "duration": 4.0, "size": (0.1, 0.2)}
    with pytest.raises(CancelledError):
        sample_recording(loop_of(spec), spec.limits, Digital(), **about, wanted=leave)


STEP = {"samples": 2001, "reference": {"theta": 0.1, "psi": 0.3}}
EXPORTED = {
    "lag": {**CALM, "rotors": LAG, "scenario": STEP},
    "filtered": {**CALM, "rotors": LAG, "scenario": {**STEP, "measured": "filtered"}},
    "friction": {**CALM, "rotors": LAG, "friction": RUBS, "scenario": STEP},
    "Aero, placed": {
        "preset": "quanser-aero-2",
        "rotors": {"pitch": {"tau": 0.156}, "yaw": {"tau": 0.169}},
        "place_rotors": True,
        "scenario": {"samples": 2001},
    },
}


def exported(spec):
    table = read_table(FORMATS["csv"].render(spec).encode(), "step.csv")
    return recording_of(table, guess_columns(table))


def machine_of(spec):
    limits = (spec.limits.V_p, spec.limits.V_y)
    return {"rotors": spec.rotors, "friction": spec.friction, "theta_0": spec.theta_0, "limits": limits}


@pytest.mark.parametrize("kind", EXPORTED)
def test_an_exported_step_is_what_the_rotors_made_of_it(kind):
    """They turn as the trim holds them while the first voltages are already the step's."""
    spec = spec_of(EXPORTED[kind])
    recording, machine = exported(spec), machine_of(spec)
    bounds = np.array([[0, len(recording.t)]])
    assert spec.actuators is not None
    _, away = beginnings(spec.parameters, recording, bounds, spec.actuators.constants)
    np.testing.assert_allclose(away[0] + recording.voltages[0], spec.actuators.trim, atol=1.0)
    assert np.max(np.abs(away)) > 1.0
    rig = spec.parameters, recording
    assert min(driven_in_segments(*rig, None, None, **machine).fit) > 99.5
    assert np.all(np.isfinite(driven_in_segments(*rig, None, None, **machine).angles))
    assert min(driven_by_voltages(*rig, None, **machine).fit) > 99.0
    assert min(driven_by_references(loop_of(spec), spec.limits, recording).fit) > 97.0


def test_what_rotors_did_before_is_found_where_a_recording_begins_in_motion():
    truth, whole = made(Actuated(duration=12.0), 6)
    acting = np.zeros(10)
    acting[:2] = [own.tau for own in truth.rotors.both]
    acting[6:8] = acting[8:] = [own.coulomb for own in truth.friction.both]
    speeds = turning(acting, np.array([[0, len(whole.t)]]), whole.t, whole.voltages).speeds
    for first in range(400, 2400, 400):
        part = Recording(whole.t[first:] - whole.t[first], whole.angles[first:], whole.voltages[first:])
        _, away = beginnings(truth.parameters, part, np.array([[0, len(part.t)]]), acting)
        right = speeds[first] - whole.voltages[first]
        assert abs(away[0, 0] - right[0]) < 0.1 and abs(away[0, 1] - right[1]) < 0.4
    known = {"rotors": truth.rotors, "friction": truth.friction}
    assert max(driven_in_segments(truth.parameters, part, **known).rms) < 1.2e-3


def test_what_does_not_show_is_taken_for_settled():
    """No thrust, an axis that sticks, a stretch of few rows, rotors that follow at once."""
    spec = spec_of(EXPORTED["lag"])
    recording = exported(spec)
    assert spec.actuators is not None
    bounds, acting = np.array([[0, len(recording.t)]]), spec.actuators.constants
    weak = spec.parameters.replaced(dict.fromkeys(("K_pp", "K_py", "K_yp", "K_yy"), 1e-09))
    np.testing.assert_allclose(beginnings(weak, recording, bounds, acting)[1], 0.0, atol=1e-3)
    stuck = acting.copy()
    stuck[6:] = 50.0
    np.testing.assert_allclose(beginnings(spec.parameters, recording, bounds, stuck)[1], 0.0, atol=1e-3)
    few = np.array([[0, 8], [8, len(recording.t)]])
    assert not beginnings(spec.parameters, recording, few, acting)[1][0].any()
    rubs = spec_of({"friction": RUBS}).actuators
    assert rubs is not None
    assert not beginnings(spec.parameters, recording, bounds, rubs.constants)[1].any()
    one = AxisFriction(Friction(0.01))
    assert driven_by_voltages(spec.parameters, recording, friction=one).angles.shape == recording.angles.shape
