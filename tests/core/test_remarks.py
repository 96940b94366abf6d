"""What a design's remarks say in figures, and where each of them begins."""

from __future__ import annotations

import re

import numpy as np
import pytest

from heli2dof_core import PoleSet, design, plant
from heli2dof_core.remarks import FAR_OUT, design_remarks


@pytest.fixture(scope="module")
def rig(spec):
    return plant(spec.parameters)


def said(rig, poles, code):
    return next((f.message for f in design(rig, PoleSet(poles)).findings if f.code == code), None)


def test_a_pole_is_named_as_it_is_read(rig):
    """A conjugate pair once, with ±; a real pole without."""
    assert "coincide at −3 ± 4j rad/s" in said(rig, [-3 + 4j, -3 - 4j, -3 + 4j, -3 - 4j], "repeated_poles")
    assert "coincide at −3.25 rad/s" in said(rig, [-12, -3.25, -3.25, -5], "repeated_poles")
    own = sorted(p.real for p in rig.poles.tolist())[0]
    assert f"pole at −{abs(own):.4g} rad/s is one of the rig's own" in said(
        rig, [-12, -10, own, -5], "open_loop_pole"
    )


def test_stability_is_said_of_the_real_part_alone(rig):
    """Of each pole: in the right half plane, on the axis, at the origin; nothing of any other."""
    codes = {"right_half_plane", "imaginary_axis", "no_steady_state"}
    for poles, expected in (
        ([-3, -4, -5, -6], set()),
        ([-1e-9, -4, -5, -6], set()),
        ([-3, -4, -5, 1e-9], {"right_half_plane"}),
        ([-3, -4, 2 + 1j, 2 - 1j], {"right_half_plane"}),
        ([-3, -4, 2j, -2j], {"imaginary_axis"}),
        ([0, -4, -5, -6], {"imaginary_axis", "no_steady_state"}),
        ([0, 1, -5, -6], {"right_half_plane", "no_steady_state"}),
    ):
        assert {f.code for f in design(rig, PoleSet(poles)).findings} & codes == expected, poles


def test_poles_are_far_out_beyond_the_stated_size_and_cost_the_volts_said(rig):
    """One degree of error times the largest entry of K's columns of angles; exactly at the bound, nothing."""
    assert said(rig, [-FAR_OUT, -3, -4, -5], "far_out") is None
    poles = [-1.5 * FAR_OUT, -3, -4, -5]
    message = said(rig, poles, "far_out")
    volts = max(np.abs(design(rig, PoleSet(poles)).K @ np.eye(4)[:2].T * (np.pi / 180)).flat)
    found = re.search(r"lies ([\d.e+]+) rad/s out: one degree of error then asks for ([\d.e+]+) V", message)
    assert float(found[1]) == pytest.approx(1500, rel=5e-3)
    assert float(found[2]) == pytest.approx(volts, rel=5e-3)


def test_motors_that_push_alike_are_told_of_by_their_share(spec):
    """The share of |γ| in what its two products sum up to, as chosen here."""
    p = spec.parameters
    for share, told in ((0.5e-2, True), (0.99e-2, True), (1.01e-2, False), (0.3, False)):
        K_yy = p.K_py * p.K_yp / p.K_pp * (1 + share) / (1 - share)  # (a − b) / (a + b) = share
        message = said(plant(p.replaced({"K_yy": K_yy})), [-12, -10, -9, -8], "nearly_uncontrollable")
        assert (message is not None) == told
        if message:
            assert float(re.search(r"differ by ([\d.]+) %", message)[1]) == pytest.approx(
                100 * share, rel=0.06
            )


def test_an_error_of_the_poles_is_measured_by_their_size(rig):
    """In rad/s where the poles are small, as a share of the largest where they are not."""
    found = np.array([-1, -2, -3, -4], dtype=complex)
    for poles, error, told in (
        ([-0.1, -0.2, -0.3, -0.4], 0.9e-6, False),
        ([-0.1, -0.2, -0.3, -0.4], 1.1e-6, True),
        ([-200, -2, -3, -4], 1.9e-4, False),
        ([-200, -2, -3, -4], 2.1e-4, True),
    ):
        remarks = design_remarks(rig, PoleSet(poles), np.zeros((2, 4)), found, error)
        assert ("pole_error" in {f.code for f in remarks}) == told


def test_poles_coincide_by_their_size(rig):
    """Closer than a millionth of the largest, or of 1 rad/s where all are smaller."""
    for poles, told in (
        ([-500, -3, -3 - 4e-4, -5], True),
        ([-500, -3, -3 - 6e-4, -5], False),
        ([-0.5, -0.3, -0.3 - 0.9e-6, -0.1], True),
        ([-0.5, -0.3, -0.3 - 1.1e-6, -0.1], False),
    ):
        assert (said(rig, poles, "repeated_poles") is not None) == told, poles
