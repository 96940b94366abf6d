"""The exported C with an observer or with placed rotors, compiled and in the loop, against two others.

One is the digital rig of the kernels; the other is typed here by the definition, its observer discretized by SciPy.
"""

from __future__ import annotations

import subprocess
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.signal import cont2discrete

from heli2dof_core import AxisFriction, Friction, Observer, OuterLoop, PoleSet, Rotor, Rotors, Spec
from heli2dof_core.design import Design
from heli2dof_core.evaluate import loop_of
from heli2dof_core.export import FORMATS
from heli2dof_core.scenario import Disturbance
from heli2dof_core.simulation.digital import simulate_digital
from tests.core.test_export_c import BAD, PLAIN, STRICT, TIGHT, TIGHTER, Controller, experiment
from tests.core.test_nonlinear_response import independent_rates

SPEC = Spec.from_preset("quanser-2dof-manual")
LAG = Rotors(Rotor(0.16), Rotor(0.1))
CURVED = Rotors(Rotor(0.16, "quadratic", 1.0, 12.5), Rotor(0.1, "quadratic", 0.5))
SLOW = {"poles": PoleSet([-4, -5, -3 + 2j, -3 - 2j]), "outer": OuterLoop("none")}
KALMAN = Observer(method="kalman", voltage_noise=2.0, angle_noise=2e-4)
TRIANGULAR = Observer(PoleSet([-30 + 10j, -30 - 10j, -25, -35]), coupling="triangular", lead="yaw")
LATE = replace(PLAIN, delay=True)


def spec_of(
    measured="observer", anti_windup="clamping", digital=PLAIN, samples=301, more=None, **own
) -> Spec:
    scenario = experiment(anti_windup, digital, samples, measured=measured, **(more or {}))
    return replace(SPEC, scenario=scenario, **own)


def placed(**own) -> Spec:
    return spec_of(**{"rotors": LAG, "place_rotors": True, "rotor_poles": (-15.0, -17.0), **own})


SPECS = {
    "full-rank": spec_of(limits=TIGHT),
    "late": spec_of(limits=TIGHT, digital=LATE),
    "kalman": spec_of(limits=TIGHT, observer=KALMAN, anti_windup="back-calculation"),
    "triangular-late": spec_of(limits=TIGHT, observer=TRIANGULAR, digital=LATE, anti_windup="none"),
    "inner-alone": spec_of(rotors=LAG, **SLOW, more={"trim_feedforward": False}),
    "inner-late": spec_of(rotors=CURVED, **SLOW, digital=LATE, more={"trim_feedforward": False}),
    "six": placed(limits=TIGHT),
    "six-late": placed(limits=TIGHT, digital=LATE, anti_windup="back-calculation"),
    "six-kalman": placed(limits=TIGHT, observer=KALMAN, rotors=CURVED, digital=LATE),
    "six-disturbed": placed(
        theta_0=0.2, more={"saturation": False, "disturbance": Disturbance(1.0, -0.5, 0.1)}
    ),
    "own-integral": spec_of(limits=TIGHTER, method="lqr-integral"),
    "tachometers": placed(limits=TIGHT, measured="filtered", digital=LATE),
    "tachometers-true": placed(rotors=CURVED, measured="states", digital=replace(PLAIN, rates="true")),
    "untrimmed-tachometers": placed(measured="states", more={"trim_feedforward": False}),
}


class MachineController(Controller):
    """The exported functions; which arguments they take is the design's."""

    def __init__(self, spec: Spec, folder: Path, real: str = "double") -> None:
        super().__init__(spec, folder, real)
        self.state = (self.real * 24)(*[9.0] * 24)
        self.observes = spec.scenario.measured == "observer"
        self.rotors = spec.place_rotors and not self.observes
        self.true_rates = spec.scenario.measured == "states" and spec.scenario.digital.rates == "true"

    def sample(self, angles, rates, rotors, reference) -> np.ndarray:
        out = self.pair()
        inputs = [self.pair(angles)]
        if not self.observes:
            found = self.pair(rates)
            if not self.true_rates:
                self.library.heli2dof_rates(self.state, self.pair(angles), found)
            inputs.append(found)
        inputs += [self.pair(rotors)] * self.rotors
        self.library.heli2dof_step(self.state, *inputs, self.pair(reference), out)
        return np.array(out)


def observer_in_steps(design: Design, L: np.ndarray, Ts: float):
    """Φ and Γ for [u, y], from A, B and L by SciPy's zero-order hold."""
    A, B = design.model
    L = np.vstack([L, np.zeros((len(A) - 4, 2))])
    C = np.eye(2, len(A))
    step = cont2discrete((A - L @ C, np.hstack([B, L]), C, np.zeros((2, 4))), Ts)
    return step[0], step[1]


