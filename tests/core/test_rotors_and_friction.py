"""Rotors that lag, thrust curves, friction and estimators in the nonlinear rig, against SciPy and laws."""

from __future__ import annotations

import os
from dataclasses import replace

import numpy as np
import pytest
from scipy.linalg import expm

import heli2dof_core as heli
from heli2dof_core import AxisFriction, Friction, PIGains, PoleSet, Rotor, Rotors, Scenario, Spec
from heli2dof_core.simulation.linear import simulate_linear
from heli2dof_core.simulation.nonlinear import NonlinearLoop, simulate_nonlinear
from tests.core.machine_reference import MachineReference

COURSES = int(os.environ.get("HELI2DOF_COURSES", "30"))
"""How many random courses; two hundred are as good as thirty, and take a minute."""
WORST = 5e-6


def random_spec(rng):
    """A rig of any kind with a loop that need not be stable, and a short experiment."""
    angle = rng.uniform(-0.3, 0.3)
    base = Spec.from_preset(rng.choice(["quanser-2dof-manual", "quanser-2dof-manual", "quanser-aero-2"]))
    lag = [0.0 if rng.random() < 0.15 else rng.uniform(0.03, 0.2) for _ in range(2)]
    place = bool(min(lag) > 0 and rng.random() < 0.3)
    quadratic = [base.parameters.m > 0 and rng.random() < 0.6 for _ in range(2)]
    rotors = [
        Rotor(
            tau,
            "quadratic" if curved else "linear",
            rng.uniform(0.2, 1.5) if curved and rng.random() < 0.7 else 0.0,
        )
        for tau, curved in zip(lag, quadratic, strict=True)
    ]
    small = 0.02 if base.parameters.m > 0 else 0.002
    friction = []
    for _ in range(2):
        coulomb = 0.0 if rng.random() < 0.3 else small * rng.uniform(0.2, 1.5)
        friction.append(Friction(coulomb, coulomb * rng.uniform(1.0, 1.8) if rng.random() < 0.7 else None))
    speed = 1.0 if base.parameters.m > 0 else 0.4
    poles = []
    for _ in range(2):
        re = -speed * rng.uniform(3, 8)
        im = speed * rng.uniform(0.5, 4)
        poles += [complex(re, im), complex(re, -im)] if rng.random() < 0.5 else [re, re * rng.uniform(1.1, 2)]
    gain = rng.uniform(2, 12)
    windup = rng.choice(["none", "back-calculation"])
    start = (angle + rng.uniform(-0.2, 0.2), rng.uniform(-0.3, 0.3), rng.uniform(-0.5, 0.5), 0.0)
    scenario = Scenario(
        theta=angle + rng.uniform(-0.3, 0.3),
        psi=rng.uniform(-0.8, 0.8),
        duration=1.2,
        samples=25,
        initial=start if rng.random() < 0.5 else (None, None, 0.0, 0.0),
        anti_windup=str(windup),
        rtol=1e-6,
        measured=str(rng.choice(["states", "states", "filtered", "observer"])),
    )
    return replace(
        base,
        theta_0=angle,
        poles=PoleSet(poles),
        structure=heli.Structure(str(rng.choice(["triangular", "input-diagonal", "axis-decoupled"]))),
        outer=heli.OuterLoop("pi" if rng.random() < 0.8 else "none", PIGains(gain, 0.4), PIGains(gain, 0.5)),
        rotors=Rotors(*rotors),
        friction=AxisFriction(*friction),
        place_rotors=place,
        rotor_poles=(-rng.uniform(6, 15), -rng.uniform(6, 15)),
        scenario=scenario,
        observer=heli.Observer(PoleSet([-20.0, -24.0, -22.0, -26.0])),
        limits=replace(base.limits, theta=rng.uniform(0.25, 0.7)),
    )


def both(spec):
    """The same experiment here and by SciPy: states (4, samples), and how many switches SciPy saw."""
    loop = heli.loop_of(spec)
    system = NonlinearLoop.of(loop, spec.limits, spec.scenario)
    own = simulate_nonlinear(loop, spec.limits, spec.scenario)
    windup = spec.scenario.anti_windup == "back-calculation" and loop.has_integrators
    travel = spec.limits.theta if spec.limits.theta is not None else np.inf
    reference = MachineReference(
        spec,
        loop,
        (spec.limits.V_p, spec.limits.V_y),
        travel,
        tracking=system.constants[29:33].reshape(2, 2) if windup else None,
    )
    y = system.start.copy()
    if loop.estimator is None:
        y = y[:8]
    elif loop.estimator.order == 4:
        y = y[:12]
    expected, events = reference.course(y, own.t)
    return own, expected, events


