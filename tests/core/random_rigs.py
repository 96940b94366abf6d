"""Random experiments with the nonlinear rig of all kinds, and the distance of its figures from SciPy's.

Encoders magnify: where two simulations differ by 1e-9 rad, an angle near the edge of a count is rounded up in one
and down in the other, and the courses part by a count. So they are compared at a fine tolerance.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from heli2dof_core import OuterLoop, PIGains, PoleSet, Scenario, close_loop, design, plant, preset
from heli2dof_core.metrics import step_metrics
from heli2dof_core.scenario import Digital, Disturbance
from heli2dof_core.simulation.digital import simulate_digital
from heli2dof_core.simulation.nonlinear import simulate_nonlinear
from tests.rig_figures import Axis, Course, settling_gap
from tests.strategies import STRUCTURES

LIMITS = preset().limits
KINDS = ("saturating", "free", "digital")
AXES = ("theta", "psi")
FINE = 1e-10
"""Tolerance of the integration in these comparisons."""
GIVEN_UP = {"integration_stopped", "diverges"}


def random_rigs(count, seed) -> Iterator[tuple[str, object, Scenario]]:
    """Stable loops with experiments: kinds in turn, windows from 5 ms to 200 s, starts off rest, disturbances."""
    rng, found = np.random.default_rng(seed), 0
    while found < count:
        kind = KINDS[found % 3]
        scale = 10 ** rng.uniform(-0.5, 0.7 if kind != "digital" else 0.2)
        poles = [p * scale for p in (*_pair(rng), *_pair(rng))]
        kp, ti = rng.uniform(2, 40, 2), rng.uniform(0.08, 0.8, 2) / scale
        outer = OuterLoop(
            "pi" if rng.random() < 0.75 else "none",
            *(PIGains(*own) for own in zip(kp * min(scale, 1.0), ti, strict=True)),
            decoupler=bool(rng.random() < 0.2),
        )
        model = plant(preset().parameters, rng.uniform(-0.3, 0.3))
        loop = close_loop(design(model, PoleSet(poles), STRUCTURES[rng.integers(4)]), outer)
        if loop.stable:
            found += 1
            yield kind, loop, _scenario(rng, kind)


def _pair(rng):
    re = -rng.uniform(1, 15)
    if rng.random() < 0.5:
        im = rng.uniform(0.5, 12)
        return complex(re, im), complex(re, -im)
    return complex(re), complex(-rng.uniform(1, 15))


def _scenario(rng, kind):
    size = 10 ** rng.uniform(-3, 0) if rng.random() < 0.4 else 1.0
    reference = [None if rng.random() < 0.15 else size * rng.uniform(-b, b) for b in (0.6, 2.0)]
    start = [None if rng.random() < 0.6 else size * rng.uniform(-0.7, 0.7) for _ in range(2)]
    rates = size * rng.uniform(-2, 2, 2) if rng.random() < 0.3 else (0.0, 0.0)
    duration, digital = 10 ** (rng.uniform(1.5, 2.3) if rng.random() < 0.05 else rng.uniform(-2.3, 1.5)), None
    if kind == "digital":
        sample_time = 10 ** rng.uniform(-3, -1.3)
        duration = min(duration, 800 * sample_time)
        if rng.random() < 0.3:
            duration = max(1, round(duration / sample_time)) * sample_time
        digital = Digital(
            sample_time,
            delay=bool(rng.random() < 0.4),
            encoders=(4096, 8192) if rng.random() < 0.6 else (0, 0),
            rates="filtered" if rng.random() < 0.6 else "true",
            noise=1e-3 if rng.random() < 0.15 else 0.0,
            seed=int(rng.integers(1000)),
        )
    pushed = None
    if rng.random() < 0.3:
        pushed = Disturbance(
            *rng.uniform(-6, 6, 2), time=float(rng.choice([0.0, 1.2, rng.random()])) * duration
        )
    return Scenario(
        *reference,
        duration=float(duration),
        samples=int(rng.choice([2, 3, 17, 401])),
        initial=(*start, *rates),
        saturation=kind == "saturating" or (kind == "digital" and rng.random() < 0.7),
        anti_windup=str(rng.choice(["none", "clamping", "clamping", "back-calculation"])),
        tracking_time=None if rng.random() < 0.7 else float(rng.uniform(0.05, 1.0)),
        travel_stops=bool(rng.random() < 0.8),
        trim_feedforward=bool(rng.random() < 0.85),
        rtol=FINE,
        digital=digital,
        disturbance=pushed,
    )


def simulated(loop, scenario):
    """The response, by whichever controller."""
    if scenario.digital is None:
        return simulate_nonlinear(loop, LIMITS, scenario)
    return simulate_digital(loop, LIMITS, scenario, scenario.digital)


def turn(loop, scenario):
    """How long an axis must stay within its band beyond the window: a period of the slowest pole, or the window."""
    sizes = np.abs(loop.poles)
    return min(2 * np.pi / np.min(sizes[sizes > 1e-9 * np.max(sizes)]), scenario.duration)


def distances(loop, scenario):
    """By figure how far it is from SciPy's, and where; None where the simulation gives the course up.

    Angles are compared in shares of the step or of the largest deviation, whichever is larger, integrals in shares of
    those of an error as large, voltages and efforts in shares of their own. A time is known as well as its angle is,
    divided by the rate there, which is 0 at a peak and may be near 0 where the band is only just reached. So times
    are compared by what SciPy's course does at them, as a share of the step; rise times at the flatter of their two
    ends. `raw` ones are plain differences, s.
    """
    response = simulated(loop, scenario)
    if GIVEN_UP & {f.code for f in response.findings}:
        return None
    own, end = step_metrics(response), scenario.duration
    ahead = turn(loop, scenario)
    course = Course(loop, LIMITS, scenario, end + ahead)
    found = {}
    for i, (name, motor) in enumerate(own.motors.items()):
        expected = course.motor(i)
        for figure, value in (("motor_peak", motor.peak), ("effort", motor.effort)):
            size = max(abs(expected[figure]), 1e-6)
            _note(found, figure, abs(value - expected[figure]) / size, name)
        _note(found, "saturated", abs(motor.saturated - expected["saturated"]), name)
    stepped = [i for i in range(2) if response.reference[i] != response.start[i]]
    assert list(own.axes) == [AXES[i] for i in stepped]
    if len(stepped) == 1:
        expected = course.deviation(1 - stepped[0], response.start[1 - stepped[0]])
        _note(found, "coupling_peak", abs(own.coupling_peak - expected) / max(expected, 1e-3), "")
    else:
        assert own.coupling_peak is None
    floor = min(max(1e-6, 10 * scenario.rtol), 1e-4)
    for i in stepped:
        axis = Axis(course, i, response.start[i], response.reference[i])
        for figure, gap in _axis_gaps(axis, own.axes[AXES[i]], end, ahead, floor).items():
            _note(found, figure, gap, AXES[i])
    return found


def _note(found, figure, gap, where):
    if figure not in found or not gap <= found[figure][0]:
        found[figure] = (float(gap), where)


def worst_of(cases):
    """By kind and figure the largest distance, and which case it was; and how many courses were given up."""
    worst, given_up = {}, 0
    for number, (kind, loop, scenario) in enumerate(cases):
        found = distances(loop, scenario)
        if found is None:
            given_up += 1
            continue
        for figure, (gap, axis) in found.items():
            if not gap <= worst.get((kind, figure), (-1.0,))[0]:
                worst[kind, figure] = (gap, f"case {number} {axis}".strip())
    return worst, given_up


def _axis_gaps(axis, own, end, ahead, floor):
    expected = axis.figures()
    many = max(1.0, float(np.max(np.abs(axis.v[axis.inside]))))  # a tiny step may go with a large swing
    size = many * abs(axis.step)
    excess = {name: expected[name] / 100 for name in ("overshoot", "undershoot")}
    gaps = {
        "peak": abs(own.peak - expected["peak"]) / size,
        "steady_state_error": abs(own.steady_state_error - expected["steady_state_error"]) / size,
        "iae": abs(own.iae - expected["iae"]) / (size * end),
        "itae": abs(own.itae - expected["itae"]) / (size * end**2),
    }
    for name, share in excess.items():
        told = getattr(own, name) / 100
        gaps[name] = max(share - floor, 0.0) if told == 0 else max(abs(told - share), floor - told) / many
    gaps |= _rise_gaps(axis, own, expected) | _peak_time_gaps(axis, own, expected, floor)
    gaps["settling_time"] = settling_gap(axis, own.settling_time if own.settled else None, ahead)
    if own.settled and expected["entered"] is not None:
        gaps["raw settling_time"] = abs(own.settling_time - expected["entered"])
    assert own.settled == (own.settling_time is not None)
    return gaps


def _rise_gaps(axis, own, expected):
    if own.rise_time is None or expected["rise_time"] is None:
        missing = own.rise_time is None and expected["rise_time"] is None
        return {"rise_time": 0.0 if missing else abs(np.max(axis.v[axis.inside]) - 0.9)}
    raw = abs(own.rise_time - expected["rise_time"])
    slope = min(abs(axis.rate(t)) for t in expected["levels"])
    return {"rise_time": raw * min(1.0, slope), "raw rise_time": raw}


def _peak_time_gaps(axis, own, expected, floor):
    """A peak time there is where the peak stands out from the reference, or the start, and from the end."""
    v = axis.v[axis.inside]
    top = (expected["peak"] - axis.start) / axis.step
    out = min(abs(top - v[-1]), (expected["undershoot"] if top < 0 else expected["overshoot"]) / 100)
    if own.peak_time is None:
        return {"peak_time": max(out - floor, 0.0)}
    raw = abs(own.peak_time - expected["peak_time"])
    return {"peak_time": max(abs(axis.share(own.peak_time) - top), floor - out), "raw peak_time": raw}
