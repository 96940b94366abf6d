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
from ..edge.protocol import waiting_of
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
_Request = tuple[float, str | bytes, bool]
"""When it came, its text, and whether it may be a quick one."""


def build_router(compute: Compute, metrics: Metrics) -> APIRouter:
    """The live socket's route."""
    router = APIRouter()

    @router.websocket("/api/v1/live")
    async def live(socket: WebSocket) -> None:
        binary = BINARY_SUBPROTOCOL in socket.scope["subprotocols"]
        await socket.accept(subprotocol=BINARY_SUBPROTOCOL if binary else None)
        await _Live(socket, compute, metrics, binary=binary).serve()

    return router


class _Live:
    """One socket: what is asked, and what is answered."""

    def __init__(self, socket: WebSocket, compute: Compute, metrics: Metrics, *, binary: bool) -> None:
        self._socket, self._compute, self._metrics, self._binary = socket, compute, metrics, binary
        self._connection, self._waiting = connection_of(socket), waiting_of(socket.scope)
        self._mailbox, self._reader = Mailbox[_Request](), LiveReader()
        self._answering = False

    async def serve(self) -> None:
        """Answers until the visitor has gone.

        A common update is answered here, where it came in; what takes longer in a task of its own, while this one
        goes on receiving.
        """
        answers = asyncio.create_task(self._answer_all())
        try:
            while True:
                text = await received(self._socket)
                since, self._connection.busy = perf_counter(), True
                if self._answering or not self._mailbox.empty or self._waiting():
                    self._mailbox.put((since, text, True))
                elif (answer := self._quick(text)) is None:
                    self._mailbox.put((since, text, False))
                else:
                    await self._send(answer, since)
        except WebSocketDisconnect:
            pass
        finally:
            answers.cancel()
            await asyncio.gather(answers, return_exceptions=True)

    async def _answer_all(self) -> None:
        while True:
            since, text, untried = await self._mailbox.take()
            self._answering = True
            answer = self._quick(text) if untried else None
            if answer is None:
                answer = await self._slow(text)
            await self._send(answer, since)
            self._answering = False
            await asyncio.sleep(0)  # others' turn, even where nothing above had to wait

    def _quick(self, text: str | bytes) -> str | bytes | None:
        """The answer in the event loop, where it takes a millisecond or two; None if it might take longer.

        A thread would cost as much again: two changes of threads, and with many clients the wait for Python's
        lock, which a computing thread keeps for 5 ms (twenty clients at 20 Hz: 15 ms instead of 54, median).
        """
        if not self._compute.compiled or len(text) > INLINE_LENGTH:
            return None
        try:
            return _evaluate(self._reader, text, self._binary, QUICK_STEPS, small=True)
        except Exception as error:
            return _refusal(error, text)

    async def _slow(self, text: str | bytes) -> str | bytes:
        try:
            answer = await self._compute.run(_evaluate, self._reader, text, self._binary, MEDIUM_STEPS)
            if answer is None:
                answer = await self._compute.run_slow(_evaluate_alone, text, self._binary)
        except Exception as error:
            return _refusal(error, text)
        return answer

    async def _send(self, answer: str | bytes, since: float) -> None:
        metrics, refused = self._metrics, False
        if isinstance(answer, bytes):
            await self._socket.send_bytes(answer)
        else:
            await self._socket.send_text(answer)
            refused = answer.startswith(TEXT_START)
        metrics.update.observe(perf_counter() - since)
        (metrics.refusals if refused else metrics.evaluations).inc()
        if self._mailbox.empty:
            await self._connection.set_idle()


def _refusal(error: Exception, text: str | bytes) -> str:
    body = problem_of(error)
    if body["status"] == 500:
        _log.exception("live request failed", exc_info=error)
    return json_text({**body, **_seq_of(text)})


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


def _evaluate_alone(text: str | bytes, binary: bool) -> str | bytes:
    return _evaluate(LiveReader(), text, binary)


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
        report = report_of(asked.task, most_steps, passing=small)
        if most_steps is not None and report.given_up:
            return None
        if binary:
            return report_frame(report, spec, seq=asked.seq)
        return json_text({"seq": asked.seq, **report_reply(report, spec)})
    except (orjson.JSONDecodeError, ValidationError, Heli2DofError) as error:
        return json_text({**problem_of(error), **_seq_of(text)})
