"""The live socket: evaluate requests in, answers out, the newest request wins."""

from __future__ import annotations

import asyncio
import logging
from time import perf_counter
from typing import Any

import orjson
from fastapi import APIRouter, WebSocket, WebSocketDisconnect
from pydantic import ValidationError

from heli2dof_core import Heli2DofError, Spec
from heli2dof_core.design import FULL_RANK
from heli2dof_core.evaluate import report_of

from ..contract.encoding import BINARY_SUBPROTOCOL, json_text
from ..contract.evaluation import LiveReader, report_frame, report_reply
from ..contract.problems import TEXT_START, problem_of
from ..edge.connections import connection_of
from ..edge.messages import Mailbox, received
from ..jobs.compute import Compute
from ..ops.metrics import Metrics

_log = logging.getLogger(__name__)
QUICK_STEPS = 4000
"""Steps of a response that still count as quick: two milliseconds' work."""
MEDIUM_STEPS = 40_000
"""Steps of a response that may keep others' designs waiting: a twentieth of a second's work."""
INLINE_LENGTH = 16_384
"""Length of a message that is read in the event loop."""
MOST_SAMPLES = 1001
_Request = tuple[float, str | bytes]
"""When it came, and its text."""


def build_router(compute: Compute, metrics: Metrics) -> APIRouter:
    """The live socket's route."""
    router = APIRouter()

    @router.websocket("/api/v1/live")
    async def live(socket: WebSocket) -> None:
        binary = BINARY_SUBPROTOCOL in socket.scope["subprotocols"]
        await socket.accept(subprotocol=BINARY_SUBPROTOCOL if binary else None)
        mailbox, connection = Mailbox[_Request](), connection_of(socket)
        answers = asyncio.create_task(_answer(socket, mailbox, compute, metrics, binary=binary))
        try:
            while True:
                request = await received(socket)
                connection.busy = True
                mailbox.put((perf_counter(), request))
        except WebSocketDisconnect:
            pass
        finally:
            answers.cancel()
            await asyncio.gather(answers, return_exceptions=True)

    return router


async def _answer(
    socket: WebSocket, mailbox: Mailbox[_Request], compute: Compute, metrics: Metrics, *, binary: bool
) -> None:
    connection, reader = connection_of(socket), LiveReader()
    while True:
        since, text = await mailbox.take()
        try:
            answer = _evaluate_inline(reader, text, binary) if compute.compiled else None
            if answer is None:
                answer = await compute.run(_evaluate, reader, text, binary, MEDIUM_STEPS)
            if answer is None:
                answer = await compute.run_slow(_evaluate, reader, text, binary)
        except Exception as error:
            body = problem_of(error)
            if body["status"] == 500:
                _log.exception("live request failed")
            answer = json_text({**body, **_seq_of(text)})
        if isinstance(answer, str):
            await socket.send_text(answer)
        else:
            await socket.send_bytes(answer)
        metrics.update.observe(perf_counter() - since)
        refused = isinstance(answer, str) and answer.startswith(TEXT_START)
        (metrics.refusals if refused else metrics.evaluations).inc()
        if mailbox.empty:
            await connection.set_idle()
        await asyncio.sleep(0)  # others' turn, even where nothing above had to wait


def _evaluate_inline(reader: LiveReader, text: str | bytes, binary: bool) -> str | bytes | None:
    """The answer in the event loop, where it takes a millisecond or two; None if it might take longer.

    A thread would cost as much again: two changes of threads, and with many clients the wait for Python's
    lock, which a computing thread keeps for 5 ms (twenty clients at 20 Hz: 15 ms instead of 54, median).
    """
    return _evaluate(reader, text, binary, QUICK_STEPS, small=True) if len(text) <= INLINE_LENGTH else None


def _seq_of(text: str | bytes) -> dict[str, int]:
    """The number of a request that was not answered as it should have been."""
    try:
        seq = orjson.loads(text)["seq"]
    except (orjson.JSONDecodeError, TypeError, KeyError):
        return {}
    return {"seq": seq} if isinstance(seq, int) else {}


def _is_small(spec: Spec) -> bool:
    """Whether only the integrator's steps are left to bound."""
    scenario, structure = spec.scenario, spec.structure
    plain = spec.method == FULL_RANK and structure.shift is None
    return plain and scenario.digital is None and scenario.samples <= MOST_SAMPLES


def _evaluate(
    reader: LiveReader, text: str | bytes, binary: bool, most_steps: int | None = None, *, small: bool = False
) -> Any:
    """One request's answer: JSON as text, or a binary frame as bytes.

    None where a response would take more than `most_steps`, or where the work is not small though it shall be.
    """
    try:
        asked = reader.read(text)
        spec = asked.task.spec
        if small and not _is_small(spec):
            return None
        report = report_of(asked.task, most_steps, passing=True)
        if most_steps is not None and report.given_up:
            return None
        if binary:
            return report_frame(report, spec, seq=asked.seq)
        return json_text({"seq": asked.seq, **report_reply(report, spec)})
    except (orjson.JSONDecodeError, ValidationError, Heli2DofError) as error:
        return json_text({**problem_of(error), **_seq_of(text)})
