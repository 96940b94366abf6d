"""Recordings with rotors and friction: courses against SciPy's, derivatives, and what identification finds."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heli2dof_core import preset
from heli2dof_core.compiled import accelerations
from heli2dof_core.errors import InvalidInputError, RecordingError
from heli2dof_core.recordings.acting import acting_of, matched
from heli2dof_core.recordings.identification import ACTUATORS, FREE, IDENTIFIABLE, INERTIAS, identify
from heli2dof_core.recordings.overlay import driven_by_voltages, driven_in_segments
from heli2dof_core.rotors import AxisFriction, Friction, Rotor, Rotors
from heli2dof_core.simulation.recorded import run_held, run_segments, turning
from tests.bench.actuated import AERO, Actuated, found, made

RIG = preset().parameters
SHORT = Actuated(duration=8.0)
STEP, ROWS = 0.01, 300
TIMES = STEP * np.arange(ROWS)
VOLTS = np.column_stack([12.5 + 4 * np.sign(np.sin(3 * TIMES)), -3.8 + 4 * np.sign(np.sin(2.2 * TIMES + 1))])
VOLTS[100:200] = 12.535, -3.813  # the trim: both axes come to rest where they rub
WHOLE = np.array([[0, ROWS]])


def constants(tau, dead=(0.0, 0.0), square=(0.0, 0.0), coulomb=(0.0, 0.0), static=(0.0, 0.0)):
    return np.concatenate([tau, dead, square, coulomb, np.maximum(coulomb, static)])


KINDS = {
    "lag": constants((0.16, 0.12)),
    "one lags": constants((0.0, 0.12), coulomb=(0.0, 0.1)),
    "friction": constants((0.16, 0.12), coulomb=(0.2, 0.1)),
    "curved, friction": constants((0.16, 0.12), (1.0, 0.5), (0.09, 0.2), (0.1, 0.05)),
    "stiction": constants((0.16, 0.12), coulomb=(0.2, 0.1), static=(0.3, 0.16)),
}


def by_scipy(c, start):
    """From event to event: an axis slips until its rate is 0, and rests until its torque is F_s."""
    tau, dead, square, coulomb, breakaway = c.reshape(5, 2)
    inertia = [RIG.alpha, RIG.J_y]
    v, x, states = VOLTS[0].copy(), np.array(start, dtype=float), []

    def free(t, x, u, v):
        speeds = np.where(tau > 0, u + (v - u) * np.exp(-t / np.maximum(tau, 1e-9)), u)
        curved = square * np.sign(speeds) * np.maximum(np.abs(speeds) - dead, 0) ** 2
        thrusts = np.where(square > 0, curved, speeds)
        return np.array(accelerations()(x[0], x[2], x[3], *thrusts, *RIG.as_dict().values()))

    def inertias(x):
        return np.array([inertia[0], inertia[1] + RIG.m * (RIG.l * np.cos(x[0])) ** 2])

    for u in VOLTS:
        states.append(x.copy())
        t = 0.0
        while t < STEP - 1e-13:
            torque = free(t, x, u, v) * inertias(x)
            still = np.abs(x[2:]) < 1e-12
            stuck = still & (np.abs(torque) <= breakaway * (1 + 1e-9)) & (breakaway > 0)
            side = np.where(stuck, 0.0, np.where(still, np.sign(torque), np.sign(x[2:])))

            def rates(t, x, u=u, v=v, side=side, stuck=stuck):
                a = free(t, x, u, v) - side * coulomb / inertias(x)
                return np.concatenate([np.where(stuck, 0, x[2:]), np.where(stuck, 0, a)])

            def turns(i, u=u, v=v, side=side, stuck=stuck):
                def event(time, y):
                    if stuck[i]:
                        return breakaway[i] * (1 + 2e-9) - abs(free(time, y, u, v)[i] * inertias(y)[i])
                    return y[2 + i] * side[i] + 1e-13

                event.terminal, event.direction = True, -1
                return event

            events = [turns(i) for i in range(2) if breakaway[i] > 0]
            run = solve_ivp(rates, (t, STEP), x, rtol=1e-10, atol=1e-13, events=events or None)
            t, x = run.t[-1], run.y[:, -1].copy()
            x[2:] = np.where((np.abs(x[2:]) < 1e-9) & (breakaway > 0), 0.0, x[2:])
        v = np.where(tau > 0, u + (v - u) * np.exp(-STEP / np.maximum(tau, 1e-9)), u)
    return np.array(states)


@pytest.mark.parametrize("kind", KINDS)
def test_courses_are_scipys(kind):
    """Turning round, sticking and breaking away included."""
    start = [0.0, 0.0, 0.3, -0.4]
    turned = turning(KINDS[kind], WHOLE, TIMES, VOLTS)
    own, theirs = (
        run_held(RIG, np.array(start), TIMES, VOLTS, None, rotors=turned),
        by_scipy(KINDS[kind], start),
    )
    np.testing.assert_allclose(own, theirs, atol=2e-6)
    if kind in ("friction", "stiction"):
        assert np.sum(own[:, 3] == 0.0) > 5  # it did stick


@pytest.mark.parametrize("kind", KINDS)
def test_sensitivities_are_derivatives(kind):
    """By starting states, parameters, τ and F_c, across all that friction does; rotors' chain included."""
    start, bounds = np.array([[0, 0, 0.3, -0.4]]), np.array([[50, 250]])

    def angles(deltas):
        p, c = SimpleNamespace(**RIG.as_dict(), alpha=RIG.alpha), KINDS[kind].copy()
        for name, delta in zip(IDENTIFIABLE, deltas[4:11], strict=True):
            setattr(p, name, getattr(p, name) + delta)
        c[:2] += deltas[11:13] * (c[:2] > 0)
        c[6:8] += deltas[13:]
        c[8:] = np.where(KINDS[kind][8:] > KINDS[kind][6:8], KINDS[kind][8:], c[6:8])
        turned = turning(c, WHOLE, TIMES, VOLTS)
        return run_segments(p, start + deltas[:4], bounds, TIMES, VOLTS, step=0.002, rotors=turned)

    slopes = angles(np.zeros(15))[1]
    for i in range(15):
        step = 1e-6 * np.eye(15)[i]
        if i >= 13 and KINDS[kind][i - 7] == 0.0:
            continue  # friction that is not there has no derivative to either side
        numeric = (angles(step)[0] - angles(-step)[0]) / 2e-6
        np.testing.assert_allclose(slopes[:, :, i], numeric, atol=2e-4 * np.max(np.abs(numeric)) + 1e-9)


