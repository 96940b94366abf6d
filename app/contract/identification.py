"""Identification over the socket: what is asked of a recording, and what is replied."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

from pydantic import Field

from heli2dof_core import Spec
from heli2dof_core.recordings.identification import (
    FREE,
    HELD_OUT,
    MOST_HELD_OUT,
    Identification,
    Progress,
    identify,
)
from heli2dof_core.recordings.recording import Recording
from heli2dof_core.recordings.validation import Agreement
from heli2dof_core.request import FRICTION, ROTOR

from .design import DesignRequest
from .fields import Whole
from .model import Finding, Model, Reply
from .presets import FrictionPair, RotorPair
from .recordings import Courses, Mapping, PerAxis, courses, gapped, kept_rows, machine_of, per_axis


class IdentifyRequest(DesignRequest):
    """A rig as it is thought to be, its rotors and friction too, and what of it is free."""

    recording: str = Field(max_length=64)
    columns: Mapping
    free: list[Annotated[str, Field(json_schema_extra={"enum": [*FREE]})]] | None = Field(
        default=None,
        max_length=len(FREE),
        description="thrust constants, damping and stiffness by default, K_s only where it is not 0; names with "
        "dots are those of a request: time constants of rotors, and friction; J_p and J_y scale with thrust and "
        "damping of their axis",
    )
    segment: float | None = Field(
        default=None, ge=0.1, le=1e4, description="s; by default by the rig's stability"
    )
    held_out: float = Field(
        default=HELD_OUT,
        ge=0,
        le=MOST_HELD_OUT,
        description="share of the recording's time, its end, that is not fitted but held against the result",
    )


class EstimateReply(Model):
    """A parameter in SI units with its 95 % interval, which allows for what the model leaves out."""

    name: str = Field(description="of the rig's parameter, or its place in a request: rotors.pitch.tau")
    unit: str
    before: float
    value: float
    low: float
    high: float
    noise: float = Field(description="half width of the interval of a model that leaves nothing out")
    plain: float = Field(description="likewise, if residuals were white")
    adopted: float


class AgreementReply(Model):
    """How near a rig comes to what was measured."""

    fit: PerAxis = Field(description="100 (1 − ‖y − ŷ‖/‖y − ȳ‖), %")
    variance: PerAxis = Field(description="accounted for, 100 (1 − var(y − ŷ)/var y), %")
    rms: PerAxis = Field(description="of the residuals, rad")


class PartReply(Model):
    """A part of the recording."""

    held_out: bool = Field(description="whether it was not fitted, but held against the result")
    first: float = Field(description="where it begins, s")
    end: float = Field(description="s")
    segments: Whole = Field(description="that were simulated in it")
    before: AgreementReply | None = Field(description="of the rig as it was; null where it runs away")
    after: AgreementReply = Field(description="of the rig as it was found")


class FittedCourses(Model):
    """Angles, and what is left of them, at no more than 1500 of the recording's times; null between segments."""

    t: list[float] = Field(description="s")
    measured: Courses
    before: Courses = Field(description="of the rig as it was")
    after: Courses = Field(description="of the rig as it was found")
    residuals: Courses = Field(description="measured minus found")


class WhitenessReply(Model):
    """Correlations of the fitted residuals of one axis, 1, 2, … samples apart, and Ljung and Box's test of them."""

    white: bool = Field(description="whether nothing speaks against it")
    probability: float = Field(description="with which white residuals would be correlated as much")
    correlations: list[float] = Field(description="shares of the residuals' power")
    band: float = Field(description="99 % of those of white residuals lie within ± so much")
    span: float = Field(description="over which they are correlated visibly, s")


class WhitenessPair(Model):
    """Of both axes."""

    theta: WhitenessReply
    psi: WhitenessReply


class IdentificationReply(Model):
    """The result over the socket; before it come `{"evaluations", "rms"}`."""

    done: bool
    estimates: list[EstimateReply]
    rotors: RotorPair = Field(
        description="with what was found, as a request takes them; quadratic curves say where they are matched"
    )
    friction: FrictionPair = Field(description="likewise")
    rms_before: PerAxis | None = None
    rms: PerAxis
    parts: list[PartReply] = Field(description="what was fitted, then what was held out where something was")
    courses: FittedCourses
    whiteness: WhitenessPair
    sample_time: float = Field(description="of the recording, s")
    segments: int
    lags: float
    evaluations: int
    seconds: float
    findings: list[Finding]


def identified(
    request: IdentifyRequest,
    spec: Spec,
    recording: Recording,
    report: Callable[[Progress], None] = lambda progress: None,
    wanted: Callable[[], None] = lambda: None,
) -> Identification:
    """What the recording says about the rig of `spec`, which is the request's.

    Raises:
        InvalidInputError: what shall be free cannot be.
        RecordingError: the recording does not say what is asked of it.
    """
    return identify(
        spec.parameters,
        recording,
        request.free,
        segment=request.segment,
        held_out=request.held_out,
        travel=spec.limits.theta,
        report=report,
        wanted=wanted,
        **machine_of(spec),
    )


def progress_reply(progress: Progress) -> Reply:
    """How far the search is."""
    return {"done": False, "evaluations": progress.evaluations, "rms": per_axis(progress.rms)}


def identification_reply(found: Identification, recording: Recording) -> Reply:
    """What was found."""
    kept = kept_rows(recording)
    own = {
        "measured": recording.angles[kept],
        "before": gapped(found.before, found.bounds, kept),
        "after": gapped(found.after, found.bounds, kept),
        "residuals": gapped(recording.angles - found.after, found.bounds, kept),
    }
    return {
        "done": True,
        "estimates": [{**vars(e), "adopted": e.allowed} for e in found.estimates],
        "rotors": {axis: place.proposal(getattr(found.rotors, axis)) for axis, place in ROTOR.items()},
        "friction": {axis: place.proposal(getattr(found.friction, axis)) for axis, place in FRICTION.items()},
        "rms_before": None if found.rms_before is None else per_axis(found.rms_before),
        "rms": per_axis(found.rms),
        "parts": [
            {
                "held_out": i > 0,
                "first": part.first,
                "end": part.end,
                "segments": part.segments,
                "before": None if part.before is None else _agreement(part.before),
                "after": _agreement(part.after),
            }
            for i, part in enumerate(found.parts)
        ],
        "courses": {"t": recording.t[kept], **{name: courses(angles) for name, angles in own.items()}},
        "whiteness": {
            axis: {
                "white": tested.white,
                "probability": tested.probability,
                "correlations": tested.correlations,
                "band": tested.band,
                "span": tested.span * recording.sample_time,
            }
            for axis, tested in zip(("theta", "psi"), found.whiteness, strict=True)
        },
        "sample_time": recording.sample_time,
        "segments": len(found.segments),
        "lags": found.lags,
        "evaluations": found.evaluations,
        "seconds": found.seconds,
        "findings": [vars(finding) for finding in found.findings],
    }


def _agreement(own: Agreement) -> Reply:
    return {"fit": per_axis(own.fit), "variance": per_axis(own.variance), "rms": per_axis(own.rms)}
