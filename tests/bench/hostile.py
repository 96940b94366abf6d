"""Sends every kind of hostile input to a server with small limits and tables what came back.

python -m tests.bench.hostile [docs/limits.md]
"""

from __future__ import annotations

import contextlib
import json
import socket
import sys
import time
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import httpx2
from websockets.exceptions import ConnectionClosed

from tests.app.test_hostile_sockets import SESSION, closing_code, frame, good, opened, raw
from tests.app.test_limits import SMALL, STIFF
from tests.whole_server import WholeServer, serving

Case = tuple[str, str, Callable[[], str]]
LIVE, CLOUD, SCENE = "/api/v1/live", "/api/v1/robustness", f"/scene/{SESSION}"


def said(reply: httpx2.Response) -> str:
    """Status, code and field of an answer."""
    kind = reply.headers.get("content-type", "")
    problem = reply.json() if "problem" in kind else {}
    words = [str(reply.status_code), problem.get("code", ""), problem.get("field", "")[:40]]
    if "Retry-After" in reply.headers:
        words.append(f"(Retry-After {reply.headers['Retry-After']})")
    if "Allow" in reply.headers:
        words.append(f"(Allow {reply.headers['Allow']})")
    return " ".join(filter(None, words))


def answer(peer: socket.socket) -> str:
    return peer.recv(4096).split(b"\r\n")[0].decode(errors="replace")


def cases(server: WholeServer, http: httpx2.Client) -> Iterator[Case]:
    def post(content: str | bytes, path: str = "/api/v1/step") -> Callable[[], str]:
        kind = {"Content-Type": "application/json"}
        return lambda: said(http.post(path, content=content, headers=kind))

    yield "HTTP", "no JSON", post("{")
    yield "HTTP", "invalid UTF-8", post(b"\xa8\xf1\x0e\x93")
    yield "HTTP", "1,900 brackets deep", post("[" * 1900)
    yield "HTTP", "NaN for a number", post('{"shift": NaN}')
    yield "HTTP", "1e999", post('{"shift": 1e999}')
    yield "HTTP", "an integer of 1,900 digits", post('{"shift": ' + "9" * 1900 + "}")
    yield "HTTP", "text for a number", post('{"shift": "1"}')
    yield "HTTP", "true for a number", post('{"shift": true}')
    yield "HTTP", "a NUL in a name", post('{"preset": "\\u0000"}')
    yield "HTTP", "code for a name", post("{\"method\": \"__import__('os').system('id')\"}")
    yield "HTTP", "a formula for a pole", post('{"poles": ["1/0", -1, -2, -3]}')
    yield "HTTP", "an unknown field", post('{"colour": 1}')
    yield "HTTP", "an unpaired pole", post('{"poles": [-1, -2, -3, {"re": -4, "im": 1}]}')
    yield "HTTP", "an uncontrollable rig", post('{"parameters": {"K_pp": 0, "K_py": 0}}')
    yield "HTTP", "20,002 samples", post('{"scenario": {"samples": 20002}}')
    yield "HTTP", "601 s", post('{"scenario": {"duration": 601}}')
    yield "HTTP", "20,001 rigs", post('{"samples": 20001}', CLOUD)
    yield "HTTP", "a frequency of 5e-324 rad/s", post('{"frequencies": [5e-324]}', "/api/v1/loops")
    wide = json.dumps({"A": [[0] * 13] * 13, "B": [[1]] * 13, "poles": [-1] * 13})
    yield "HTTP", "13 states to place", post(wide, "/api/v1/place")
    yield (
        "HTTP",
        "a script as a link",
        lambda: said(http.post("/api/v1/export/python", params={"link": "javascript:alert(1)"}, json={})),
    )
    yield "HTTP", "a path out of the folder", lambda: said(http.get("/static/%2e%2e/app/main.py"))
    yield "HTTP", "an unknown path", lambda: said(http.get("/api/v1/nothing"))
    yield "HTTP", "DELETE", lambda: said(http.delete("/api/v1/step"))
    yield "HTTP", "a body beyond the limit", post(b" " * 2001)
    yield (
        "HTTP",
        "the same in chunks, unannounced",
        lambda: said(http.post("/api/v1/step", content=(b" " * 500 for _ in range(5)))),
    )
    yield "HTTP", "a body that never ends", lambda: slow_body(server)
    yield "HTTP", "200 half-sent heads", lambda: halves(server)
    yield "HTTP", "60 requests at once", lambda: burst(http)
    yield "HTTP", "a cloud that takes minutes", lambda: said(http.post(CLOUD, json=STIFF))
    yield "HTTP", "eight of them at once", lambda: many(http)
    yield "HTTP", "a second scene", lambda: second_scene(server, http)

    for path, name in ((LIVE, "live"), (CLOUD, "robustness"), (SCENE, "scene"), (SCENE + "/hub", "hub")):

        def broken(sent: bytes, path: str = path) -> Callable[[], str]:
            return lambda: f"closed, {closing(server, path, sent)}"

        yield name, "invalid UTF-8", broken(frame(b"\xff\xfe"))
        yield name, "a frame of 1 MiB and a byte", broken(frame(b" " * (2**20 + 1))[:1000])
        yield name, "an unmasked frame", broken(b"\x81\x01a")
        yield name, "a reserved opcode", broken(frame(b"", 3))
        yield name, "random bytes", lambda path=path: spoken(server, path, b"\x93\x01\xff")
        yield name, "text that is no JSON", lambda path=path: spoken(server, path, "{")
        yield name, "50,000 brackets deep", lambda path=path: spoken(server, path, "[" * 50_000)
        yield name, "reset in the middle of a frame", lambda path=path: vanish(server, path)
    yield "sockets", "a fifth of one address", lambda: fifth(server)
    yield "sockets", "no session's id", lambda: unknown(server)


