"""SciPy's LSODA behind the signature of `dormand_prince.integrate`, for very fast poles."""

from __future__ import annotations

import numpy as np

from ..signals import Floats
from .dormand_prince import EventFunction, RightHandSide, Segment, State, StepBudgetError

MOST_EVALUATIONS = 100_000
"""After that many the simulation is given up; they take about two seconds."""


def integrate_stiff(
    rate: RightHandSide,
    t: float,
    state: Floats,
    samples: Floats,
    *,
    rtol: float,
    atol: float,
    event: EventFunction | None = None,
) -> Segment:
    """As `dormand_prince.integrate`, implicit where needed; slower, but its cost is bounded.

    Raises:
        StepBudgetError: LSODA gave up.
    """
    from scipy.integrate import solve_ivp  # 0.8 s to import, for rare designs only

    evaluations = 0

    def slope(_t: float, y: Floats) -> State:
        nonlocal evaluations
        evaluations += 1
        if evaluations > MOST_EVALUATIONS:
            raise StepBudgetError(f"{MOST_EVALUATIONS} evaluations do not reach t = {samples[-1]:g} s")
        return rate(y.tolist())

    def crossing(_t: float, y: Floats) -> float:
        return event(y.tolist()) if event else -1.0

    crossing.terminal, crossing.direction = True, 1.0  # pyright: ignore[reportFunctionMemberAccess]
    solution = solve_ivp(
        slope,
        (t, float(samples[-1])),
        state,
        method="LSODA",
        t_eval=samples,
        events=crossing if event else None,
        rtol=max(rtol, 1e-12),
        atol=atol,
    )
    if solution.status < 0:
        raise StepBudgetError(solution.message)
    if solution.status == 1:
        return Segment(solution.y, float(solution.t_events[0][0]), solution.y_events[0][0], True)
    final = solution.y[:, -1] if solution.y.size else state
    return Segment(np.asarray(solution.y), float(samples[-1]), final, False)
