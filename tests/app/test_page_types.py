"""The page's types of the contract: current, and replies are what they say of fields that may be absent."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from typing import Any

import pytest

from tests.app.class_room import in_class
from tests.app.test_openapi import DOCUMENT, bodies
from tests.page_types import PAGE, REF, WHOLE, contract, module

KNOWN, ASKED = contract()
UNSTABLE = [{"re": 1, "im": 0}, {"re": -2, "im": 0}, {"re": -3, "im": 0}, {"re": -4, "im": 0}]
MORE = [
    ("/api/v1/evaluate", {"method": "lqr", "outer": "none", "each_axis": True}),
    ("/api/v1/evaluate", {"poles": UNSTABLE, "scenario": {"duration": 0.2}}),
    ("/api/v1/evaluate", {"preset": "quanser-aero", "scenario": {"reference": {"psi": 0.1}}}),
    ("/api/v1/walkthrough", {"method": "lqr-integral"}),
    ("/api/v1/compare", {"poles": UNSTABLE}),
]
EXAMPLES = [(path, example["value"]) for path, _, example in bodies() if "{key}" not in f"{path} {example}"]
CALLS = [(path, body) for path, body in [*EXAMPLES, *MORE] if "{" not in path]
GOT = [
    path
    for path, calls in DOCUMENT["paths"].items()
    if "get" in calls and path.startswith("/api/v1/") and not path.endswith("/members")
]
"""Members are told by a learning platform: see test_lti.py."""


def test_the_pages_types_are_current():
    """`python -m tests.page_types` writes them anew."""
    assert PAGE.read_text("utf-8") == module()


def may_be(value: Any, schema: Mapping[str, Any]) -> bool:
    """Whether a value can be this one of several kinds: an object has no other fields than its own."""
    fields = KNOWN.get(schema.get("$ref", "").removeprefix(REF), {}).get("properties")
    return not fields or (isinstance(value, dict) and set(value) <= set(fields))


def misplaced(value: Any, schema: Mapping[str, Any], place: str = "") -> Iterator[str]:
    """Where something is null that the types say is left out, or left out that they say is null."""
    if name := schema.get("$ref", "").removeprefix(REF):
        fields = KNOWN[name]["properties"]
        required = fields if name in WHOLE else KNOWN[name].get("required", ())
        yield from (f"{place}.{key} is left out" for key in required if key not in value)
        for key, part in value.items():
            if part is None and key not in required:
                yield f"{place}.{key} is null"
            more = {key: {}} if KNOWN[name].get("additionalProperties") is True else {}
            yield from misplaced(part, (more | fields)[key], f"{place}.{key}")
    elif isinstance(value, list):
        yield from (x for part in value for x in misplaced(part, schema.get("items", {}), f"{place}[]"))
    elif isinstance(value, dict):
        own = schema.get("additionalProperties") or {}
        own = {} if own is True else own
        yield from (x for key, part in value.items() for x in misplaced(part, own, f"{place}.{key}"))
    if value is not None:
        yield from (
            x
            for part in schema.get("anyOf", ())
            if may_be(value, part)
            for x in misplaced(value, part, place)
        )


def replied(path: str, verb: str) -> Mapping[str, Any]:
    content = DOCUMENT["paths"][path][verb]["responses"]["200"]["content"]
    return content.get("application/json", {}).get("schema", {})


@pytest.mark.parametrize(("path", "body"), CALLS, ids=lambda part: str(part)[:60])
def test_what_is_absent_is_left_out(client, path, body):
    if path == "/api/v1/classes":
        _, body, _ = in_class(client, path, body)
    reply = client.post(path, json=body)
    assert reply.status_code == 200
    if schema := replied(path, "post"):
        assert list(misplaced(reply.json(), schema)) == []


@pytest.mark.parametrize("path", GOT)
def test_what_is_absent_is_left_out_of_what_is_got(client, path):
    if schema := replied(path, "get"):
        address, _, headers = in_class(client, path) if "{" in path else (path, None, {})
        reply = client.get(address, headers=headers)
        assert reply.status_code == 200, reply.text
        assert list(misplaced(reply.json(), schema)) == []


def test_what_is_absent_of_a_recording_is_null(client):
    reply = {"$ref": f"{REF}Preview"}
    rows = [{"a": k / 10, "b": k * k} for k in range(40)]
    for file in ("a,b\n0,1\n1,2\n2,3\n", json.dumps(rows)):
        preview = client.post("/api/v1/recordings?name=a", content=file).json()
        assert list(misplaced(preview, reply)) == []
        assert preview["guess"]["sample_time"] is None
    assert preview["dialect"] is None
    columns = {"theta": "theta", "psi": "psi", "V_p": "V_p", "V_y": "V_y", "sample_time": 0.002}
    recording = client.post("/api/v1/recordings/sample", json={"length": 2}).content
    preview = client.post("/api/v1/recordings?name=b", content=recording).json()
    overlay = client.post(f"/api/v1/recordings/{preview['id']}/overlay", json={"columns": columns}).json()
    assert list(misplaced(overlay, {"$ref": f"{REF}OverlayReply"})) == []
    with client.websocket_connect("/api/v1/recordings/identify") as socket:
        socket.send_json({"recording": preview["id"], "columns": columns, "free": ["B_p"]})
        while not (found := socket.receive_json()).get("done", True):
            pass
    assert list(misplaced(found, {"$ref": f"{REF}IdentificationReply"})) == []


def test_what_is_refused_leaves_out_what_it_does_not_say(client):
    problem = client.post("/api/v1/gains", json={"method": "none"}).json()
    assert list(misplaced(problem, {"$ref": f"{REF}Problem"})) == []
    assert "request_id" not in problem


def test_requests_may_say_null_and_replies_do_not():
    assert {"DesignRequest", "LiveRequest", "IdentifyRequest", "Mapping", "ScenarioChanges"} <= ASKED
    assert not ASKED & {
        "Evaluation",
        "Preset",
        "Complex",
        "Finding",
        "IdentificationReply",
        "Problem",
        *WHOLE,
    }
    text = PAGE.read_text("utf-8")
    assert "  coupling?: 'triangular' | 'input-diagonal' | 'axis-decoupled' | null;" in text
    assert "  rise_time?: number;" in text
