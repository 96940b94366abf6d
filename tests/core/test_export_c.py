"""The exported C, compiled and in the loop, against the digital rig."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from heli2dof_core import Limits, OuterLoop, PIGains, Scenario, Spec, close_loop, place, preset
from heli2dof_core.export import FORMATS
from heli2dof_core.scenario import Digital
from heli2dof_core.simulation.digital import simulate_digital
from tests.core.test_nonlinear_response import independent_rates

STRICT = [
    "-std=c99",
    "-pedantic",
    "-Wall",
    "-Wextra",
    "-Werror",
    "-Wconversion",
    "-Wshadow",
    "-Wdouble-promotion",
]
SPEC = Spec.from_preset(preset())
PLAIN = Digital(0.002, encoders=(0, 0))
TIGHT = Limits(18.0, 6.0, 0.7)
TIGHTER = Limits(13.5, 4.2, 0.7)


class Controller:
    """The exported functions, called through ctypes."""

    def __init__(self, spec: Spec, folder: Path, real: str = "double") -> None:
        compiler = shutil.which("cc")
        assert compiler, "the tests need a C compiler"
        for name in ("c-header", "c-source"):
            (folder / FORMATS[name].filename).write_bytes(FORMATS[name].content(spec))
        library = folder / f"controller_{real}.so"
        source = folder / FORMATS["c-source"].filename
        flags = [*STRICT, f"-DHELI2DOF_REAL={real}", "-O2", "-ffp-contract=off", "-shared", "-fPIC"]
        subprocess.run([compiler, *flags, str(source), "-o", str(library)], check=True)
        self.library = ctypes.CDLL(str(library))
        self.real = ctypes.c_double if real == "double" else ctypes.c_float
        self.state = (self.real * 12)(*[9.0] * 12)

    def pair(self, values=(0.0, 0.0)):
        return (self.real * 2)(*values)

    def start(self, angles) -> None:
        self.library.heli2dof_start(self.state, self.pair(angles))

    def step(self, angles, rates, reference) -> np.ndarray:
        """Voltages; without rates, those of the filters."""
        found, out = self.pair(rates if rates is not None else (0.0, 0.0)), self.pair()
        if rates is None:
            self.library.heli2dof_rates(self.state, self.pair(angles), found)
        self.library.heli2dof_step(self.state, self.pair(angles), found, self.pair(reference), out)
        return np.array(out)

    @property
    def integrals(self) -> np.ndarray:
        return np.array(self.state[4:6])


def experiment(anti_windup="clamping", digital=PLAIN, samples=301, **more) -> Scenario:
    duration = (samples - 1) * digital.sample_time
    return Scenario(
        0.35,
        1.0,
        duration,
        samples,
        anti_windup=anti_windup,
        digital=digital,
        rtol=1e-12,
        travel_stops=False,
        **more,
    )


def in_the_loop(spec: Spec, controller: Controller) -> tuple[np.ndarray, np.ndarray]:
    """Angles and voltages at the samples: the C controller around the theory sheet's rig, by SciPy."""
    scenario, Ts = spec.scenario, spec.scenario.digital.sample_time
    *reference, theta, psi, theta_dot, psi_dot = scenario.resolved(spec.theta_0)
    x = np.array([theta, psi, theta_dot, psi_dot])
    controller.start(x[:2])
    angles, voltages, waiting = [], [], place(spec).plant.trim
    for _ in range(scenario.samples):
        rates = x[2:] if scenario.digital.rates == "true" else None
        computed = controller.step(x[:2], rates, reference)
        held, waiting = (waiting if scenario.digital.delay else computed), computed
        angles.append(x[:2].copy())
        voltages.append(held)
        rate = independent_rates(spec.parameters, lambda _x, v=held: (*v, ()))
        x = solve_ivp(rate, (0, Ts), x, "DOP853", rtol=3e-14, atol=1e-15).y[:, -1]
    return np.array(angles), np.array(voltages)


@pytest.mark.parametrize(
    "spec",
    [
        replace(SPEC, limits=TIGHT, scenario=experiment("clamping")),
        replace(SPEC, limits=TIGHT, scenario=experiment("back-calculation", replace(PLAIN, rates="true"))),
        replace(SPEC, limits=TIGHT, scenario=experiment("none", replace(PLAIN, sample_time=0.005), 121)),
        replace(SPEC, theta_0=0.2, scenario=experiment(saturation=False, initial=(0.1, -0.1, 0.0, 0.0))),
        replace(SPEC, outer=OuterLoop("none"), scenario=experiment(trim_feedforward=False)),
        replace(SPEC, method="lqr-integral", limits=TIGHTER, scenario=experiment("clamping")),
        replace(SPEC, limits=TIGHT, scenario=experiment("clamping", replace(PLAIN, delay=True))),
    ],
    ids=["clamping", "back-calculation", "windup", "unlimited", "static", "own-integral", "late"],
)
def test_c_in_the_loop_is_the_digital_rig(spec: Spec, tmp_path: Path):
    own = simulate_digital(
        close_loop(place(spec), spec.outer), spec.limits, spec.scenario, spec.scenario.digital
    )
    angles, voltages = in_the_loop(spec, Controller(spec, tmp_path))
    assert (max(own.saturated) > 0.02) == spec.scenario.saturation
    print(np.max(np.abs(angles - own.angles.T)), np.max(np.abs(voltages - own.voltages.T)))
    assert np.max(np.abs(angles - own.angles.T)) < 1e-9
    assert np.max(np.abs(voltages - own.voltages.T)) < 1e-9


