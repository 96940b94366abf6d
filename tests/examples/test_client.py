"""The example client against a running server."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from importlib.util import module_from_spec, spec_from_file_location

import pytest

from heli2dof_core import PRESETS
from tests.children import ROOT, python, served
from tests.patience import until

pytestmark = pytest.mark.slow

FILE = ROOT / "examples" / "client.py"


def _module():
    spec = spec_from_file_location("heli2dof_example_client", FILE)
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


example = _module()


@pytest.fixture(scope="module")
def address(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    with served(tmp_path_factory.mktemp("server")) as server, example.Client(server.http) as client:
        until(lambda: client.presets() != [], "the server answers")
        yield server.http


def test_it_gets_the_numbers(address):
    with example.Client(address) as heli:
        assert heli.presets() == list(PRESETS)
        gains = heli.gains([-12, -10, -9.25, -8.76])
        assert gains["K"][0][0] == pytest.approx(51.170053, abs=1e-6)
        rga = heli.rga([-12, -10, -9.25, -8.76], coupling="triangular")
        assert sum(rga[0]) == pytest.approx(1)
        step = heli.step([-12, -10, -3 + 4j, -3 - 4j], theta=0.1, duration=2.0)
        assert step["stable"] and step["t"][-1] == 2.0 and len(step["theta"]) == len(step["t"])


def test_a_refusal_names_the_field(address):
    with example.Client(address) as heli, pytest.raises(example.RefusedError) as refused:
        heli.gains([-1, -2 + 1j, -3, -4])
    assert refused.value.field == "poles.1" and refused.value.status == 422
    assert refused.value.hint and refused.value.hint in str(refused.value)


def test_it_runs_as_a_program(address):
    lines = python(str(FILE), address).strip().split("\n")
    assert [line.partition(":")[0] for line in lines] == list(PRESETS)
