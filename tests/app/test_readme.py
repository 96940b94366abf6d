"""The examples of the README and of docs/api.md work as they stand there."""

from __future__ import annotations

import json
import re
import shlex
from pathlib import Path

import numpy as np
import pytest
from scipy.io import savemat

from heli2dof_core import Spec, close_loop, place, preset
from heli2dof_core.recordings.files import write_csv
from heli2dof_core.recordings.samples import deviating_rig, sample_recording
from heli2dof_core.scenario import Digital

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
API = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
SERVER = "http://127.0.0.1:8000"


def blocks(text: str, language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", text, re.DOTALL)


def curls(text: str) -> list[str]:
    """Every command that begins with curl, wherever it stands, its lines joined."""
    found = [
        c for block in blocks(text, "sh") for c in re.findall(r"^curl (?:.*\\\n)*.*$", block, re.MULTILINE)
    ]
    assert len(found) == len(re.findall(r"^\s*curl ", text, re.MULTILINE))
    return [c.replace("\\\n", " ") for c in found]


def in_class(client, command: str) -> str:
    """The command with what a class that is made now tells in place of variables."""
    if "$CLASS" not in command:
        return command
    made = client.post("/api/v1/classes", json={"lab": "one-pair", "title": "Monday"}).json()
    address = f"{SERVER}/api/v1/classes/{made['code']}"
    joined = client.post(f"{address.removeprefix(SERVER)}/join", json={"name": "Ada"}).json()
    known = {"CLASS": address, "INSTRUCTOR": made["instructor"], "STUDENT": joined["student"]}
    for name, value in known.items():
        command = command.replace(f"${name}", value)
    return command


def ask(client, command: str):
    words = shlex.split(in_class(client, command), comments=True)
    path = next(word for word in words if word.startswith(f"{SERVER}/")).removeprefix(SERVER)
    if "--data-binary" in words:  # the file that the call before has saved
        return client.post(path, content=client.post("/api/v1/recordings/sample", json={"length": 5}).content)
    headers = dict(words[at + 1].split(": ", 1) for at, word in enumerate(words) if word == "-H")
    if "-d" not in words:
        return client.get(path, headers=headers)
    body = words[words.index("-d") + 1]
    for name in re.findall("ID_OF_([A-Z]+)", body):  # of files that were sent before
        body = body.replace(
            f"ID_OF_{name}", client.post("/api/v1/recordings", content=signal(name)).json()["id"]
        )
    return client.post(path, content=body, headers=headers)


def signal(name: str) -> str:
    """A file with one signal over time."""
    return f"time,{name.lower()}\n" + "".join(f"{0.01 * k:.2f},{0.001 * k:.3f}\n" for k in range(20))


@pytest.mark.parametrize("command", [*curls(README), *curls(API)])
def test_curl_lines_get_an_answer(client, command):
    if " -sN " in command:  # a stream without an end: that it would be opened (see test_classes_replicas.py)
        command = command.replace("$INSTRUCTOR", "another")
        assert ask(client, command).json()["code"] == "unknown_secret"
        return
    reply = ask(client, command)
    assert reply.status_code == 200, command
    assert reply.content if "-o " in command or "format=csv" in command else json.loads(reply.text)


def test_every_call_is_worked(client):
    """Each path of the OpenAPI document stands in docs/api.md as a call."""
    known = {path for path in client.get("/openapi.json").json()["paths"] if not path.startswith("/scene")}
    worked = set(re.findall(rf"{SERVER}([^\s'?#]+)", "\n".join(curls(API))))
    assert {path for path in known if "{" not in path} <= worked


def test_python_example_runs(capsys, monkeypatch):
    monkeypatch.setenv("MPLBACKEND", "agg")
    (example,) = blocks(README, "python")
    exec(compile(example, "README.md", "exec"), {})
    shown = capsys.readouterr().out
    assert "51.17" in shown and "1.0069" in shown
    import matplotlib.pyplot as plt

    assert len(plt.gca().lines) == 2
    plt.close("all")


def save_files():
    """A rig's run, a study and a flight's script as the files that the README names."""
    spec = Spec.from_preset(preset())
    loop, digital = close_loop(place(spec), spec.outer), Digital()
    rig = deviating_rig(spec.parameters, 0.1, 1)
    made = sample_recording(loop, spec.limits, digital, rig=rig, duration=4.0, size=(0.1, 0.2))
    signals = dict(zip(("pitch", "yaw", "Vp", "Vy"), (*made.measured.T, *made.voltages.T), strict=True))
    Path("run.csv").write_bytes(write_csv({"time": made.t, **signals}))
    degrees = {name: np.degrees(v) if name in ("pitch", "yaw") else v for name, v in signals.items()}
    savemat("run.mat", {"t": made.t, **degrees})
    for name, values in signals.items():
        Path(f"{name}.csv").write_bytes(write_csv({"time": made.t, name: values}))
    Path("gains.toml").write_text("study = 1\n[rigs]\ncount = 20\n")
    Path("gust.txt").write_bytes((ROOT / "examples" / "gust.txt").read_bytes())
    Path("plant.m").write_text("A = [0 1; 20.6 0]; B = [0; 1]; C = [1 0]; p = [-2 -3];")


def test_command_lines_run(tmp_path, monkeypatch):
    from click.testing import CliRunner

    from app.cli.group import heli2dof

    monkeypatch.chdir(tmp_path)
    save_files()
    lines = [
        line for block in blocks(README, "sh") for line in block.split("\n") if line.startswith("heli2dof ")
    ]
    called = [shlex.split(line, comments=True)[1:] for line in lines]
    assert len({words[0] for words in called}) >= 6
    for words in called:
        if words[0] not in ("serve", "completion"):
            result = CliRunner().invoke(heli2dof, words, prog_name="heli2dof")
            assert result.exit_code == 0, (words, result.output)
