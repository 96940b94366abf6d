"""Tasks in the air: what they ask, that a log is known as one of its task, and what it is worth."""

from __future__ import annotations

from math import hypot, radians

import numpy as np
import pytest

from heli2dof_core.errors import InvalidInputError
from heli2dof_core.figures import FLIGHT
from heli2dof_core.flight import FlightLog, Rig, simulate_flight
from heli2dof_core.flight.scores import BY_AXIS, score
from heli2dof_core.flight.task_flights import fly_task, require_task
from heli2dof_core.flight.tasks import TASKS, reach_of, told
from heli2dof_core.request import spec_of

BODY = {"preset": "quanser-2dof-manual"}


def flown(task: str, **how: object) -> FlightLog:
    return fly_task(task, BODY, 3, **how)  # type: ignore[arg-type]


@pytest.mark.parametrize("task", list(TASKS))
def test_a_design_flies_every_task_and_its_log_is_one_of_it(task):
    log = FlightLog.read(flown(task).body())
    course = simulate_flight(log)
    require_task(course)
    found = score(course)
    assert found.done and found.stars >= 2
    for name, value in found.values.items():
        assert name in FLIGHT and isinstance(value, dict) == (name in BY_AXIS)
    assert TASKS[task].figure in found.values


def test_figures_are_those_of_the_whole_course():
    course = simulate_flight(flown("path"))
    task, spec = TASKS["path"], spec_of(BODY)
    asked = np.array([task.asked(t, spec.theta_0, reach_of(spec)) for t in course.t])
    error = np.stack((course.theta, course.psi), axis=1) - asked
    dt = np.append(np.diff(course.t), course.t[-1] - course.t[-2])
    rms = np.sqrt((error**2 * dt[:, None]).sum(0) / dt.sum())
    found = score(course)
    assert [found.value("flight_error_rms", axis) for axis in ("theta", "psi")] == pytest.approx(rms.tolist())
    assert found.value("path_error") == pytest.approx(hypot(*rms))
    assert found.value("flight_error_max", "psi") == pytest.approx(np.abs(error[:, 1]).max())
    assert found.value("time_within") == pytest.approx(
        (dt * (np.abs(error).max(1) <= radians(2))).sum() / dt.sum()
    )
    assert found.value("flight_effort") == pytest.approx(((course.voltages**2).sum(1) * dt).sum())
    assert found.value("flight_time") is None


def test_a_hand_flies_as_well_and_its_time_is_told():
    def still(rig: Rig) -> None:
        if not rig.u[0]:
            rig.do("hands", 1)

    course = simulate_flight(flown("hold", hand=still, every=1.0))
    require_task(course)
    found = score(course)
    assert found.value("by_hand") == 1.0 and found.stars == 0
    assert (found.value("path_error") or 0) > 0.1


def test_time_by_hand_is_time_whatever_ticks_are():
    rig = Rig(spec_of(BODY))
    rig.do("hands", 1)
    rig.do("sticks", 12.5, -3.8)
    rig.fly(1.0)
    rig.do("hands", 0)
    rig.change(spec_of({**BODY, "scenario": {"digital": {"sample_time": 5e-4}}}))
    rig.fly(3.0)
    assert score(simulate_flight(FlightLog.of(rig))).value("by_hand") == pytest.approx(0.25, abs=1e-9)


def test_a_flight_of_one_tick_is_worth_something():
    rig = Rig(spec_of(BODY))
    rig.fly_ticks(1)
    found = score(simulate_flight(FlightLog.of(rig)))
    volts = spec_of(BODY).limits
    assert 0.0 < (found.value("flight_effort") or 0.0) < (volts.V_p**2 + volts.V_y**2) * 0.002


