"""What metrics, request ids and the list of open sockets cost a live answer: python -m tests.bench.live_cost."""

from __future__ import annotations

import asyncio
import logging
from time import perf_counter

from app.edge.connections import Connections
from app.edge.requests import Requests
from app.edge.sockets import Sockets
from app.ops.metrics import Metrics

ROUNDS = 20_000


async def _handler(scope, receive, send) -> None:
    """As app.routes.live handles its messages, less the mathematics."""
    metrics, connection = scope["metrics"], scope.get("heli2dof.connection")
    await send({"type": "websocket.accept"})
    answer = {"type": "websocket.send", "bytes": b"x" * 40_000}
    while True:
        message = await receive()
        if message["type"] == "websocket.disconnect":
            return
        if connection is not None:
            since = perf_counter()
            connection.busy = True
        await send(answer)
        if connection is not None:
            metrics.update.observe(perf_counter() - since)
            metrics.evaluations.inc()
            await connection.set_idle()


async def _seconds(with_middleware: bool) -> float:
    metrics, left = Metrics(), ROUNDS
    app = Requests(Sockets(_handler, metrics, Connections()), metrics) if with_middleware else _handler

    async def receive():
        nonlocal left
        left -= 1
        return {"type": "websocket.receive", "text": "{}"} if left >= 0 else {"type": "websocket.disconnect"}

    async def send(_message) -> None:
        pass

    scope = {"type": "websocket", "headers": [], "path": "/api/v1/live", "metrics": metrics}
    began = perf_counter()
    await app(scope, receive, send)
    return perf_counter() - began


def main() -> None:
    """Prints microseconds per answer, the least of seven runs each."""
    logging.disable(logging.CRITICAL)
    least = {kind: min(asyncio.run(_seconds(kind)) for _ in range(7)) for kind in (False, True)}
    print(f"{(least[True] - least[False]) / ROUNDS * 1e6:.2f} µs for each answer")


if __name__ == "__main__":
    main()