def test_without_lag_and_friction_it_is_the_plain_rig():
    start, bounds = np.array([[0.1, 0.2, 0.3, -0.4]]), np.array([[0, 200]])
    turned = turning(np.zeros(10), WHOLE, TIMES, VOLTS)
    plain = run_segments(RIG, start, bounds, TIMES, VOLTS, step=0.002)
    other = run_segments(RIG, start, bounds, TIMES, VOLTS, step=0.002, rotors=turned)
    np.testing.assert_allclose(other[0], plain[0], atol=1e-9)
    np.testing.assert_allclose(other[1][:, :, :11], plain[1], atol=1e-7 * np.max(np.abs(plain[1])))


def test_the_truth_lies_near_as_the_intervals_say():
    """Nothing but the data sheet known; how often it lies inside is counted by the bench."""
    for case, seed in ((SHORT, 3), (replace(AERO, duration=16.0), 1)):
        truth, result = found(case, seed)
        assert {e.name for e in result.estimates} >= set(ACTUATORS)
        for e in result.estimates:
            half = (e.high - e.low) / 2
            assert abs(e.value - truth.of(e.name)) < 3 * half + 1e-9
            assert half < 0.2 * abs(truth.of(e.name)), e
        for name in ACTUATORS:
            kind, axis, quantity = name.split(".")
            own = {e.name: e.allowed for e in result.estimates}[name]
            assert getattr(getattr(getattr(result, kind), axis), quantity) == own


def test_what_is_not_free_stays_and_is_simulated():
    truth, recording = made(SHORT, 4)
    p = truth.parameters
    result = identify(p, recording, ["K_pp"], truth.rotors, truth.friction)
    assert [e.name for e in result.estimates] == ["K_pp"]
    assert (result.rotors, result.friction) == (truth.rotors, truth.friction)
    known = {"rotors": truth.rotors, "friction": truth.friction}
    right, wrong = driven_in_segments(p, recording, **known), driven_in_segments(p, recording)
    assert max(right.rms) < 1.2e-3 < max(wrong.rms)
    in_one = driven_by_voltages(p, recording, **known), driven_by_voltages(p, recording)
    assert in_one[0].rms[1] < 0.2 * in_one[1].rms[1]


def test_lag_that_a_recording_cannot_tell_is_told():
    """Too slow a sampling; and a motor that hardly moves."""
    truth, recording = made(replace(SHORT, tau=(0.008, 0.01), sample_time=0.02), 1)
    free = ["rotors.pitch.tau", "rotors.yaw.tau"]
    result = identify(truth.parameters, recording, free, friction=truth.friction)
    assert "tau_unresolved" in {f.code for f in result.findings}
    truth, recording = made(SHORT, 5)
    still = replace(recording, voltages=np.tile(recording.voltages[0], (len(recording.t), 1)))
    with pytest.raises(RecordingError, match=r"nothing about rotors\.pitch\.tau"):
        identify(truth.parameters, still, ["rotors.pitch.tau"])
    with pytest.raises(InvalidInputError, match=r"rotors\.pitch\.lag"):
        identify(truth.parameters, recording, ["rotors.pitch.lag"])
    assert (*IDENTIFIABLE, *ACTUATORS, *INERTIAS) == FREE


def test_rotors_forget_how_they_began():
    """A recording that begins with rotors at rest under the trim's voltages: the run-up is left out."""
    truth, recording = made(Actuated(duration=10.0), 6)
    late = slice(400, None)  # in the middle of a motion: the rotors are not settled
    part = replace(
        recording,
        t=recording.t[late] - recording.t[400],
        angles=recording.angles[late],
        voltages=recording.voltages[late],
    )
    result = identify(truth.parameters, part, ["rotors.pitch.tau", "rotors.yaw.tau"], friction=truth.friction)
    assert result.segments[0, 0] * 0.004 > 0.5
    for e in result.estimates:
        assert abs(e.value - truth.of(e.name)) < 3 * e.noise


def test_curves_keep_the_point_where_they_are_matched():
    """By the trim of the rig as it was thought to be; a motor that rests there needs its limit."""
    rotors = Rotors(Rotor(0.1, "quadratic", 1.0), Rotor(0.1, "quadratic", 0.5))
    acting = acting_of(RIG, rotors, AxisFriction())
    assert acting is not None
    again = acting_of(RIG.replaced({"K_pp": 0.3}), matched(rotors, acting), AxisFriction(Friction(0.01)))
    assert again is not None
    np.testing.assert_allclose(again[:6], acting[:6], rtol=1e-12)
    aero = preset("quanser-aero-2").parameters
    with pytest.raises(InvalidInputError, match="matched"):
        acting_of(aero, rotors, AxisFriction())
    assert acting_of(aero, rotors, AxisFriction(), limits=(18.0, 18.0)) is not None
    assert acting_of(aero, Rotors(), AxisFriction()) is None