class Typed:
    """The digital controller of theory's sheet, anti-windup and delay included, for designs with an observer."""

    def __init__(self, spec: Spec) -> None:
        self.spec, self.loop = spec, loop_of(spec)
        self.design, self.Ts = self.loop.design, spec.scenario.digital.sample_time
        self.Phi, self.Gamma = observer_in_steps(self.design, self.loop.estimator.L, self.Ts)
        self.trim = self.design.trim
        self.fed = self.trim * spec.scenario.trim_feedforward
        self.limits = (
            np.array([spec.limits.V_p, spec.limits.V_y]) if spec.scenario.saturation else np.full(2, np.inf)
        )

    def start(self, angles) -> None:
        self.w = np.zeros(len(self.Phi))
        self.w[:2] = angles - np.array([self.spec.theta_0, 0.0])
        self.z, self.waiting = np.zeros(2), np.clip(self.fed, -self.limits, self.limits)

    def sample(self, angles, _rates, _rotors, reference) -> np.ndarray:
        loop, scenario = self.loop, self.spec.scenario
        error, y = reference - angles, angles - np.array([self.spec.theta_0, 0.0])
        asked = self.fed - self.design.K @ self.w + loop.proportional @ error
        asked = asked + loop.feedforward @ (reference - np.array([self.spec.theta_0, 0.0]))
        if loop.integral is not None:
            asked = asked + loop.integral @ self.z
        given = np.clip(asked, -self.limits, self.limits)
        told, self.waiting = (self.waiting if scenario.digital.delay else given), given
        self.w = self.Phi @ self.w + self.Gamma @ np.concatenate([told - self.trim, y])
        if loop.integral is not None:
            self.z = self.z + self.Ts * self._wound(error, asked, given)
        return given

    def _wound(self, error, asked, given):
        loop, kind = self.loop, self.spec.scenario.anti_windup
        if not self.spec.scenario.saturation or kind == "none":
            return error
        if kind == "back-calculation":
            tracking = np.diag(1.0 / loop.integral_times) @ np.linalg.inv(loop.integral)
            return error + tracking @ (given - asked)
        own = np.argmax(np.abs(loop.integral), axis=0)  # the motor that each integral drives
        winds = (given != asked)[own] & (loop.integral[own, [0, 1]] * error * asked[own] > 0)
        return np.where(winds, 0.0, error)


def in_the_loop(spec: Spec, controller) -> tuple[np.ndarray, np.ndarray]:
    """Angles and voltages at the samples: a controller around the rig with its rotors, by SciPy."""
    scenario, design = spec.scenario, loop_of(spec).design
    Ts, machine, disturbance = scenario.digital.sample_time, design.actuators, scenario.disturbance
    tau = np.zeros(2) if machine is None else machine.tau
    bounds = [spec.limits.V_p, spec.limits.V_y] if scenario.saturation else [np.inf, np.inf]
    waiting = np.clip(design.trim * scenario.trim_feedforward, -np.array(bounds), bounds)
    *reference, theta, psi, theta_dot, psi_dot = scenario.resolved(spec.theta_0)
    x, v = np.array([theta, psi, theta_dot, psi_dot]), waiting.copy()
    controller.start(x[:2])
    angles, voltages = [], []

    def thrust(v):
        if machine is None:
            return v
        square, dead = machine.square, machine.dead_zone
        return np.where(square > 0, square * np.sign(v) * np.maximum(np.abs(v) - dead, 0) ** 2, v)

    for k in range(scenario.samples):
        computed = controller.sample(x[:2], x[2:], v, np.array(reference))
        held, waiting = (waiting if scenario.digital.delay else computed), computed
        angles.append(x[:2].copy())
        voltages.append(held)
        on = disturbance is not None and k * Ts >= disturbance.time - 1e-12
        motors = held + (np.array([disturbance.V_p, disturbance.V_y]) if on else 0.0)

        def speeds(t, v=v, motors=motors):
            share = np.where(tau > 0, np.exp(-t / np.where(tau > 0, tau, 1.0)), 0.0)
            return motors + (v - motors) * share

        def rate(t, x, speeds=speeds):
            return independent_rates(spec.parameters, lambda _x: (*thrust(speeds(t)), ()))(t, x)

        x = solve_ivp(rate, (0, Ts), x, "DOP853", rtol=3e-14, atol=1e-15).y[:, -1]
        v = speeds(Ts)
    return np.array(angles), np.array(voltages)


@pytest.mark.parametrize("name", SPECS)
def test_c_in_the_loop_is_the_digital_rig(name: str, tmp_path: Path):
    spec = SPECS[name]
    own = simulate_digital(loop_of(spec), spec.limits, spec.scenario, spec.scenario.digital)
    angles, voltages = in_the_loop(spec, MachineController(spec, tmp_path))
    assert np.max(np.abs(angles - own.angles.T)) < 1e-9
    assert np.max(np.abs(voltages - own.voltages.T)) < 1e-9
    assert np.ptp(own.angles) > 0.1 and (max(own.saturated) > 0.01) == spec.scenario.saturation


