"""What every placement method is given, and what it gives back."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Annotated, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..errors import InvalidInputError
from ..frozen import Frozen, read_only
from ..quantities import Quantity
from ..rank import numeric_rank
from ..signals import Complexes, Floats

MOST_STATES = 12
"""Systems with more states are refused: exact placement takes 0.1 s with 12, and 10 s with 20."""


HEAVIEST, LIGHTEST = 1e12, 1e-12
"""The largest weight, and the smallest of those that must not be 0."""


def _on_states(unit: str) -> Quantity:
    return Quantity("on Q's diagonal", unit, 0.0, HEAVIEST)


def _on_input() -> Quantity:
    return Quantity("on R's diagonal", "1/V²", LIGHTEST, HEAVIEST)


def _on_integral() -> Quantity:
    return Quantity("on the integral of this error", "1/(rad·s)²", LIGHTEST, HEAVIEST)


@dataclass(frozen=True)
class Weights:
    """Diagonals of the quadratic cost ∫ (xᵀQx + zᵀQ_z z + uᵀRu) dt, z = ∫ (r − y) dt.

    The quantities are the rig's; other systems have as many as states, inputs and outputs.

    Attributes:
        states: n, ≥ 0, diagonal of Q.
        inputs: p, > 0, diagonal of R.
        integrals: as many as outputs, > 0, diagonal of Q_z; integral action alone uses it.
    """

    states: Annotated[
        tuple[float, ...],
        Quantity(
            "diagonal of Q",
            parts={
                "theta": _on_states("1/rad²"),
                "psi": _on_states("1/rad²"),
                "theta_dot": _on_states("s²/rad²"),
                "psi_dot": _on_states("s²/rad²"),
            },
        ),
    ]
    inputs: Annotated[
        tuple[float, ...], Quantity("diagonal of R", parts={"V_p": _on_input(), "V_y": _on_input()})
    ]
    integrals: Annotated[
        tuple[float, ...],
        Quantity("diagonal of Q_z", parts={"theta": _on_integral(), "psi": _on_integral()}),
    ] = ()


@dataclass(frozen=True)
class Task(Frozen):
    """A system ẋ = Ax + Bu, y = Cx and what is wanted of it.

    Attributes:
        A, B, C: n×n, n×p, q×n.
        poles: n desired poles, closed under conjugation, rad/s; quadratic methods choose their own.
        weights: of the quadratic methods.
    """

    A: Floats
    B: Floats
    poles: Complexes
    C: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    weights: Weights | None = None

    def __post_init__(self) -> None:
        for name in ("A", "B", "poles", "C"):
            object.__setattr__(self, name, read_only(getattr(self, name)))


@dataclass(frozen=True)
class Placement(Frozen):
    """A state feedback u = −Kx + v, or u = −Kx + K_z z with integral action, z = ∫ (r − y) dt.

    Attributes:
        K: p×n.
        integral: K_z, p×q; None where the method brings no integral action.
        weakest: smallest singular value that a column of the scan left (see `controllability.scan`); None where the
            method looks for none.
    """

    K: Floats
    integral: Floats | None = None
    weakest: float | None = None

    def construction(self) -> dict[str, Any]:
        """What else the method found on its way, by name, in plain numbers and lists."""
        return {}


class Method(Protocol):
    """One placement method; `registry.METHODS` holds them all.

    Attributes:
        name: for programs.
        title: for people.
        short: the same in few words.
        source: who published it, and whose code runs.
        needs: the distribution whose code runs, where it is an optional one.
        places_poles: whether it takes the poles given, rather than choose its own.
        weighted: whether it minimizes a cost, by `Task.weights`.
        integrates: whether it brings integral action, which takes the PI loops' place.
        structured: whether the closed loop's structure can be chosen (`couplings.Structure`).
    """

    name: str
    title: str
    short: str
    source: str
    needs: str | None = None
    places_poles: bool = True
    weighted: bool = False
    integrates: bool = False
    structured: bool = False

    def place(self, task: Task) -> Placement:
        """The gain.

        Raises:
            MethodUnavailableError: the method cannot solve this task, with the reason.
        """
        ...


def require_system(A: ArrayLike, B: ArrayLike, poles: ArrayLike) -> tuple[Floats, Floats, Complexes]:
    """A, B and the poles as arrays of fitting shapes and finite numbers.

    Raises:
        InvalidInputError: they are not; the field names which.
    """
    A, B = _array(A, "A", float), _array(B, "B", float)
    wanted = _array(poles, "poles", complex)
    if A.ndim != 2 or A.shape[0] != A.shape[1] or not 1 <= len(A) <= MOST_STATES:
        raise InvalidInputError(
            f"A has the shape {A.shape}",
            field="A",
            hint=f"Give a square matrix, row by row, of at most {MOST_STATES} states.",
        )
    n = len(A)
    if B.ndim != 2 or len(B) != n or not 1 <= B.shape[1] <= n:
        raise InvalidInputError(
            f"B has the shape {B.shape}",
            field="B",
            hint=f"Give {n} rows, one per state, and at most {n} columns, one per input."
            if n > 1
            else "Give one row and one column: there is one state.",
        )
    for name, values in (("A", A), ("B", B), ("poles", wanted)):
        if not np.all(np.isfinite(values)):
            raise InvalidInputError(f"{name} holds a number that is not finite", field=name)
    if wanted.shape != (n,):
        raise InvalidInputError(
            f"{wanted.size} poles given for {n} states",
            field="poles",
            value=wanted.size,
            hint=f"Give {n} poles, complex ones with their conjugates.",
        )
    _require_inputs(B)
    return A, B, wanted


def _require_inputs(B: Floats) -> None:
    """Raises InvalidInputError if an input does nothing, or what others do."""
    for i, column in enumerate(B.T, 1):
        if not np.any(column):
            raise InvalidInputError(
                f"column {i} of B is zero: that input does nothing", field="B", hint="Leave that column out."
            )
    p, rank = B.shape[1], int(numeric_rank(B))
    if rank < p:
        raise InvalidInputError(
            f"the {p} columns of B are dependent: only {rank} of the inputs act{'s' * (rank == 1)} by "
            f"{'itself' if rank == 1 else 'themselves'}",
            field="B",
            hint="Leave out inputs that others can replace.",
        )


def _array(values: ArrayLike, field: str, kind: type) -> NDArray[Any]:
    try:
        return np.asarray(values, dtype=kind)
    except (TypeError, ValueError) as error:
        raise InvalidInputError(f"{field} is no array of numbers: {error}", field=field) from error
