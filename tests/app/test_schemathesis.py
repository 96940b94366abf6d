"""Schemathesis over the whole OpenAPI document with every check on: what it says is what is answered.

One check is narrowed rather than switched off: valid input may be refused where JSON Schema cannot express
the rule. `RULES` lists, for each call, which refusals those are; any other refusal fails.

Bodies share most of their fields. Each field is covered in the first call of the document that takes it (every bound,
every type, every omission), and whole bodies, valid and invalid, are generated for every call.
"""

from __future__ import annotations

import copy
import json
import math
import re
from collections import Counter
from collections.abc import Iterator
from typing import Any

import httpx2
import orjson
import pytest
import schemathesis

# Schemathesis imports it late. In Python 3.11 pytest's rewriting of it fails where another thread prints a traceback:
# both parse, and ast keeps one depth for all threads.
import schemathesis.specs.openapi.object_authorization
from hypothesis import HealthCheck, Phase, settings
from schemathesis.checks import load_all_checks
from schemathesis.config import SchemathesisConfig
from schemathesis.specs.openapi.checks import positive_data_acceptance

from app.main import create_app
from tests.app.class_room import ClassRoom, labs_folder
from tests.patience import PATIENCE
from tests.whole_server import serving

load_all_checks()
pytestmark = [pytest.mark.filterwarnings("ignore"), pytest.mark.slow]

