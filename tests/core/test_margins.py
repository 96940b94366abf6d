"""Margins against python-control and against eigenvalues under changed gains, in loops of every kind."""

from __future__ import annotations

import control
import numpy as np
import pytest
from heli2dof_core.interpreted.polynomials import positive_roots

from heli2dof_core import Spec, evaluate
from heli2dof_core.margins import loop_margins
from tests.core.random_loops import opened, random_stable_loops


def test_margins_of_500_random_loops_are_python_controls():
    """Of plants that are unstable too, with and without integrators; every crossing, ω = 0 among them."""
    at_zero = checked = 0
    for loop in random_stable_loops(500, seed=1):
        for motor, own in enumerate(loop_margins(loop)):
            A, b, c = opened(loop, motor)
            system = control.ss(A, b[:, None], -c[None], 0)
            gains, phases, _, crossings, crossovers, _ = control.stability_margins(system, returnall=True)
            gains, crossings = (
                gains[gains > 1e-6],
                crossings[gains > 1e-6],
            )  # with an integrator, some 1e-8 at ω = 0
            above, below = gains[gains > 1], gains[gains < 1]
            theirs = above.min() if len(above) else None, below.max() if len(below) else None
            found = own.gain_margin, own.gain_reduction_margin
            found = tuple(gain if gain is None or gain > 1e-6 else None for gain in found)
            assert found == tuple(None if gain is None else pytest.approx(gain, rel=1e-4) for gain in theirs)
            at_zero += any(crossings[gains == gain] < 1e-6 for gain in theirs if gain is not None)
            lags = np.radians(phases % 360)
            if len(lags):
                assert own.phase_margin == pytest.approx(np.min(np.minimum(lags, 2 * np.pi - lags)), rel=1e-4)
                assert own.delay_margin == pytest.approx(np.min(lags / crossovers), rel=1e-4)
            else:
                assert own.phase_margin is None
            checked += 1
    assert checked == 1000 and at_zero > 100


def test_gains_within_the_margins_keep_500_random_loops_stable_and_the_margins_do_not():
    """By eigenvalues of A − B diag(k₁, k₂) K, one k from 1 to its margin, or to 1,000 and 0.001."""
    limited = 0
    for loop in random_stable_loops(500, seed=2, edges=True):
        for motor, own in enumerate(loop_margins(loop)):
            A, b, c = opened(loop, motor)
            scale = max(abs(loop.connected_poles))
            for margin, far in ((own.gain_margin, 1e3), (own.gain_reduction_margin, 1e-3)):
                factors = np.geomspace(1, margin or far, 41)
                rightmost = np.max(
                    np.linalg.eigvals(A + factors[:, None, None] * np.outer(b, c)).real, axis=1
                )
                assert np.all(rightmost[:-1] < 1e-9 * scale * max(1, margin or 1))
                if margin is not None:
                    limited += 1
                    assert abs(rightmost[-1]) < 1e-6 * scale * max(1, margin)
    assert limited > 200


@pytest.mark.parametrize(
    ("theta_0", "poles", "reduction"),
    [
        (0.8, [-1, -2, -1.5, -2.5], 0.913915),
        (0.3, [-1, -2, -3, -4], 0.813903),
        (0.3, [-12, -10, -9.25, -8.76], 0.067940),
        (0.8, [-12, -10, -9.25, -8.76], 0.150340),
    ],
)
def test_less_gain_lets_a_rig_above_level_fall(theta_0, poles, reduction):
    """Values of the eigenvalue that passes 0: there is no integrator, and the rig's pitch is unstable."""
    report = evaluate(Spec.from_preset(theta_0=theta_0, poles=poles, outer="none"))
    assert report.margins[0].gain_reduction_margin == pytest.approx(reduction, rel=1e-5)


@pytest.mark.parametrize("factor", [1.25, 3.0])
def test_a_gain_margin_at_zero_frequency_counts(factor):
    """A law that falls over with more gain: pitch's own stiffness, and feedback that pushes it over."""
    rig = Spec.from_preset("quanser-aero-2", coupling="axis-decoupled", outer="none")
    spec = rig.changed(parameters={"K_py": 0.0, "K_yp": 0.0})
    stiffness = spec.parameters.K_s / spec.parameters.alpha
    slow = stiffness * (1 - 1 / factor)  # d₁(0): what is left of the rig's own stiffness
    report = evaluate(spec.changed(poles=[-1.0, -slow, -3, -4]))
    assert report.margins[0].gain_margin == pytest.approx(factor)