OBSERVED = [
    name
    for name, spec in SPECS.items()
    if spec.scenario.measured == "observer" and spec.method == "full-rank"
]


@pytest.mark.parametrize("name", OBSERVED)
def test_c_is_the_controller_that_is_typed_here(name: str, tmp_path: Path):
    spec = SPECS[name]
    _, voltages = in_the_loop(spec, MachineController(spec, tmp_path))
    _, expected = in_the_loop(spec, Typed(spec))
    assert np.max(np.abs(voltages - expected)) < 1e-9


@pytest.mark.parametrize("name", ["full-rank", "six-late", "tachometers"])
def test_floats_do_nearly_the_same(name: str, tmp_path: Path):
    spec = SPECS[name]
    double, _ = in_the_loop(spec, MachineController(spec, tmp_path))
    single, _ = in_the_loop(spec, MachineController(spec, tmp_path, "float"))
    assert 1e-9 < np.max(np.abs(double - single)) < 1e-4


@pytest.mark.parametrize("name", SPECS)
@pytest.mark.parametrize("real", ["double", "float"])
def test_it_is_cpp_too(name: str, real: str, tmp_path: Path):
    for kind in ("c-header", "c-source"):
        (tmp_path / FORMATS[kind].filename).write_bytes(FORMATS[kind].content(SPECS[name]))
    source = tmp_path / FORMATS["c-source"].filename
    flags = [flag for flag in STRICT if not flag.startswith("-std")]
    command = [
        "c++",
        "-x",
        "c++",
        "-std=c++11",
        *flags,
        f"-DHELI2DOF_REAL={real}",
        "-fsyntax-only",
        str(source),
    ]
    subprocess.run(command, check=True)


@pytest.mark.parametrize("name", ["full-rank", "six-late", "tachometers", "inner-late"])
def test_what_is_not_read_changes_nothing(name: str, tmp_path: Path):
    """As if the last good value had been read again, of each axis by itself; rotors' speeds among them."""
    spec, rng = SPECS[name], np.random.default_rng(6)
    spoilt, whole = MachineController(spec, tmp_path), MachineController(spec, tmp_path)
    design = loop_of(spec).design
    for controller in (spoilt, whole):
        controller.start([0.1, np.nan])
    good = np.array([0.1, 0.0, 0.1, 0.0, *design.trim])
    for k in range(200):
        read = rng.normal([0, 0, 0, 0, 10, 5], 0.1)
        bad = rng.random(6) < (0.3 if k < 150 else 0.0)
        good = np.where(bad, good, read)
        read[bad] = rng.choice(BAD, int(np.sum(bad)))
        voltages = [c.sample(x[:2], (0, 0), x[4:], x[2:4]) for c, x in ((spoilt, read), (whole, good))]
        assert np.all(np.isfinite(voltages[0])) and np.all(np.isfinite(np.array(spoilt.state)))
        np.testing.assert_array_equal(*voltages)


def test_the_header_says_what_the_controller_is():
    """Observer with its poles and discretization, what it is told of the voltages, and what the functions take."""
    texts = {name: FORMATS["c-header"].render(spec) for name, spec in SPECS.items()}
    for name, text in texts.items():
        assert text.isascii() and text.count("*/") == text.count("/*")
        assert ("heli2dof_rates" in text) == (SPECS[name].scenario.measured != "observer")
        assert ("const heli2dof_real rotors[2]" in text) == ("tachometers" in name)
    texts = {name: " ".join(text.replace("\n *", " ").split()) for name, text in texts.items()}
    for said in (
        "axis-decoupled, with poles -40, -42, -41, -43 rad/s",
        "poles of A - LC: -40, -41, -42, -43 rad/s",
    ):
        assert said in texts["full-rank"]
    assert "limits, those of this sample." in texts["full-rank"] and "one sample before" in texts["late"]
    assert "Kalman filter for white noise of 2 V/sqrt(Hz)" in texts["kalman"]
    assert "theta, psi, theta_dot, psi_dot, v_p, v_y), y" in texts["six"]
    assert "(theta, psi, theta_dot, psi_dot), y" in texts["inner-late"]
    assert "Rotors: pitch lags by 0.16 s, thrust" in texts["inner-late"]
    own = loop_of(SPECS["kalman"]).estimator.poles
    assert f"{own[0].real:.6g}" in texts["kalman"]


def test_only_the_rig_differs_where_the_controller_knows_nothing_of_it():
    """Rotors and friction that a design does not know of change its file in words alone; its trim with the curve."""
    for machine in ({"rotors": LAG}, {"friction": AxisFriction(Friction(0.01), Friction(0.02, 0.03))}):
        plain, own = (FORMATS["c-source"].render(spec_of("states", **more)) for more in ({}, machine))
        code = [text[text.index("#include") :] for text in (plain, own)]
        assert code[0] == code[1] and plain != own
    assert "Friction: pitch 0.01 N m against the motion, 0.01 N m at rest; yaw 0.02" in own
