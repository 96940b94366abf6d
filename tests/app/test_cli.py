"""The command line: the REST API's numbers, its words for refused input, its exit statuses, a short start."""

from __future__ import annotations

import io
import json
import signal
import socket
import subprocess
import sys
from typing import Any

import pytest
from click.testing import CliRunner
from rich.console import Console

from app.cli import main
from app.cli.fields import ALL, body, flag_of
from app.cli.group import COMMANDS, heli2dof
from app.cli.values import Poles
from app.contract.experiment import StepRequest
from app.contract.frequency import RgaRequest
from app.contract.identification import IdentifyRequest
from app.contract.maps import MapRequest
from app.contract.recordings import OverlayRequest
from tests.children import ROOT, environment, python
from tests.patience import PATIENCE


def run(*words: str, status: int = 0, given: str | None = None):
    result = CliRunner().invoke(heli2dof, words, input=given, prog_name="heli2dof")
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    assert result.exit_code == status, result.output
    return result


def test_an_interrupted_server_ends_in_good_order():
    command = [sys.executable, "-m", "app", "serve", "--port", "0"]
    pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    process = subprocess.Popen(command, cwd=ROOT, env=environment(), **pipes)
    assert process.stdout is not None
    assert "is ready: http://127.0.0.1:" in process.stdout.readline()
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0 and "Abort" not in said


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


RIG = {"preset": "quanser-aero-2", "poles": [-2, -3, {"re": -1.5, "im": 1}, {"re": -1.5, "im": -1}]}
WORDS = ("--preset", "quanser-aero-2", "--poles", "-2,-3,-1.5±1j")


@pytest.mark.parametrize(
    ("words", "call", "request_body"),
    [
        (("gains", *WORDS, "--coupling", "input-diagonal"), "gains", {**RIG, "coupling": "input-diagonal"}),
        (("gains", *WORDS, "--parameter", "J_p=0.03"), "gains", {**RIG, "parameters": {"J_p": 0.03}}),
        (("gains", *WORDS, "--split", "3,4/1,2"), "gains", {**RIG, "split": [[2, 3], [0, 1]]}),
        (("rga", *WORDS, "--frequencies", "0,1,10"), "rga", {**RIG, "frequencies": [0, 1, 10]}),
        (
            ("step", *WORDS, "--theta", "0.1", "--kp-pitch", "5", "--model", "linear", "--samples", "11"),
            "step",
            {
                **RIG,
                "loops": {"pitch": {"kp": 5}},
                "scenario": {"reference": {"theta": 0.1}, "model": "linear", "samples": 11},
            },
        ),
        (
            ("compare", *WORDS, "--methods", "full-rank,lqr"),
            "compare",
            {**RIG, "methods": ["full-rank", "lqr"]},
        ),
        (
            ("robustness", *WORDS, "--rigs", "20", "--seed", "3", "--uncertainty", "J_p=0.2"),
            "robustness",
            {**RIG, "samples": 20, "seed": 3, "uncertainty": {"J_p": 0.2}},
        ),
        (
            ("map", *WORDS, "--move", "yaw-pair", "--measure", "overshoot", "--axis", "psi", "--size", "5x4"),
            "map",
            {**RIG, "map": {"move": "yaw-pair", "measure": "overshoot", "axis": "psi", "size": [5, 4]}},
        ),
        (
            (
                *(
                    "map",
                    *WORDS,
                    "--move",
                    "pitch-pi",
                    "--over=1:9,0.1:2",
                    "--size",
                    "4x3",
                    "--scale",
                    "linear",
                ),
                *("--measure", "share_stable", "--uncertainty", "J_p=0.2", "--rigs", "5", "--seed", "2"),
            ),
            "map",
            {
                **RIG,
                "map": {
                    "move": "pitch-pi",
                    "over": [[1, 9], [0.1, 2]],
                    "size": [4, 3],
                    "scale": "linear",
                    "measure": "share_stable",
                    "uncertainty": {"spread": {"J_p": 0.2}, "samples": 5, "seed": 2},
                },
            },
        ),
    ],
)
def test_json_is_what_the_rest_api_replies(client, words, call, request_body):
    reply = client.post(f"/api/v1/{call}", json=request_body)
    assert reply.status_code == 200, reply.text
    own, theirs = json.loads(run(*words, "--json").stdout), reply.json()
    if call == "robustness":  # the sums are dealt out to threads in another order
        assert own.pop("envelopes").keys() == theirs.pop("envelopes").keys()
    assert own == theirs