def test_random_courses_are_scipys():
    """Lag, curves, dead zones, friction, limits, stops, anti-windup and estimators, every switch located."""
    rng, worst, seen, done = np.random.default_rng(17), [], 0, 0
    while done < COURSES:
        spec = random_spec(rng)
        if spec.actuators is None or spec.actuators.slope.min() == 0:
            continue
        own, expected, events = both(spec)
        if expected is None or np.max(np.abs(expected[:2])) > 20:
            continue  # hunts without end, or runs away: errors grow with it
        done += 1
        seen += events
        worst.append(np.max(np.abs(own.angles - expected[:2])))
    print(f"worst {max(worst):.2e}, median {np.median(worst):.2e}, {seen} switches in {done} courses")
    assert seen > 2 * done
    assert max(worst) <= WORST


def energy(p, states):
    """Kinetic and potential, J."""
    theta, _, theta_dot, psi_dot = states[:4]
    ml2 = p.m * p.l**2
    kinetic = 0.5 * (p.J_p + ml2) * theta_dot**2 + 0.5 * (p.J_y + ml2 * np.cos(theta) ** 2) * psi_dot**2
    return kinetic + p.m * p.g * p.l * np.sin(theta) + 0.5 * p.K_s * theta**2


@pytest.mark.parametrize("lag", [0.0, 0.15])
def test_energy_never_grows_without_input(lag):
    """Motors that have next to no thrust; friction, damping and stops only take."""
    spec = Spec.from_preset()
    weak = spec.changed(
        parameters={
            "K_pp": 1e-7,
            "K_yy": 1e-7,
            "K_py": 0.0,
            "K_yp": 0.0,
            "B_p": 0.02,
            "B_y": 0.01,
            "K_s": 2.0,
        },
        rotors=Rotors(Rotor(lag), Rotor(lag)),
        friction=AxisFriction(Friction(0.03, 0.05), Friction(0.05, 0.06)),
    )
    scenario = Scenario(
        initial=(-0.6, 0.0, 1.0, 3.0), duration=8.0, samples=4001, rtol=1e-9, trim_feedforward=False
    )
    weak = replace(weak, scenario=scenario, limits=heli.Limits(V_p=1e-3, V_y=1e-3))
    states = simulate_nonlinear(heli.loop_of(weak), weak.limits, scenario).states
    total = energy(weak.parameters, states)
    assert np.max(np.diff(total)) < 1e-9
    assert total[0] - total[-1] > 0.1
    assert states[2, -1] == states[3, -1] == 0.0  # friction has stopped it for good


def test_standstill_is_a_standstill():
    """Within stiction nothing moves, not by the last digit; beyond it does."""
    held = Spec.from_preset(outer="none").changed(
        friction=AxisFriction(Friction(0.1, 0.2), Friction(0.1, 0.2)), reference=(0.001, 0.001)
    )
    response = simulate_nonlinear(heli.loop_of(held), held.limits, held.scenario)
    assert np.all(response.angles == response.angles[:, :1]) and np.all(response.states[2:4] == 0.0)
    moved = held.changed(reference=(0.1, 0.1))
    assert np.ptp(simulate_nonlinear(heli.loop_of(moved), moved.limits, moved.scenario).angles[0]) > 0.05


def test_rotors_that_hardly_lag_are_the_papers():
    """τ → 0: the difference shrinks with τ."""
    spec = Spec.from_preset()
    own = simulate_nonlinear(heli.loop_of(spec), spec.limits, spec.scenario)
    gaps = []
    for tau in (1e-3, 1e-4, 1e-5):
        lagged = spec.changed(rotors=Rotors(Rotor(tau), Rotor(tau)))
        gaps.append(
            np.max(
                np.abs(
                    simulate_nonlinear(heli.loop_of(lagged), spec.limits, spec.scenario).angles - own.angles
                )
            )
        )
    assert gaps[0] < 0.02 and gaps[1] < 0.11 * gaps[0] and gaps[2] < 0.11 * gaps[1]


@pytest.mark.parametrize("measured", ["states", "filtered", "observer"])
@pytest.mark.parametrize("place", [False, True])
def test_linear_course_is_the_matrix_exponential(measured, place):
    spec = Spec.from_preset().changed(
        rotors=Rotors(Rotor(0.08), Rotor(0.05)), place_rotors=place, measured=measured, reference=(0.2, 0.4)
    )
    loop = heli.loop_of(spec)
    response = simulate_linear(loop, spec.scenario)
    n, r = len(loop.A), np.array([0.2, 0.4])
    whole = np.zeros((n + 1, n + 1))
    whole[:n, :n], whole[:n, n] = loop.A, loop.B @ r
    start = np.zeros(n + 1)
    start[n] = 1.0
    for k in (1, 100, 500):
        expected = (expm(whole * response.t[k]) @ start)[:n]
        np.testing.assert_allclose(response.states[:, k], expected, atol=1e-11)
        volts = loop.voltage_from_state @ expected + loop.voltage_from_reference @ r
        np.testing.assert_allclose(response.voltages[:, k], volts, atol=1e-9)
