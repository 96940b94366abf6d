"""K and L of a system in closed form, for up to six states."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from ..errors import Heli2DofError, InvalidInputError, Wanted, nobody_leaves
from ..placement.symbols import SymbolicPlacement, symbolic_place

if TYPE_CHECKING:
    import sympy as sp

MOST_CHARACTERS = 20_000
"""Of K or L written out; nobody reads more, and a browser takes long to draw it."""


@dataclass(frozen=True)
class ClosedForms:
    """The gains in formulas.

    Attributes:
        control: K, T, Q and where they hold, in the desired poles p_1 … p_n.
        observer: the same of (Aᵀ, Cᵀ), whose K is Lᵀ, in the observer's poles q_1 … q_n; None without C.
        reason: why there is no observer, though C is there; else empty.
    """

    control: SymbolicPlacement
    observer: SymbolicPlacement | None
    reason: str


def closed_forms(
    A: Sequence[Sequence[Any]],
    B: Sequence[Sequence[Any]],
    C: Sequence[Sequence[Any]] | None = None,
    *,
    wanted: Wanted = nobody_leaves,
) -> ClosedForms:
    """K of u = −Kx, and L where C is given, by the construction that `symbolic_place` has.

    Raises:
        InvalidInputError: there are more than six states, an entry is no expression, or the formulas take too long or
            are too long to be read.
        UncontrollableError: (A, B) is not controllable, whatever the letters are.
    """
    control = _readable(symbolic_place(A, B, wanted=wanted))
    if C is None:
        return ClosedForms(control, None, "")
    try:
        dual = symbolic_place(_transposed(A), _transposed(C), wanted=wanted)
        return ClosedForms(control, _readable(_in_q(dual)), "")
    except Heli2DofError as error:
        return ClosedForms(control, None, _of_outputs(error))


def _transposed(rows: Sequence[Sequence[Any]]) -> list[list[Any]]:
    return [list(column) for column in zip(*rows, strict=True)]


def _of_outputs(error: Heli2DofError) -> str:
    if error.code == "uncontrollable":
        return "The outputs do not show all states, whatever the letters are: there is no L for all poles."
    if error.field == "B":
        return "An output depends on others: leave out outputs that others imply."
    return f"L: {error}."


def _readable(placed: SymbolicPlacement) -> SymbolicPlacement:
    size = len(str(placed.K))
    if size > MOST_CHARACTERS:
        raise InvalidInputError(
            f"this gain has {size} characters written out, and {MOST_CHARACTERS} are shown at most",
            field="A",
            hint="Give numbers for some letters, or one letter for a whole expression.",
        )
    return placed


def _in_q(placed: SymbolicPlacement) -> SymbolicPlacement:
    """With the observer's poles called q_1 … q_n, unless the system has such letters."""
    import sympy as sp

    n = placed.A.shape[0]
    named = {sp.Symbol(f"p_{i}"): sp.Symbol(f"q_{i}") for i in range(1, n + 1)}
    if set(named.values()) & set(placed.letters.values()):
        return placed

    def renamed(matrix: sp.ImmutableMatrix) -> sp.ImmutableMatrix:
        return sp.ImmutableMatrix(matrix.xreplace(named))

    return replace(placed, K=renamed(placed.K), closed_loop=renamed(placed.closed_loop))
