"""Schemathesis over the whole OpenAPI document, every check on: what it describes is what is answered."""

from __future__ import annotations

import pytest
import schemathesis
from hypothesis import HealthCheck, Phase, settings

from app.main import create_app

pytestmark = pytest.mark.filterwarnings("default")
schema = schemathesis.openapi.from_dict(create_app().openapi())


@pytest.fixture(scope="module")
def base(server):
    return server.http


@schema.parametrize()
@settings(
    max_examples=10,
    derandomize=True,
    database=None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
    phases=[Phase.explicit, Phase.generate],
)
def test_api(case, base):
    case.call_and_validate(base_url=base)
