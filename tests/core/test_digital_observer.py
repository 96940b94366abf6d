"""The digital rig with rotors and an observer within the controller: SciPy's DOP853 from sample to sample."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete

from heli2dof_core import Digital, Observer, PoleSet, Rotor, Rotors, Spec, evaluate, loop_of, simulate
from tests.core.machine_reference import MachineReference

LAG = Rotors(Rotor(0.05), Rotor(0.08))
GENTLE = {"poles": [-4, -5, -3 + 2j, -3 - 2j], "pitch": (5, 0.8), "yaw": (5, 0.8)}
SLOW = Observer(PoleSet([-20.0, -22.0, -21.0, -23.0]))


class Held(MachineReference):
    """The rig's motion under voltages that are held."""

    held = (0.0, 0.0)

    def given(self, u):
        return np.array(self.held)


def by_hand(spec, digital, count, noise):
    """Angles at the samples and voltages from each to the next, (count, 2) both; rounding, law, sums typed here."""
    loop, limits = loop_of(spec), np.array([spec.limits.V_p, spec.limits.V_y])
    rig, known, trim, origin = (
        Held(spec, loop),
        loop.estimator,
        loop.design.trim,
        np.array([spec.theta_0, 0.0]),
    )
    m, Ts = known.order, digital.sample_time
    inputs = np.hstack((known.G, known.H))
    F, G, *_ = cont2discrete((known.F, inputs, np.eye(m), np.zeros((m, 4))), Ts)

    def seen(angles):
        widths = [2 * np.pi / counts if counts else 0.0 for counts in digital.encoders]
        return np.array([w * np.floor(a / w + 0.5) if w else a for a, w in zip(angles, widths, strict=True)])

    y = np.zeros(8 + m)
    y[0] = spec.theta_0
    y[6:8] = trim
    y[8:10] = seen(y[:2]) - origin
    waiting, angles, volts = trim, [], []
    for k in range(count):
        measured = seen(y[:2] + noise[k])
        asked = rig.asked(np.concatenate((measured, y[2:])))
        fresh = np.clip(asked, -limits, limits)
        rig.held = waiting if digital.delay else fresh
        waiting = fresh
        angles.append(y[:2].copy())
        volts.append(rig.held)
        error = rig.reference - measured
        against = (fresh != asked) & (np.diag(loop.integral) * error * asked > 0)
        w, z = y[8:].copy(), y[4:6] + Ts * np.where(against, 0.0, error)
        y = solve_ivp(rig.rates, (0, Ts), y, "DOP853", rtol=1e-11, atol=1e-13).y[:, -1]
        y[4:6], y[8:] = z, F @ w + G @ np.concatenate((measured - origin, rig.held - trim))
    return np.array(angles), np.array(volts)


CASES = {
    "observer": ({**GENTLE, "observer": SLOW}, Digital(sample_time=0.01), (0, 0)),
    "curved": (
        {**GENTLE, "rotors": Rotors(Rotor(0.05, "quadratic"), Rotor(0.08)), "observer": SLOW, "theta_0": 0.2},
        Digital(sample_time=0.01, delay=True),
        (2e-4, 1e-4),
    ),
    "placed": (
        {**GENTLE, "rotors": LAG, "place_rotors": True, "observer": SLOW},
        Digital(sample_time=0.005, encoders=(0, 0)),
        (0, 0),
    ),
    "kalman": (
        {**GENTLE, "rotors": LAG, "observer": Observer(method="kalman", angle_noise=1e-3)},
        Digital(sample_time=0.02, seed=4),
        (1e-3, 5e-4),
    ),
    "limits": (
        {"rotors": LAG, "place_rotors": True, "observer": SLOW, "reference": (0.4, 1.2)},
        Digital(sample_time=0.005),
        (0, 0),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_the_digital_rig_with_an_observer_is_scipys_sample_by_sample(name):
    changes, digital, noise = CASES[name]
    count = 80
    spec = Spec.from_preset(measured="observer", **{"rotors": LAG, "reference": (0.25, 0.2), **changes})
    own = replace(
        spec.scenario,
        digital=digital,
        noise=noise,
        samples=count,
        duration=(count - 1) * digital.sample_time,
        rtol=1e-10,
    )
    spec = replace(spec, scenario=own)
    drawn = int(np.ceil(2 * own.duration / digital.sample_time)) + 2
    draws = np.array(noise) * np.random.default_rng(digital.seed).standard_normal((drawn, 2))
    found = simulate(loop_of(spec), spec, "nonlinear").response
    angles, volts = by_hand(spec, digital, count, draws)
    np.testing.assert_allclose(found.angles.T, angles, atol=1e-6)
    np.testing.assert_allclose(found.voltages.T, volts, atol=1e-5 * max(1.0, np.max(np.abs(volts))))
    assert np.ptp(angles[:, 0]) > 0.02
    assert (name == "limits") == bool(np.any(np.abs(volts) >= [spec.limits.V_p, spec.limits.V_y]))


@pytest.mark.parametrize("measured", ["states", "filtered", "observer"])
def test_noise_shows_in_the_voltages_and_repeats_with_its_seed(measured):
    base = Spec.from_preset(rotors=LAG, measured=measured, **GENTLE).changed(
        reference=(0.1, None), duration=2.0
    )

    def voltages(level, seed):
        digital = Digital(encoders=(0, 0), rates="true", seed=seed)
        return (
            evaluate(replace(base, scenario=replace(base.scenario, digital=digital, noise=(level, level))))
            .step["nonlinear"]
            .response.voltages
        )

    calm, noisy = voltages(0.0, 1), voltages(5e-4, 1)
    np.testing.assert_array_equal(noisy, voltages(5e-4, 1))
    spread = np.std(noisy - calm, axis=1)
    assert np.all(spread > 1e-3)
    assert not np.array_equal(noisy, voltages(5e-4, 2))
    np.testing.assert_allclose(
        np.std(voltages(2e-3, 1) - calm, axis=1), 4 * spread, rtol=0.1
    )  # it is linear there
