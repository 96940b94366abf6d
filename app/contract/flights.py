"""Flights: the log that is sent, and the course that is made of it."""

from __future__ import annotations

import base64
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field, WrapValidator

from heli2dof_core.errors import InvalidInputError, Wanted, nobody_leaves, within_field
from heli2dof_core.export.flights import flight_recording
from heli2dof_core.flight import (
    FlightController,
    FlightCourse,
    FlightLog,
    Takeover,
    ThinFlight,
    sampled_flight,
    thin_flight,
)
from heli2dof_core.flight.log import (
    LARGEST_SEED,
    LONGEST_NAME,
    MOST_EVENTS,
    MOST_TICKS,
)
from heli2dof_core.flight.scores import score
from heli2dof_core.flight.task_flights import require_task
from heli2dof_core.flight.tasks import told
from heli2dof_core.flight.tasks.task import FlightTask as CoreTask
from heli2dof_core.flight.thin import FEWEST_SAMPLES, MOST_KEPT, MOST_SAMPLES, require_kept
from heli2dof_core.kernels.flight_layout import (
    ON_STOP,
    OUTSIDE,
    SENSED,
    SPEED,
    STATE,
    UNLIMITED,
    VOLTAGE,
    WISH,
)
from heli2dof_core.signals import Floats

from .experiment import StepRequest
from .fields import Strict, Whole
from .model import Model, Reply, Voltages, voltages_reply

SAMPLES = 2001
"""Of a course that is replied, where nobody asks for another number."""


class FlightBody(Strict):
    """A flight as it was flown: from this alone it is made again. docs/flights.md has its words."""

    flight: Literal[1] = Field(description="version of the format")
    design: StepRequest = Field(description="rig, design, and where the experiment begins")
    ticks: Whole = Field(ge=1, le=MOST_TICKS, description="how many were flown")
    events: list[list[Any]] = Field(
        default=[],
        max_length=MOST_EVENTS,
        description="[tick, word, values …] in order; the value of `design` is a design; rad, rad/s, V, N·m",
    )
    seed: Whole = Field(default=0, ge=0, le=LARGEST_SEED, description="of the noise on measured angles")
    checks: list[Annotated[list[float], Field(min_length=5, max_length=5)]] = Field(
        default=[], description="[tick, θ, ψ, θ̇, ψ̇]: states on the way, rad and rad/s"
    )
    task: str = Field(default="", max_length=LONGEST_NAME, description="that was flown; empty without one")
    checksum: str = Field(min_length=8, max_length=8, description="CRC-32 of all else, see docs/flights.md")


class OfFlight(Strict):
    """A flight."""

    # The core judges it as it stands: its checksum is that of what was sent, not of what a model would make of it.
    flight: Annotated[FlightBody, WrapValidator(lambda value, _handler: value)]

    def to_log(self) -> FlightLog:
        """The core's.

        Raises:
            InvalidInputError: it is none, or it was changed.
        """
        with within_field("flight"):
            return FlightLog.read(self.flight)


class FlightRequest(OfFlight):
    """A flight, and how much of its course is replied."""

    samples: Whole = Field(
        default=SAMPLES,
        ge=FEWEST_SAMPLES,
        le=MOST_SAMPLES,
        description="of the course, at most: every n-th tick, and the last state",
    )

    def to_reply(self, wanted: Wanted) -> Reply:
        """Makes it again, and says what it is worth where its whole course can be kept.

        Raises:
            Heli2DofError: see `heli2dof_core.flight.fly_log`.
        """
        log = self.to_log()
        with within_field("flight"):
            return log_reply(log, self.samples, wanted)


class FlightNumbersRequest(OfFlight):
    """A flight whose numbers are wanted as a file."""

    every: Whole = Field(
        default=1, ge=1, le=100_000, description=f"tick that is told; at most {MOST_KEPT:,} rows are"
    )

    def to_flight(self, wanted: Wanted) -> ThinFlight:
        """Makes it again.

        Raises:
            Heli2DofError: as above, or there are too many rows.
        """
        log = self.to_log()
        require_kept(log, self.every)
        with within_field("flight"):
            return thin_flight(log, self.every, wanted=wanted)


