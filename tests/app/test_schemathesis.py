"""Schemathesis over the whole OpenAPI document with every check on: what it says is what is answered.

One check is narrowed rather than switched off: valid input may be refused where JSON Schema cannot express
the rule. `RULES` lists, for each call, which refusals those are; any other refusal fails.
"""

from __future__ import annotations

import math
import re
import zlib
from collections import Counter
from collections.abc import Iterator

import orjson
import pytest
import schemathesis

# Schemathesis imports it late. In Python 3.11 pytest's rewriting of it fails where another thread prints a traceback:
# both parse, and ast keeps one depth for all threads.
import schemathesis.specs.openapi.object_authorization
from hypothesis import HealthCheck, Phase, settings
from schemathesis.checks import load_all_checks
from schemathesis.specs.openapi.checks import positive_data_acceptance

from app.main import create_app
from tests.whole_server import serving

load_all_checks()
pytestmark = pytest.mark.filterwarnings("ignore")

DESIGN = {
    "unpaired_poles": "a pair is two real poles or two conjugates; a split may separate conjugates",
    "uncontrollable": "K_pp K_yy = K_py K_yp: a product of four fields",
    "structure_unavailable": "a coupling needs K_pp or K_yy other than 0; only some have a shift",
    "method_unavailable": "a method may not solve the task: multiple poles, a Riccati equation without solution",
    "invalid_input shift": "the axis-decoupled structure has none",
}
EXPERIMENT = DESIGN | {
    "invalid_input scenario.digital.sample_time": "the duration may hold at most 100,000 samples of the controller",
    "invalid_input scenario.digital.encoders.(theta|psi)": "the counts of another rig",
}
RIGS = EXPERIMENT | {
    "invalid_input scenario.(digital|disturbance)": "the cloud is continuous and undisturbed",
}
RULES: dict[str, dict[str, str]] = {
    "POST /api/v1/suggest": DESIGN
    | {
        "invalid_input poles": "PI values are suggested for stable poles only",
        "invalid_input loops.*": "there may be none in the range of gains that keep the whole loop stable",
    },
    **dict.fromkeys(
        [f"POST /api/v1/{name}" for name in ("gains", "rga", "loops", "splits", "walkthrough")],
        DESIGN,
    ),
    **dict.fromkeys(
        [
            f"POST /api/v1/{name}"
            for name in ("step", "evaluate", "compare", "recording", "recordings/sample")
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
    "POST /api/v1/place": {
        "unpaired_poles": "each complex pole needs its conjugate",
        "uncontrollable": "the rank of [B, AB, …]",
        "method_unavailable": "a method may not solve the task: multiple poles, too few inputs, outputs left out",
        "invalid_input (A|B|C|poles|shift|groups|input_order|weights).*": "the shapes of matrices must agree",
        "invalid_input (groups|input_order|triangle|shift)": "belong to full-rank placement alone",
    },
    "POST /api/v1/recordings": {"unusable_recording file": "a table in the file's bytes"},
    "POST /api/v1/recordings/{key}/overlay": EXPERIMENT
    | {"unusable_recording (recording|columns.*)": "the key of a recording that is there, and its columns"},
    "GET /api/v1/symbolic": {"invalid_input shifted": "the axis-decoupled structure has no shift"},
}
SLOW = (
    "compare",
    "recording",
    "recordings/sample",
    "robustness",
    "export/{format}",
    "recordings/{key}/overlay",
)
THINNED = {f"POST /api/v1/{name}": 5 for name in SLOW}
"""Of the slow calls whose bodies are a step's with little more: one of so many cases is sent, always the same."""
sent: Counter[str] = Counter()
schema = schemathesis.openapi.from_dict(create_app().openapi())
bounded = settings(
    max_examples=8,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.explicit, Phase.generate],
)


@pytest.fixture(scope="module")
def base() -> Iterator[str]:
    with serving(request_rate=10_000, request_burst=100_000) as server:
        yield server.http
    print(f"{sent.total()} cases: {dict(sent)}")


def refusal(case, response) -> bool:
    """Whether valid input was refused by a rule of its call's list."""
    if response.status_code != 422 or not case.meta.generation.mode.is_positive:
        return False
    problem = response.json()
    said = f"{problem['code']} {problem.get('field', '')}".strip()
    rules = RULES.get(case.operation.label, {})
    return any(re.fullmatch(rule if " " in rule else f"{rule}( .*)?", said) for rule in rules)


def finite(value) -> bool:
    if isinstance(value, dict):
        return all(map(finite, value.values()))
    if isinstance(value, list):
        return all(map(finite, value))
    return not isinstance(value, float) or math.isfinite(value)


@schema.parametrize()
@bounded
def test_what_is_described_is_what_is_answered(case, base):
    if zlib.crc32(repr((case.query, case.body)).encode()) % THINNED.get(case.operation.label, 1):
        return
    sent[case.operation.label] += 1
    response = case.call(base_url=base, timeout=60)
    excepted = [positive_data_acceptance] if refusal(case, response) else []
    case.validate_response(response, excluded_checks=excepted, transport_kwargs={"base_url": base})
    (kind,) = response.headers.get("content-type", [""])
    if response.status_code >= 400:
        assert kind == "application/problem+json"
        problem = response.json()
        assert problem["status"] == response.status_code and problem["code"] and problem["detail"]
    elif kind == "application/json":
        assert finite(orjson.loads(response.content))  # which knows no NaN


def test_every_exception_belongs_to_a_call():
    labels = {result.ok().label for result in schema.get_all_operations()}
    assert set(RULES) <= labels
