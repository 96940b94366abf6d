"""Whether an algebraic Riccati equation has a stabilizing solution, and if not, which mode is the reason."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..controllability import in_own_units
from ..errors import MethodUnavailableError
from ..frozen import Frozen
from ..rank import equilibrated
from ..signals import Floats
from .exact import exact_matrix, roots
from .verdict import judge

NEAR_AXIS = 1e-6
"""Share of the fastest pole: where the slowest closed-loop pole decays less, floats do not tell whether it does."""
RESIDUAL = 1e-6
"""Share of the Riccati equation's terms by which its solution may miss it, in units of the system's own."""
MOST_EXACT = 8
"""States up to which the Hamiltonian matrix's polynomial is computed exactly: 0.1 s."""
UNREACHED = 1e-8
"""Singular value, in a mode's scaled Hautus matrix, below which the mode is not reached, or not seen."""


@dataclass(frozen=True)
class Regulator(Frozen):
    """What is minimized: ẋ = Ax + Bu, ∫ (xᵀQx + uᵀRu) dt, Q and R diagonal.

    Attributes:
        A, B: n×n, n×p.
        states, inputs: the diagonals of Q (≥ 0) and R (> 0).
        integrators: how many of the states, the last ones, are integrals of outputs.
        speed: the unit of A's eigenvalues, rad/s.
    """

    A: Floats
    B: Floats
    states: Floats
    inputs: Floats
    integrators: int = 0
    speed: float = 1.0

    def in_own_units(self) -> tuple[Regulator, Floats, Floats]:
        """The same problem with R = I in units in which states and time are of one size, and D and E of K = E K' D⁻¹.

        Solvers lose digits where states are in units far apart.
        """
        E = 1 / np.sqrt(self.inputs)
        A, B, units, speed = in_own_units(self.A, self.B * E)
        own = Regulator(A, B, self.states * units**2, np.ones(len(E)), self.integrators, self.speed * speed)
        return own, units, E


def require_stabilizing(task: Regulator, K: Floats, X: Floats) -> None:
    """Raises MethodUnavailableError unless K = R⁻¹BᵀX comes from the stabilizing solution X.

    It exists if and only if all modes that do not decay can be controlled and those on the imaginary axis are seen
    by Q (Kučera, IEEE TAC 17 (1972) 344–347); then the eigenvalues of A − BK are those of the Hamiltonian matrix in
    the left half plane. What a solver returns otherwise looks like a gain, too.
    """
    if not (np.all(np.isfinite(K)) and np.all(np.isfinite(X))):
        raise refusal(task)
    guesses = np.linalg.eigvals(task.A - task.B @ K).astype(np.complex128)
    poles = judge(task.A, task.B, K, guesses).poles
    fastest = max(float(np.max(np.abs(poles))), float(np.max(np.abs(np.linalg.eigvals(task.A)))))
    slowest = -float(np.max(poles.real))
    if slowest <= 0:
        raise refusal(task)
    if slowest <= NEAR_AXIS * fastest and not _decays(task, slowest):
        raise refusal(task)
    if _residual(task, X) > RESIDUAL:
        raise MethodUnavailableError(
            "the Riccati equation was solved too inexactly: its terms are of very different size",
            field="weights",
            hint="Give weights that are closer to one another.",
        )


def refusal(task: Regulator) -> MethodUnavailableError:
    """Why there is no stabilizing solution: a mode that the inputs do not reach, or that Q does not see."""
    message, field, hint = "none was found", "weights", "Change them."
    for value, reached, seen in _modes(task):
        words = f"{value.real + 0.0:.3g}" + (f" ± {abs(value.imag):.3g}j" if value.imag else "")
        if not reached and task.integrators and value == 0:
            message, field = "the inputs cannot hold all these outputs at once: an integral runs away", "C"
            hint = "Regulate at most as many outputs as inputs, and none that the plant blocks at rest."
            break
        if not reached:
            message = f"the inputs do not reach the mode at {words}, which does not decay by itself"
            field, hint = "B", "Add an input, or take that mode out of the model."
            break
        if not seen:
            message = f"the weights do not see the mode at {words}, so that the optimum leaves it there"
            hint = "Give weight to a state that this mode moves."
            break
    return MethodUnavailableError(
        f"the Riccati equation has no stabilizing solution: {message}", field=field, hint=hint
    )


def _modes(task: Regulator) -> list[tuple[complex, bool, bool]]:
    """The eigenvalues of A that do not decay, whether the inputs reach each and, on the axis, whether Q sees it."""
    A, B, units, speed = in_own_units(task.A, task.B)
    Q = np.sqrt(task.states) * units
    values = np.linalg.eigvals(A)
    found = []
    for raw in values:
        # rounding scatters multiple eigenvalues: those near one another are asked at their mean
        near = values[np.abs(values - raw) <= 1e-4 * max(1.0, abs(raw))]
        value = complex(np.mean(near))
        value = complex(0.0 if abs(value.real) <= UNREACHED else value.real, value.imag)
        if abs(value.imag) <= UNREACHED:
            value = complex(value.real, 0.0)
        if value.real < 0:
            continue
        shifted = A - value * np.eye(len(A))
        seen = value.real > 0 or _full(np.vstack([shifted, np.diag(Q)]))
        found.append((value * speed * task.speed, _full(np.hstack([shifted, B])), seen))
    return found


def _full(matrix: Any) -> bool:
    sizes = np.linalg.svd(equilibrated(matrix), compute_uv=False)
    return bool(sizes[-1] > UNREACHED * sizes[0])


def _decays(task: Regulator, slowest: float) -> bool:
    """Whether the optimal loop's slowest pole decays, and as fast as the gain says.

    The Hamiltonian matrix's characteristic polynomial is one of s², computed exactly; without a root s² ≤ 0 nothing
    stays on the imaginary axis (Sturm's theorem). With many states, or roots too close to be told apart, the modes'
    Hautus matrices decide.
    """
    n = len(task.A)
    if n > MOST_EXACT:
        return _stabilizable(task)
    from sympy import QQ
    from sympy.polys.rootisolation import dup_count_real_roots

    A, B = exact_matrix(task.A), exact_matrix(task.B)
    R = exact_matrix(np.diag(task.inputs)).inv()
    upper = A.hstack(-B.matmul(R).matmul(B.transpose()))
    lower = (-exact_matrix(np.diag(task.states))).hstack(-A.transpose())
    polynomial = upper.vstack(lower).charpoly()[::2]
    if dup_count_real_roots(polynomial, QQ, sup=QQ(0)):
        return False
    try:
        squares = roots(polynomial)
    except ArithmeticError:
        return _stabilizable(task)
    decay = min(abs((complex(square) ** 0.5).real) for square in squares)
    return 0.5 * decay <= slowest <= 2.0 * decay


def _stabilizable(task: Regulator) -> bool:
    """Whether the inputs reach every mode that does not decay, and Q sees those on the axis."""
    return all(reached and seen for _, reached, seen in _modes(task))


def _residual(task: Regulator, X: Floats) -> float:
    """‖AᵀX + XA − XBR⁻¹BᵀX + Q‖ as a share of its terms' size."""
    A, B, Q = task.A, task.B, np.diag(task.states)
    left, right = A.T @ X, X @ B / task.inputs @ B.T @ X
    size = 2 * np.linalg.norm(left) + np.linalg.norm(right) + np.linalg.norm(Q)
    return float(np.linalg.norm(left + left.T - right + Q) / (size or 1.0))
