"""SciPy's `place_poles`, its refusals in our words; what `tits_yang` and `knv0` share."""

from __future__ import annotations

import warnings
from typing import Literal

import numpy as np

from ..errors import MethodUnavailableError
from ..signals import Floats
from .method import Task


def place_with_scipy(task: Task, method: Literal["YT", "KNV0"]) -> Floats:
    """K by `scipy.signal.place_poles`.

    SciPy warns where its iteration stops before its own tolerance; the gain places the poles all the
    same, only its eigenvectors are not the best, so the warning is left out.

    Raises:
        MethodUnavailableError: a pole occurs more often than there are inputs.
    """
    from scipy.signal import place_poles

    rank = task.B.shape[1]
    poles = task.poles if np.any(task.poles.imag) else task.poles.real
    _, counts = np.unique(np.round(task.poles, 9), return_counts=True)
    if counts.max() > rank:
        raise MethodUnavailableError(
            f"a pole that occurs {counts.max()} times has at most {rank} independent eigenvectors with {rank} "
            "inputs, and this method places eigenvectors",
            field="poles",
            hint=f"Let no pole occur more than {rank} times; full-rank placement has no such limit.",
        )
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        try:
            found = place_poles(task.A, task.B, poles, method=method)
        except (ValueError, np.linalg.LinAlgError) as error:
            raise MethodUnavailableError(f"SciPy cannot place these poles: {error}", field="poles") from error
    return np.asarray(found.gain_matrix, dtype=float)  # pyright: ignore[reportAttributeAccessIssue]