DESIGN = {
    "unpaired_poles": "a pair is two real poles or two conjugates; a split may separate conjugates",
    "uncontrollable": "K_pp K_yy = K_py K_yp: a product of four fields",
    "structure_unavailable": "a coupling needs K_pp or K_yy other than 0; only some have a shift",
    "method_unavailable": "a method may not solve the task: multiple poles, a Riccati equation without solution",
    "invalid_input shift": "the axis-decoupled structure has none",
    "invalid_input rotors.(pitch|yaw).tau": "rotors are placed that follow at once",
    "invalid_input rotors.(pitch|yaw).(matched_at|dead_zone)": "a curve is matched beyond its dead zone",
    "invalid_input rotor_poles.[01]": "those are real: each axis' pair may be complex",
}
EXPERIMENT = DESIGN | {
    "invalid_input scenario.digital.sample_time": "the duration may hold at most 100,000 samples of the controller",
    "invalid_input scenario.digital.encoders.(theta|psi)": "the counts of another rig",
}
SYSTEM = {
    "unpaired_poles": "each complex pole needs its conjugate",
    "uncontrollable": "the rank of [B, AB, …] or of its dual",
    "method_unavailable": "a method may not solve the task",
    "invalid_input (A|B|C|D|poles|observer_poles|weights|x0|duration).*": "the shapes of matrices must agree",
}
RIGS = EXPERIMENT | {
    "invalid_input scenario.(digital|disturbance|noise)": "the cloud is continuous and undisturbed",
}
LAB = {"unknown_step step": "the lab's steps", "invalid_input hints": "as many hints as the step has"}
LOG = {
    "changed_log flight.checksum": "CRC-32 of all else that the log holds",
    "invalid_input flight.flight": "an event's values may be anything in the schema, but are not deep",
}
RULES: dict[str, dict[str, str]] = {
    "POST /api/v1/suggest": DESIGN
    | {
        "invalid_input poles": "PI values are suggested for stable poles only",
        "invalid_input loops.*": "there may be none in the range of gains that keep the whole loop stable",
    },
    **dict.fromkeys(
        [f"POST /api/v1/{name}" for name in ("gains", "rga", "splits", "walkthrough", "locus")],
        DESIGN,
    ),
    **dict.fromkeys(
        [
            f"POST /api/v1/{name}"
            for name in ("step", "evaluate", "loops", "lag", "compare", "motion", "recordings/sample")
        ],
        EXPERIMENT,
    ),
    "POST /api/v1/export/{format}": EXPERIMENT,
    "POST /api/v1/recordings/sample": EXPERIMENT
    | {
        "invalid_input poles": "under this controller the rig runs away",
        "invalid_input parameters.*": "the recorded rig deviates from the design's, at the edge of a range beyond it",
        "invalid_input duration": "length over sample time is bounded",
    },
    "POST /api/v1/robustness": RIGS,
    **dict.fromkeys(
        ["POST /api/v1/map", "POST /api/v1/map/{format}"],
        RIGS
        | {
            "invalid_input map.(move|real|scale)": "a method may not depend on it; poles have no logarithms",
            "invalid_input map.(axis|motor|model|steps)": "only some figures have them; an axis may not be stepped",
            "invalid_input map.over.*": "ends rise, and are what poles or gains may be",
            "invalid_input map.size": "the product of both sides is bounded",
            "invalid_input map.uncertainty.*": "shares need rigs; their number times the places is bounded",
        },
    ),
    "POST /api/v1/nearest": EXPERIMENT
    | {
        "invalid_input nearest.require.*": "limits rise; a figure has an axis, a motor or neither; no shares",
        "invalid_input nearest.free.*": "loops or rotors may not be there; a pair that the method does not place",
        "invalid_input method": "of some methods the poles are no handles",
    },
    "POST /api/v1/find": RIGS
    | {
        "invalid_input find.free": "loops, weights, rotors, an observer may not be there, or be without effect",
        "invalid_input find.(require|minimize).*": "limits rise; a figure has an axis, a motor or neither",
        "invalid_input find.bounds.*": "ranges rise, above 0",
        "invalid_input find.uncertainty.*": "shares need rigs, and each of those told is put on all",
    },
    **dict.fromkeys(
        [f"POST /api/v1/track{kind}" for kind in ("", "/csv", "/svg")],
        EXPERIMENT
        | {
            "invalid_input track.(path|kept)": "a pair is real or complex; weights are of some methods",
            "invalid_input track.(over|scale)": "each number has a range of its own; no equal factors from 0",
            "invalid_input track.measures.*": "a figure has an axis, a motor or neither; kept gains have none",
            "invalid_input uncertainty": "shares are of uncertain rigs",
        },
    ),
    "POST /api/v1/place": {
        "unpaired_poles": "each complex pole needs its conjugate",
        "uncontrollable": "the rank of [B, AB, …]",
        "method_unavailable": "a method may not solve the task: multiple poles, too few inputs, outputs left out",
        "invalid_input (A|B|C|poles|shift|groups|input_order|weights).*": "the shapes of matrices must agree",
        "invalid_input (groups|input_order|triangle|shift)": "belong to full-rank placement alone",
    },
    "POST /api/v1/system/read": {
        "invalid_input text": "the grammar of pasted texts, and the shapes of matrices",
    },
    "POST /api/v1/system/design": SYSTEM,
    "POST /api/v1/system/export/{format}": SYSTEM,
    "POST /api/v1/system/formulas": {
        "uncontrollable": "the rank of [B, AB, …]",
        "invalid_input (A|B|C).*": "the grammar of expressions, the shapes of matrices, and time",
    },
    "POST /api/v1/symbolic/place": {
        "unpaired_poles": "each complex pole needs its conjugate",
        "uncontrollable": "the rank of [B, AB, …]",
        "invalid_input (A|B).*": "the grammar of expressions, the shapes of matrices, and time",
        "invalid_input (poles|groups).*": "as many poles as states, dealt by the indices",
    },
    "POST /api/v1/flights/controller": EXPERIMENT,
    **dict.fromkeys(
        [f"POST /api/v1/flights{kind}" for kind in ("", "/csv", "/mat", "/recording", "/film")], LOG
    ),
    "POST /api/v1/recordings": {"unusable_recording file": "a table in the file's bytes"},
    "POST /api/v1/recordings/join": {"unusable_recording recording": "the keys of recordings that are there"},
    "POST /api/v1/recordings/{key}/overlay": EXPERIMENT
    | {"unusable_recording (recording|columns.*)": "the key of a recording that is there, and its columns"},
    "GET /api/v1/classes/{code}/recording": LAB,
    "GET /api/v1/labs/{lab}/recording": LAB,
    "GET /api/v1/labs/{lab}/steps/{step}/hints/{hint}": LAB,
    "POST /api/v1/labs/{lab}/mark": LAB | EXPERIMENT,
    "POST /api/v1/classes": {"invalid_input (title|closes)": "signs that cannot be seen; a calendar"},
    "PATCH /api/v1/classes/{code}": {"invalid_input (title|closes|open)": "as above; null is none of them"},
    "POST /api/v1/classes/{code}/join": {
        "invalid_input (name|email|login)": "signs that cannot be seen",
        "missing_field name": "a name, or the secret of who comes back",
    },
    "POST /api/v1/classes/{code}/attempts": LAB | EXPERIMENT | {"invalid_input at": "a calendar"},
    "PUT /api/v1/classes/{code}/draft": LAB | EXPERIMENT,
    "POST /api/v1/classes/{code}/hints": LAB,
    "POST /api/v1/classes/{code}/students/{student}/marks": LAB
    | {
        "invalid_input comment": "control characters",
        "unknown_question question": "the lab's questions that are marked by hand",
        "too_many_points points": "as many as the question has",
    },
    "GET /api/v1/symbolic": {"invalid_input shifted": "the axis-decoupled structure has no shift"},
}
EMPTY = {"type": "object", "additionalProperties": False}
GENERATED = 8
"""Whole bodies for each call, of which each may be valid or not."""
BY = "#/components/schemas/"


