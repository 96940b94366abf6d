"""One number swept: what is asked and what is replied."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from heli2dof_core.errors import within_field
from heli2dof_core.many import Measure
from heli2dof_core.measured import MEASURED
from heli2dof_core.requirements import measure_of, told_measure
from heli2dof_core.signals import Floats
from heli2dof_core.tracks import FEWEST, MOST, MOST_MEASURES, Scale, Track, known_paths, track

from .experiment import THREADS, StepRequest
from .fields import Strict, Whole
from .model import Complex, Model, Reply, poles_reply, present
from .requirements import OfResponse

Value = Annotated[float, Field(ge=-1e6, le=1e6)]


class TrackedFigure(OfResponse):
    """A figure of merit, and of which response."""

    measure: str = Field(json_schema_extra={"enum": [*MEASURED]})

    def to_measure(self) -> Measure:
        """The core's; of both axes where none is named.

        Raises:
            InvalidInputError: there is no such figure, or none of such a response.
        """
        return measure_of(self.model_dump(exclude_none=True))


class TrackOptions(Strict):
    """Which number is swept, over what, and what is found along it."""

    path: str = Field(
        default="gain",
        json_schema_extra={"enum": [*known_paths()]},
        description="of a number in a request, such as loops.pitch.kp, rotors.pitch.tau, parameters.m, "
        "operating_point.theta; or gain, gain.pitch, gain.yaw (factor on the motors' voltages: 0 opens "
        "the loop, 1 is the design), poles.0 to poles.3, pitch-pair.re, .im, .frequency, .damping "
        "(yaw-pair alike), poles.factor, rotors.tau (both)",
    )
    over: list[Value] | None = Field(
        default=None,
        min_length=2,
        max_length=2,
        description="lowest and highest value, in the number's unit; by default around its present one",
    )
    points: Whole = Field(
        default=200,
        ge=FEWEST,
        le=MOST,
        description="values asked for; more are added where poles move fast or meet",
    )
    scale: Scale = Field(default="linear", description="even steps, or equal factors")
    kept: bool = Field(
        default=False,
        description="the gains stay and only the rig changes; else each value has a design of its own",
    )
    measures: list[TrackedFigure] = Field(
        default=[], max_length=MOST_MEASURES, description="figures that are found at each value"
    )


class TrackRequest(StepRequest):
    """A design with its experiment, and the number that is swept."""

    track: TrackOptions = TrackOptions()

    def to_track(self, check: Callable[[], None] = lambda: None) -> Track:
        """Sweeps it.

        Raises:
            Heli2DofError: as `heli2dof_core.tracks.track`.
        """
        own, measures = self.track, []
        for i, figure in enumerate(own.measures):
            with within_field(f"track.measures.{i}"):
                measures.append(figure.to_measure())
        over = None if own.over is None else (own.over[0], own.over[1])
        return track(
            self.to_spec(),
            own.path,
            over,
            own.points,
            measures,
            scale=own.scale,
            kept=own.kept,
            threads=THREADS,
            check=check,
        )


class Crossed(Model):
    """Where a pole, and its conjugate with it, passes the border of stability."""

    value: float = Field(description="of the number, in its unit, found to 1e-9 of it")
    pole: Complex = Field(description="with Im ≥ 0, rad/s or in the z-plane")
    outwards: bool = Field(description="whether it leaves the stable side as the number grows")


class FigureTrack(Model):
    """A figure at each value; where there is none it is 0, and `valid` says so."""

    measure: str
    axis: str | None = None
    motor: str | None = None
    model: str | None = None
    steps: str | None = None
    words: str = Field(description="what is measured")
    unit: str
    values: list[float] = Field(description="one per value of the number, in `unit`")
    valid: list[bool] = Field(
        description="whether there is one: not where unstable, not settled or unlimited"
    )
    unlimited: list[bool] | None = Field(
        None, description="whether it has no limit; left out where that is nowhere"
    )


class TrackReply(Model):
    """Poles of the whole loop and figures over one number."""

    path: str
    meaning: str
    unit: str
    symbol: str | None = None
    now: float | None = Field(None, description="the design's own value; left out where it has none")
    low: float | None = Field(None, description="least value that the number may have")
    high: float | None = Field(None, description="largest one")
    plane: Literal["s", "z"] = Field(description="z where sample times are swept: s = ln z/Ts")
    values: list[float] = Field(description="ascending, those of which there is a loop")
    starts: list[int] = Field(description="positions in `values` at which a stretch without gaps begins")
    poles: list[list[Complex]] = Field(
        description="per pole its course over `values`, rad/s or in the z-plane"
    )
    stable: list[bool] = Field(description="one per value")
    on_border: list[bool] = Field(
        description="whether it is not stable, but no pole lies beyond the border of stability either: some lie on it"
    )
    crossings: list[Crossed] = Field(description="of the border of stability, by value")
    zeros: list[Complex] = Field(description="where branches end as a gain grows without limit, rad/s")
    figures: list[FigureTrack] = Field(description="in the order of the request's measures")


def track_reply(found: Track) -> Reply:
    """A track as JSON."""
    about = found.number.quantity
    return {
        **present(
            {"symbol": about.symbol or None, "now": found.number.now, "low": about.low, "high": about.high}
        ),
        "path": found.number.path,
        "meaning": about.meaning,
        "unit": about.unit,
        "plane": found.plane,
        "values": found.values,
        "starts": list(found.starts),
        "poles": [poles_reply(course) for course in found.poles.T],
        "stable": found.stable,
        "on_border": found.on_border,
        "crossings": [
            {"value": c.value, "pole": {"re": c.pole.real, "im": c.pole.imag}, "outwards": c.outwards}
            for c in found.crossings
        ],
        "zeros": poles_reply(found.zeros),
        "figures": [
            _figure(measure, np.ascontiguousarray(values))
            for measure, values in zip(found.measures, found.figures.T, strict=True)
        ],
    }


def _figure(measure: Measure, values: Floats) -> Reply:
    own, valid = told_measure(measure), np.isfinite(values)
    if np.isinf(values).any():
        own["unlimited"] = np.isinf(values)
    return {
        **own,
        "words": measure.words,
        "unit": measure.figure.unit,
        "values": np.where(valid, values, 0.0),
        "valid": valid,
    }
