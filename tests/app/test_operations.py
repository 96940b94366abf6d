"""Logs, metrics, health and settings."""

from __future__ import annotations

import json
import logging
import re
from pathlib import Path

import httpx2
import pytest
from fastapi import FastAPI
from prometheus_client.parser import text_string_to_metric_families
from pydantic import ValidationError
from starlette.testclient import TestClient
from websockets.sync.client import connect

from app.cli.group import heli2dof
from app.main import create_app
from app.ops import logs
from app.ops.settings import Settings, complaint, variable
from tests.children import ROOT, served
from tests.patience import until
from tests.scene_client import session_id

README = (ROOT / "README.md").read_text(encoding="utf-8")


def figures(client: TestClient) -> dict[str, float]:
    """Every sample by its name with its labels."""
    families = text_string_to_metric_families(client.get("/metrics").text)
    return {
        sample.name + "".join(f"|{label}" for label in sample.labels.values()): sample.value
        for family in families
        for sample in family.samples
    }


# Metrics


def test_what_is_done_is_counted(client: TestClient):
    before = figures(client)
    client.post("/api/v1/gains", json={})
    client.post("/api/v1/gains", json={"poles": [1]})
    client.get("/no/such/thing")
    client.get("/nor/this/one")
    with client.websocket_connect("/api/v1/live") as socket:
        socket.send_json({"seq": 1})
        socket.receive_json()
        socket.send_json({"seq": "x"})
        socket.receive_json()
        during = figures(client)
    with client.websocket_connect("/api/v1/robustness") as socket:
        socket.send_json({"samples": 3})
        socket.receive_json()
    after = figures(client)

    def more(name: str) -> float:
        return after.get(name, 0.0) - before.get(name, 0.0)

    assert more("heli2dof_http_requests_total|POST|/api/v1/gains|200") == 1
    assert more("heli2dof_http_requests_total|POST|/api/v1/gains|422") == 1
    assert more("heli2dof_http_requests_total|GET|(none)|404") == 2
    assert more("heli2dof_live_answers_total|evaluation") == 1
    assert more("heli2dof_live_answers_total|problem") == 1
    assert more("heli2dof_live_update_seconds_count") == 2
    assert 0 < more("heli2dof_live_update_seconds_sum") < 20
    assert more("heli2dof_robustness_runs_total") == 1
    assert during["heli2dof_sockets_open|/api/v1/live"] == 1
    assert after["heli2dof_sockets_open|/api/v1/live"] == 0
    assert after["heli2dof_scene_sessions"] == 0
    assert after["heli2dof_pool_waiting|quick"] == after["heli2dof_pool_waiting|slow"] == 0
    assert after["process_resident_memory_bytes"] > 1e7
    assert after["process_open_fds"] > 3


def test_labels_stay_few_whatever_is_asked(client: TestClient):
    client.get("/livez")
    before = set(figures(client))
    for k in range(40):
        client.get(f"/made/up/{k}")
        client.get(f"/static/made-up-{k}.js")
        client.get(f"/scene/{session_id(str(k))}/")
        client.request(f"MADE{k}", "/livez")
    labels = {re.sub(r"\|.*\|", "|", name) for name in set(figures(client)) - before if "_total" in name}
    new = [name for name in set(figures(client)) - before if name.startswith("heli2dof_http_requests_total")]
    assert len(new) <= 5, new
    assert labels


def test_each_app_counts_for_itself(client: TestClient):
    other = TestClient(create_app())
    other.get("/livez")
    assert figures(other)["heli2dof_http_requests_total|GET|/livez|200"] == 1


def test_metrics_can_be_switched_off():
    assert TestClient(create_app(Settings(metrics=False))).get("/metrics").status_code == 404


# Logs


@pytest.mark.parametrize("given", ["abcdef-123", "A.b_c-0123456789"])
def test_a_sane_request_id_is_taken_over(client: TestClient, given: str):
    assert client.get("/livez", headers={"X-Request-ID": given}).headers["x-request-id"] == given


