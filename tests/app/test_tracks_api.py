"""POST track and `heli2dof track`: the core's tracks as JSON, tables and files."""

from __future__ import annotations

import json

import numpy as np
import pytest
from click.testing import CliRunner

from app.cli.group import heli2dof
from app.contract import tracks
from app.contract.experiment import THREADS
from app.contract.tracks import TrackReply, TrackRequest
from heli2dof_core import Spec
from heli2dof_core.tracks import track
from tests.app.test_rest import post

POLES = [-12, -10, {"re": -3, "im": 4}, {"re": -3, "im": -4}]
TAU = {"path": "rotors.tau", "over": [0.01, 0.3], "points": 30}
MEASURES = [
    {"measure": "disk_margin"},
    {"measure": "settling_time", "model": "linear"},
    {"measure": "lag_margin"},
]


def run(*words, status=0):
    result = CliRunner().invoke(heli2dof, words, prog_name="heli2dof")
    assert result.exit_code == status, result.output
    return result


def test_the_reply_is_the_cores_track(client):
    reply = post(client, "track", {"poles": POLES, "track": {**TAU, "measures": MEASURES}})
    TrackReply.model_validate(reply)
    own = track(Spec.from_preset(poles=[-12, -10, -3 + 4j, -3 - 4j]), "rotors.tau", (0.01, 0.3), 30)
    assert reply["values"] == own.values.tolist() and reply["stable"] == own.stable.tolist()
    for course, theirs in zip(own.poles.T.tolist(), reply["poles"], strict=True):
        assert [complex(p["re"], p["im"]) for p in theirs] == course
    assert [c["value"] for c in reply["crossings"]] == [c.value for c in own.crossings]
    assert reply["symbol"] == "τ" and reply["unit"] == "s" and "now" in reply
    disk, settling, _ = reply["figures"]
    assert settling["axis"] == "both" and settling["words"].startswith("Settling time")
    assert [v > 0 for v in disk["values"]] == disk["valid"] == reply["stable"]


def test_where_poles_lie_on_the_border_of_stability_is_told(client):
    found = track(Spec.from_preset(), "gain", (0.0, 1.0), 20)
    reply = post(client, "track", {"track": {"path": "gain", "over": [0, 1], "points": 20}})
    assert reply["on_border"] == found.on_border.tolist() == [True] + [False] * (len(reply["values"]) - 1)
    beyond = post(client, "track", {"poles": POLES, "track": TAU})
    assert not all(beyond["stable"]) and not any(beyond["on_border"])


def test_a_figure_without_a_limit_says_so(client):
    reply = post(client, "track", {"track": {"path": "poles.factor", "points": 5, "measures": [MEASURES[2]]},
                                   "outer": "none"})  # fmt: skip
    figure = reply["figures"][0]
    unlimited = figure.get("unlimited", [False] * len(figure["values"]))
    assert all(
        u or v == good
        for u, v, good in zip(unlimited, map(bool, figure["values"]), figure["valid"], strict=True)
    )


@pytest.mark.parametrize(
    ("options", "field"),
    [
        ({"path": "loops.pitch.tau"}, "track.path"),
        ({"path": "gain", "over": [2, 1]}, "track.over"),
        ({"path": "gain", "over": [0, 1e5]}, "track.over"),
        ({"path": "gain", "scale": "log"}, "track.scale"),
        ({"path": "gain", "points": 5000}, "track.points"),
        ({"path": "loops.pitch.kp", "kept": True}, "track.kept"),
        ({"path": "gain", "measures": [{"measure": "speed"}]}, "track.measures.0.measure"),
        ({"path": "gain", "measures": [{"measure": "share_stable"}]}, "track.measures.0.measure"),
        (
            {"path": "gain", "measures": [{"measure": "disk_margin", "axis": "theta"}]},
            "track.measures.0.axis",
        ),
    ],
)
def test_refusals_name_the_field(client, options, field):
    assert post(client, "track", {"track": options}, status=422)["field"] == field


def test_the_command_line_gives_the_same_numbers_tables_and_files(client, tmp_path):
    words = ("track", "rotors.tau", "--over", "0.01,0.3", "--points", "30", "--poles", "-12,-10,-3±4j")
    body = {"poles": POLES, "track": {**TAU, "measures": [{"measure": "settling_time", "axis": "theta"}]}}
    own = json.loads(run(*words, "--measures", "settling_time:theta", "--json").stdout)
    assert own == post(client, "track", body)
    shown = run(*words, "--measures", "disk_margin").stdout
    assert "leaves stability" in shown and "Disk margin" in shown
    file = tmp_path / "tau.svg"
    assert run(*words, "--svg", "-o", str(file)).stdout.strip() == str(file)
    assert file.read_text("utf-8").startswith("<svg")
    run(*words, "--svg", "-o", str(file), status=1)
    rows = [line for line in run(*words, "--csv").stdout.splitlines() if not line.startswith("#")]
    assert len(rows) == 1 + len(own["values"])
    assert "settling_time:theta" in run(*words, "--measures", "settling_time:up", status=2).output


def test_files_are_those_of_the_command_line(client):
    body = {"poles": POLES, "track": TAU}
    words = ("track", "rotors.tau", "--over", "0.01,0.3", "--points", "30", "--poles", "-12,-10,-3±4j")
    for kind in ("csv", "svg"):
        reply = client.post(f"/api/v1/track/{kind}", json=body)
        assert (
            reply.status_code == 200
            and f'filename="heli2dof_track.{kind}"' in reply.headers["Content-Disposition"]
        )
        assert reply.text == run(*words, f"--{kind}").stdout


def test_its_request_keeps_the_design():
    request = TrackRequest.model_validate({"poles": POLES, "track": {"path": "gain"}})
    assert np.allclose(request.to_spec().poles.array[2:], [-3 + 4j, -3 - 4j])


def test_a_track_takes_as_many_threads_as_a_map(monkeypatch):
    taken = []

    def swept(*args, threads, **options):
        taken.append(threads)
        return track(*args, threads=threads, **options)

    monkeypatch.setattr(tracks, "track", swept)
    asked = {"track": {"path": "loops.pitch.kp", "points": 3, "measures": [{"measure": "disk_margin"}]}}
    assert TrackRequest.model_validate(asked).to_track().figures.shape[1] == 1
    assert taken == [THREADS]
