"""Design and loop of an update's block: what the steps one by one would make, without computing it again."""

from __future__ import annotations

from math import isfinite, isnan

import numpy as np

from .block import Block
from .design import FULL_RANK, Design
from .estimators import Estimator, estimator
from .kernels.layout import PLAIN
from .kernels.update_layout import (
    CONDITION,
    CONNECTED,
    DETERMINANT,
    DOUBTFUL,
    LAG_MARGIN,
    PLACED_STABLE,
    POLE_ERROR_BOUND,
    STABLE,
)
from .loop import Loop
from .placement.verdict import Verdict
from .plant import plant
from .poles import match_poles
from .signals import Complexes
from .spec import Spec


def exists(number: float) -> float | None:
    """The number; None where the kernel has left NaN for what does not exist."""
    return None if isnan(number) else float(number)


def design_of(spec: Spec, block: Block, placed: Design | None) -> Design:
    """The design; `placed` is it where the kernel was given its K."""
    rig, figures = plant(spec.parameters, spec.theta_0), block["figures"]
    own = placed
    if own is None:
        rotors = spec.rotor_poles if spec.place_rotors else None
        K = block["K"] if spec.place_rotors else np.ascontiguousarray(block["K"][:, :4])
        task = (rig, spec.poles, FULL_RANK, spec.structure, K, block["inverse"])
        own = Design(*task, None, True, spec.actuators, rotors)
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