def test_symbolic_and_paper_give_the_rest_apis_json(client):
    shown = json.loads(run("symbolic", "--coupling", "axis-decoupled", "--json").stdout)
    assert shown == client.get("/api/v1/symbolic?coupling=axis-decoupled").json()
    assert json.loads(run("paper", "--json").stdout) == client.get("/api/v1/paper").json()


def test_a_design_comes_from_a_file_and_options_change_it(tmp_path):
    file = tmp_path / "design.json"
    file.write_text(json.dumps({**RIG, "parameters": {"J_p": 0.03}}), encoding="utf-8")
    changed = json.loads(run("gains", "--design", str(file), "--parameter", "B_p=0.01", "--json").stdout)
    both = json.dumps({**RIG, "parameters": {"J_p": 0.03, "B_p": 0.01}})
    assert changed == json.loads(run("gains", "--design", "-", "--json", given=both).stdout)
    assert "not JSON" in run("gains", "--design", "-", given="{", status=2).stderr
    assert "not a JSON object" in run("gains", "--design", "-", given="[]", status=2).stderr


@pytest.mark.parametrize(
    ("words", "field", "flag"),
    [
        (("gains", "--preset", "nix"), "preset", "--preset"),
        (("gains", "--poles", "-1,-2,-3"), "poles", "--poles"),
        (("gains", "--poles", "-1,-2+1j,-3,-4"), "poles.1", "--poles"),
        (("gains", "--coupling", "loose"), "coupling", "--coupling"),
        (("gains", "--parameter", "J_p=-1"), "parameters.J_p", "--parameter"),
        (("gains", "--parameter", "J_q=1"), "parameters.J_q", "--parameter"),
        (("step", "--ti-yaw", "0"), "loops.yaw.ti", "--ti-yaw"),
        (("step", "--duration", "nan"), "scenario.duration", "--duration"),
        (("robustness", "--rigs", "0"), "samples", ""),
        (("map", "--move", "pitch"), "map.move", "--move"),
        (("map", "--move", "pitch-pi", "--over=0:1,1:2"), "map.over.0.0", "--over"),
        (("map", "--move", "yaw-pair", "--measure", "norm", "--axis", "psi"), "map.axis", "--axis"),
        (
            ("map", "--move", "yaw-pair", "--measure", "share_stable", "--uncertainty", "mass=1"),
            "map.uncertainty.spread.mass",
            "--uncertainty",
        ),
        (("symbolic", "nonsense"), "names", ""),
        (("symbolic", "--lead", "roll"), "lead", "--lead"),
        (
            ("export", "csv", "-o", "-", "--operating-point", "3"),
            "operating_point.theta",
            "--operating-point",
        ),
    ],
)
def test_refused_input_is_status_2_and_names_the_field(words, field, flag):
    told = run(*words, status=2)
    assert told.stdout == ""
    assert told.stderr.startswith(f"heli2dof: {flag} ({field}): " if flag else f"heli2dof: {field}: ")
    problem = json.loads(run(*words, "--json", status=2).stderr)
    assert problem["field"] == field and problem["status"] == 422


@pytest.mark.parametrize(
    "words",
    [
        ("gains", "--poles", "x"),
        ("gains", "--parameter", "J_p"),
        ("nix",),
        ("gains", "--nix"),
        ("rga", "--split", "a"),
    ],
)
def test_what_is_no_input_at_all_is_status_2_too(words):
    assert "Usage: heli2dof" in run(*words, status=2).stderr


def test_tables_hold_the_numbers_and_fit():
    shown = run("gains").stdout
    assert "51.17" in shown and "−12" in shown and "V·s/rad" in shown
    assert max(map(len, run("compare").stdout.split("\n")[:20])) <= 120
    assert "overshoot (%)" in run("step", "--theta", "0.1").stdout
    assert "Niederlinski" in run("rga").stdout
    robust = run("robustness", "--rigs", "600")
    assert "600 of 600 rigs" in robust.stdout and "rigs" not in robust.stderr
    paper = " ".join(run("paper").stdout.split())
    assert (
        "8 errata are confirmed" in paper
        and "4 places are unclear" in paper
        and "FAILS" not in paper
        and paper.count("holds") >= 12
    )
    assert run("symbolic", "B", "alpha").stdout.count("\n") == 2
    assert run("symbolic", "--notation", "latex").stdout.startswith(r"\left[")


