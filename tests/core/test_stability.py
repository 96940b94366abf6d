"""What lies on the imaginary axis: one verdict for poles, steady state, RGA, margins, and no verdict by rounding."""

from __future__ import annotations

from dataclasses import replace

import mpmath
import numpy as np
import pytest

from heli2dof_core import (
    PRESETS,
    Heli2DofError,
    InvalidInputError,
    Rotors,
    Spec,
    Uncertainty,
    close_loop,
    cloud,
    evaluate,
    interaction,
    place,
    relative_gain_array,
    rga_over_frequency,
    suggest_pi,
)
from heli2dof_core.margins import open_loop_response
from tests.bench.random_designs import run
from tests.core.random_loops import STRUCTURES, exact_poles, random_spec

ON_THE_AXIS = [
    [0, -1, -2, -3],
    [-2, -3, 0, -1],
    [0, 0, -2, -3],
    [0, 0, 0, 0],
    [0, -1000, -2000, -3000],
    [1j, -1j, -2, -3],
    [-2, -3, 5j, -5j],
    [1j, -1j, 1j, -1j],
    [1j, -1j, 0, -3],
]


@pytest.mark.parametrize("poles", ON_THE_AXIS, ids=str)
@pytest.mark.parametrize("name", PRESETS)
def test_on_the_axis_is_not_stable_on_any_rig(name, poles):
    for structure in STRUCTURES:
        spec = replace(
            Spec.from_preset(name, poles=poles, outer="none", rotors=Rotors()), structure=structure
        )
        report = evaluate(spec)
        codes = {finding.code for finding in report.findings}
        assert not report.loop.stable and report.margins is None and report.sensitivity is None
        assert "imaginary_axis" in codes and "right_half_plane" not in codes
        at_zero = 0 in poles
        assert (report.interaction.rga is None) == at_zero == ("no_steady_state" in codes)
        assert (report.design.steady_state is None) == at_zero
        if at_zero:
            assert not {"pairing_cross", "pairing_diagonal"} & codes
        with pytest.raises(InvalidInputError, match="stable poles"):
            suggest_pi(report.design)


SLOW = [
    [-340 + 5435j, -340 - 5435j, -3.8e-4 + 2e-5j, -3.8e-4 - 2e-5j],
    [-3.8e-4 + 2e-5j, -3.8e-4 - 2e-5j, -340 + 5435j, -340 - 5435j],
    [-1e-8, -4, -5, -6],
    [-1e-6, -1e-6, -5, -6],
    [-1e-3, -1e-3, -1e-3, -1e-3],
    [-1e-6 + 3j, -1e-6 - 3j, -2, -4],
    [-5e4, -6e4, -1e-2, -2e-2],
]


@pytest.mark.parametrize("poles", SLOW, ids=str)
@pytest.mark.parametrize("name", ["quanser-2dof-manual", "quanser-aero-2", "quanser-aero"])
def test_slow_is_not_on_the_axis(name, poles):
    """However far the other poles lie; and the RGA is that of the closed form at 40 digits."""
    for structure in STRUCTURES:
        spec = replace(
            Spec.from_preset(name, poles=poles, outer="none", rotors=Rotors()), structure=structure
        )
        report = evaluate(spec)
        assert report.loop.stable and report.margins is not None and report.sensitivity is not None
        assert not {"no_steady_state", "imaginary_axis"} & {finding.code for finding in report.findings}
        assert report.interaction.relative_gain == pytest.approx(
            exact_relative_gain(report.design), rel=1e-9, abs=1e-9
        )


def exact_relative_gain(design):
    """λ₁₁ at 40 digits from A₂₁ − B₂K₁, whose form in the structure's coordinates z of the angles defines it."""
    with mpmath.workdps(40):
        B, A = (mpmath.matrix(M[2:, :2].tolist()) for M in (design.plant.B, design.plant.A))
        p = [mpmath.mpc(pole) for pole in design.poles.values]
        d_1, d_2 = (p[0] * p[1]).real, (p[2] * p[3]).real
        own, by_inputs = design.structure, B**-1
        Z = mpmath.eye(2) if own.coupling == "axis-decoupled" else by_inputs.copy()
        if own.coupling == "triangular":
            leads = 0 if own.lead == "pitch" else 1
            Z[leads, 0], Z[leads, 1] = 1 - leads, leads
        stiffness = mpmath.diag([d_1, d_2])
        if (
            own.coupling == "triangular"
        ):  # where the leading axis drives the other, the plant's own path stays
            stiffness[1 - leads, leads] = (-Z * A * Z**-1)[1 - leads, leads]
        inverse = by_inputs * Z**-1 * stiffness * Z
        return float(inverse[0, 0] * inverse[1, 1] / mpmath.det(inverse))


