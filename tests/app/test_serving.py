"""The socket that `heli2dof serve` listens on, and the files that it keeps in memory."""

from __future__ import annotations

import asyncio
import gzip
import mimetypes
import os
import socket
from pathlib import Path

import pytest
from fastapi import FastAPI
from fastapi.testclient import TestClient

from app.cli import serving
from app.cli.serving import listener, own_address
from app.ops.cached_files import CachedFiles
from app.ops.settings import Settings
from tests.loops import run

SCRIPT = "export const answer = 42; // what it is for\n" * 40


@pytest.mark.parametrize("host", ["127.0.0.1", "::1"])
def test_accepted_connections_send_at_once(host: str):
    """What asyncio accepts has TCP_NODELAY: a body does not wait for the header's acknowledgement."""

    async def accepted() -> int:
        delays: asyncio.Queue[int] = asyncio.Queue()

        async def took(_: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
            option = writer.get_extra_info("socket").getsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY)
            writer.close()
            await delays.put(option)

        bound = listener(Settings(host=host, port=0))
        async with await asyncio.start_server(took, sock=bound) as server:
            _, writer = await asyncio.open_connection(*server.sockets[0].getsockname()[:2])
            found = await delays.get()
            writer.close()
            return found

    assert run(accepted()) != 0


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    inside = tmp_path / "static"
    (inside / "panels").mkdir(parents=True)
    (inside / "panels" / "plot.js").write_text(SCRIPT)
    (inside / "dot.png").write_bytes(bytes(range(256)) * 8)
    (inside / "kernels.wasm").write_bytes(b"\0asm" + bytes(2000))
    (inside / "short.css").write_text("p { margin: 0 }")
    (tmp_path / "secret.txt").write_text("not for the web")
    (inside / "escape.txt").symlink_to(tmp_path / "secret.txt")
    return inside


@pytest.fixture
def client(folder: Path) -> TestClient:
    app = FastAPI()
    app.mount("/static", CachedFiles(directory=folder))
    return TestClient(app)


def test_text_is_compressed_for_who_takes_it(client: TestClient):
    plain = client.get("/static/panels/plot.js", headers={"Accept-Encoding": "identity"})
    assert plain.text == SCRIPT
    assert "content-encoding" not in plain.headers
    assert plain.headers["content-type"].startswith("text/javascript")
    with client.stream("GET", "/static/panels/plot.js", headers={"Accept-Encoding": "br, gzip"}) as packed:
        raw = b"".join(packed.iter_raw())
    assert packed.headers["content-encoding"] == "gzip"
    assert gzip.decompress(raw).decode() == SCRIPT
    assert len(raw) < len(SCRIPT) / 5
    assert plain.headers["vary"] == packed.headers["vary"] == "Accept-Encoding"
    assert plain.headers["etag"] != packed.headers["etag"]


def test_webassembly_has_the_type_that_browsers_stream_whatever_the_machine_says(
    client: TestClient, folder: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(mimetypes, "guess_type", lambda _: ("application/x-other", None))
    reply = client.get("/static/kernels.wasm")
    assert reply.headers["content-type"] == "application/wasm"
    assert reply.headers["content-encoding"] == "gzip"
    assert reply.content == (folder / "kernels.wasm").read_bytes()


@pytest.mark.parametrize("name", ["dot.png", "short.css"])
def test_what_compression_does_not_help_is_sent_as_it_is(client: TestClient, folder: Path, name: str):
    reply = client.get(f"/static/{name}")
    assert "content-encoding" not in reply.headers
    assert reply.content == (folder / name).read_bytes()


def test_who_has_a_file_already_is_told_so_until_it_changes(client: TestClient, folder: Path):
    first = client.get("/static/panels/plot.js")
    known = {"If-None-Match": f'W/"something", {first.headers["etag"]}'}
    again = client.get("/static/panels/plot.js", headers=known)
    assert (again.status_code, again.content) == (304, b"")
    assert again.headers["etag"] == first.headers["etag"]
    assert first.headers["cache-control"] == again.headers["cache-control"] == "no-cache"
    path = folder / "panels" / "plot.js"
    path.write_text(SCRIPT.replace("42", "43"))
    os.utime(path, ns=(path.stat().st_atime_ns, path.stat().st_mtime_ns + 1))
    changed = client.get("/static/panels/plot.js", headers=known)
    assert changed.status_code == 200
    assert "43" in changed.text


def test_head_tells_the_size_alone(client: TestClient):
    reply = client.head("/static/dot.png")
    assert (reply.status_code, reply.headers["content-length"]) == (200, "2048")


@pytest.mark.parametrize(
    "path",
    [
        "nothing.js",
        "panels",
        "",
        "../secret.txt",
        "%2e%2e/secret.txt",
        "escape.txt",
        "a" * 300,
        "a%00b",
        "/etc/hosts",
    ],
)
def test_there_is_nothing_outside_the_folder(client: TestClient, path: str):
    assert client.get(f"/static/{path}").status_code == 404


def test_only_get_and_head_are_answered(client: TestClient):
    reply = client.post("/static/dot.png")
    assert (reply.status_code, reply.headers["allow"]) == (405, "GET, HEAD")


class Outward(socket.socket):
    """A UDP socket of a machine with one way out, or none."""

    way: str | None = None

    def connect(self, address) -> None:
        if self.way is None:
            raise OSError("Network is unreachable")

    def getsockname(self):
        return (self.way, 9)


@pytest.mark.parametrize("way", ["192.0.2.7", "127.0.1.1", None])
def test_who_lets_others_in_is_told_their_address(monkeypatch, way: str | None):
    monkeypatch.setattr(serving, "_CONTAINERS", ())
    monkeypatch.setattr(Outward, "way", way)
    monkeypatch.setattr("app.cli.serving.socket.socket", Outward)
    assert own_address() == (way if way == "192.0.2.7" else None)


def test_a_container_does_not_tell_its_own_address(monkeypatch, tmp_path: Path):
    monkeypatch.setattr(serving, "_CONTAINERS", (tmp_path / "none", tmp_path))
    monkeypatch.setattr(Outward, "way", "192.0.2.7")
    monkeypatch.setattr("app.cli.serving.socket.socket", Outward)
    assert own_address() is None