def bodies(document: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """The JSON bodies' media types, by call."""
    return {
        f"{method.upper()} {path}": operation["requestBody"]["content"]["application/json"]
        for path, methods in document["paths"].items()
        for method, operation in methods.items()
        if "application/json" in operation.get("requestBody", {}).get("content", {})
    }


def first_fields(document: dict[str, Any]) -> dict[str, Any]:
    """The document with each body reduced to what no call before it takes: the same name and the same schema."""
    reduced, seen = copy.deepcopy(document), set()
    for media in bodies(reduced).values():
        body = copy.deepcopy(document["components"]["schemas"][media["schema"]["$ref"].removeprefix(BY)])
        fields = {(name, json.dumps(field, sort_keys=True)) for name, field in body["properties"].items()}
        new = {name for name, _ in fields - seen} | set(body.get("required", ()))
        body["properties"] = {name: field for name, field in body["properties"].items() if name in new}
        for name, field in body["properties"].items():
            known = document["components"]["schemas"].get(field.get("$ref", "").removeprefix(BY), {})
            if "$ref" in field and (name, json.dumps(field, sort_keys=True)) in seen:
                # required, and covered in another call: left as its defaults, where it has some, or refused
                body["properties"][name] = field if known.get("required") and name != "flight" else EMPTY
        seen |= fields
        media["schema"] = body
        media.pop("examples", None)  # they are whole bodies
    return reduced


def schema_of(document: dict[str, Any], **phases: bool):
    enabled = {name: {"enabled": on} for name, on in phases.items()}
    settings = {"phases": enabled, "generation": {"max-examples": GENERATED}}
    return schemathesis.openapi.from_dict(document, config=SchemathesisConfig.from_dict(settings))


DOCUMENT = create_app().openapi()
STREAM = "/api/v1/classes/{code}/events"
"""Has no end that one could wait for; `test_classes_replicas.py` listens to it."""
del DOCUMENT["paths"][STREAM]
BODIES = {call: media["schema"]["$ref"].removeprefix(BY) for call, media in bodies(DOCUMENT).items()}
SEARCH = "POST /api/v1/find"
"""Takes as long as it is given."""
whole = schema_of(DOCUMENT, examples=True, coverage=False, fuzzing=True)
fields = schema_of(first_fields(DOCUMENT), examples=False, coverage=True, fuzzing=False)
sent: Counter[tuple[str, str, str]] = Counter()
bounded = settings(
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.explicit, Phase.generate],
)


