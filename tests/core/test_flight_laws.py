"""Flights held to the laws of mechanics: energy, angular momentum, and the work of all that acts."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import heli2dof_core as heli
from heli2dof_core.flight import Rig
from heli2dof_core.kernels.flight_layout import OUTSIDE, SPEED, STATE, VOLTAGE

GRAVITY = 9.81
RATES = slice(STATE + 2, STATE + 4)


def free_rig(preset: str, *, damped: bool = False, stops: bool = False, **changes) -> Rig:
    """A rig in hand with its motors off, thrown about both axes: nothing but gravity acts on it."""
    spec = heli.Spec.from_preset(preset)
    spec = spec.changed(parameters={} if damped else {"B_p": 0.0, "B_y": 0.0}, **changes)
    spec = replace(
        spec,
        friction=heli.AxisFriction(),
        scenario=replace(
            spec.scenario, initial=(0.3, -0.2, 1.1, 2.3), travel_stops=stops, digital=None, noise=(0.0, 0.0)
        ),
    )
    rig = Rig(spec)
    rig.do("hands", 1)
    rig.do("sticks", 0.0, 0.0)
    return rig


def inertias(rig: Rig, theta, hung: tuple[float, float] = (0.0, 0.0)):
    """About pitch's axis and, at θ, about yaw's, kg·m²."""
    p, (mass, arm) = rig.controller.spec.parameters, hung
    ml2 = p.m * p.l**2 + mass * arm**2
    return p.J_p + ml2, p.J_y + ml2 * np.cos(theta) ** 2


def energy(rig: Rig, rows: np.ndarray, hung: tuple[float, float] = (0.0, 0.0)) -> np.ndarray:
    """Of motion, of height and of the spring, J."""
    p, (mass, arm) = rig.controller.spec.parameters, hung
    theta, rates = rows[:, STATE], rows[:, RATES]
    about_pitch, about_yaw = inertias(rig, theta, hung)
    height = p.m * p.g * p.l + mass * GRAVITY * arm
    motion = about_pitch * rates[:, 0] ** 2 + about_yaw * rates[:, 1] ** 2
    return 0.5 * motion + height * np.sin(theta) + 0.5 * p.K_s * theta**2


@pytest.mark.parametrize("preset", list(heli.PRESETS))
def test_energy_stays_where_nothing_acts_and_nothing_damps(preset):
    rig = free_rig(preset)
    found = energy(rig, rig.fly(10.0).rows)
    assert np.ptp(found) <= 1e-8 * np.abs(found).max()


def test_a_mass_hung_on_moves_by_the_same_law():
    rig, hung = free_rig("quanser-2dof-manual"), (0.25, -0.15)
    rig.do("hung", *hung)
    rows = rig.fly(10.0).rows
    found, without = energy(rig, rows, hung), energy(rig, rows)
    assert np.ptp(found) <= 1e-8 * np.abs(found).max()
    assert np.ptp(without) > 1e-2 * np.abs(without).max()  # the law sees the mass


def test_what_pitch_does_leaves_the_angular_momentum_about_yaw():
    rig = free_rig("quanser-2dof-manual")
    stretches = []
    for torque in (0.0, 0.4, -0.7, 1.1):
        rig.do("push", torque, 0.0)
        stretches.append(rig.fly(1.0).rows)
    rows = np.concatenate(stretches)
    momentum = inertias(rig, rows[:, STATE])[1] * rows[:, STATE + 3]
    assert np.ptp(momentum) <= 1e-9 * np.abs(momentum).max()
    assert np.ptp(rows[:, STATE + 3]) > 0.1  # the rate itself does change


def test_angular_momentum_grows_by_the_torques_of_hands_and_gusts():
    rig = free_rig("quanser-2dof-manual")
    rig.do("push", 0.1, 0.05)
    rig.do("gust", 0.0, -0.3, 400)
    rows = np.concatenate((rig.fly(1.5).rows, rig.row()[None]))
    momentum = inertias(rig, rows[:, STATE])[1] * rows[:, STATE + 3]
    impulse = np.cumsum(rows[:-1, OUTSIDE + 1]) * rig.controller.tick
    np.testing.assert_allclose(momentum[1:] - momentum[0], impulse, atol=1e-9)
    # (1 − cos)/2 has half its height on average: the gust's whole impulse
    assert impulse[-1] == pytest.approx(0.05 * 1.5 - 0.5 * 0.3 * 400 * rig.controller.tick, abs=1e-9)


@pytest.mark.parametrize("thrust", [(1.0, 1.0), (0.6, 1.3)])
def test_what_motors_and_hands_put_in_is_stored_or_damped(thrust):
    """The balance of energy: torques are constant within a tick, so that their work is torque by angle."""
    rig = free_rig("quanser-2dof-manual", damped=True)
    p = rig.controller.spec.parameters
    rig.do("thrust", *thrust)
    rng, stretches = np.random.default_rng(3), []
    for _ in range(12):
        rig.do("sticks", *rng.uniform(-8, 8, 2))
        rig.do("push", *rng.uniform(-0.2, 0.2, 2))
        rig.do("gust", *rng.uniform(-0.3, 0.3, 2), 150)
        stretches.append(rig.fly(0.4).rows)
    rows = np.concatenate((*stretches, rig.row()[None]))
    own = rows[:-1, SPEED : SPEED + 2] * thrust
    np.testing.assert_array_equal(rows[:-1, SPEED : SPEED + 2], rows[:-1, VOLTAGE : VOLTAGE + 2])
    K = np.array([[p.K_pp, p.K_py], [p.K_yp, p.K_yy]])
    torques = own @ K.T + rows[:-1, OUTSIDE : OUTSIDE + 2]
    work = (torques * np.diff(rows[:, STATE : STATE + 2], axis=0)).sum()
    power = rows[:, RATES] ** 2 @ np.array([p.B_p, p.B_y])
    damped = 0.5 * (power[1:] + power[:-1]).sum() * rig.controller.tick  # by the trapezoidal rule
    stored = np.diff(energy(rig, rows)[[0, -1]])[0]
    assert abs(work) > 0.1
    assert stored == pytest.approx(work - damped, abs=2e-5 * (abs(work) + damped))


def test_a_stop_takes_energy_and_never_gives_any():
    rig = free_rig("quanser-2dof-manual", stops=True)
    rows = rig.fly(10.0).rows
    found, travel = energy(rig, rows), rig.controller.spec.limits.theta
    assert travel is not None and np.abs(rows[:, STATE]).max() == pytest.approx(travel)
    assert np.diff(found).max() <= 1e-9 * np.abs(found).max()
    assert found[-1] < found[0] - 0.1
