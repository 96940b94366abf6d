"""Hypervolume: what a set of designs dominates, up to a reference point; smaller is better in every figure."""

from __future__ import annotations

import numpy as np


def front(goals: np.ndarray) -> np.ndarray:
    """Which of the rows, (n, k), are dominated by none: their numbers, sorted by the first figure; k up to 2."""
    order = np.lexsort(goals.T[::-1])
    if goals.shape[1] == 1:
        return order[:1]
    best, kept = np.inf, []
    for i in order:
        if goals[i, 1] < best:
            best = goals[i, 1]
            kept.append(i)
    return np.array(kept, dtype=int)


def volume(goals: np.ndarray, reference: np.ndarray) -> float:
    """Of one or two figures, (n, k)."""
    inside = goals[np.all(goals < reference, axis=1)]
    if not len(inside):
        return 0.0
    own = inside[front(inside)]
    if own.shape[1] == 1:
        return float(reference[0] - own[0, 0])
    right = np.append(own[1:, 0], reference[0])
    return float(np.sum((right - own[:, 0]) * (reference[1] - own[:, 1])))
