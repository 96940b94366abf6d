"""A system ẋ = Ax + Bu, y = Cx + Du in numbers."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..errors import InvalidInputError
from ..frozen import Frozen, read_only
from ..placement.method import MOST_STATES, require_system
from ..rank import numeric_rank
from ..signals import Complexes, Floats


@dataclass(frozen=True, eq=False)
class System(Frozen):
    """ẋ = Ax + Bu, y = Cx + Du, with n states, p inputs and q outputs.

    Attributes:
        A, B, C, D: n×n, n×p, q×n, q×p.
        measured: whether C was given; else all states are outputs, and there is nothing to observe.
    """

    A: Floats
    B: Floats
    C: Floats
    D: Floats
    measured: bool = True

    @classmethod
    def of(cls, A: ArrayLike, B: ArrayLike, C: ArrayLike | None = None, D: ArrayLike | None = None) -> System:
        """From anything that is an array.

        Raises:
            InvalidInputError: a shape does not fit, a number is not finite, or an input does nothing.
        """
        A, B, _ = require_system(A, B, np.zeros(len(np.asarray(A))))
        n, p = B.shape
        outputs = np.eye(n) if C is None else np.asarray(C, dtype=float)
        if outputs.ndim != 2 or outputs.shape[1] != n or not 1 <= len(outputs) <= MOST_STATES:
            raise InvalidInputError(
                f"C has the shape {outputs.shape}",
                field="C",
                hint=f"Give {n} columns, one per state, and a row per output, at most {MOST_STATES}.",
            )
        through = np.zeros((len(outputs), p)) if D is None else np.asarray(D, dtype=float)
        if through.size == 1 and not through.any():
            through = np.zeros((len(outputs), p))  # D = 0, as books print it
        if through.shape != (len(outputs), p):
            raise InvalidInputError(
                f"D has the shape {through.shape}",
                field="D",
                hint=f"Give {len(outputs)} rows, one per output, and {p} columns, one per input; or leave D out.",
            )
        for name, values in (("C", outputs), ("D", through)):
            if not np.all(np.isfinite(values)):
                raise InvalidInputError(f"{name} holds a number that is not finite", field=name)
        return cls(*(read_only(matrix) for matrix in (A, B, outputs, through)), measured=C is not None)

    @cached_property
    def _key(self) -> tuple[object, ...]:
        matrices = (self.A, self.B, self.C, self.D)
        return (self.measured, *((m.shape, np.ascontiguousarray(m).tobytes()) for m in matrices))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, System) and self._key == other._key

    def __hash__(self) -> int:
        return hash(self._key)

    @property
    def sizes(self) -> tuple[int, int, int]:
        """n, p, q."""
        return len(self.A), self.B.shape[1], len(self.C)

    @cached_property
    def dual(self) -> tuple[Floats, Floats]:
        """(Aᵀ, Cᵀ), whose state feedback is the observer's gain, transposed.

        Raises:
            InvalidInputError: an output is 0 or depends on others.
        """
        rank = int(numeric_rank(self.C))
        if rank < len(self.C):
            raise InvalidInputError(
                f"the {len(self.C)} rows of C are dependent: only {rank} say something of their own",
                field="C",
                hint="Leave out outputs that others imply.",
            )
        return read_only(np.ascontiguousarray(self.A.T)), read_only(np.ascontiguousarray(self.C.T))

    def require_poles(self, poles: ArrayLike, field: str = "poles") -> Complexes:
        """As many desired poles as there are states.

        Raises:
            InvalidInputError: they are not n finite numbers.
        """
        wanted, n = np.asarray(poles, dtype=np.complex128), len(self.A)
        if wanted.shape != (n,) or not np.all(np.isfinite(wanted)):
            raise InvalidInputError(
                f"{wanted.size} poles given for {n} states",
                field=field,
                value=wanted.size,
                hint=f"Give {n} finite poles, complex ones with their conjugates.",
            )
        return wanted