CROSS = OuterLoop("pi", PIGains(3.0, 0.5), PIGains(2.0, 0.4), "cross")
DECOUPLED = OuterLoop("pi", PIGains(20.0, 0.2), PIGains(25.0, 0.3), "diagonal", True)


@pytest.mark.parametrize(
    ("outer", "anti_windup"),
    list(product([SPEC.outer, CROSS, DECOUPLED], ["none", "clamping", "back-calculation"])),
    ids=lambda value: value if isinstance(value, str) else f"{value.pairing}{value.decoupler:d}",
)
def test_c_answers_the_encoders_as_the_digital_rig_does(outer: OuterLoop, anti_windup: str, tmp_path: Path):
    """Open loop, on the rig's own trajectory: rounding would make two closed loops part."""
    digital = Digital(0.004)
    spec = replace(SPEC, outer=outer, limits=TIGHT, scenario=experiment(anti_windup, digital, 251))
    own = simulate_digital(close_loop(place(spec), outer), TIGHT, spec.scenario, digital)
    steps = 2 * np.pi / np.array(digital.encoders)
    measured = steps * np.floor(own.angles.T / steps + 0.5)
    controller = Controller(spec, tmp_path)
    controller.start(measured[0])
    for sample, voltages, integrals in zip(measured, own.voltages.T, own.states[4:6].T, strict=True):
        np.testing.assert_allclose(controller.step(sample, None, own.reference), voltages, atol=1e-9)
        np.testing.assert_allclose(controller.integrals, integrals, atol=1e-9)


BAD = [np.nan, np.inf, -np.inf, 1e300, -2e6]


@pytest.mark.parametrize("outer", [SPEC.outer, OuterLoop("none")], ids=lambda outer: outer.outer)
@pytest.mark.parametrize("real", ["double", "float"])
def test_c_holds_the_last_good_reading(outer: OuterLoop, real: str, tmp_path: Path):
    """Each axis by itself, angles, rates and references: as if the last good value had been read again."""
    spec = replace(SPEC, outer=outer, limits=TIGHT, scenario=experiment())
    rng = np.random.default_rng(5)
    spoilt, whole = Controller(spec, tmp_path, real), Controller(spec, tmp_path, real)
    for controller in (spoilt, whole):
        controller.start([0.1, -0.2])
    good = np.array([0.1, -0.2, 0.0, 0.0, 0.1, -0.2])
    used, held = 0, 6 if outer.outer == "none" else 8  # where the last good rates stand
    for k in range(400):
        read = rng.normal(0, 0.1, 6)
        bad = rng.random(6) < (0.3 if k % 100 < 50 else 0.0)
        good = np.where(bad, good, read)
        used += int(np.sum(bad))
        read[bad] = rng.choice(BAD, int(np.sum(bad)))
        for controller, values in ((spoilt, read), (whole, good)):
            rates = None if k < 200 else values[2:4]  # None: those of the filters
            controller.last = controller.step(values[:2], rates, values[4:])
        if k < 200:
            good[2:4] = spoilt.state[held : held + 2]
        assert np.all(np.isfinite(spoilt.last)) and np.all(np.isfinite(np.array(spoilt.state)))
        np.testing.assert_array_equal(spoilt.last, whole.last)
    assert used > 200


def test_one_bad_angle_is_forgotten(tmp_path: Path):
    """The loop with a lost sample comes back to the one without."""
    spec = replace(SPEC, scenario=experiment())
    one, other = Controller(spec, tmp_path), Controller(spec, tmp_path)
    for controller in (one, other):
        controller.start([0.05, 0.0])
    for k in range(300):
        angles = np.array([0.05 * np.cos(0.02 * k), 0.01])
        expected = one.step(angles, None, [0.05, 0.01])
        seen = other.step([np.nan, angles[1]] if k == 100 else angles, None, [0.05, 0.01])
        assert np.all(np.isfinite(seen))
    np.testing.assert_allclose(seen, expected, atol=1e-3)


def test_c_started_without_a_reading_stands_at_the_operating_point(tmp_path: Path):
    spec = replace(SPEC, theta_0=0.2, scenario=experiment())
    controller = Controller(spec, tmp_path)
    controller.start([np.nan, np.inf])
    voltages = controller.step([np.nan, np.nan], None, [np.nan, np.nan])
    np.testing.assert_allclose(voltages, place(spec).plant.trim, atol=1e-9)


def test_floats_do_nearly_the_same(tmp_path: Path):
    spec = replace(SPEC, limits=TIGHT, scenario=experiment())
    double, _ = in_the_loop(spec, Controller(spec, tmp_path))
    single, _ = in_the_loop(spec, Controller(spec, tmp_path, "float"))
    assert 1e-9 < np.max(np.abs(double - single)) < 1e-4


def test_the_header_is_cpp_too_and_everything_is_said(tmp_path: Path):
    spec = replace(SPEC, scenario=experiment())
    texts = [FORMATS[name].render(spec, "http://lab/*/x*/") for name in ("c-header", "c-source")]
    for text in texts:
        assert text.isascii() and text.count("*/") == text.count("/*")
        for said in (
            "preset quanser-2dof-manual",
            "-12, -10, -9.25, -8.76 rad/s",
            "POST /api/v1/export/c-",
            "heli2dof ",
        ):
            assert said in text
    assert "last good one" in texts[0] and "NaN, infinite or beyond +-1e+06" in texts[0]
    assert "sample time 2 ms" in texts[0] and "forward Euler" in texts[0] and "clamping" in texts[0]
    header = tmp_path / "heli2dof_controller.h"
    header.write_text(texts[0])
    subprocess.run(
        ["c++", "-x", "c++", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", str(header)], check=True
    )
