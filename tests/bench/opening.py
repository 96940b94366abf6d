"""A class opens the page at one moment: when every tab has all files, from memory and as starlette serves them.

python -m tests.bench.opening [tabs]
"""

from __future__ import annotations

import asyncio
import multiprocessing
import socket
import sys
from time import perf_counter

import httpx2
import numpy as np
import uvicorn
from fastapi.staticfiles import StaticFiles
from starlette.routing import Mount

from app.cli.serving import listener, server_config
from app.main import create_app
from app.ops.settings import Settings
from tests.patience import until

CONNECTIONS = 6
"""Of one tab, as browsers limit them."""
PEER = "/as-starlette-serves-them"
ROUNDS = 3


def serve(bound: socket.socket) -> None:
    """The whole app, and its files a second time."""
    settings = Settings()
    app = create_app(settings)
    app.router.routes.insert(1, Mount(PEER, StaticFiles(directory=settings.static)))  # as early as ours
    uvicorn.Server(server_config(app, settings)).run([bound])


def files() -> list[str]:
    """What the page loads: its own modules and styles, and uPlot."""
    folder = Settings().static
    paths = [p.relative_to(folder) for p in sorted(folder.rglob("*")) if p.suffix in (".js", ".css")]
    return [str(p) for p in paths if p.parts[0] not in ("vendor", "languages") or "uplot" in p.parts]


async def connection(port: int, prefix: str, names: list[str]) -> int:
    """One file after the other; returns how many bytes came."""
    reader, writer = await asyncio.open_connection("127.0.0.1", port)
    total = 0
    for name in names:
        writer.write(f"GET {prefix}/{name} HTTP/1.1\r\nHost: a\r\nAccept-Encoding: gzip\r\n\r\n".encode())
        head = (await reader.readuntil(b"\r\n\r\n")).lower()
        assert head.startswith(b"http/1.1 200"), head
        length = int(head.split(b"content-length: ")[1].split(b"\r\n")[0])
        total += len(await reader.readexactly(length))
    writer.close()
    return total


async def tab(port: int, prefix: str, names: list[str]) -> int:
    """All files of one tab; returns their bytes."""
    parts = [connection(port, prefix, names[k::CONNECTIONS]) for k in range(CONNECTIONS)]
    return sum(await asyncio.gather(*parts))


async def opened(port: int, prefix: str, names: list[str], tabs: int) -> tuple[float, int]:
    """Seconds until the last of so many tabs has all, and the bytes of one."""
    began = perf_counter()
    done = await asyncio.gather(*(tab(port, prefix, names) for _ in range(tabs)))
    return perf_counter() - began, done[0]


def main(tabs: int) -> None:
    names = files()
    bound = listener(Settings(host="127.0.0.1", port=0))
    port = bound.getsockname()[1]
    server = multiprocessing.get_context("fork").Process(target=serve, args=(bound,), daemon=True)
    server.start()
    bound.close()
    times: dict[str, list[float]] = {"/static": [], PEER: []}
    size = {}
    try:
        until(lambda: ready(port), "the server is ready", 60)
        for prefix in list(times) * ROUNDS:
            seconds, size[prefix] = asyncio.run(opened(port, prefix, names, tabs))
            times[prefix].append(seconds)
    finally:
        server.terminate()
        server.join(20)
    print(f"{tabs} tabs, {len(names)} files each, medians of {ROUNDS}:")
    for prefix, name in (("/static", "from memory"), (PEER, "starlette")):
        print(
            f"  {name}: all have all after {np.median(times[prefix]):.2f} s; {size[prefix] / 1e3:.0f} kB each"
        )
    print(f"  ratio {np.median(times[PEER]) / np.median(times['/static']):.1f}")


def ready(port: int) -> bool:
    """Whether the server has derived and compiled everything."""
    try:
        return httpx2.get(f"http://127.0.0.1:{port}/healthz").status_code == 200
    except httpx2.TransportError:
        return False


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 40)
