"""What is asked of the finder."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from math import inf
from typing import Annotated, Any

from pydantic import Field

from heli2dof_core.errors import Heli2DofError
from heli2dof_core.finder import Bounds, Designs, Find, Free, Progress, find_in_parts
from heli2dof_core.finder.ask import LONGEST_SEARCH, MOST_DESIGNS, MOST_MINIMIZED, SHORTEST_SEARCH
from heli2dof_core.many import SHARES
from heli2dof_core.measured import MEASURED
from heli2dof_core.requirements import MOST, measure_of, requirements_of

from .experiment import THREADS, StepRequest
from .fields import Strict, Whole
from .requirements import LimitedFigure, OfResponse
from .robustness import UncertainRigs, within_part

FIGURES = (*MEASURED, *SHARES)


class RequiredFigure(LimitedFigure):
    """Limits of one figure, on the nominal rig and on a share of uncertain ones."""

    share: float | None = Field(
        default=None,
        json_schema_extra={"minimum": 0.0, "maximum": 1.0},
        description="least share of the uncertain rigs that meet them, beside the nominal one",
    )


class MinimizedFigure(OfResponse):
    """A figure that is made as good as it can be."""

    measure: Annotated[str, Field(json_schema_extra={"enum": [*FIGURES]})]


_Range = Annotated[list[float], Field(min_length=2, max_length=2)]


class FindBounds(Strict):
    """How far what is free may go, [least, largest]; what is left out follows from the design."""

    poles: _Range | None = Field(default=None, description="size of a pole, rad/s")
    damping: float = Field(
        default=0.3,
        json_schema_extra={"minimum": 1e-6, "maximum": 1.0},
        description="least damping ratio of a complex pair",
    )
    rotor_poles: _Range | None = Field(default=None, description="size of a rotor's pole, rad/s")
    kp: _Range | None = Field(default=None, description="proportional gains, V/rad")
    ti: _Range | None = Field(default=None, description="integral times, s")
    shift: _Range = Field(default=[-1.0, 1.0], description="shift c of Luenberger's basis")
    observer: _Range | None = Field(default=None, description="size of an observer's pole, rad/s")
    weights: _Range = Field(default=[1e-2, 1e2], description="factors on the present weights")


class FindOptions(Strict):
    """What is free, what is required, and what is made as good as can be."""

    free: list[Free] = Field(default=["poles"], min_length=1, max_length=9, description="what may change")
    require: dict[str, RequiredFigure | Annotated[list[RequiredFigure], Field(max_length=MOST)]] = Field(
        default={},
        max_length=MOST,
        json_schema_extra={"propertyNames": {"enum": [*FIGURES]}},
        description="by figure its limits, several in a list",
    )
    minimize: list[Annotated[str, Field(json_schema_extra={"enum": [*FIGURES]})] | MinimizedFigure] = Field(
        default=[],
        max_length=MOST_MINIMIZED,
        description="figures that are made as small as they can be, or as large where more is better; each once",
    )
    uncertainty: UncertainRigs | None = Field(default=None, description="needed for shares of uncertain rigs")
    bounds: FindBounds = FindBounds()
    designs: Annotated[Whole, Field(json_schema_extra={"minimum": 100, "maximum": MOST_DESIGNS})] = Field(
        default=20_000,
        description="how many are tried, at most; one on uncertain rigs counts as many as there are rigs",
    )
    seconds: float = Field(
        default=60.0,
        json_schema_extra={"minimum": SHORTEST_SEARCH, "maximum": LONGEST_SEARCH},
        description="after which the search ends in any case; a server gives it at most three quarters of the time "
        "of a slow job",
    )
    seed: Annotated[Whole, Field(json_schema_extra={"minimum": 0, "maximum": 2**32 - 1})] = Field(
        default=0, description="the same seed gives the same designs"
    )

    def to_find(self) -> Find:
        """The core's.

        Raises:
            InvalidInputError: something is unknown or out of its range.
        """
        own = self.model_dump(exclude_unset=True, exclude_none=True)
        given = {name: own[name] for name in ("designs", "seconds", "seed") if name in own}
        bounds: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value
            for name, value in own.get("bounds", {}).items()
        }
        return Find(
            free=tuple(self.free),
            require=_read("require", lambda: requirements_of(own.get("require", {}))),
            minimize=tuple(
                _read(f"minimize.{i}", lambda one=one: measure_of(one))
                for i, one in enumerate(own.get("minimize", ()))
            ),
            uncertainty=None if self.uncertainty is None else self.uncertainty.to_uncertainty(),
            bounds=Bounds(**bounds),
            **given,
        )


def _read(path: str, make: Callable[[], Any]) -> Any:
    try:
        return make()
    except Heli2DofError as error:
        error.name_field(f"{path}.{error.field}".rstrip("."))
        raise


class FindRequest(StepRequest):
    """A design, an experiment, and what is sought around them."""

    find: FindOptions

    def in_parts(self, check: Callable[[], None], seconds: float = inf) -> Iterator[Progress | Designs]:
        """Searches.

        Args:
            check: called now and then; what it raises ends the work.
            seconds: for which it searches at most, whatever is asked for.

        Raises:
            Heli2DofError: as `to_spec` and `finder.find`.
        """
        spec = self.to_spec()
        with within_part("find", FindOptions):
            ask = self.find.to_find()
            ask = replace(ask, seconds=max(min(ask.seconds, seconds), SHORTEST_SEARCH))
            yield from find_in_parts(spec, ask, check, THREADS)
