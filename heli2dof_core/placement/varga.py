"""Schur placement after Varga, by SLICOT's SB01BD."""

from __future__ import annotations

import warnings

import numpy as np

from ..errors import MethodUnavailableError
from ..poles import pole_error
from .method import Placement, Task

MISSED = 1e-3
"""Share of the largest pole by which a gain may miss the poles and still count as one that places them."""


class Varga:
    """Moves the poles one or two at a time up the real Schur form of A."""

    name = "varga"
    title = "Varga's Schur method (SLICOT SB01BD)"
    source = "A. Varga, IEEE Trans. Autom. Control 26 (1981) 517–519; slycot.sb01bd"
    needs = "slycot"
    places_poles = True

    def place(self, task: Task) -> Placement:
        """K from poles placed one after the other, without inverting a controllability matrix.

        Raises:
            MethodUnavailableError: slycot is not installed, or SLICOT refuses the task.
        """
        try:
            from slycot import sb01bd
            from slycot.exceptions import SlycotError, SlycotResultWarning
        except ImportError as error:
            raise MethodUnavailableError(
                "Varga's method needs the package slycot, which is not installed",
                field="method",
                value=self.name,
                hint="pip install 'heli2dof[slycot]'",
            ) from error
        n, p = task.B.shape
        fastest = float(np.max(np.abs(np.linalg.eigvals(task.A)), initial=1.0))
        try:
            with warnings.catch_warnings():  # of large gains, which the norm of K tells anyway
                warnings.simplefilter("ignore", SlycotResultWarning)
                *_, F, _Z = sb01bd(n, p, n, -10.0 * fastest, task.A, task.B, task.poles, "C")
        except SlycotError as error:
            raise MethodUnavailableError(
                f"SLICOT cannot place these poles: {str(error).strip()}", field="poles"
            ) from error
        K = -np.asarray(F, dtype=float)
        missed = pole_error(task.poles, np.linalg.eigvals(task.A - task.B @ K).astype(np.complex128))
        if not missed <= MISSED * max(float(np.max(np.abs(task.poles))), 1.0):
            raise MethodUnavailableError(
                f"SLICOT's gain, of norm {np.linalg.norm(K):.1e}, misses these poles by {missed:.1e}: it moves "
                "complex poles two at a time, and meets two of the plant's that the inputs hardly reach together",
                field="poles",
                hint="Take real poles, or another method.",
            )
        return Placement(K)
