"""The cloud of uncertain rigs over REST and, with progress and cancel, over a WebSocket."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import Iterator, Mapping
from typing import Any

import orjson
from fastapi import APIRouter, Response, WebSocket, WebSocketDisconnect
from pydantic import Field, ValidationError

from heli2dof_core import Heli2DofError
from heli2dof_core.robustness import Cloud, Distribution, Uncertainty, cloud, cloud_in_parts

from .compute import Compute
from .encoding import json_bytes, json_response
from .models import Complex, Model, described
from .problems import problem, problem_of
from .replies import Reply, poles_reply
from .requests import StepRequest

_log = logging.getLogger(__name__)
MOST_POLES = 2000
"""Rigs whose poles are sent; more make no other picture."""


class RobustnessRequest(StepRequest):
    """A design, an experiment, and how far the rigs may differ from the nominal one."""

    uncertainty: dict[str, float] | None = Field(
        default=None, description="relative, per parameter; by default 0.1 for all but g"
    )
    distribution: Distribution = "uniform"
    samples: int = Field(default=200, ge=1, le=20_000)
    seed: int = Field(default=0, ge=0, le=2**32 - 1)

    def to_uncertainty(self) -> Uncertainty:
        """The core's uncertainty."""
        given: Mapping[str, Any] = {} if self.uncertainty is None else {"spread": self.uncertainty}
        return Uncertainty(**given, distribution=self.distribution, samples=self.samples, seed=self.seed)


class Envelope(Model):
    """One output's percentiles over t, rad: a row per percentile."""

    theta: list[list[float]]
    psi: list[list[float]]


class RobustnessReply(Model):
    """After `done` of `samples` rigs; poles of the whole loop of the first of them, rad/s."""

    done: int
    samples: int
    loop_poles: list[list[Complex]]
    t: list[float]
    percentiles: list[float]
    envelopes: Envelope
    share_stable: float
    share_within_limits: float


def cloud_reply(result: Cloud) -> Reply:
    """A cloud, or what is known of it so far."""
    return {
        "done": result.done,
        "samples": result.samples,
        "loop_poles": [poles_reply(poles) for poles in result.loop_poles[:MOST_POLES]],
        "t": result.t,
        "percentiles": list(result.percentiles),
        "envelopes": result.envelopes,
        "share_stable": result.share_stable,
        "share_within_limits": result.share_within_limits,
    }


def build_router(compute: Compute) -> APIRouter:
    """POST and WebSocket /api/v1/robustness."""
    router = APIRouter(prefix="/api/v1", tags=["robustness"])

    @router.post(
        "/robustness", **described(RobustnessReply, "Poles and responses of many rigs under one controller")
    )
    async def robustness(request: RobustnessRequest) -> Response:
        def work() -> Reply:
            return cloud_reply(cloud(request.to_spec(), request.to_uncertainty()))

        return json_response(await compute.run(work))

    @router.websocket("/robustness")
    async def progressing(socket: WebSocket) -> None:
        """One request in; clouds out, the last with done = samples. Whatever comes next cancels it."""
        await socket.accept()
        try:
            text = await socket.receive_text()
            while True:
                answering = asyncio.create_task(_answer(socket, text, compute))
                try:
                    text = await socket.receive_text()
                finally:
                    answering.cancel()
                    await asyncio.gather(answering, return_exceptions=True)
        except WebSocketDisconnect:
            pass

    return router


def _following(parts: Iterator[Cloud]) -> str | None:
    """The next part as text, made in the pool too: twelve thousand poles would hold up the event loop."""
    part = next(parts, None)
    return None if part is None else json_bytes(cloud_reply(part)).decode()


async def _answer(socket: WebSocket, text: str, compute: Compute) -> None:
    try:
        data = orjson.loads(text)
        if isinstance(data, dict) and data.get("cancel"):
            await socket.send_text(json_bytes({"cancelled": True}).decode())
            return
        request = RobustnessRequest.model_validate(data)
        parts = await compute.run(lambda: cloud_in_parts(request.to_spec(), request.to_uncertainty()))
        while (part := await compute.run(_following, parts)) is not None:
            await socket.send_text(part)
    except orjson.JSONDecodeError as error:
        refused = problem(422, f"Not JSON: {error}.", "invalid_json", hint="Send one JSON object.")
        await socket.send_text(json_bytes(refused).decode())
    except (ValidationError, Heli2DofError) as error:
        await socket.send_text(json_bytes(problem_of(error)).decode())
    except (asyncio.CancelledError, WebSocketDisconnect):
        raise
    except Exception:
        _log.exception("robustness request failed")
        failed = problem(500, "The server failed to answer; this is a bug.", "internal_error")
        await socket.send_text(json_bytes(failed).decode())
