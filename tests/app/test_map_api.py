"""The map over REST: as its model says, the same as the library, files, refusals by their fields."""

from __future__ import annotations

import io
import json
import xml.etree.ElementTree as ET

import numpy as np
import pandas as pd
import pytest

from app.contract.maps import MapReply
from heli2dof_core import Spec, Uncertainty, design_map
from tests.app.test_rest import PAPER, post

PSI = {"measure": "settling_time", "axis": "psi"}
SVG = "{http://www.w3.org/2000/svg}"


def test_the_reply_is_the_librarys_map(client):
    reply = post(client, "map", {**PAPER, "map": {"move": "yaw-pair", "size": [12, 9], **PSI}})
    MapReply.model_validate(reply)
    found = design_map(Spec.from_preset(), "yaw-pair", PSI, size=(12, 9))
    assert (reply["x"], reply["y"]) == (found.x.tolist(), found.y.tolist())
    assert reply["valid"] == found.valid.tolist()
    assert reply["stable"] == found.stable.tolist()
    assert reply["values"] == np.where(found.valid, found.values, 0.0).tolist()
    assert (reply["unit"], reply["better"], reply["model"]) == ("s", "lower", "nonlinear")
    assert reply["title"] == "Settling time, yaw step"
    assert "here" not in reply  # two different real poles
    assert not np.all(found.valid) and np.any(found.valid)


def test_what_has_no_limit_is_told_apart(client):
    asked = {"move": "yaw-pair", "over": [[-3, -1], [0, 1]], "size": [4, 3], "measure": "gain_margin"}
    reply = post(client, "map", {**PAPER, "outer": "none", "map": asked})
    MapReply.model_validate(reply)
    unlimited = np.array(reply["unlimited"])
    assert np.any(unlimited)
    assert not np.any(unlimited & np.array(reply["valid"]))
    assert np.all(np.array(reply["values"])[unlimited] == 0)


def test_gains_and_shares(client):
    rigs = {"spread": {"J_p": 0.3}, "samples": 20, "seed": 3}
    asked = {"move": "pitch-pi", "size": [5, 4], "measure": "share_stable", "uncertainty": rigs}
    reply = post(client, "map", {**PAPER, "map": asked})
    MapReply.model_validate(reply)
    uncertainty = Uncertainty({"J_p": 0.3}, samples=20, seed=3)
    found = design_map(Spec.from_preset(), "pitch-pi", "share_stable", size=(5, 4), uncertainty=uncertainty)
    assert reply["values"] == np.where(found.valid, found.values, 0.0).tolist()
    assert (reply["scale"], reply["unit"]) == ("log", "")
    assert reply["here"] == {"x": 30.0, "y": 0.1, "unlimited": False, "value": found.own}


def test_files_say_the_same(client):
    body = {**PAPER, "map": {"move": "yaw-pair", "size": [12, 9], **PSI}}
    reply = post(client, "map", body)
    rows = client.post("/api/v1/map/csv", json=body)
    assert rows.headers["content-type"].startswith("text/csv")
    table = pd.read_csv(io.StringIO(rows.text), comment="#")
    assert table.columns.tolist() == ["re [rad/s]", "im [rad/s]", "settling_time [s]", "state"]
    ok = table["state"] == "ok"
    assert ok.tolist() == np.ravel(reply["valid"]).tolist()
    assert table["settling_time [s]"][ok].tolist() == np.ravel(reply["values"])[ok].tolist()
    assert table["re [rad/s]"].tolist() == reply["x"] * 9
    again = rows.text.split("\n")[2].removeprefix("# ")
    assert post(client, "map", json.loads(again)) == reply
    picture = client.post("/api/v1/map/svg", json=body)
    assert picture.headers["content-type"] == "image/svg+xml"
    assert "heli2dof_map.svg" in picture.headers["content-disposition"]
    root = ET.fromstring(picture.text)
    assert root.tag == f"{SVG}svg"
    assert root.find(f"{SVG}title").text == reply["title"]


@pytest.mark.parametrize(
    ("asked", "field"),
    [
        ({}, "map.move"),
        ({"move": "roll-pair"}, "map.move"),
        ({"move": "pitch-pair", "measure": "speed"}, "map.measure"),
        ({"move": "pitch-pair", "measure": "norm", "axis": "theta"}, "map.axis"),
        ({"move": "pitch-pair", "over": [[-1, -2], [0, 1]]}, "map.over.0.1"),
        ({"move": "pitch-pair", "size": [1000, 2]}, "map.size.0"),
        ({"move": "pitch-pair", "size": [2.5, 2]}, "map.size.0"),
        ({"move": "pitch-pair", "measure": "share_stable"}, "map.uncertainty"),
        (
            {"move": "pitch-pair", "measure": "share_stable", "uncertainty": {"spread": {"tau_p": 0.1}}},
            "map.uncertainty.spread.tau_p",
        ),
        (
            {"move": "pitch-pair", "measure": "share_stable", "uncertainty": {"samples": 0}},
            "map.uncertainty.samples",
        ),
        ({"move": "pitch-pair", "wanted": 1}, "map.wanted"),
    ],
)
def test_refusals_name_the_field(client, asked, field):
    assert post(client, "map", {"map": asked}, status=422)["field"] == field


def test_what_is_the_designs_keeps_its_own_field(client):
    rigs = {"move": "pitch-pair", "measure": "share_stable", "uncertainty": {}}
    digital = {"scenario": {"digital": {}}, "map": rigs}
    assert post(client, "map", digital, status=422)["field"] == "scenario.digital"
    assert post(client, "map", {"poles": [1, 2], "map": {"move": "pitch-pi"}}, status=422)["field"] == "poles"