class FlightRecordingRequest(OfFlight):
    """A flight that is to be a recording."""

    whole: bool = Field(
        default=False,
        description="whether samples stay in which something pushed the body or an encoder stuck",
    )

    def to_recording(self, wanted: Wanted) -> bytes:
        """CSV of it.

        Raises:
            Heli2DofError: see `heli2dof_core.export.flights.flight_recording`.
        """
        log = self.to_log()
        with within_field("flight"):
            return flight_recording(log, whole=self.whole, wanted=wanted)


class FlightFilmRequest(OfFlight):
    """A flight to be played by the rig."""

    begin: float = Field(default=0.0, ge=0.0, le=1e4, description="of the film, s into the flight")
    end: float | None = Field(default=None, ge=0.0, le=1e4, description="of the film, s; null: the flight's")

    def to_flight(self, wanted: Wanted) -> ThinFlight:
        """Makes it again, with enough rows for a film.

        Raises:
            Heli2DofError: see `heli2dof_core.flight.fly_log`.
        """
        log = self.to_log()
        with within_field("flight"):
            return sampled_flight(log, MOST_SAMPLES, wanted=wanted)


class AxesCourse(Model):
    """A course for each axis."""

    theta: list[float] = Field(description="of pitch; rad, or N·m of torques")
    psi: list[float] = Field(description="of yaw; rad, or N·m of torques")


class MeasuredCourse(Model):
    """What the controller knew at its last sample."""

    theta: list[float] = Field(description="rad")
    psi: list[float] = Field(description="rad")
    theta_dot: list[float] = Field(description="rad/s")
    psi_dot: list[float] = Field(description="rad/s")


class AskedCourse(Model):
    """What the controller or a hand asked of the motors, before their limits."""

    V_p: list[float] = Field(description="V")
    V_y: list[float] = Field(description="V")


class SpeedsCourse(Model):
    """The rotors' speeds, as the voltages that would hold them."""

    v_p: list[float] = Field(description="V")
    v_y: list[float] = Field(description="V")


class ControllerChange(Model):
    """How a controller took over in the air."""

    tick: int = Field(description="when it did: at the first sample behind the event")
    time: float = Field(description="s")
    jump: Voltages
    jump_without: Voltages = Field(description="what it would have been with the integrals as they were")
    bumpless: bool = Field(description="whether the integrals drive both motors, so that neither need jump")


class AxisFigures(Model):
    """A figure of each axis, in the registry's unit."""

    theta: float = Field(description="of pitch")
    psi: float = Field(description="of yaw")


class FlightScore(Model):
    """What a flight is worth; without a task its own set points are what was asked."""

    values: dict[str, float | AxisFigures] = Field(
        description="by figure, in the registry's units (SI); what there is not is left out"
    )
    stars: int = Field(description="of the task, 0 to 3; 0 without one")
    done: bool = Field(description="whether the task has come to its end")
    flaw: str = Field(description="why the flight does not count as its task; empty if it does, or has none")


class FlightReply(Model):
    """A flight as the server makes it again."""

    ticks: int = Field(description="that were flown")
    duration: float = Field(description="s")
    every: int = Field(description="tick of which the course tells")
    t: list[float] = Field(description="s; the last is that of the last state")
    theta: list[float] = Field(description="pitch, rad")
    psi: list[float] = Field(description="yaw, rad")
    theta_dot: list[float] = Field(description="rad/s")
    psi_dot: list[float] = Field(description="rad/s")
    V_p: list[float] = Field(description="of the pitch motor, V")
    V_y: list[float] = Field(description="of the yaw motor, V")
    measured: MeasuredCourse
    asked: AskedCourse
    speeds: SpeedsCourse
    references: AxesCourse
    torques: AxesCourse = Field(description="from outside: hands and gusts")
    stops: list[int] = Field(description="stop that pitch rests on: 1 the upper, −1 the lower, 0 none")
    changes: list[ControllerChange] = Field(description="of the controller, in order")
    ended: str = Field(description="why the flight ended by itself; empty if it did not")
    apart: float = Field(
        description="how far the log's own states are from these at most, rad and rad/s; 0 without any"
    )
    score: FlightScore | None = Field(
        None, description=f"left out of a flight of more than {MOST_KEPT:,} ticks"
    )
    hash: str = Field(description="SHA-256 of all rows that were flown, as little-endian 64-bit floats")