def test_progress_is_on_the_terminal_alone(monkeypatch):
    from app.cli import comparisons
    from heli2dof_core import Spec, Uncertainty
    from heli2dof_core.robustness import cloud_in_parts

    screen = Console(force_terminal=True, width=80, record=True, file=io.StringIO())
    monkeypatch.setattr(comparisons, "console", lambda **_: screen)
    part = comparisons._followed(cloud_in_parts(Spec.from_preset(), Uncertainty(samples=600)), 600)
    assert part.done == 600
    assert "600/600" in screen.export_text()


def test_a_map_is_a_table_a_picture_or_rows(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    words = ("map", *WORDS, "--move", "yaw-pair", "--measure", "norm", "--size", "6x5")
    shown = run(*words).stdout
    assert "Norm of K" in shown and "6 × 5 places of yaw's pair" in shown and "best" in shown
    assert max(map(len, shown.split("\n"))) <= 120
    assert run(*words, "--svg").stdout.strip() == "heli2dof_map.svg"
    assert (tmp_path / "heli2dof_map.svg").read_text(encoding="utf-8").startswith("<svg ")
    assert "--force" in run(*words, "--svg", status=1).stderr
    assert run(*words, "-o", "own.csv").stdout.strip() == "own.csv"
    rows = (tmp_path / "own.csv").read_text(encoding="utf-8")
    assert rows == run(*words, "--csv", "-o", "-").stdout
    assert "--svg" in run(*words, "-o", "own.txt", status=2).stderr
    assert "--move" in run("map", status=2).stderr


def test_an_export_is_a_file_and_is_not_written_over(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    name = run("export", "csv", *WORDS).stdout.strip()
    first = (tmp_path / name).read_bytes()
    assert b"quanser-aero-2" in first
    assert "--force" in run("export", "csv", status=1).stderr
    assert (tmp_path / name).read_bytes() == first
    run("export", "csv", "--force")
    assert (tmp_path / name).read_bytes() != first
    assert "cannot write" in run("export", "csv", "-o", "no/such/folder", status=1).stderr
    assert run("export", "csv", *WORDS, "-o", "-").stdout_bytes == first


def test_every_option_names_a_field_that_exists():
    requests = StepRequest, RgaRequest, OverlayRequest, IdentifyRequest, MapRequest
    schemas = [request.model_json_schema() for request in requests]
    schemas.append({"properties": {name: {} for name in ("separator", "decimal")}})  # of the query
    for option in ALL:
        found = False
        for schema in schemas:
            place, known = schema, True
            for part in option.path.split("."):
                while "$ref" in place or "anyOf" in place:
                    place = (
                        place["anyOf"][0]
                        if "anyOf" in place
                        else schema["$defs"][place["$ref"].split("/")[-1]]
                    )
                known = known and part in place.get("properties", {})
                place = place.get("properties", {}).get(part, {})
            found = found or known
        assert found, option.path
        assert flag_of(option.path) == option.flag.partition("/")[0]


def test_the_request_is_made_of_what_is_given_alone():
    nothing = {option.parameter: None for option in ALL}
    assert body(None, nothing) == {}
    assert body(None, {**nothing, "scenario__saturation": False}) == {"scenario": {"saturation": False}}


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("-1,-2,-3,-4", [-1, -2, -3, -4]),
        ("-12, -10, −3±4i", [-12, -10, {"re": -3, "im": 4}, {"re": -3, "im": -4}]),
        ("-3+-4j,-1e-3,-1e+1", [{"re": -3, "im": 4}, {"re": -3, "im": -4}, -0.001, -10]),
    ],
)
def test_poles_as_people_write_them(text, expected):
    assert Poles().convert(text, None, None) == expected


