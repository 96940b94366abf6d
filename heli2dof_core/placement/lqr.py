"""Linear quadratic regulator, by python-control."""

from __future__ import annotations

import numpy as np

from ..errors import InvalidInputError, MethodUnavailableError
from ..signals import Floats
from .method import Method, Placement, Task, Weights
from .riccati import Regulator, refusal, require_stabilizing


class LQR(Method):
    """Minimizes ∫ (xᵀQx + uᵀRu) dt; chooses its own poles."""

    name = "lqr"
    title = "Linear quadratic regulator (python-control)"
    short = "LQR"
    source = "R. E. Kalman, Bol. Soc. Mat. Mexicana 5 (1960) 102–119; control.lqr"
    needs = "control"
    places_poles = False
    weighted = True

    def place(self, task: Task) -> Placement:
        """The optimal K for the task's weights.

        Raises:
            MethodUnavailableError: there are no weights, or no stabilizing solution exists.
        """
        weights = require_weights(task)
        return Placement(regulate(task.A, task.B, np.diag(weights.states), np.diag(weights.inputs)))


def require_weights(task: Task, outputs: int = 0) -> Weights:
    """The task's weights, or MethodUnavailableError; `outputs` is how many are integrated.

    Raises:
        InvalidInputError: there are more or fewer than states, inputs or outputs.
    """
    weights = task.weights
    if weights is None:
        raise MethodUnavailableError(
            "a quadratic method needs weights", field="weights", hint="Give weights."
        )
    n, p = task.B.shape
    for name, size in (("states", n), ("inputs", p), *((("integrals", outputs),) if outputs else ())):
        values = getattr(weights, name)
        low = 0.0 if name == "states" else np.finfo(float).tiny
        if len(values) != size or not all(low <= value < np.inf for value in values):
            raise InvalidInputError(
                f"the weights of the {name} are {values}",
                field=f"weights.{name}",
                hint=f"Give {size}, each {'0 or more' if name == 'states' else 'above 0'}.",
            )
    return weights


def with_integrals(A: Floats, B: Floats, C: Floats) -> tuple[Floats, Floats]:
    """A and B of [x, ∫y], y = Cx."""
    q = len(C)
    whole = np.block([[A, np.zeros((len(A), q))], [C, np.zeros((q, q))]])
    return whole, np.vstack([B, np.zeros((q, B.shape[1]))])


def regulate(A: Floats, B: Floats, Q: Floats, R: Floats, integrate: Floats | None = None) -> Floats:
    """K of u = −Kx by `control.lqr`; with `integrate` = C, of u = −K [x, ∫y]; Q and R are diagonal.

    Raises:
        MethodUnavailableError: the Riccati equation has no stabilizing solution, with the reason.
    """
    import control

    whole, inputs, integrators = A, B, 0
    if integrate is not None:
        integrators = len(integrate)
        whole, inputs = with_integrals(A, B, integrate)
    task, units, volts = Regulator(whole, inputs, np.diag(Q), np.diag(R), integrators).in_own_units()
    weights = np.diag(task.states), np.diag(task.inputs)
    try:
        K, X, _ = control.lqr(task.A, task.B, *weights, method="scipy")
    except (ValueError, control.ControlArgument) as error:  # a LinAlgError is a ValueError
        raise refusal(task) from error
    require_stabilizing(task, np.asarray(K, dtype=float), np.asarray(X, dtype=float))
    return volts[:, None] * np.asarray(K, dtype=float) / units
