"""Live answers beside REST's, for all kinds of specs; requests of one socket, each beside the one before."""

from __future__ import annotations

import numpy as np
import orjson
import pytest
from pydantic import ValidationError

from app.contract.encoding import json_bytes
from app.contract.evaluation import EvaluateRequest, LiveReader, report_reply
from app.routes.live import _evaluate
from heli2dof_core import Heli2DofError, evaluate
from heli2dof_core.body import body_of
from tests.app.test_live import decode
from tests.core.random_specs import random_specs

OTHERS = (
    {"method": "lqr"},
    {"method": "tits-yang"},
    {"poles": [-5, -5, -5, -5]},
    {"poles": [0, -5, -6, -7]},
    {"poles": [1, -5, -6, -7], "outer": "none"},
    {"loops": {"pitch": {"kp": 0}}},
    {"scenario": {"reference": {"theta": 0.3}, "samples": 50}},
    {"scenario": {"reference": {}, "samples": 50}},
    {"scenario": {"measured": "observer", "samples": 50}, "observer": {"method": "kalman"}},
    {"observer": {"poles": [-20, -21, -22, -23]}},
    {"scenario": {"disturbance": {"V_p": 2, "time": 0.5}, "samples": 50}},
    {"scenario": {"noise": {"theta": 0.001}, "duration": 0.5, "samples": 50}},
    {"preset": "quanser-aero", "place_rotors": True},
)
BODIES = (*OTHERS, *({"random": k} for k in range(40)))
RANDOM = [body_of(spec) for spec in random_specs(40, 5, samples=40, rtol=1e-6)]


def rest(body: dict) -> dict:
    request = EvaluateRequest.model_validate({**body, "each_axis": True})
    spec = request.to_spec()
    return orjson.loads(json_bytes(report_reply(evaluate(spec, each_axis=True), spec)))


def same(frame: object, exact: object, path: str = "") -> None:
    """Equal, but for curves, which are float32 in a frame."""
    if isinstance(exact, dict):
        assert isinstance(frame, dict) and frame.keys() == exact.keys(), path
        for name, value in exact.items():
            same(frame[name], value, f"{path}.{name}")
    elif path.rsplit(".", 1)[-1] in {"t", "theta", "psi", "V_p", "V_y", "v_p", "v_y"} and isinstance(
        exact, list
    ):
        assert np.array_equal(np.float32(frame), np.float32(exact)), path
    else:
        assert frame == exact, path


@pytest.mark.parametrize("body", BODIES, ids=str)
def test_a_frame_is_rests_reply(body):
    body = RANDOM[body["random"]] if "random" in body else body
    text = orjson.dumps({"seq": 7, "each_axis": True, **body})
    frame = decode(_evaluate(LiveReader(), text, binary=True))
    assert frame.pop("seq") == 7
    same(frame, rest(body))


DRAG = ([-12, -10, -9.25, -8.76], [{"re": -3, "im": 4}, {"re": -3, "im": -4}, -5, -6.5], [-4, -5.5, -6, -7])


@pytest.mark.parametrize(
    "rest_of_it",
    [
        {},
        {"split": [[2, 3], [0, 1]]},
        {"preset": "quanser-aero-2", "place_rotors": True, "scenario": {"measured": "observer"}},
        {"method": "tits-yang", "scenario": {"samples": 20}},
    ],
    ids=str,
)
def test_a_drags_answers_do_not_depend_on_what_was_asked_before(rest_of_it):
    reader = LiveReader()
    for seq, poles in enumerate((*DRAG, *DRAG[::-1])):
        text = orjson.dumps({"seq": seq, "poles": poles, **rest_of_it})
        assert _evaluate(reader, text, binary=True) == _evaluate(LiveReader(), text, binary=True)


@pytest.mark.parametrize(
    ("before", "change"),
    [
        ({"decoupler": True}, {"decoupler": 1}),
        ({"scenario": {"samples": 20, "saturation": True}}, {"scenario": {"samples": 20, "saturation": 1}}),
        ({}, {"seq": True}),
        ({}, {"seq": -1}),
        ({}, {"seq": 2**53 + 1}),
        ({}, {"seq": None}),
        ({}, {"poles": [-1, -2, -3]}),
        ({}, {"poles": [-1, -2, -3, True]}),
        ({}, {"poles": [-1, -2, -3, "-4"]}),
        ({}, {"poles": [-1, -2, -3, {"re": -4}]}),
        ({}, {"poles": [-1, -2, -3, {"re": -4, "im": 1}]}),
        ({}, {"poles": [-1, -2, -3, -1e6]}),
        ({}, {"poles": {"0": -1}}),
        ({"split": [[0, 2], [1, 3]]}, {"poles": [{"re": -3, "im": 4}, {"re": -3, "im": -4}, -5, -6]}),
        ({}, {"colour": 1}),
    ],
    ids=str,
)
def test_what_is_wrong_is_refused_as_if_nothing_had_been_asked_before(before, change):
    good, bad = {"seq": 1, "poles": DRAG[0], **before}, {"seq": 2, "poles": DRAG[2], **before, **change}
    reader = LiveReader()
    reader.read(orjson.dumps(good))
    reader.read(orjson.dumps({**good, "poles": DRAG[2]}))
    with pytest.raises((ValidationError, Heli2DofError)) as refused:
        reader.read(orjson.dumps(bad))
    with pytest.raises(type(refused.value)) as alone:
        LiveReader().read(orjson.dumps(bad))
    assert str(refused.value) == str(alone.value)
    assert reader.read(orjson.dumps(good)).seq == 1
