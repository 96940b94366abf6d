"""POST flights: a flight's log in; out comes what was flown, or a file of it."""

from __future__ import annotations

import numpy as np
from fastapi import APIRouter, Response

from heli2dof_core.errors import InvalidInputError
from heli2dof_core.export.flights import flight_csv, flight_mat
from heli2dof_core.flight import FlightController, ThinFlight
from heli2dof_core.flight.tasks import TASKS
from heli2dof_core.kernels.flight_layout import STATE, VOLTAGE, WISH
from heli2dof_core.presets import DEFAULT
from heli2dof_core.request import spec_of

from ..contract.encoding import described_files, json_bytes, json_content, json_response
from ..contract.experiment import StepRequest
from ..contract.flights import (
    ControllerReply,
    FlightFilmRequest,
    FlightNumbersRequest,
    FlightRecordingRequest,
    FlightReply,
    FlightRequest,
    FlightTask,
    controller_reply,
    task_reply,
)
from ..contract.model import Reply, described
from ..jobs.compute import Compute, check_cancelled
from ..scene.motion import motion_file
from ..scene.poses import Motion
from .kernels import wait_for_kernels
from .motion import of_rig

_BINARY = {"schema": {"type": "string", "format": "binary"}}
FILM_FRAMES = 5400
"""Of a film at most: three minutes at thirty a second; a longer one has fewer a second."""
_PLAYED = (STATE, STATE + 1, VOLTAGE, VOLTAGE + 1, WISH, WISH + 1)
SHORTEST_FILM = 0.1
"""s."""


def build_router(compute: Compute) -> APIRouter:
    """The routes flights under /api/v1."""
    router = APIRouter(prefix="/api/v1/flights", tags=["flights"])

    @router.post("", **described(FlightReply, "The flight made again from its log, by the same kernel"))
    async def fly(request: FlightRequest) -> Response:
        await wait_for_kernels()
        return json_content(await compute.run_slow(_course, request))

    @router.get("/tasks", **described(list[FlightTask], "The tasks in the air"))
    async def tasks() -> Response:
        return json_response([task_reply(task) for task in TASKS.values()])

    @router.post(
        "/controller",
        **described(
            ControllerReply, "A design's numbers, for a page that makes a flight's controller of them"
        ),
    )
    async def controller(request: StepRequest) -> Response:
        def work() -> Reply:
            return controller_reply(FlightController.of(request.to_spec()))

        return json_response(await compute.run(work))

    @router.post(
        "/csv", **described_files("A flight's course as numbers, a row per tick", {"text/csv": _BINARY})
    )
    async def csv(request: FlightNumbersRequest) -> Response:
        await wait_for_kernels()
        return _file(await compute.run_slow(_csv, request), "text/csv; charset=utf-8", "flight.csv")

    @router.post(
        "/mat",
        **described_files(
            "A flight's course for MATLAB and Octave, with its log", {"application/x-matlab-data": _BINARY}
        ),
    )
    async def mat(request: FlightNumbersRequest) -> Response:
        await wait_for_kernels()
        return _file(await compute.run_slow(_mat, request), "application/x-matlab-data", "flight.mat")

    @router.post(
        "/recording",
        **described_files(
            "A flight as a laboratory would have recorded it: CSV that POST recordings takes",
            {"text/csv": _BINARY},
        ),
    )
    async def recording(request: FlightRecordingRequest) -> Response:
        await wait_for_kernels()
        return _file(await compute.run_slow(_recording, request), "text/csv; charset=utf-8", "recording.csv")

    @router.post(
        "/film",
        **described_files("A flight as a page that plays it offline in 3D", {"text/html": _BINARY}),
    )
    async def film(request: FlightFilmRequest) -> Response:
        await wait_for_kernels()
        return _file(await compute.run_slow(_film, request), "text/html; charset=utf-8", "flight.html")

    return router


def _file(content: str | bytes, media_type: str, name: str) -> Response:
    headers = {"Content-Disposition": f'attachment; filename="heli2dof-{name}"'}
    return Response(content, media_type=media_type, headers=headers)


def _course(request: FlightRequest) -> bytes:
    return json_bytes(request.to_reply(check_cancelled))


def _csv(request: FlightNumbersRequest) -> str:
    return flight_csv(request.to_flight(check_cancelled))


def _mat(request: FlightNumbersRequest) -> bytes:
    return flight_mat(request.to_flight(check_cancelled))


def _recording(request: FlightRecordingRequest) -> bytes:
    return request.to_recording(check_cancelled)


def _film(request: FlightFilmRequest) -> bytes:
    flight = request.to_flight(check_cancelled)
    rig, title = of_rig(flight.log.design.get("preset") or DEFAULT)
    motion = _motion(flight, request.begin, request.end)
    return motion_file(rig, motion, "html", f"{title}: a flight", most=FILM_FRAMES, wanted=check_cancelled)


def _motion(flight: ThinFlight, begin: float, end: float | None) -> Motion:
    until = float(flight.t[-1]) if end is None else min(end, float(flight.t[-1]))
    own = (flight.t >= begin) & (flight.t <= until)
    if until - begin < SHORTEST_FILM or np.count_nonzero(own) < 2:
        raise InvalidInputError(
            f"a film lasts {SHORTEST_FILM:g} s at least, within the flight of {flight.t[-1]:.6g} s",
            field="begin",
            value=begin,
            hint="Begin sooner, or end later.",
        )
    t, rows = flight.t[own], flight.rows[own]
    limits = spec_of(flight.log.design).limits
    theta, psi, V_p, V_y, theta_ref, psi_ref = (rows[:, at] for at in _PLAYED)
    most = (limits.V_p, limits.V_y, limits.theta)
    return Motion(t - t[0], theta, psi, V_p, V_y, (theta_ref, psi_ref), most)