@pytest.mark.parametrize(
    "given", ["", "short", "x" * 65, "with space in it", "line%0abreak", "ümlaut-and-more"]
)
def test_any_other_is_replaced(client: TestClient, given: str):
    reply = client.get("/livez", headers={"X-Request-ID": given.encode()})
    assert re.fullmatch(r"[0-9a-f]{32}", reply.headers["x-request-id"])


def test_a_failure_names_the_request_and_its_log_line_does_too(caplog: pytest.LogCaptureFixture):
    app = create_app()
    assert isinstance(app, FastAPI)

    @app.get("/fails/{secret}")
    async def fails(secret: str) -> None:
        raise RuntimeError("broken")

    with caplog.at_level(logging.ERROR):
        reply = TestClient(app).get("/fails/of-a-session", headers={"X-Request-ID": "request-17"})
    assert reply.status_code == 500
    assert reply.headers["x-request-id"] == reply.json()["request_id"] == "request-17"
    assert reply.headers["x-content-type-options"] == "nosniff"
    assert reply.json()["code"] == "internal_error"
    (record,) = caplog.records
    assert record.exc_info and "of-a-session" not in record.getMessage()


def test_lines_are_json_objects_or_plain():
    record = logging.LogRecord("app.x", logging.INFO, __file__, 1, "%s done", ("all",), None)
    record.fields = {"route": "/livez", "status": 200}
    token = logs.request_id.set("request-18")
    try:
        entry = json.loads(logs.JsonFormatter().format(record))
        line = logs.PlainFormatter().format(record)
    finally:
        logs.request_id.reset(token)
    assert entry.pop("time").endswith("+00:00")
    assert entry == {
        "level": "info",
        "logger": "app.x",
        "message": "all done",
        "request_id": "request-18",
        "route": "/livez",
        "status": 200,
    }
    assert line.endswith("INFO app.x: all done [request-18]")
    try:
        raise ValueError("one\ntwo")
    except ValueError as error:
        record.exc_info = (type(error), error, error.__traceback__)
    text = logs.JsonFormatter().format(record)
    assert "\n" not in text and "two" in json.loads(text)["exception"]


def test_a_servers_log_says_what_was_done_and_not_by_whom(tmp_path: Path):
    session = session_id("secret")
    with served(tmp_path, log_format="json", log_level="debug") as server:
        assert httpx2.get(f"{server.http}/api/v1/presets?who=me&token=hidden").status_code == 200
        assert httpx2.get(f"{server.http}/scene/{session}/").status_code == 200
        assert httpx2.get(f"{server.http}/private/path").status_code == 404
        with connect(f"{server.ws}/scene/{session}/hub?page=true", proxy=None) as socket:
            socket.recv(timeout=20)
        until(lambda: "closed with" in server.log.read_text(), "the socket's end is logged")
        server.process.terminate()
        assert server.process.wait(20) == 0
        text = server.log.read_text()
    entries = [json.loads(line) for line in text.splitlines()]
    assert {"time", "level", "logger", "message"} <= set.intersection(*(set(entry) for entry in entries))
    routes = {(entry.get("route"), entry.get("status")) for entry in entries}
    assert {("/api/v1/presets", 200), ("/scene/{session}/", 200), ("(none)", 404)} <= routes
    opened, closed = [e for e in entries if e.get("route") == "/scene/{session}/hub"]
    assert opened["request_id"] == closed["request_id"]
    assert (opened["event"], closed["event"], closed["code"]) == ("opened", "closed", 1000)
    for private in ("127.0.0.1", "hidden", "who=me", session, "private/path"):
        assert private not in text


# Settings