def test_stars_do_not_depend_on_the_volts_of_the_amplifiers():
    """The same rig with motors for a quarter of the voltage."""
    spec = spec_of(BODY)
    p, pi = spec.parameters, spec.outer
    gains = {name: 4.0 * getattr(p, name) for name in ("K_pp", "K_py", "K_yp", "K_yy")}
    limits = {name: getattr(spec.limits, name) / 4.0 for name in ("V_p", "V_y")}
    loops = {axis: {"kp": getattr(pi, axis).kp / 4.0} for axis in ("pitch", "yaw")}
    other = {**BODY, "parameters": gains, "limits": limits, "loops": loops}
    first, second = (score(simulate_flight(fly_task("effort", body, 3))) for body in (BODY, other))
    assert second.value("flight_effort") == pytest.approx(
        (first.value("flight_effort") or 0.0) / 16.0, rel=1e-6
    )
    assert first.stars == second.stars == 2
    own = TASKS["effort"].limits(spec)
    assert TASKS["effort"].limits(spec_of(other)) == pytest.approx([limit / 16.0 for limit in own])


@pytest.mark.parametrize("preset", ["quanser-2dof-manual", "quanser-aero-2", "quanser-aero"])
def test_the_path_has_three_stars_on_every_rig_for_who_moves_the_poles(preset):
    stiff = [-7.2, -12.6, {"re": -9.0, "im": 3.0}, {"re": -9.0, "im": -3.0}]
    found = score(simulate_flight(fly_task("path", {"preset": preset, "poles": stiff, "outer": "none"}, 3)))
    assert found.stars == 3


def test_gusts_that_are_missing_moved_or_more_are_told():
    log = flown("hold")
    gusts = [n for n, event in enumerate(log.events) if event[1] == "gust"]
    assert len(gusts) == TASKS["hold"].gusts
    without = [event for n, event in enumerate(log.events) if n != gusts[4]]
    weaker = [list(event) for event in log.events]
    weaker[gusts[0]][2] *= 0.99
    more = (*log.events, (log.ticks - 5, "thrust", 1.0, 1.0))
    pushed = (*log.events, (log.ticks - 5, "push", 0.01, 0.0))
    for events in (without, weaker, more, pushed):
        other = FlightLog(log.design, log.ticks, tuple(map(tuple, events)), 3, (), "hold")
        with pytest.raises(InvalidInputError, match="what acts on the rig"):
            require_task(simulate_flight(other))
    with pytest.raises(InvalidInputError, match="what acts on the rig"):
        require_task(simulate_flight(FlightLog(log.design, log.ticks, log.events, 4, (), "hold")))


def test_the_design_may_change_in_the_air_and_the_rig_may_not():
    log = flown("hold")

    def changed(**body: object) -> FlightLog:
        event = (log.ticks - 5, "design", {**BODY, **body})
        return FlightLog(log.design, log.ticks, (*log.events, event), 3, (), "hold")

    require_task(simulate_flight(changed(poles=[-6, -7, -8, -9])))
    for part in (
        {"limits": {"V_p": 30.0}},
        {"parameters": {"J_p": 0.1}},
        {"scenario": {"saturation": False}},
    ):
        with pytest.raises(InvalidInputError, match="the rig may not"):
            require_task(simulate_flight(changed(**part)))


def test_an_early_end_and_another_beginning_are_told():
    log = flown("path")
    short = FlightLog(
        log.design, log.ticks // 2, tuple(e for e in log.events if e[0] <= log.ticks // 2), 3, (), "path"
    )
    with pytest.raises(InvalidInputError, match="the task takes 40 s"):
        require_task(simulate_flight(short))
    moved = {**BODY, "scenario": {"initial": {"psi": 0.1}}}
    with pytest.raises(InvalidInputError, match="does not begin at rest"):
        require_task(simulate_flight(FlightLog(moved, log.ticks, log.events, 3, (), "path")))


def test_what_is_asked_moves_smoothly_and_stays_within_the_travel():
    spec = spec_of(BODY)
    for task in TASKS.values():
        t = np.arange(0.0, task.duration, 0.01)
        asked = np.array([task.asked(x, spec.theta_0, reach_of(spec)) for x in t])
        assert np.abs(asked[:, 0]).max() < (spec.limits.theta or 9)
        if not task.ends:
            assert np.abs(np.diff(asked, axis=0)).max() < 0.01
        assert told(task)["marks"][0][0] == 0.0
