"""Robust placement after Kautsky, Nichols and Van Dooren, method 0, by SciPy."""

from __future__ import annotations

import numpy as np

from ..errors import MethodUnavailableError
from .method import Method, Placement, Task
from .robust import place_with_scipy


class KNV0(Method):
    """Improves one eigenvector after the other; real poles only."""

    name = "knv0"
    title = "Kautsky–Nichols–Van Dooren, method 0 (SciPy)"
    short = "Kautsky–Nichols–Van Dooren"
    source = (
        "J. Kautsky, N. K. Nichols and P. Van Dooren, Int. J. Control 41 (1985) 1129–1155; "
        "scipy.signal.place_poles"
    )

    def place(self, task: Task) -> Placement:
        """K with well-conditioned closed-loop eigenvectors.

        Raises:
            MethodUnavailableError: a pole is complex, among what `robust` raises.
        """
        if np.any(task.poles.imag):
            raise MethodUnavailableError(
                "KNV0 places real poles only", field="poles", hint="Make all poles real, or take Tits–Yang."
            )
        return Placement(place_with_scipy(task, "KNV0"))