def test_a_root_of_even_order_is_found():
    """Where a curve touches circle or axis and turns back, no sign changes."""
    p, (roots, before, chain) = np.zeros(16), np.empty((3, 16))
    p[:5] = np.poly([2.0, 2.0, 5.0, 0.1])[::-1]  # (x − 2)² (x − 5) (x − 0.1)
    found, touched = positive_roots(p, np.abs(p), chain, roots, before)
    np.testing.assert_allclose(roots[:found], [0.1, 5.0])
    np.testing.assert_allclose(roots[found : found + touched], [2.0])
    p[2] *= 1 - 1e-9  # now it stays away
    assert positive_roots(p, np.abs(p), chain, roots, before)[1] == 0


ZEROS = [
    ("quanser-aero", {"B_p": 0, "B_y": 0}, "input-diagonal", [-4, -4, -4, -4]),
    ("quanser-aero-2", {"B_p": 0, "B_y": 0}, "input-diagonal", [-4, -4, -4, -4]),
    ("quanser-aero-2", {"B_p": 0, "B_y": 0, "K_s": 0, "K_py": 0}, "axis-decoupled", [-1, -1, -1, -1]),
    ("quanser-2dof-manual", {"B_p": 0, "B_y": 0, "m": 0}, "triangular", [-2, -2, -2, -2]),
    ("quanser-2dof-manual", {"B_p": 0, "K_yp": 0, "g": 0}, "triangular", [-1 + 1j, -1 - 1j, -3, -3]),
]


@pytest.mark.parametrize(("name", "parameters", "coupling", "poles"), ZEROS)
@pytest.mark.parametrize("outer", ["none", "pi"])
def test_poles_of_the_opened_loop_on_the_axis_are_no_crossing(name, parameters, coupling, poles, outer):
    """There L is infinite: a factor of 0 on the gain, which is no margin, and no error."""
    report = evaluate(
        Spec.from_preset(name, parameters=parameters, coupling=coupling, poles=poles, outer=outer)
    )
    assert (report.margins is None) == (not report.loop.stable)
    for own in report.margins or ():
        assert own.gain_reduction_margin is None or own.gain_reduction_margin > 1e-6


@pytest.mark.parametrize("axis", ["pitch", "yaw"])
@pytest.mark.parametrize("name", ["quanser-2dof-manual", "quanser-aero-2", "quanser-aero"])
def test_a_loop_that_is_switched_off_is_open_and_not_unstable(name, axis):
    spec = Spec.from_preset(name)
    own = getattr(spec.outer, axis)
    off = evaluate(spec.changed(**{axis: (0.0, own.ti)}))
    apart = off.loop.poles[off.loop.poles == 0]
    assert off.loop.stable and len(apart) == 1 and len(off.loop.poles) == len(off.loop.A)
    assert np.max(off.loop.connected_poles.real) < 0
    expected = np.linalg.eigvals(off.loop.A)
    np.testing.assert_allclose(np.poly(off.loop.poles), np.poly(expected), rtol=1e-8, atol=1e-8)
    assert off.margins is not None and off.sensitivity is not None
    assert f"{axis}_loop_open" in {finding.code for finding in off.findings}
    assert not any("Lower" in finding.message for finding in off.findings)
    faint = evaluate(spec.changed(**{axis: (1e-9 * own.kp, own.ti)}))
    for one, other in zip(off.margins, faint.margins, strict=True):
        assert one.phase_margin == pytest.approx(other.phase_margin, rel=1e-6)
    assert off.sensitivity.peak == pytest.approx(faint.sensitivity.peak, rel=1e-6)


def test_with_both_loops_off_the_inner_loop_decides():
    off = {"pitch": (0.0, 0.1), "yaw": (0.0, 0.1)}
    both, alone = Spec.from_preset(**off), Spec.from_preset(outer="none")
    assert evaluate(both).margins == evaluate(alone).margins
    for poles in ([1, -2, -3, -4], [0, -2, -3, -4], [1j, -1j, -3, -4]):
        report = evaluate(both.changed(poles=poles))
        assert not report.loop.stable and report.margins is None
        assert not any("Lower" in finding.message for finding in report.findings)


def test_advice_is_for_the_loop_that_is_closed():
    """Pitch's loop is off; yaw's is so fast that it is unstable."""
    spec = Spec.from_preset(poles=[-3, -2, -3, -2], pitch=(0.0, 0.1), yaw=(300.0, 0.1))
    finding = next(f for f in evaluate(spec).findings if f.code == "pi_unstable")
    assert finding.message.startswith("The PI loop of yaw makes") and "Lower its gain" in finding.message
