"""The command line's own words."""

from __future__ import annotations

import socket

import pytest

from app.cli import main


def test_a_port_in_use_is_told_with_a_way_out(capsys):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(SystemExit) as ended:
            main(["serve", "--port", str(port)])
    assert ended.value.code == 1
    told = capsys.readouterr().err
    assert f"port {port}: it is in use" in told
    assert f"--port {port + 1}" in told
