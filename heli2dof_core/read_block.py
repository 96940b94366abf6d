"""What an update's block says: its numbers as they are judged and replied, and the objects that stand for them."""

from __future__ import annotations

from collections.abc import Callable
from math import isfinite, isnan

import numpy as np

from .behaviour import Course, Experiment
from .block import Block, Task
from .design import FULL_RANK, Design
from .estimators import Estimator, estimator
from .findings import Finding
from .judged import Judged, Placed, Size
from .kernels.layout import HELD, PLAIN, SHARE, START
from .kernels.update_layout import (
    CONDITION,
    CONNECTED,
    DETERMINANT,
    DOUBTFUL,
    LAG_MARGIN,
    NORM,
    PLACED_STABLE,
    POLE_ERROR,
    POLE_ERROR_BOUND,
    STABLE,
)
from .loop import Loop
from .metrics import metrics_numbers
from .placement.verdict import Verdict
from .poles import match_poles
from .signals import Complexes
from .simulation.nonlinear import rig_findings
from .simulation.response import end_of_course
from .spec import Spec


def exists(number: float) -> float | None:
    """The number; None where the kernel has left NaN for what does not exist."""
    return None if isnan(number) else float(number)


def placed_in(task: Task, block: Block, own: Design | None) -> Placed:
    """The design's numbers; `own` is it where the kernel was given its K, or where floats do not tell its poles."""
    if own is not None:
        return own.numbers
    figures, spec = block["figures"].tolist(), task.spec
    rotors, wanted = spec.rotor_poles if spec.place_rotors else None, [*spec.poles.values]
    if rotors is None:
        K = block["K"][:, :4].tolist()
    else:
        K, wanted = block["K"].tolist(), [*wanted, *map(complex, rotors)]
    return Placed(
        task.rest.plant,
        FULL_RANK,
        K,
        None,
        wanted,
        rotors,
        True,
        block["closed"][: len(wanted)].tolist(),
        figures[POLE_ERROR],
        figures[POLE_ERROR_BOUND],
        bool(figures[PLACED_STABLE]),
        figures[DETERMINANT] != 0.0,
    )


def size_in(block: Block) -> Size:
    """Figures of the gain."""
    norm, spectral, condition = block["figures"][NORM:POLE_ERROR].tolist()
    return Size(norm, spectral, exists(condition))


def judged_in(task: Task, block: Block, placed: Placed, loop: Callable[[], Loop]) -> Judged:
    """The loop's numbers; `loop` is asked where they are not in the block."""
    spec, outer, figures = task.spec, task.spec.outer, block["figures"].tolist()
    static = placed.integral is None and outer.outer != "pi"
    by_axis = None if static else block["integral"].T.tolist()
    connected, stable, lag = int(figures[CONNECTED]), bool(figures[STABLE]), figures[LAG_MARGIN]
    apart = 0 if by_axis is None else (not any(by_axis[0])) + (not any(by_axis[1]))
    observed = spec.scenario.measured == "observer"
    own = None if stable or not observed else loop().estimator
    return Judged(
        placed,
        by_axis,
        (outer.pitch.kp, outer.yaw.kp),
        outer.decoupler,
        block["connected"][:connected].tolist(),
        block["poles"][: connected + apart].tolist(),
        stable,
        lag if isfinite(lag) else None,
        spec.actuators,
        own and own.growing,
        block["L"].tolist() if observed else None,
        block["estimator_poles"].tolist() if observed else None,
    )


