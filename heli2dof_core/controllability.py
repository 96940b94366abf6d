"""Controllability indices of a numeric pair (A, B)."""

from __future__ import annotations

import numpy as np

from .errors import UncontrollableError
from .signals import Floats

RANK_TOLERANCE = 1e-10
"""A unit column counts as dependent when the smallest singular value falls below this."""


def controllability_indices(A: Floats, B: Floats) -> tuple[int, ...]:
    """Scans b₁ … b_p, Ab₁ … left to right; σ_i is the number of columns kept of input i.

    Every column is scaled to length 1 before it is judged, so that units and fast poles do not
    decide; `RANK_TOLERANCE` applies to the smallest singular value of the columns kept with it.
    Source: Luenberger, IEEE TAC 12:290–293, 1967.

    Args:
        A: n×n.
        B: n×p.

    Raises:
        UncontrollableError: fewer than n independent columns exist.
    """
    n, p = B.shape
    kept: list[Floats] = []
    indices, alive, power = [0] * p, [True] * p, B.astype(float)
    while len(kept) < n and any(alive):
        for i in range(p):
            length = float(np.linalg.norm(power[:, i]))
            if not alive[i] or len(kept) == n:
                continue
            column = power[:, i] / length if length else power[:, i]
            trial = np.column_stack([*kept, column])
            if np.linalg.svd(trial, compute_uv=False)[-1] > RANK_TOLERANCE:
                kept.append(column)
                indices[i] += 1
            else:
                alive[i] = False  # all later powers of this input depend too
        power = A @ power
    if len(kept) < n:
        raise UncontrollableError(
            f"only {len(kept)} of {n} states can be reached from the inputs", field="parameters"
        )
    return tuple(indices)
