"""Linear quadratic regulator, by python-control."""

from __future__ import annotations

import numpy as np

from ..errors import MethodUnavailableError
from ..signals import Floats
from .method import Placement, Task, Weights


class LQR:
    """Minimizes ∫ (xᵀQx + uᵀRu) dt; chooses its own poles."""

    name = "lqr"
    title = "Linear quadratic regulator (python-control)"
    source = "R. E. Kalman, Bol. Soc. Mat. Mexicana 5 (1960) 102–119; control.lqr"
    needs = "control"
    places_poles = False

    def place(self, task: Task) -> Placement:
        """The optimal K for the task's weights.

        Raises:
            MethodUnavailableError: there are no weights, or no stabilizing solution exists.
        """
        weights = require_weights(task)
        return Placement(regulate(task.A, task.B, np.diag(weights.states), np.diag(weights.inputs)))


def require_weights(task: Task) -> Weights:
    """The task's weights, or MethodUnavailableError."""
    if task.weights is None:
        raise MethodUnavailableError(
            "a quadratic method needs weights", field="weights", hint="Give weights."
        )
    return task.weights


def regulate(A: Floats, B: Floats, Q: Floats, R: Floats, integrate: Floats | None = None) -> Floats:
    """K of u = −Kx by `control.lqr`; with `integrate` = C, of u = −K [x, ∫y].

    Raises:
        MethodUnavailableError: the Riccati equation has no stabilizing solution.
    """
    import control

    more = {} if integrate is None else {"integral_action": integrate}
    try:
        K, _, _ = control.lqr(A, B, Q, R, method="scipy", **more)
        if not np.all(np.isfinite(K)):
            raise ValueError("its solution is not finite")
    except (ValueError, control.ControlArgument) as error:  # a LinAlgError is a ValueError
        raise MethodUnavailableError(
            f"the Riccati equation has no stabilizing solution: {error}", field="weights"
        ) from error
    return np.asarray(K, dtype=float)
