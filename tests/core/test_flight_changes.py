"""Changes of the controller in the air: no jump of the voltages where the integrals drive both motors."""

from __future__ import annotations

import os
from dataclasses import replace

import numpy as np

import heli2dof_core as heli
from heli2dof_core.errors import Heli2DofError
from heli2dof_core.flight import Rig

CHANGES = int(os.environ.get("HELI2DOF_CHANGES", "120"))
"""Random changes in the suite; 500 are four times as long."""
BUMP = 1e-9
"""V: what may be left of a jump by rounding."""
METHODS = ("full-rank", "full-rank", "tits-yang", "knv0", "varga", "lqr", "lqr-integral")


def random_change(rng: np.random.Generator, spec: heli.Spec) -> heli.Spec | None:
    """Another design for the same rig, any method, structure, pairing, estimator, limits; None if there is none."""
    poles = [complex(-rng.uniform(1, 15)) for _ in range(4)]
    for at in (0, 2):
        if rng.random() < 0.5:
            pole = complex(-rng.uniform(1, 8), rng.uniform(0.5, 8))
            poles[at : at + 2] = [pole, pole.conjugate()]
    try:
        new = spec.changed(
            poles=poles,
            method=str(rng.choice(METHODS)),
            coupling=str(rng.choice(["triangular", "axis-decoupled", "input-diagonal"])),  # type: ignore[arg-type]
            theta_0=float(rng.uniform(-0.2, 0.2)),
            outer="none" if rng.random() < 0.15 else "pi",
            pitch=(rng.uniform(-5, 40), rng.uniform(0.05, 3)),
            yaw=(0.0 if rng.random() < 0.1 else rng.uniform(-5, 40), rng.uniform(0.05, 3)),
            pairing=str(rng.choice(["diagonal", "cross"])),  # type: ignore[arg-type]
            decoupler=bool(rng.random() < 0.3),
            measured=str(rng.choice(["states", "filtered", "observer"])),  # type: ignore[arg-type]
        )
        limits = replace(spec.limits, V_p=float(rng.uniform(18, 30)), V_y=float(rng.uniform(10, 20)))
        windup = str(rng.choice(["none", "clamping", "back-calculation"]))
        new = replace(new, limits=limits, scenario=replace(new.scenario, anti_windup=windup))  # type: ignore[arg-type]
        heli.place(new)
    except Heli2DofError:
        return None
    return new


def test_random_changes_in_the_air_leave_the_voltages_where_they_are():
    rng = np.random.default_rng(7)
    spec = heli.Spec.from_preset("quanser-2dof-manual")
    rig, bumpless, without, done = Rig(spec), 0, 0.0, 0
    while done < CHANGES:
        new = random_change(rng, spec)
        if new is None:
            continue
        if rig.ended or max(map(abs, rig.rates)) > 20:  # what was drawn is not always stable
            rig = Rig(spec)
        rig.do("reference", rng.uniform(-0.2, 0.2), rng.uniform(-0.6, 0.6))
        rig.do("push", *rng.uniform(-0.1, 0.1, 2))
        rig.fly(float(rng.uniform(0.05, 0.3)))
        if rig.ended:
            continue
        rig.change(new)
        took = len(rig.takeovers)
        volts = rig.step().voltages[0]
        assert len(rig.takeovers) == took + 1
        told, done = rig.takeovers[-1], done + 1
        own = rig.controller
        limits = np.array([own.spec.limits.V_p, own.spec.limits.V_y])
        # a limit that is lower than what the motor had is met, whatever the integrals
        lowered = bool((np.abs(volts) >= limits).any())
        jump = max(map(abs, told.jump))
        integral = own.c[[15, 16, 21, 22]].reshape(2, 2)  # ∂u/∂z
        drives = abs(np.linalg.det(integral)) > 1e-12 * (integral**2).sum()
        assert told.bumpless == drives
        if told.bumpless and not lowered:
            bumpless += 1
            assert jump <= BUMP, (new, told)
        if not told.bumpless and new.outer.outer == "none":
            assert told.jump == told.jump_without  # there is nothing to set, and it is told
        without = max(without, *map(abs, told.jump_without))
        if done % 20 == 0:
            rig = Rig(spec)
    assert bumpless > 0.5 * CHANGES and without > 1.0


def test_the_jump_that_is_told_is_the_one_that_flies():
    """Of a loop without integrals: the voltage before is what the old controller would have given at that sample."""
    spec = heli.Spec.from_preset("quanser-2dof-manual", outer="none")
    old, new = Rig(spec), Rig(spec)
    for rig in (old, new):
        rig.do("reference", 0.1, 0.2)
        rig.fly(0.4)
    new.change(spec.changed(poles=[-2, -3, -2 + 1j, -2 - 1j]))
    before, after = old.step(), new.step()
    told = new.takeovers[-1]
    assert not told.bumpless and max(map(abs, told.jump)) > 0.1
    np.testing.assert_allclose(after.voltages[0] - before.voltages[0], told.jump, atol=1e-12)


def test_hands_off_hands_over_without_a_jump():
    rig = Rig(heli.Spec.from_preset("quanser-2dof-manual"))
    rig.fly(0.5)
    last = rig.step((9.0, -2.0))
    rig.fly(0.2)
    first = rig.step()
    assert last.voltages[0].tolist() == [9.0, -2.0]
    assert np.abs(first.voltages[0] - [9.0, -2.0]).max() <= BUMP
    assert rig.takeovers[-1].bumpless and max(map(abs, rig.takeovers[-1].jump_without)) > 1.0
