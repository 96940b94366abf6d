"""Placement in symbols, for any plant whose entries hold letters: what is asked and what is replied."""

from __future__ import annotations

from dataclasses import asdict
from typing import TYPE_CHECKING, Annotated, Literal

from pydantic import Field

from heli2dof_core.errors import Wanted, nobody_leaves
from heli2dof_core.placement.groups import Group as CoreGroup
from heli2dof_core.placement.symbols import MOST_STATES, symbolic_place

from .derivation import Formula
from .fields import Pole, Strict
from .model import Finding, Model, Reply, findings_reply, plain
from .placement import Group, PoleGroup

if TYPE_CHECKING:
    from heli2dof_core.placement.symbols import SymbolicPlacement

Entry = Annotated[
    str | float,
    Field(description="a number, or an expression of numbers, letters, + - * / ^, brackets and sqrt"),
]
Row = Annotated[list[Entry], Field(min_length=1, max_length=MOST_STATES)]
Matrix = Annotated[list[Row], Field(min_length=1, max_length=MOST_STATES)]
Poles = Annotated[list[Pole], Field(min_length=1, max_length=MOST_STATES)]


class SymbolicPlaceRequest(Strict):
    """Any system ẋ = Ax + Bu of up to six states, row by row; nothing in it is ever run as code."""

    A: Matrix = Field(description="n×n, row by row")
    B: Matrix = Field(description="n×p, row by row")
    poles: Literal["symbols"] | Poles = Field(
        default="symbols", description="n, complex ones with their conjugates; or symbols: p_1 … p_n"
    )
    groups: list[PoleGroup] | None = Field(
        default=None, max_length=MOST_STATES, description="by default in the order of the poles"
    )

    def place(self, wanted: Wanted = nobody_leaves) -> SymbolicPlacement:
        """Places the poles, `wanted` called now and then.

        Raises:
            Heli2DofError: an entry is no expression, the system cannot be placed, or the formulas take too long.
        """
        groups = None
        if self.groups is not None:
            groups = [CoreGroup(tuple(g.inputs), tuple(g.poles)) for g in self.groups]
        return symbolic_place(self.A, self.B, self.poles, groups, wanted=wanted)


class SymbolicPlacementReply(Model):
    """K of u = −Kx + v in formulas, and where they hold."""

    A: Formula
    B: Formula
    T: Formula = Field(description="n×n, x̄ = Tx")
    Q: Formula = Field(description="p×p, the nonzero rows of TB")
    K: Formula = Field(description="p×n, rows are inputs")
    closed_loop: Formula = Field(description="A − BK")
    controllability_indices: list[int] = Field(description="one per input, for letters in general position")
    groups: list[Group]
    holds_unless: list[Formula] = Field(
        description="what must not be 0: where it is, an entry divides by 0 or the indices are others"
    )
    letters: dict[str, Formula] = Field(
        description="by its name the letter as the formulas have it: gamma_, where SymPy has a meaning for gamma"
    )
    findings: list[Finding]


def symbolic_placement_reply(placed: SymbolicPlacement, wanted: Wanted = nobody_leaves) -> Reply:
    """A placement in symbols, rendered within the time that one input may take."""
    from heli2dof_core.symbolic.budget import within_budget
    from heli2dof_core.symbolic.render import formula_of_letters

    with within_budget(wanted=wanted):
        names = ("A", "B", "T", "Q", "K", "closed_loop")
        formulas = {name: asdict(formula_of_letters(getattr(placed, name), placed.letters)) for name in names}
        conditions = [asdict(formula_of_letters(c, placed.letters)) for c in placed.holds_unless]
        letters = {
            name: asdict(formula_of_letters(symbol, placed.letters))
            for name, symbol in placed.letters.items()
        }
    return {
        **formulas,
        "controllability_indices": list(placed.controllability_indices),
        "groups": plain(placed.groups),
        "holds_unless": conditions,
        "letters": letters,
        "findings": findings_reply(placed.findings),
    }
