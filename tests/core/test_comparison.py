"""Methods side by side: as placed, and with PI loops tuned by one rule, the same for all."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import control
import numpy as np
import pytest

from heli2dof_core import Spec
from heli2dof_core.comparison import compare
from heli2dof_core.errors import InvalidInputError
from heli2dof_core.evaluate import evaluate, place
from heli2dof_core.loop import close_loop
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.scenario import PIGains
from heli2dof_core.tuning import DAMPING, EASED, suggest_pi

FIRST, AERO = Spec.from_preset(), Spec.from_preset("quanser-aero-2")


def test_as_placed_there_are_no_outer_loops():
    for row in compare(FIRST, tuning="placed").rows:
        if row.report is None:
            continue
        assert row.outer is not None and row.outer.outer == "none"
        own = evaluate(
            replace(FIRST, method=row.method, structure=row.structure or FIRST.structure, outer=row.outer)
        )
        assert row.report.judged.poles == own.judged.poles
        if not METHODS[row.method].integrates:  # the inner loop's poles are all there are
            np.testing.assert_allclose(
                np.sort_complex(row.report.judged.poles),
                np.sort_complex(own.placed.poles),
                rtol=1e-5,
                atol=1e-5,
            )


@pytest.mark.parametrize("spec", [FIRST, AERO, Spec.from_preset(poles=[-4, -5, -3 + 4j, -3 - 4j])])
def test_one_rule_and_one_target_for_all(spec):
    """Every whole loop has the damping that is asked for, by python-control's poles of loops closed there."""
    tuned = 0
    for row in compare(spec, tuning="tuned").rows:
        if row.report is None or METHODS[row.method].integrates:
            continue
        design, outer = row.report.design, row.outer
        assert outer is not None and outer.outer == "pi"
        plant = replace(design, actuators=None).to_control()
        c = [control.tf([pi.kp, pi.kp / pi.ti], [1, 0]) for pi in (outer.pitch, outer.yaw)]
        pi = control.append(control.tf2ss(c[0]), control.tf2ss(c[1]))
        series: Any = plant * pi
        poles = np.asarray(series.feedback(np.eye(2)).poles(), np.complex128)
        if (
            design.actuators is not None and design.actuators.lags
        ):  # the rotors are the rig's, not the design's
            poles = np.array(row.report.judged.poles, dtype=np.complex128)
            inner = close_loop(design, replace(outer, outer="none")).poles
        else:
            inner = design.closed_loop_poles
        target = min(DAMPING, EASED * float(np.min(-inner.real / np.abs(inner))))
        assert np.all(-poles.real / np.abs(poles) >= target - 2e-3), row.name
        tuned += 1
    assert tuned >= 6


def test_a_tuned_row_is_what_the_suggestion_gives():
    row = next(r for r in compare(FIRST, ["tits-yang"], "tuned").rows)
    spec = replace(FIRST, method="tits-yang")
    assert row.outer == suggest_pi(place(spec), spec.outer).outer


def test_the_grid_is_searched_as_loop_by_loop():
    """The matrix of the loop is affine in the gains, so that three corners give them all."""
    design = place(FIRST)
    best = suggest_pi(design)
    for p, y in ((0.9, 1.0), (1.2, 1.3), (2.0, 0.5)):
        pitch, yaw = best.outer.pitch, best.outer.yaw
        other = replace(best.outer, pitch=PIGains(p * pitch.kp, pitch.ti), yaw=PIGains(y * yaw.kp, yaw.ti))
        poles = close_loop(design, other).poles
        complies = bool(np.all(-poles.real / np.abs(poles) >= DAMPING))
        assert not complies or poles[0].real >= 1.06 * best.loop.poles[0].real


def test_kept_is_as_ever_and_warns_where_there_are_loops_to_keep():
    kept = compare(FIRST, ["full-rank", "lqr"])
    assert all(row.outer == FIRST.outer for row in kept.rows)
    assert "other poles" in kept.rule
    alone = compare(FIRST.changed(outer="none"), ["lqr"])
    assert "as placed" in alone.rule


def test_each_comparison_says_its_rule():
    rules = {tuning: compare(FIRST, ["lqr-integral"], tuning).rule for tuning in ("placed", "tuned", "kept")}
    assert len(set(rules.values())) == 3
    assert "0.7" in rules["tuned"] and "prefilter" in rules["placed"]
    assert all("own integrators" in rule for rule in rules.values())
    with pytest.raises(InvalidInputError) as refused:
        compare(FIRST, tuning="other")  # pyright: ignore[reportArgumentType]
    assert refused.value.field == "tuning"


def test_a_method_that_the_rule_finds_no_loops_for_says_so():
    rows = {row.method: row for row in compare(AERO, ["ackermann", "knv0"], "tuned").rows}
    assert "no PI values" in str(rows["ackermann"].unavailable)
    assert "real poles" in str(rows["knv0"].unavailable)
