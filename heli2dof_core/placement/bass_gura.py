"""Bass and Gura's formula through a dyadic input."""

from __future__ import annotations

import numpy as np

from ..controllability import controllability_matrix
from ..signals import Floats
from .dyadic import Dyadic


def bass_gura(A: Floats, b: Floats, wanted: Floats) -> Floats:
    """k, shape (n,), so that det(sI − A + bk) has the coefficients `wanted`, highest first."""
    from scipy.linalg import toeplitz

    own = np.asarray(np.poly(A).real, dtype=np.float64)
    W = toeplitz(np.eye(len(A))[0], own[:-1])  # upper triangular: 1, a₁, a₂ … along the rows
    basis = np.asarray(controllability_matrix(A, b) @ W, dtype=np.float64)
    change = np.asarray(wanted[1:] - own[1:], dtype=np.float64)
    return np.asarray(np.linalg.solve(basis.T, change), dtype=np.float64)


class BassGura(Dyadic):
    """k = (d − a)(𝒞 W)⁻¹ from the open-loop polynomial, along the direction with the smallest gain."""

    name = "bass-gura"
    title = "Bass–Gura formula, dyadic input"
    short = "Bass–Gura formula"
    source = "R. W. Bass and I. Gura, Proc. Joint Automatic Control Conf. (1965) 233–240"
    formula = staticmethod(bass_gura)
