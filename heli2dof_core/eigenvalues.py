"""Eigenvalues of small real matrices."""

from __future__ import annotations

from math import isfinite
from typing import Any

import numpy as np
from scipy.linalg import get_lapack_funcs

from .signals import Floats

_geev: Any = get_lapack_funcs("geev")


def eigenvalues(A: Floats) -> list[complex]:
    """Eigenvalues of a real square matrix, by LAPACK's geev as in `numpy.linalg.eigvals`.

    On matrices of six rows, of which every update has two, NumPy takes longer around it than it takes itself.

    Raises:
        numpy.linalg.LinAlgError: the iteration does not converge, or an entry is not finite.
    """
    real, imaginary, _, _, info = _geev(A, compute_vl=0, compute_vr=0)
    if info or not isfinite(A.sum()):  # geev itself gives some answer to NaN
        raise np.linalg.LinAlgError(f"the eigenvalues of a matrix of {len(A)} rows were not found")
    return list(map(complex, real.tolist(), imaginary.tolist()))
