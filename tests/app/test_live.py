"""The live socket: sequence numbers, newest wins, binary frames, problems."""

from __future__ import annotations

import asyncio
import json
import struct

import numpy as np
import pytest

from app.contract.encoding import ARRAY_KEY, BINARY_SUBPROTOCOL
from app.contract.evaluation import Evaluation
from app.edge.messages import Mailbox
from tests.loops import run
from tests.patience import until


def test_answers_carry_the_sequence_number_and_the_evaluation(client):
    with client.websocket_connect("/api/v1/live") as socket:
        socket.send_json({"seq": 7, "poles": [-12, -10, -9.25, -8.76]})
        reply = socket.receive_json()
        Evaluation.model_validate(reply)
        assert reply["seq"] == 7
    assert reply == {"seq": 7, **client.post("/api/v1/evaluate", json={}).json()}


def test_of_waiting_requests_only_the_newest_is_answered(client):
    with client.websocket_connect("/api/v1/live") as socket:
        for seq in range(50):
            socket.send_json({"seq": seq, "scenario": {"digital": {}}})  # too long for the event loop
        answered = []
        while not answered or answered[-1] != 49:
            answered.append(socket.receive_json()["seq"])
    assert answered == sorted(answered)
    assert len(answered) < 50


def test_mailbox_keeps_the_newest():
    async def scene():
        mailbox = Mailbox()
        mailbox.put("old")
        mailbox.put("new")
        first = await mailbox.take()
        waiting = asyncio.create_task(mailbox.take())
        await asyncio.sleep(0)
        assert not waiting.done()
        mailbox.put("next")
        return first, await waiting

    assert run(scene()) == ("new", "next")


def decode(frame: bytes):
    (length,) = struct.unpack_from("<I", frame)
    assert length % 4 == 0
    data = np.frombuffer(frame, "<f4", offset=4 + length)

    def filled(value):
        if isinstance(value, dict) and ARRAY_KEY in value:
            offset, count = value[ARRAY_KEY]
            return data[offset : offset + count].tolist()
        if isinstance(value, dict):
            return {key: filled(item) for key, item in value.items()}
        return value

    return filled(json.loads(frame[4 : 4 + length]))


def test_binary_frames_hold_the_same_evaluation(client):
    request = {"seq": 1, "each_axis": True}
    with client.websocket_connect("/api/v1/live", subprotocols=[BINARY_SUBPROTOCOL]) as socket:
        assert socket.accepted_subprotocol == BINARY_SUBPROTOCOL
        socket.send_json(request)
        frame = socket.receive_bytes()
    reply = decode(frame)
    Evaluation.model_validate(reply)
    exact = client.post("/api/v1/evaluate", json={"each_axis": True}).json()
    np.testing.assert_allclose(
        reply["step"]["linear"]["theta"], exact["step"]["linear"]["theta"], rtol=1e-6, atol=1e-9
    )
    assert reply["gains"] == exact["gains"]
    assert len(frame) < 0.35 * len(json.dumps(exact))


def test_the_times_travel_once(client):
    request = {"seq": 1, "each_axis": True, "scenario": {"samples": 301}}
    with client.websocket_connect("/api/v1/live", subprotocols=[BINARY_SUBPROTOCOL]) as socket:
        socket.send_json(request)
        frame = socket.receive_bytes()
    (length,) = struct.unpack_from("<I", frame)
    reply = json.loads(frame[4 : 4 + length])
    both = [reply["step"], *reply["axis_steps"].values()]
    places = {tuple(step["t"][ARRAY_KEY]) for steps in both for step in steps.values()}
    assert len(both) == 3 and len(places) == 1
    assert len(frame) - 4 - length == (1 + 6 * 4) * 301 * 4  # t once, four curves of each response


@pytest.mark.parametrize(
    ("text", "code", "seq"),
    [
        ('{"seq": 3, "poles": [-1, -2, -3, {"re": -4, "im": 1}]}', "unpaired_poles", 3),
        ('{"seq": 4, "colour": 1}', "unknown_field", 4),
        ('{"poles": [-1, -2, -3, -4]}', "missing_field", None),
        ('{"seq": 5, "parameters": {"K_yy": 0.00073}}', "uncontrollable", 5),
        ('{"seq": "x"}', "invalid_input", None),
        ("[1]", "invalid_input", None),
        ("not json", "invalid_json", None),
        ("", "invalid_json", None),
    ],
)
@pytest.mark.parametrize("subprotocols", [[], [BINARY_SUBPROTOCOL]])
def test_problems_are_text_and_the_socket_lives_on(client, text, code, seq, subprotocols):
    with client.websocket_connect("/api/v1/live", subprotocols=subprotocols) as socket:
        socket.send_text(text)
        problem = socket.receive_json()
        assert (problem["code"], problem.get("seq"), problem["status"]) == (code, seq, 422)
        socket.send_json({"seq": 9})
        reply = socket.receive_bytes() if subprotocols else socket.receive_text()
        assert b'"seq":9' in (reply if isinstance(reply, bytes) else reply.encode())


def test_quick_requests_are_answered_without_a_thread_and_others_with_one(client, monkeypatch):
    """Same answers either way; what might hold up the event loop goes to the pool."""
    compute = client.app.state.compute
    threaded = []
    run = compute.run

    async def counted(*args):
        threaded.append(args)
        return await run(*args)

    monkeypatch.setattr(compute, "run", counted)
    requests = [
        ({}, 0),
        ({"poles": [-1e5, -9e4, -9, -8], "scenario": {"rtol": 1e-6}}, 1),  # too many steps
        ({"scenario": {"digital": {}}}, 1),
        ({"scenario": {"samples": 2001}}, 1),
        ({"method": "tits-yang"}, 1),
        ({"poles": [1, 2, 3]}, 0),  # a problem is quick
    ]
    until(lambda: compute.compiled, "all is derived and compiled")
    for body, threads in requests:
        threaded.clear()
        with client.websocket_connect("/api/v1/live") as socket:
            socket.send_json({"seq": 1, **body})
            answer = socket.receive_json()
        assert answer == {**client.post("/api/v1/evaluate", json=body).json(), "seq": 1}
        assert sum(function.__module__ == "app.routes.live" for function, *_ in threaded) == threads, body