def log_reply(log: FlightLog, samples: int, wanted: Wanted = nobody_leaves) -> Reply:
    """A flight made again as JSON, with what it is worth where its whole course can be kept.

    Raises:
        Heli2DofError: see `heli2dof_core.flight.fly_log`.
    """
    if log.ticks > MOST_KEPT:
        return flight_reply(sampled_flight(log, samples, wanted=wanted))
    whole = thin_flight(log, wanted=wanted)
    return flight_reply(whole.thinned(samples)) | {"score": score_reply(whole.course())}


def flight_reply(flight: ThinFlight) -> Reply:
    """A course as JSON."""
    own = flight.flown

    def columns(names: tuple[str, ...], at: int) -> dict[str, Floats]:
        return {name: np.ascontiguousarray(flight.rows[:, at + i]) for i, name in enumerate(names)}

    angles, motors = ("theta", "psi"), ("V_p", "V_y")
    states = (*angles, "theta_dot", "psi_dot")
    return {
        "ticks": own.ticks,
        "duration": own.duration,
        "every": flight.every,
        "t": flight.t,
        **columns(states, STATE),
        **columns(motors, VOLTAGE),
        "measured": columns(states, SENSED),
        "asked": columns(motors, UNLIMITED),
        "speeds": columns(("v_p", "v_y"), SPEED),
        "references": columns(angles, WISH),
        "torques": columns(angles, OUTSIDE),
        "stops": flight.rows[:, ON_STOP].astype(np.int64),
        "changes": [_change(change) for change in own.takeovers],
        "ended": own.ended,
        "apart": own.apart,
        "hash": flight.digest,
    }


def score_reply(course: FlightCourse) -> Reply:
    """What a whole course is worth; who flew no fair task has no stars, and is told why."""
    found, flaw = score(course), ""
    if course.log.task:
        try:
            require_task(course)
        except InvalidInputError as error:
            flaw = f"{error}"
    return {"values": found.values, "stars": 0 if flaw else found.stars, "done": found.done, "flaw": flaw}


def _change(change: Takeover) -> Reply:
    return {
        "tick": change.tick,
        "time": change.time,
        "jump": voltages_reply(change.jump),
        "jump_without": voltages_reply(change.jump_without),
        "bumpless": change.bumpless,
    }


class ControllerReply(Model):
    """A design's numbers, of which the kernel `flight_controller` makes the controller that flies."""

    numbers: str = Field(description="little-endian 64-bit floats, NaN and infinities among them, in base64")
    stable: bool = Field(description="whether the linear loop is")


def controller_reply(found: FlightController) -> Reply:
    """A controller's numbers as text, since JSON has no infinities."""
    content = np.ascontiguousarray(found.numbers, dtype="<f8").tobytes()
    return {"numbers": base64.b64encode(content).decode(), "stable": found.stable}


class FlightTask(Model):
    """A task in the air."""

    name: str = Field(description="in logs")
    title: str
    words: str = Field(description="what is to be done")
    duration: float = Field(description="s; with marks to be reached, at most")
    marks: list[Annotated[list[float], Field(min_length=3, max_length=3)]] = Field(
        description="[time (s), θ − θ₀ as a share of the task's reach, ψ (rad)], in between smoothly"
    )
    figure: str = Field(description="by which stars are given; lower is better")
    figures: list[str] = Field(description="that are told, it first")
    stars: list[float] = Field(description="its limits for one, two and three stars")
    gusts: int = Field(description="that come, by the log's seed")
    strength: float = Field(description="of their torques, as a share of what a motor's limit gives")
    free: bool = Field(description="whether set points are the pilot's")
    ends: Literal["", "landed", "reached"] = Field(description="how it is done before its time")
    pilots: int = Field(description="whose hands share it")
    per_square_volt: bool = Field(
        description="whether these limits are times V_p,max² + V_y,max² of the rig, V²"
    )


def task_reply(task: CoreTask) -> Reply:
    """A task as JSON."""
    return told(task)
