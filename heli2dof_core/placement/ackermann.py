"""Ackermann's formula through a dyadic input."""

from __future__ import annotations

import numpy as np

from ..controllability import controllability_matrix
from ..signals import Floats
from .dyadic import Dyadic


def ackermann(A: Floats, b: Floats, wanted: Floats) -> Floats:
    """k, shape (n,), so that det(sI − A + bk) has the coefficients `wanted`, highest first."""
    polynomial = np.zeros_like(A)
    for coefficient in wanted:  # Horner
        polynomial = polynomial @ A + coefficient * np.eye(len(A))
    last = np.zeros(len(A))
    last[-1] = 1.0
    return np.linalg.solve(controllability_matrix(A, b).T, last) @ polynomial


class Ackermann(Dyadic):
    """k = [0 … 0 1] 𝒞⁻¹ d(A), applied to the input direction with the smallest gain."""

    name = "ackermann"
    title = "Ackermann's formula, dyadic input"
    short = "Ackermann’s formula"
    source = "J. Ackermann, Regelungstechnik 20 (1972) 297–300; dyadic: Gopinath, IEEE TAC 16 (1971) 230"
    formula = staticmethod(ackermann)
