"""Linear quadratic regulator with integral action, by python-control."""

from __future__ import annotations

import numpy as np

from ..errors import MethodUnavailableError
from .lqr import regulate, require_weights
from .method import Method, Placement, Task


class LQRIntegral(Method):
    """Minimizes ∫ (xᵀQx + zᵀQ_z z + uᵀRu) dt; brings its own integrators in place of PI loops."""

    name = "lqr-integral"
    title = "Linear quadratic regulator with integral action (python-control)"
    short = "LQR, integral action"
    source = (
        "P. C. Young and J. C. Willems, Int. J. Control 15 (1972) 961–978; control.lqr(integral_action=C)"
    )
    needs = "control"
    places_poles = False
    weighted = True
    integrates = True

    def place(self, task: Task) -> Placement:
        """The optimal K and K_z for the task's weights.

        Raises:
            MethodUnavailableError: weights or outputs are missing, or no stabilizing solution exists.
        """
        weights = require_weights(task, len(task.C))
        if not task.C.size:
            raise MethodUnavailableError(
                "integral action needs the outputs that it shall regulate", field="C", hint="Give y = Cx."
            )
        n = len(task.A)
        Q = np.diag([*weights.states, *weights.integrals])
        K = regulate(task.A, task.B, Q, np.diag(weights.inputs), integrate=task.C)
        return Placement(K[:, :n], K[:, n:])
