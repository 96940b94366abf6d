"""How platforms are asked: registered hosts alone, no redirects, nothing large, nothing slow."""

from __future__ import annotations

import socket
import threading
from collections.abc import Callable, Iterator

import pytest

from app.lti import outward
from app.lti.errors import LtiError, PlatformError
from app.lti.outward import MOST_BYTES, ask


@pytest.fixture
def served() -> Iterator[Callable[[bytes], tuple[str, str]]]:
    """Starts a server that answers its one client with these bytes, ends there, or not; returns address and host."""
    sockets: list[socket.socket] = []
    threads: list[threading.Thread] = []

    def serve(answer: bytes, *, ends: bool = True) -> tuple[str, str]:
        listener = socket.create_server(("127.0.0.1", 0))
        sockets.append(listener)

        def run() -> None:
            client, _ = listener.accept()
            sockets.append(client)
            client.recv(65536)
            try:
                client.sendall(answer)
                if ends:
                    client.shutdown(socket.SHUT_RDWR)
            except OSError:
                pass  # the client has had enough

        threads.append(threading.Thread(target=run))
        threads[-1].start()
        host = f"127.0.0.1:{listener.getsockname()[1]}"
        return f"http://{host}/a", host

    yield serve
    for thread in threads:
        thread.join()
    for one in sockets:
        one.close()


def test_an_answer(served: Callable[..., tuple[str, str]]) -> None:
    address, host = served(b'HTTP/1.1 200 OK\r\nLink: <x>; rel="next"\r\nContent-Length: 2\r\n\r\n{}')
    answer = ask("GET", address, (host,))
    assert (answer.status, answer.json(), answer.headers["link"]) == (200, {}, '<x>; rel="next"')


def test_a_redirect_leads_nowhere(served: Callable[..., tuple[str, str]]) -> None:
    inner, _ = "http://127.0.0.1:1/secrets", None
    address, host = served(f"HTTP/1.1 302 Found\r\nLocation: {inner}\r\nContent-Length: 0\r\n\r\n".encode())
    assert ask("GET", address, (host,)).status == 302


def test_a_refusal_is_an_answer(served: Callable[..., tuple[str, str]]) -> None:
    address, host = served(b"HTTP/1.1 429 Slow down\r\nRetry-After: 7\r\nContent-Length: 3\r\n\r\nno!")
    answer = ask("POST", address, (host,), body=b"x")
    assert (answer.status, answer.body, answer.headers["retry-after"]) == (429, b"no!", "7")


def test_large_answers_are_not_read_whole(served: Callable[..., tuple[str, str]]) -> None:
    address, host = served(b"HTTP/1.1 200 OK\r\n\r\n" + b"x" * (MOST_BYTES + 100_000))
    with pytest.raises(PlatformError, match="too large"):
        ask("GET", address, (host,))


def test_silence_is_not_waited_for(served: Callable[..., tuple[str, str]]) -> None:
    address, host = served(b"HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\nx", ends=False)
    with pytest.raises(PlatformError, match="does not answer"):
        ask("GET", address, (host,), seconds=0.2)


def test_what_drips_is_given_up(
    served: Callable[..., tuple[str, str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = iter(range(0, 1000, 6))
    monkeypatch.setattr(outward, "monotonic", lambda: float(next(clock)))
    address, host = served(b"HTTP/1.1 200 OK\r\n\r\n" + b"x" * 500_000)
    with pytest.raises(PlatformError, match="too slow"):
        ask("GET", address, (host,))


@pytest.mark.parametrize(
    "answer", [b"", b"nonsense\r\n\r\n", b"HTTP/1.1 200 OK\r\nContent-Length: 9\r\n\r\nx"]
)
def test_broken_answers(served: Callable[..., tuple[str, str]], answer: bytes) -> None:
    address, host = served(answer)
    try:
        got = ask("GET", address, (host,))
    except PlatformError:
        return
    with pytest.raises(PlatformError):
        got.json()


def test_nobody_there() -> None:
    with socket.create_server(("127.0.0.1", 0)) as listener:
        host = f"127.0.0.1:{listener.getsockname()[1]}"
    with pytest.raises(PlatformError, match="does not answer") as caught:
        ask("GET", f"http://{host}/", (host,))
    assert caught.value.http_status == 0


@pytest.mark.parametrize(
    "address",
    ["http://127.0.0.1:1/", "https://169.254.169.254/", "file:///etc/passwd", "http://moodle.example/", "https://moodle.example:8443/"],
)  # fmt: skip
def test_addresses_that_were_not_registered_are_not_asked(
    address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(outward, "build_opener", lambda *_: pytest.fail("it is asked"))
    with pytest.raises(LtiError) as caught:
        ask("GET", address, ("moodle.example",))
    assert caught.value.code in ("foreign_address", "bad_address")