def slow_body(server: WholeServer) -> str:
    with socket.create_connection(("127.0.0.1", server.port), timeout=10) as peer:
        peer.sendall(b"POST /api/v1/gains HTTP/1.1\r\nHost: x\r\nContent-Length: 9\r\n\r\n{")
        return answer(peer).removeprefix("HTTP/1.1 ")


def halves(server: WholeServer) -> str:
    peers = [socket.create_connection(("127.0.0.1", server.port)) for _ in range(200)]
    for peer in peers:
        peer.sendall(b"GET / HTTP/1.1\r\nHost: x\r\n")
    took = good(server)
    for peer in peers:
        peer.close()
    return f"nothing; others meanwhile {1e3 * took:.0f} ms"


def burst(http: httpx2.Client) -> str:
    replies = [said(http.get("/api/v1/presets")) for _ in range(60)]
    return ", then ".join(dict.fromkeys(replies))


def many(http: httpx2.Client) -> str:
    time.sleep(3)
    with ThreadPoolExecutor(8) as pool:
        replies = list(pool.map(lambda _: said(http.post(CLOUD, json=STIFF)), range(8)))
    return ", ".join(f"{replies.count(each)} × {each}" for each in sorted(set(replies)))


def second_scene(server: WholeServer, http: httpx2.Client) -> str:
    with opened(server, SCENE):
        time.sleep(1)
        return said(http.put(f"/scene/{'y' * 22}/rig", json={"rig": "aero"}))


def closing(server: WholeServer, path: str, sent: bytes) -> int:
    with raw(server, path) as peer:
        peer.sendall(sent)
        return closing_code(peer)


def spoken(server: WholeServer, path: str, message: str | bytes) -> str:
    with opened(server, path) as peer:
        try:
            peer.send(message)
            while True:
                reply = peer.recv(1.5)
                if isinstance(reply, str) and '"status"' in reply:
                    problem = json.loads(reply)
                    return f"{problem['status']} {problem['code']}, the socket lives on"
        except TimeoutError:
            return "dropped, the socket lives on"
        except ConnectionClosed as closed:
            return f"closed, {closed.rcvd.code if closed.rcvd else 'no code'}"


def vanish(server: WholeServer, path: str) -> str:
    peer = raw(server, path)
    peer.sendall(frame(b" " * 500)[:100])
    peer.close()
    return "forgotten"


def fifth(server: WholeServer) -> str:
    with contextlib.ExitStack() as stack:
        for _ in range(4):
            stack.enter_context(opened(server, LIVE))
        late = stack.enter_context(opened(server, LIVE))
        try:
            late.recv(5)
        except ConnectionClosed as closed:
            return f"closed, {closed.rcvd.code}: {closed.rcvd.reason}" if closed.rcvd else "closed"
    return "served"


def unknown(server: WholeServer) -> str:
    try:
        with opened(server, "/scene/short"):
            return "served"
    except Exception as error:
        return str(error)


def main() -> None:
    """Prints the table, or puts it into the file named."""
    rows = ["| where | sent | answer | others |", "|---|---|---|---|"]
    with (
        serving(**SMALL | {"slow_seconds": 4.0}) as server,
        httpx2.Client(base_url=server.http, timeout=60, trust_env=False) as http,
    ):
        for where, sent, act in cases(server, http):
            got = act()
            while http.get("/api/v1/presets").status_code != 200:
                time.sleep(0.5)
            took = good(server)
            rows.append(f"| {where} | {sent} | {got} | {1e3 * took:.0f} ms |")
            print(rows[-1], flush=True)
            time.sleep(0.8)  # the bucket of requests fills again
    if len(sys.argv) > 1:
        page = Path(sys.argv[1])
        head, _, tail = page.read_text(encoding="utf-8").partition("<!-- hostile -->\n")
        rest = tail[tail.index("\n## ") :] if "\n## " in tail else ""
        page.write_text(f"{head}<!-- hostile -->\n" + "\n".join(rows) + "\n" + rest, encoding="utf-8")


if __name__ == "__main__":
    main()
