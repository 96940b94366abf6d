"""Figures of merit of the nonlinear rig and of its digital controller: SciPy's, whatever samples and window."""

from __future__ import annotations

from dataclasses import asdict, replace

import pytest

from heli2dof_core import OuterLoop, PoleSet, Scenario, close_loop, design, plant, preset
from heli2dof_core.metrics import step_metrics
from heli2dof_core.scenario import Digital, Disturbance
from heli2dof_core.simulation.nonlinear import simulate_nonlinear
from tests.core.random_rigs import KINDS, LIMITS, random_rigs, simulated, worst_of

CLOSE = 1e-6
"""A share of the step, or of the figure itself."""


@pytest.mark.slow
def test_figures_are_scipys():
    """A sample of the bench's, all kinds in turn: saturating, free and digital."""
    worst, given_up = worst_of(random_rigs(36, seed=41))
    assert given_up == 0
    assert {kind for kind, _ in worst} == set(KINDS)
    far = {key: gap for key, gap in worst.items() if not key[1].startswith("raw") and not gap[0] < CLOSE}
    assert not far


def flat(metrics):
    """All figures by name."""
    found = {"coupling_peak": metrics.coupling_peak}
    for name, each in (*metrics.axes.items(), *metrics.motors.items()):
        found |= {f"{name} {figure}": value for figure, value in asdict(each).items()}
    return found


def test_figures_do_not_depend_on_samples():
    for _, loop, scenario in random_rigs(12, seed=42):
        own = [
            flat(step_metrics(simulated(loop, replace(scenario, samples=samples))))
            for samples in (2, 3, 17, 401, 20_001)
        ]
        for other in own[1:]:
            assert other == pytest.approx(own[0], rel=1e-9, abs=1e-12)


def test_figures_do_not_depend_on_a_window_that_holds_the_settling():
    """What has settled has settled; only what goes on with time, errors and effort, does."""
    always, peaks = (
        ("rise_time", "settling_time", "settled", "undershoot"),
        ("overshoot", "peak", "peak_time"),
    )
    compared = dict.fromkeys(KINDS, 0)
    for kind, loop, drawn in random_rigs(90, seed=43):
        exact = drawn.digital and replace(drawn.digital, noise=0.0, encoders=(0, 0))
        scenario = replace(drawn, duration=6.0, disturbance=None, samples=2, digital=exact)
        own = step_metrics(simulated(loop, scenario))
        if not own.axes or not all(axis.settled for axis in own.axes.values()):
            continue
        compared[kind] += 1
        settled = max(axis.settling_time for axis in own.axes.values())
        for duration in (7.3, 15.0, 60.0, settled + 0.05):
            other = step_metrics(simulated(loop, replace(scenario, duration=duration)))
            for name, axis in own.axes.items():
                if duration < settled + 0.1:  # whether it stays there is looked for over less time, too
                    assert other.axes[name].settling_time in (
                        None,
                        pytest.approx(axis.settling_time, abs=1e-6),
                    )
                    continue
                beyond_the_band = axis.overshoot > 2.0  # a lower one may yet be overtaken, slowly
                for figure in (*always, *peaks) if beyond_the_band else always:
                    value = getattr(other.axes[name], figure)
                    assert value == pytest.approx(getattr(axis, figure), rel=1e-6, abs=1e-6), (
                        figure,
                        duration,
                    )
    assert min(compared.values()) >= 5, compared


@pytest.mark.parametrize("digital", [None, Digital()], ids=["continuous", "digital"])
def test_a_disturbance_after_the_window_changes_nothing_that_is_known_before_it(digital):
    """The course beyond the window, which tells what has settled, meets it when it comes."""
    loop = close_loop(
        design(plant(preset().parameters), PoleSet([-12, -10, -9.25, -8.76])), OuterLoop("none")
    )
    calm = Scenario(theta=0.05, duration=2.0, samples=3, digital=digital)
    own = step_metrics(simulated(loop, calm)).axes["theta"]
    assert own.settled and own.settling_time < 1.2
    for time, settled in ((2.6, True), (2.01, True), (1.9, False)):
        pushed = replace(calm, disturbance=Disturbance(V_p=20.0, time=time))
        other = step_metrics(simulated(loop, pushed)).axes["theta"]
        assert other.settled == settled
        if settled:
            assert other == own
    late = replace(calm, duration=own.settling_time + 0.02)
    for after, settled in ((0.02, False), (5.0, True)):
        pushed = Disturbance(V_p=20.0, time=late.duration + after)
        other = step_metrics(simulated(loop, replace(late, disturbance=pushed))).axes["theta"]
        assert other.settled == settled


def test_what_creeps_to_a_value_beyond_the_reference_has_no_peak_time():
    """Gravity leaves an error without integrators: where it lies beyond the reference, no time is the peak's."""
    placed = design(plant(preset().parameters), PoleSet([-12, -10, -9.25, -8.76]))
    for duration in (3.0, 5.0, 12.0, 30.0):
        scenario = Scenario(theta=0.2, duration=duration)
        own = step_metrics(simulate_nonlinear(close_loop(placed, OuterLoop("none")), LIMITS, scenario)).axes[
            "theta"
        ]
        assert own.overshoot == pytest.approx(-500 * own.steady_state_error, rel=1e-3) and own.overshoot > 2
        assert own.peak_time is None
    turning = step_metrics(simulate_nonlinear(close_loop(placed), LIMITS, scenario)).axes["theta"]
    assert turning.overshoot > 2 and 0 < turning.peak_time < 1