@pytest.mark.slow
def test_no_verdict_is_rounding():
    """300 loops near the axis: stable only if they are so exactly, at 60 digits, as far as A, B and K are known."""
    rng, stable, on_axis = np.random.default_rng(5), 0, 0
    while stable + on_axis < 300:
        spec = random_spec(rng)
        if rng.random() < 0.5:  # poles that are near the axis but not on it
            near = -(10 ** rng.uniform(-9, -3))
            im = float(rng.choice([0.0, 2.0]))
            spec = spec.changed(poles=[complex(near, im), complex(near, -im), *spec.poles.values[2:]])
        try:
            loop = close_loop(place(spec), spec.outer)
        except Heli2DofError:
            continue
        if not -1e-2 < loop.connected_poles[0].real < 1e-3:
            continue
        rightmost = max(p.real for p in exact_poles(loop))
        scale = max(abs(loop.connected_poles))
        if loop.stable:
            stable += 1
            assert rightmost < 0, (spec, rightmost)
        else:
            on_axis += 1
            law = loop.voltage_from_state
            nearby = (
                [law * (1 + 1e-14 * rng.choice([-1, 1], law.shape)) for _ in range(8)]
                if rightmost < 0
                else []
            )
            moved = [max(p.real for p in exact_poles(loop, each)) for each in nearby]
            placed = loop.design.stable or len(loop.connected) == 6
            assert not placed or max([rightmost, *moved]) > -1e-13 * scale, (spec, rightmost, moved)
    assert stable > 60 and on_axis > 60


def test_random_designs_of_every_kind_raise_nothing():
    run(400, seed=3)


def test_the_cloud_judges_as_the_loop_does():
    """Also with a loop that is off."""
    for off in ({}, {"yaw": (0.0, 0.1)}, {"outer": "none"}):
        spec = Spec.from_preset(poles=[-3, -2.2, -3, -2.2], **off)
        found = cloud(spec, Uncertainty({"K_pp": 0.5, "K_yy": 0.5, "B_p": 0.9}, samples=60))
        assert found.share_stable == pytest.approx(np.mean(np.max(found.loop_poles.real, axis=1) < 0))


def test_what_rounding_of_the_gain_hides_is_at_zero_for_all():
    """A pair so slow beside the other that K cannot hold it: no steady state, no RGA, no margin, and it is told."""
    for structure in STRUCTURES:
        spec = Spec.from_preset(
            "quanser-aero-2", poles=[-2e-9, -2e-9, -300, -300], outer="none", rotors=Rotors()
        )
        report = evaluate(replace(spec, structure=structure))
        steady = report.design.steady_state is not None
        codes = {finding.code for finding in report.findings}
        assert (
            steady
            == report.loop.stable
            == (report.interaction.rga is not None)
            == (report.margins is not None)
        )
        assert steady == (not {"no_steady_state", "imaginary_axis"} <= codes)


def test_responses_over_frequency_exist_at_poles_on_the_axis():
    """Exactly at jω, and of loops that have a pole there when opened."""
    at = np.array([0.5, 1.0, 2.0])
    spec = Spec.from_preset(poles=[1j, -1j, -3, -4], outer="none")
    for structure in STRUCTURES:
        rga = rga_over_frequency(place(replace(spec, structure=structure)), at)
        assert np.all(np.isfinite(rga))
    bare = {"K_s": 0.0232, "J_p": 0.0232, "B_p": 0.0, "K_py": 0.0, "K_yp": 0.0}
    spec = Spec.from_preset("quanser-aero-2", parameters=bare, outer="none", coupling="axis-decoupled")
    response = open_loop_response(close_loop(place(spec), spec.outer), at)
    assert np.all(np.isfinite(response)) and abs(response[0, 1]) > 1e9


def test_a_decoupler_without_steady_state_is_told():
    spec = Spec.from_preset(poles=[0, -3, -4, -5], decoupler=True)
    plain = evaluate(spec.changed(decoupler=False))
    report = evaluate(spec)
    assert "no_decoupler" in {finding.code for finding in report.findings}
    np.testing.assert_array_equal(report.loop.proportional, plain.loop.proportional)


@pytest.mark.parametrize("scale", [1.0, 1e-9, 1e9])
def test_singular_gains_have_no_rga(scale):
    singular = np.array([[0.7, 0.1, 0.8], [0.2, 0.3, 0.5], [0.9, 0.4, 1.3]]) * [[1], [scale], [1]]
    for gains in (singular, singular.T, np.zeros((2, 2)), np.array([[1.0, 2.0], [3.0, 6.0]])):
        with pytest.raises(InvalidInputError, match="singular"):
            relative_gain_array(gains)
    np.testing.assert_allclose(relative_gain_array(np.diag([1.0, 1e-30])), np.eye(2))


def test_interaction_says_what_the_design_says():
    for poles in ON_THE_AXIS:
        design = place(Spec.from_preset(poles=poles))
        assert (interaction(design).relative_gain is None) == (design.steady_state is None)