@pytest.fixture(scope="module")
def base(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    labs = labs_folder(tmp_path_factory.mktemp("labs"))
    rates = {"request_rate": 100_000, "request_burst": 1_000_000, "classes_most": 100_000}
    with serving(labs=labs, **rates) as server:
        yield server.http
    print(f"\n{sent.total()} cases")
    for body in dict.fromkeys(body for body, *_ in sent):
        rows = {key[1:]: count for key, count in sent.items() if key[0] == body}
        print(f"{body}: {sum(rows.values())}")
        for (call, kind), count in rows.items():
            print(f"    {call}, {kind}: {count}")


def refusal(case, response) -> bool:
    """Whether valid input was refused by a rule of its call's list."""
    if response.status_code != 422 or not case.meta.generation.mode.is_positive:
        return False
    problem = response.json()
    # A pin is a design like another, and so is that of an attempt.
    field = re.sub(r"^(pins\.\d+|design)\.", "", problem.get("field") or "")
    said = f"{problem['code']} {field}".strip()
    rules = RULES.get(case.operation.label, {})
    return any(re.fullmatch(rule if " " in rule else f"{rule}( .*)?", said) for rule in rules)


def finite(value) -> bool:
    if isinstance(value, dict):
        return all(map(finite, value.values()))
    if isinstance(value, list):
        return all(map(finite, value))
    return not isinstance(value, float) or math.isfinite(value)


def admit(case, base: str) -> None:
    """Lets a valid call on a lab or a class meet one that is there, with secrets that open it."""
    path = case.path_parameters
    if "lab" in path:
        path["lab"] = "small"
    if "code" not in path:
        return
    with httpx2.Client(base_url=base, timeout=PATIENCE, trust_env=False) as client:
        room = ClassRoom.made(client)
        ada = room.join()
    path["code"] = room.code
    if "student" in path:
        path["student"] = ada["id"]
    own = case.path.endswith(("/mine", "/recording"))
    case.headers["Heli2dof-Secret"] = ada["student"] if own else room.instructor
    if isinstance(case.body, dict) and case.body.get("student"):
        case.body["student"] = ada["student"]


def check(case, base: str, kind: str) -> None:
    """Sends a case and holds the answer to what is described."""
    label = case.operation.label
    sent[BODIES.get(label, "no JSON body"), label, kind] += 1
    if case.meta.generation.mode.is_positive:
        admit(case, base)
        if label == SEARCH and isinstance(case.body, dict):
            case.body["find"] |= {"seconds": min(case.body["find"].get("seconds", 60.0), 0.3)}
    response = case.call(base_url=base, timeout=PATIENCE)
    excepted = [positive_data_acceptance] if refusal(case, response) else []
    case.validate_response(response, excluded_checks=excepted, transport_kwargs={"base_url": base})
    (media,) = response.headers.get("content-type", [""])
    if response.status_code >= 400:
        assert media == "application/problem+json"
        problem = response.json()
        assert problem["status"] == response.status_code and problem["code"] and problem["detail"]
    elif media == "application/json":
        assert finite(orjson.loads(response.content))  # which knows no NaN


@whole.parametrize()
@bounded
def test_what_is_described_is_what_is_answered(case, base):
    check(case, base, "whole")


@fields.parametrize()
@bounded
def test_every_field_is_what_is_described(case, base):
    check(case, base, "fields")


def test_every_field_is_covered_once():
    """No field of any body is left to its siblings without one that covers it, and none is covered twice."""
    reduced = bodies(first_fields(DOCUMENT))
    covered = Counter(
        (name, json.dumps(field, sort_keys=True))
        for media in reduced.values()
        for name, field in media["schema"]["properties"].items()
        if name not in media["schema"].get("required", ())
    )
    schemas = [DOCUMENT["components"]["schemas"][name] for name in set(BODIES.values())]
    everything = {
        (name, json.dumps(field, sort_keys=True))
        for body in schemas
        for name, field in body["properties"].items()
        if name not in body.get("required", ())
    }
    assert set(covered) == everything
    assert set(covered.values()) == {1}


def test_every_exception_belongs_to_a_call():
    labels = {result.ok().label for result in whole.get_all_operations()}
    assert set(RULES) <= labels