def experiments_in(task: Task, block: Block, sampling: Callable[[], tuple[Finding, ...]]) -> list[Experiment]:
    """What both models have made of the experiments; `sampling`: what is to be said of the controller's."""
    runs, scenario, t = task.rest.runs, task.spec.scenario, block["t"]
    x, axes = block["experiments"].tolist(), block["axes"].tolist()
    motors, courses = block["motors"].tolist(), block["courses"].tolist()
    calm_axes, calm_courses, pushed = axes, courses, scenario.disturbance is not None
    if pushed:
        calm_axes = [(None, own) for own in block["calm_axes"].tolist()]
        calm_courses = [(None, own) for own in block["calm_courses"].tolist()]
    sampled, found = sampling() if task.rest.controller is not None else (), []
    for n in range(runs):
        ends, (own, rig), (of_linear, of_rig) = x[n][: START + 2], courses[n], motors[n]
        linear = metrics_numbers(ends, (axes[n][0], own, of_linear), _NEVER)
        limited = metrics_numbers(ends, (calm_axes[n][1], calm_courses[n][1], of_rig), rig[SHARE:HELD])
        findings = (*rig_findings(t, x[n], rig), *sampled)
        if pushed and ("theta" in limited or "psi" in limited):
            findings = (*findings, CALM)
        theta, psi, theta_from, psi_from = ends
        both = (Course(linear, end_of_course("linear", t, own)), Course(limited, findings))
        found.append(Experiment((theta, psi), (theta - theta_from, psi - psi_from), *both))
    return found


_NEVER = (0.0, 0.0)
"""Shares of time at limits that a linear model knows nothing of."""
CALM = Finding(
    "disturbance_left_out",
    "info",
    "The steps' figures (rise, settling, overshoot, errors) are those without the disturbance; the motors' "
    "include it.",
)


def design_of(task: Task, block: Block, placed: Design | None) -> Design:
    """The design; `placed` is it where the kernel was given its K."""
    spec, figures, own = task.spec, block["figures"], placed
    if own is None:
        rotors = spec.rotor_poles if spec.place_rotors else None
        K = block["K"] if spec.place_rotors else np.ascontiguousarray(block["K"][:, :4])
        made = (task.rest.plant, spec.poles, FULL_RANK, spec.structure, K, block["inverse"])
        own = Design(*made, None, True, spec.actuators, rotors)
    known = {"steady_state_determinant": float(figures[DETERMINANT]), "stable": bool(figures[PLACED_STABLE])}
    known["eigenvector_condition"] = exists(figures[CONDITION])
    if not figures[DOUBTFUL]:
        known["verdict"] = _verdict(own, block["closed"], float(figures[POLE_ERROR_BOUND]))
    vars(own).update(known)
    return own


def _verdict(design: Design, closed: Complexes, bound: float) -> Verdict:
    wanted, found = design.wanted, closed[: len(design.wanted)]
    if not design.aims:  # the kernel takes each pole's nearest one, which others may want, too
        found = found[match_poles(wanted, found)]
    return Verdict(found, float(np.max(np.abs(found - wanted))), bound, bound, exact=False)


def loop_in(spec: Spec, block: Block, design: Design, known: Estimator | None) -> Loop:
    """The whole loop; `known` is the estimator where the kernel was given its gain."""
    figures, outer = block["figures"], spec.outer
    estimated = known or estimator(design, spec.scenario.measured, spec.observer)
    static = design.integral is None and outer.outer != "pi"
    tau = (0.0, 0.0) if design.actuators is None else design.actuators.tau.tolist()
    places = [*range(4 if static else PLAIN), *(6 + j for j in range(2) if tau[j] > 0.0)]
    places += range(8, 8 + (estimated.order if estimated else 0))
    law, A, B, n = block["law"], block["whole"], block["driven"], len(places)
    if n != len(A):
        law, A, B = np.ascontiguousarray(law[:, places]), A[np.ix_(places, places)], B[places]
    motors = np.zeros((n, 2))
    thrust = block["B"] if design.actuators is None else block["B"] * design.actuators.slope
    for j in range(2):
        if tau[j] > 0.0:
            motors[places.index(6 + j), j] = 1.0 / tau[j]
        else:
            motors[:4, j] = thrust[:, j]
    integral = None if static else block["integral"]
    gains = (block["proportional"], integral, block["feedforward"])
    loop = Loop(design, outer, *gains, law, block["by_reference"], A, B, tuple(places), motors, estimated)
    lag = float(figures[LAG_MARGIN])
    vars(loop).update(
        stable=bool(figures[STABLE]),
        lag_margin=lag if isfinite(lag) else None,
        connected_poles=block["connected"][: int(figures[CONNECTED])],
        poles=block["poles"][:n],
    )
    return loop
