"""The map: one figure over a plane of designs. What is asked and what is replied."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from heli2dof_core.figures.figure import Better
from heli2dof_core.many import SHARES
from heli2dof_core.maps import LARGEST_SIDE, DesignMap, Move, Scale, design_map
from heli2dof_core.measured import MEASURED, Axis, Motor, Steps
from heli2dof_core.requirements import told_measure
from heli2dof_core.scenario import Model as RigModel

from .experiment import THREADS, StepRequest
from .fields import Whole
from .model import Model, Reply
from .requirements import OfResponse
from .robustness import UncertainRigs, within_part

Figure = Annotated[str, Field(json_schema_extra={"enum": [*MEASURED, *SHARES]})]
Ends = Annotated[list[float], Field(min_length=2, max_length=2)]
Side = Annotated[Whole, Field(json_schema_extra={"minimum": 2, "maximum": LARGEST_SIDE})]


class MapAsked(OfResponse):
    """Which two numbers of the design are moved, over which places, and what is measured there."""

    measure: Figure = Field(default="settling_time", description="name of a figure of merit")
    move: Move = Field(description="a pair of poles, x ± jy, or k_p (x) and T_i (y) of an axis' PI loop")
    over: Annotated[list[Ends], Field(min_length=2, max_length=2)] | None = Field(
        default=None,
        description="[[x first, last], [y first, last]], rad/s, or V/rad and s; around the design where left out",
    )
    size: Annotated[list[Side], Field(min_length=2, max_length=2)] = Field(
        default=[64, 48], description="places along x and along y"
    )
    real: bool = Field(default=False, description="of a pair: both poles are real, x and y")
    scale: Scale | None = Field(default=None, description="of gains: log where left out; of poles: linear")
    uncertainty: UncertainRigs | None = Field(
        default=None, description="needed for shares of uncertain rigs, and used for them alone"
    )

    def told(self) -> dict[str, Any]:
        """What `requirements.measure_of` reads."""
        return self.model_dump(include={"measure", *OfResponse.model_fields}, exclude_none=True)


class MapRequest(StepRequest):
    """A design, an experiment, and what is mapped around them."""

    map: MapAsked

    def to_map(self, check: Callable[[], None]) -> DesignMap:
        """The map; `check` is called now and then, and what it raises ends the work.

        Raises:
            Heli2DofError: as `to_spec` and `maps.design_map`.
        """
        spec, asked = self.to_spec(), self.map
        with within_part("map", MapAsked):
            uncertainty = None if asked.uncertainty is None else asked.uncertainty.to_uncertainty()
            return design_map(
                spec,
                asked.move,
                asked.told(),
                asked.over,
                asked.size,
                real=asked.real,
                scale=asked.scale,
                uncertainty=uncertainty,
                threads=THREADS,
                check=check,
            )


class Place(Model):
    """Where the design itself stands in the plane, and what it has."""

    x: float = Field(description="rad/s, or k_p in V/rad")
    y: float = Field(description="rad/s, or T_i in s")
    value: float | None = Field(None, description="left out where it has none")
    unlimited: bool = Field(description="whether it has none because there is no limit")


class MapReply(Model):
    """A figure at every place; row j of the tables is at y[j]."""

    move: Move
    real: bool
    scale: Scale
    measure: str
    axis: Axis | None = None
    motor: Motor | None = None
    model: RigModel | None = None
    steps: Steps | None = None
    title: str = Field(description="the figure and its response in words")
    unit: str = Field(description="of the values; empty of ratios and shares (0 to 1)")
    better: Better = Field(description="which values are")
    x: list[float] = Field(description="rad/s, or k_p in V/rad")
    y: list[float] = Field(description="rad/s, or T_i in s")
    values: list[list[float]] = Field(description="0 where not valid")
    valid: list[list[bool]] = Field(description="whether the loop is stable and has such a figure")
    unlimited: list[list[bool]] = Field(
        description="whether it has none because there is no limit, which is as good as can be"
    )
    stable: list[list[bool]] = Field(description="whether the loop is stable")
    here: Place | None = Field(None, description="left out where the design is none of this plane")


def map_reply(found: DesignMap) -> Reply:
    """A map; its large tables are NumPy's."""
    plane, valid = found.plane, found.valid
    reply: Reply = {
        "move": plane.move,
        "real": plane.real,
        "scale": plane.scale,
        **told_measure(found.measure),
        "title": found.title,
        "unit": found.unit,
        "better": found.measure.figure.better,
        "x": found.x,
        "y": found.y,
        "values": np.where(valid, found.values, 0.0),
        "valid": valid,
        "unlimited": found.unlimited,
        "stable": found.stable,
    }
    here = found.here
    if here is not None:
        own: Reply = {"x": here[0], "y": here[1], "unlimited": bool(np.isinf(found.own))}
        reply["here"] = own | ({"value": found.own} if np.isfinite(found.own) else {})
    return reply


FileFormat = Literal["svg", "csv"]
MEDIA_TYPES: dict[FileFormat, str] = {"svg": "image/svg+xml", "csv": "text/csv; charset=utf-8"}


def map_file(found: DesignMap, kind: FileFormat) -> bytes:
    """A map as a file."""
    return (found.svg() if kind == "svg" else found.csv()).encode()