def test_recordings_are_read_overlaid_and_identified(tmp_path):
    """Columns and units by the file; what the options say goes before; refusals name the option."""
    made = run("export", "csv", "--theta", "0.1", "--duration", "4", "-o", "-").stdout_bytes
    path = tmp_path / "run.csv"
    path.write_bytes(made)
    table = run("read", str(path)).stdout
    assert "theta_nonlinear [rad]" in table and "501 rows" in table
    preview = json.loads(run("read", str(path), "--json").stdout)
    assert preview["guess"]["columns"]["theta"] == "theta_nonlinear [rad]"
    reply = json.loads(run("overlay", str(path), "--json").stdout)
    assert min(reply["fit"].values()) > 98
    assert "fit (%)" in run("overlay", str(path), "--driver", "voltages").stdout
    wrong = json.loads(
        run("overlay", str(path), "--json", "--sign", "theta=-1", "--column", "psi=psi_linear [rad]").stdout
    )
    assert wrong["fit"]["theta"] < 50
    found = json.loads(run("identify", str(path), "--free", "K_pp,K_yy", "--segment", "2", "--json").stdout)
    assert [e["name"] for e in found["estimates"]] == ["K_pp", "K_yy"]
    assert "K_pp" in run("identify", str(path), "--free", "K_pp").stdout
    refused = run("overlay", str(path), "--time-unit", "us", status=2).stderr
    assert "--time-unit (columns.time_unit)" in refused and "Choose its unit" in refused
    assert "--separator" in run("read", str(path), "--separator", "slash", status=2).stderr
    assert "cannot read" in run("read", str(tmp_path / "none.csv"), status=2).stderr


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_has_help(name):
    assert f"Usage: heli2dof {name}" in run(name, "--help").stdout
    assert COMMANDS[name][1] in run("--help").stdout


@pytest.mark.parametrize(
    ("shell", "words", "expected"),
    [("bash", "heli2dof ga", "gains"), ("bash", "heli2dof gains --preset quanser-aero", "quanser-aero-2"),
     ("bash", "heli2dof step --parameter K_p", "K_pp="), ("bash", "heli2dof gains --coupling tri", "triangular")],
)  # fmt: skip
def test_the_shell_completes(shell, words, expected):
    environment = {
        "_HELI2DOF_COMPLETE": f"{shell}_complete",
        "COMP_WORDS": words,
        "COMP_CWORD": str(len(words.split()) - 1),
    }
    result = CliRunner().invoke(heli2dof, [], env=environment, prog_name="heli2dof")
    assert expected in result.stdout
    assert "_HELI2DOF_COMPLETE=bash_complete" in run("completion", "bash").stdout


@pytest.mark.parametrize(
    ("code", "forbidden"),
    [
        (
            "import app.cli; app.cli.main(['--help'])",
            ("numpy", "heli2dof_core", "rich", "fastapi", "uvicorn"),
        ),
        (
            "import app.cli; app.cli.main(['gains', '--json'])",
            ("fastapi", "uvicorn", "viser", "control", "rich"),
        ),
        ("import app.cli.serving", ("rich.console", "sympy", "control", "viser", "scipy")),
    ],
)
def test_the_start_is_short(code, forbidden):
    told = f"print([m for m in {forbidden!r} if m in sys.modules])"
    ends = f"import sys, atexit; atexit.register(lambda: {told}); {code}"
    assert python("-c", ends).strip().split("\n")[-1] == "[]"


def test_tables_are_not_markup():
    from app.cli import output
    from heli2dof_core.tables import Table

    runner = CliRunner()
    with runner.isolation() as (out, *_):
        output.show((Table.of("[b]", ("[red]x",), [("[/]",)]),))
        assert b"[b]" in out.getvalue() and b"[red]x" in out.getvalue() and b"[/]" in out.getvalue()


def test_any_system_is_placed_in_numbers_and_in_formulas(client):
    numbers = ("place", "-A", "0,1; 2,3", "-B", "0;1", "--poles", "-2±1j", "--json")
    body = {"A": [[0, 1], [2, 3]], "B": [[0], [1]], "poles": [{"re": -2, "im": 1}, {"re": -2, "im": -1}]}
    assert json.loads(run(*numbers).stdout) == client.post("/api/v1/place", json=body).json()
    letters = ("place", "-A", "0,1; -k/m,−b/m", "-B", "0;1/m")
    body = {"A": [["0", "1"], ["-k/m", "-b/m"]], "B": [["0"], ["1/m"]]}
    assert (
        json.loads(run(*letters, "--json").stdout) == client.post("/api/v1/symbolic/place", json=body).json()
    )
    shown = run(*letters).stdout
    assert "holds where m ≠ 0" in shown and "K = Matrix([[" in shown
    refused = run("place", "-A", "a*", "-B", "1", status=2)
    assert "A.0.0" in refused.stderr and "position 3" in refused.stderr
