"""Placement methods, and the poles of any system, not of the rig alone: what is asked and what is replied."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from typing import Annotated, Literal, get_args

import numpy as np
from pydantic import Field

from heli2dof_core.couplings import Coupling, Lead
from heli2dof_core.design import FULL_RANK
from heli2dof_core.errors import InvalidInputError
from heli2dof_core.placement.assess import Assessment, assess, place_poles
from heli2dof_core.placement.full_rank import full_rank
from heli2dof_core.placement.groups import Group as CoreGroup
from heli2dof_core.placement.method import MOST_STATES, Weights, require_system
from heli2dof_core.placement.method import Method as CoreMethod
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.signals import Floats

from .fields import Pole, PositiveWeight, Strict, Weight, Whole
from .model import OF_GAINS, Complex, Finding, Model, Reply, reply_of, told_by

Row = Annotated[list[float], Field(min_length=1, max_length=MOST_STATES)]


Matrix = Annotated[list[Row], Field(min_length=1, max_length=MOST_STATES)]


Position = Annotated[Whole, Field(ge=0, lt=MOST_STATES)]


class PoleGroup(Strict):
    """A block of the closed loop: whose chains form it, and which poles it gets; positions from 0."""

    inputs: list[Position] = Field(max_length=MOST_STATES, description="positions from 0")
    poles: list[Position] = Field(max_length=MOST_STATES, description="positions from 0")


class SystemWeights(Strict):
    """Diagonals of Q, R and of the integrals' weight; ones where left out."""

    states: list[Weight] | None = Field(default=None, max_length=MOST_STATES, description="of Q, n")
    inputs: list[PositiveWeight] | None = Field(default=None, max_length=MOST_STATES, description="of R, p")
    integrals: list[PositiveWeight] | None = Field(
        default=None, max_length=MOST_STATES, description="of the integrated errors, one per row of C"
    )


class PlaceRequest(Strict):
    """Any system ẋ = Ax + Bu and its desired poles, row by row, in any units."""

    A: Matrix = Field(description="n×n, row by row")
    B: Matrix = Field(description="n×p, row by row")
    poles: list[Pole] = Field(
        min_length=1,
        max_length=MOST_STATES,
        description="n, in the unit of A; complex ones with their conjugates",
    )
    method: str = Field(default=FULL_RANK, json_schema_extra={"enum": [*METHODS]})
    groups: list[PoleGroup] | None = Field(
        default=None, max_length=MOST_STATES, description="full-rank: by default in the order of the poles"
    )
    input_order: list[Position] | None = Field(
        default=None, max_length=MOST_STATES, description="full-rank: order in which the inputs are scanned"
    )
    triangle: Literal["none", "lower", "upper"] = Field(
        default="none", description="full-rank: off-diagonal blocks that stay as the plant has them"
    )
    shift: Matrix | None = Field(default=None, description="full-rank: p×p, leading rows q → shift · q")
    C: Matrix | None = Field(default=None, description="lqr-integral: the outputs that it regulates")
    weights: SystemWeights = SystemWeights()

    def place(self) -> Assessment:
        """Places the poles.

        Raises:
            Heli2DofError: a shape or number does not fit, or the method cannot solve the task.
        """
        A, B, poles = require_system(array_of(self.A, "A"), array_of(self.B, "B"), self.poles)
        options = ("groups", "input_order", "triangle", "shift")
        if self.method == FULL_RANK:
            groups = None
            if self.groups is not None:
                groups = [CoreGroup(tuple(g.inputs), tuple(g.poles)) for g in self.groups]
            shift = None if self.shift is None else array_of(self.shift, "shift")
            placed = full_rank(
                A,
                B,
                poles,
                groups=groups,
                input_order=self.input_order,
                triangle=self.triangle,
                shift=shift,
            )
            return assess(A, B, poles, placed)
        for option in options:
            if option in self.model_fields_set:
                raise InvalidInputError(
                    f"{option} belongs to full-rank placement alone", field=option, hint="Leave it out."
                )
        n, p = B.shape
        C = None if self.C is None else array_of(self.C, "C", columns=n)
        weights = Weights(
            sized(self.weights.states, n, "weights.states"),
            sized(self.weights.inputs, p, "weights.inputs"),
            sized(self.weights.integrals, 0 if C is None else len(C), "weights.integrals"),
        )
        return place_poles(A, B, poles, self.method, C=C, weights=weights)


def array_of(rows: Sequence[Sequence[float]], field: str, *, columns: int | None = None) -> Floats:
    """A matrix of a request.

    Raises:
        InvalidInputError: its rows differ in length, or have not so many columns.
    """
    lengths = {len(row) for row in rows}
    if len(lengths) > 1 or (columns is not None and lengths != {columns}):
        raise InvalidInputError(
            f"the rows of {field} have {sorted(lengths)} entries",
            field=field,
            hint="Give a matrix row by row, all rows of the same length.",
        )
    return np.array(rows, dtype=float)


def sized(values: list[float] | None, size: int, field: str) -> tuple[float, ...]:
    """A diagonal of so many entries; ones where it is left out.

    Raises:
        InvalidInputError: it has another number of entries.
    """
    if values is not None and len(values) != size:
        raise InvalidInputError(f"{field} has {len(values)} entries, not {size}", field=field)
    return (1.0,) * size if values is None else tuple(values)


class Method(Model):
    """A placement method; `needs` names the package that it takes, `couplings` are full-rank's alone."""

    name: str
    title: str
    source: str
    places_poles: bool = Field(description="whether it takes the poles given, rather than choose its own")
    weighted: bool = Field(description="whether it minimizes a quadratic cost, by weights")
    integrates: bool = Field(description="whether it brings integral action, in place of the PI loops")
    available: bool
    couplings: list[str]
    leads: list[str]
    needs: str | None = None


class Group(Model):
    """A block of the closed loop: its inputs and its poles, by position from 0."""

    inputs: list[int] = Field(description="positions from 0")
    poles: list[int] = Field(description="positions from 0")


class Placement(told_by(OF_GAINS)):
    """K of u = −Kx + v for any system; T, Q, indices and groups with full-rank placement."""

    K: list[list[float]] = Field(description="p×n, rows are inputs")
    integral: list[list[float]] | None = Field(None, description="p×q, the method's own integral action")
    T: list[list[float]] | None = Field(None, description="n×n, x̄ = Tx")
    Q: list[list[float]] | None = Field(None, description="p×p")
    controllability_indices: list[int] | None = Field(None, description="one per input")
    groups: list[Group] | None = None
    closed_loop_poles: list[Complex]
    findings: list[Finding]


def methods_reply() -> list[Reply]:
    """All placement methods; structures apply to full-rank placement alone."""
    return [_method(method) for method in METHODS.values()]


def _method(method: CoreMethod) -> Reply:
    return reply_of(
        Method,
        method,
        available=method.needs is None or find_spec(method.needs) is not None,
        couplings=get_args(Coupling) if method.structured else (),
        leads=get_args(Lead) if method.structured else (),
    )


def assessment_reply(result: Assessment) -> Reply:
    """A placement of any system."""
    placement = result.placement
    return reply_of(
        Placement,
        result,
        K=placement.K,
        integral=placement.integral,
        pole_error_bound=None if result.pole_error is None else result.pole_error_bound,
        **placement.construction(),
    )
