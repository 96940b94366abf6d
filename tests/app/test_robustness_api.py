"""The cloud over REST and over its WebSocket: progress, cancel, errors."""

from __future__ import annotations

import pytest

from app.contract.robustness import UNCERTAIN, RobustnessReply
from tests.app.test_rest import PAPER, post


def test_rest_gives_the_whole_cloud(client):
    reply = post(client, "robustness", {**PAPER, "samples": 50, "uncertainty": {"K_pp": 0.2}})
    RobustnessReply.model_validate(reply)
    assert reply["done"] == reply["samples"] == len(reply["loop_poles"]) == 50
    assert len(reply["t"]) == len(reply["envelopes"]["theta"][0])
    assert reply["share_stable"] == 1
    for body, field in (
        ({"uncertainty": {"mass": 0.1}}, "uncertainty.mass"),
        ({"samples": 10**6}, "samples"),
        ({"distribution": "flat"}, "distribution"),
        ({"scenario": {"digital": {}}}, "scenario.digital"),
        ({"scenario": {"disturbance": {"V_p": 1.0}}}, "scenario.disturbance"),
    ):
        assert post(client, "robustness", body, status=422)["field"] == field


def test_all_that_is_uncertain_may_be_so_at_once(client):
    """Every parameter but g, and both rotors' lags: what the page asks for an Aero."""
    names = [name for name in UNCERTAIN if name != "g"]
    body = {"preset": "quanser-aero-2", "samples": 20, "uncertainty": dict.fromkeys(names, 0.1)}
    assert post(client, "robustness", body)["done"] == 20


def test_socket_tells_progress(client):
    with client.websocket_connect("/api/v1/robustness") as socket:
        socket.send_json({**PAPER, "samples": 800})
        parts = []
        while not parts or parts[-1]["done"] < 800:
            parts.append(socket.receive_json())
            RobustnessReply.model_validate(parts[-1])
        assert [part["done"] for part in parts] == [250, 750, 800]
        socket.send_json({**PAPER, "samples": 10})
        assert socket.receive_json()["done"] == 10


def test_socket_can_be_cancelled(client):
    with client.websocket_connect("/api/v1/robustness") as socket:
        socket.send_json({**PAPER, "samples": 20_000})
        assert socket.receive_json()["done"] < 20_000
        socket.send_json({"cancel": True})
        replies = []
        while not replies or "cancelled" not in replies[-1]:
            replies.append(socket.receive_json())
        assert all(reply["done"] < 20_000 for reply in replies[:-1])


@pytest.mark.parametrize(
    "text", ["{", '{"samples": 0}', '{"poles": [-1, -2, -3]}', '{"uncertainty": {"m": 2}}']
)
def test_socket_answers_errors_with_problems_and_goes_on(client, text):
    with client.websocket_connect("/api/v1/robustness") as socket:
        socket.send_text(text)
        assert socket.receive_json()["status"] == 422
        socket.send_json({"samples": 5})
        assert socket.receive_json()["done"] == 5