@pytest.mark.parametrize(
    ("name", "value", "says"),
    [
        ("HELI2DOF_SCENES", "many", "HELI2DOF_SCENES: input should be a valid integer"),
        ("HELI2DOF_SCENES", "-1", "HELI2DOF_SCENES: input should be greater than or equal to 0"),
        ("HELI2DOF_PORT", "99999", "HELI2DOF_PORT: input should be less than or equal to 65535"),
        ("PORT", "http", "PORT: input should be a valid integer"),
        ("HELI2DOF_LOG_FORMAT", "xml", "HELI2DOF_LOG_FORMAT: input should be 'plain' or 'json'"),
        ("HELI2DOF_ACCESS_TOKEN", "secret123", "HELI2DOF_ACCESS_TOKEN: it needs 16 characters"),
        ("HELI2DOF_CORS_ORIGINS", "tools.example", "HELI2DOF_CORS_ORIGINS: 'tools.example' is no origin"),
        ("HELI2DOF_FRAME_ANCESTORS", "https://a;b", "HELI2DOF_FRAME_ANCESTORS: 'https://a;b' is no source"),
        ("HELI2DOF_ROOT_PATH", "lab", "HELI2DOF_ROOT_PATH: string should match"),
        (
            "HELI2DOF_TRUSTED_PROXIES",
            "10.0.0.0/99",
            "HELI2DOF_TRUSTED_PROXIES: '10.0.0.0/99' does not appear",
        ),
        ("HELI2DOF_DRAIN", "nan", "HELI2DOF_DRAIN: input should be"),
        ("HELI2DOF_DASK", "10.0.0.1:8786", "HELI2DOF_DASK: it is no address of a scheduler"),
    ],
)
def test_a_wrong_value_ends_it_with_one_line_that_names_the_variable(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], name: str, value: str, says: str
):
    from click.testing import CliRunner

    monkeypatch.delenv("PORT", raising=False)
    monkeypatch.setenv(name, value)
    result = CliRunner().invoke(heli2dof, ["serve"], prog_name="heli2dof")
    assert result.exit_code == 2
    (line,) = result.stderr.splitlines()
    assert line.startswith(f"heli2dof: {says}")
    assert "secret123" not in line


def test_a_cluster_asks_for_its_package(monkeypatch: pytest.MonkeyPatch):
    assert Settings(dask="tcp://10.0.0.1:8786").dask == "tcp://10.0.0.1:8786"
    monkeypatch.setattr("app.ops.settings.find_spec", lambda name: None)
    with pytest.raises(ValidationError) as refused:
        Settings(dask="tcp://10.0.0.1:8786")
    assert complaint(refused.value) == (
        "HELI2DOF_DASK: distributed is not installed: pip install 'heli2dof[dask]'"
    )


def test_words_are_read_from_one_variable(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setenv("HELI2DOF_CORS_ORIGINS", "https://A.example, http://b.example:81")
    monkeypatch.setenv("HELI2DOF_FRAME_ANCESTORS", "self https://*.uni.example")
    monkeypatch.setenv("PORT", "9001")
    settings = Settings()
    assert settings.cors_origins == ("https://a.example", "http://b.example:81")
    assert settings.frame_ancestors == ("'self'", "https://*.uni.example")
    assert settings.port == 9001
    monkeypatch.setenv("HELI2DOF_PORT", "9002")
    assert Settings().port == 9002
    assert Settings(port=9003).port == 9003


def test_unknown_settings_are_refused():
    with pytest.raises(ValidationError) as refused:
        Settings(colour="red")  # pyright: ignore[reportCallIssue]
    assert complaint(refused.value) == "HELI2DOF_COLOUR: extra inputs are not permitted"


def rows_of_settings() -> list[str]:
    """The README's table as the settings themselves say it."""
    rows = []
    for name, field in Settings.model_fields.items():
        default = field.get_default(call_default_factory=False) if field.default_factory is None else None
        words = " ".join(default) if isinstance(default, tuple) else default
        shown = "" if words in (None, "") else f"`{words:g}`" if isinstance(words, float) else f"`{words}`"
        rows.append(f"| `{variable(name)}` | {shown} | {field.description} |")
    return rows


def test_the_readme_lists_every_setting():
    table = [line for line in README.splitlines() if line.startswith("| `HELI2DOF_")]
    assert table == rows_of_settings()
