"""Why not: the smallest moves with which a design meets what is required. What is asked and what is replied."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

from pydantic import Field

from heli2dof_core.errors import Heli2DofError, within_field
from heli2dof_core.measured import MEASURED
from heli2dof_core.nearest import CLOSEST, FARTHEST, WITHIN, Free, Handle, Move, Nearest, nearest
from heli2dof_core.requirements import MOST, requirements_of

from .design import Loops, loops_reply
from .experiment import StepRequest
from .fields import Strict
from .model import Complex, Model, Reply, poles_reply
from .requirements import LimitedFigure


class NearestAsked(Strict):
    """What is required, and what may move."""

    require: dict[str, LimitedFigure | Annotated[list[LimitedFigure], Field(max_length=MOST)]] = Field(
        max_length=MOST,
        json_schema_extra={"propertyNames": {"enum": [*MEASURED]}},
        description="by figure its limits, several in a list; none: the loop shall be stable",
    )
    free: list[Free] = Field(
        default=["poles", "loops"],
        min_length=1,
        max_length=6,
        description="what may move: poles, loops, or one pair or one axis' PI; what moves nothing is left out",
    )
    within: float = Field(
        default=WITHIN,
        json_schema_extra={"minimum": CLOSEST, "maximum": FARTHEST},
        description="how far is near, as the moves' distances",
    )


class NearestRequest(StepRequest):
    """A design, an experiment, and what is required of them."""

    nearest: NearestAsked

    def to_nearest(self, check: Callable[[], None]) -> Nearest:
        """What would have to move; `check` is called now and then, and what it raises ends the work.

        Raises:
            Heli2DofError: as `to_spec` and `nearest.nearest`.
        """
        spec, asked = self.to_spec(), self.nearest
        own = asked.model_dump(include={"require"}, exclude_none=True)["require"]
        with within_field("nearest.require"):
            requirements = requirements_of(own)
        try:
            return nearest(spec, requirements, asked.free, within=asked.within, check=check)
        except Heli2DofError as error:
            if error.field.partition(".")[0] in NearestAsked.model_fields:  # else it is of the design
                error.name_field(f"nearest.{error.field}")
            raise


class FigureOfMove(Model):
    """The value by which a requirement is judged."""

    value: float | None = Field(
        None, description="in the figure's unit; left out where there is none or no limit"
    )
    text: str = Field(description="as it is shown")
    met: bool


class Moved(Model):
    """Poles and loops of a design that is near."""

    poles: list[Complex] = Field(description="p₁, p₂ (pitch's pair), p₃, p₄ (yaw's), rad/s")
    rotor_poles: list[float] | None = Field(None, description="where they are placed, rad/s")
    loops: Loops


class MoveReply(Model):
    """A design near the one that was asked about."""

    handles: list[Handle] = Field(description="what moves")
    distance: float = Field(
        description="root of the squares' sum: each pole by what it moves, as a share of its distance from "
        "the origin, each gain and integral time by the logarithm of its ratio"
    )
    words: str = Field(description="what moves where")
    design: Moved
    figures: list[FigureOfMove] = Field(description="one of each requirement")


class RequirementTold(Model):
    """One requirement, and how the design stands to it."""

    words: str = Field(description="the figure and its response")
    limit: str = Field(description="as it is shown")
    now: FigureOfMove


class NearestReply(Model):
    """The moves, nearest first."""

    met: bool = Field(description="whether the design meets everything as it is, and is stable")
    requirements: list[RequirementTold]
    free: list[Handle] = Field(description="what was free and moves something in this design")
    moves: list[MoveReply] = Field(
        description="that meet everything: of all that is free, and of less where that is enough; each is proved "
        "by evaluate"
    )
    closest: MoveReply | None = Field(
        None,
        description="where no design near meets everything: the one, within reach, that misses the least",
    )
    out_of_reach: list[int] = Field(description="positions of requirements that no design near has met")
    excluding: list[list[int]] | None = Field(
        None,
        description="pairs of positions of requirements whose limits exclude one another; left out where there are "
        "none",
    )
    summary: str = Field(description="in words: where there is no move, all that the closest misses")
    within: float = Field(description="how far was looked")
    tried: int = Field(description="designs that were looked at")


def nearest_reply(found: Nearest) -> Reply:
    """The moves, or why there is none."""
    reply: Reply = {
        "met": found.met,
        "requirements": [
            {"words": own.words, "limit": own.limit_text, "now": now}
            for own, now in zip(found.requirements, _figures(found.now), strict=True)
        ],
        "free": [*found.free],
        "moves": [_move(move) for move in found.moves],
        "out_of_reach": [*found.out_of_reach],
        "summary": found.summary(),
        "within": found.within,
        "tried": found.tried,
    }
    if found.excluding:
        reply["excluding"] = [[*pair] for pair in found.excluding]
    if found.closest is not None:
        reply["closest"] = _move(found.closest)
    return reply


def _move(move: Move) -> Reply:
    spec = move.spec
    design: Reply = {"poles": poles_reply(spec.poles.values), "loops": loops_reply(spec.outer)}
    if spec.place_rotors:
        design["rotor_poles"] = [*spec.rotor_poles]
    return {
        "handles": [*move.handles],
        "distance": move.distance,
        "words": move.words,
        "design": design,
        "figures": _figures(move),
    }


def _figures(move: Move) -> list[Reply]:
    each = zip(move.values, move.shown, move.meets, strict=True)
    return [
        {"text": text, "met": met} | ({} if value is None else {"value": value}) for value, text, met in each
    ]
