"""The page's WebAssembly module: made from these sources, and of the same numbers as the compiled kernels."""

from __future__ import annotations

import gzip
import json
import os
import re
from collections import defaultdict
from contextlib import suppress
from hashlib import sha256
from pathlib import Path

import numpy as np
import pytest

from heli2dof_core import InvalidInputError, Uncertainty, evaluate
from heli2dof_core.kernels.layout import SIZES
from heli2dof_core.many import Measure, evaluate_many
from heli2dof_core.measured import Where
from heli2dof_core.robustness import cloud, random_factors
from tests.children import ROOT, python
from tests.flown import flown
from tests.wasm.agreement import EXACT, gaps
from tests.wasm.designs import random_designs
from tests.wasm.replay import MODULE, Call, called, recorded, replayed
from wasm import stamp
from wasm.entries import ENTRIES
from wasm.module import MATH, STACK, linker

TABLE = MODULE.with_name("table.js")
LIMIT = 68_000
"""Bytes of the module, compressed as the server does it."""
MANY = (
    Measure("settling_time", Where("both")),
    Measure("V_peak", Where(model="linear")),
    Measure("disk_margin"),
    Measure("lag_margin"),
    Measure("share_within_limits"),
)
STALE = "static/kernel is not of these sources: call `make wasm`."


def told(name: str) -> str:
    """A text that the table exports."""
    found = re.search(rf"export const {name} =\s*'([^']*)'", TABLE.read_text("utf-8"))
    assert found, name
    return found[1]


def tools() -> dict[str, str]:
    """What the table says that it was made with."""
    return dict(re.findall(r"^  (\w+): '([\d.]+)',$", TABLE.read_text("utf-8"), re.MULTILINE))


def calls_of(count: int, seed: int) -> list[Call]:
    """All that so many random designs and a flight ask of the kernels, and eigenvalues of random matrices."""
    rng, designs = np.random.default_rng(seed), random_designs(np.random.default_rng(seed))
    with recorded() as calls:
        for _ in range(count):
            spec = next(designs)
            evaluate(spec, each_axis=True)
            with suppress(InvalidInputError):  # sampled and disturbed rigs have no cloud
                cloud(spec, Uncertainty(samples=2))
            evaluate_many([spec, spec], MANY, factors=random_factors(Uncertainty(samples=3, seed=seed)))
    for n in rng.integers(1, 15, count):
        a = rng.standard_normal((n, n)) * 10.0 ** rng.uniform(-3, 3, (n, 1))
        calls.append(called("eigenvalues", a, np.zeros(n), np.zeros(n), np.zeros(n)))
    with recorded() as flown_calls:
        flown(0.3, seed)
    calls += flown_calls
    return calls


def test_the_module_is_of_these_sources():
    assert told("SOURCES") == stamp.checksum(), STALE
    assert told("MODULE") == sha256(MODULE.read_bytes()).hexdigest(), STALE


def test_it_was_made_by_the_pinned_versions():
    pinned = dict(re.findall(r"^(\w+)==(\S+)$", (ROOT / "constraints.txt").read_text("utf-8"), re.MULTILINE))
    assert {name: pinned[name] for name in stamp.TOOLS} == {name: tools()[name] for name in stamp.TOOLS}, (
        STALE
    )


def test_it_is_light(record_property):
    size = len(gzip.compress(MODULE.read_bytes(), 6))
    record_property("bytes", size)
    assert size <= LIMIT


def test_the_table_and_the_page_know_what_the_builder_knows():
    table, page = TABLE.read_text("utf-8"), MODULE.with_name("module.js").read_text("utf-8")
    assert tuple(re.findall(r"^  (\w+): \{$", table, re.MULTILINE)) == ENTRIES
    given = re.search(r"^const env = \{(.*?)^\};", page, re.MULTILINE | re.DOTALL)
    assert given
    assert set(re.findall(r"\b(\w+)(?=:|,| \})", re.sub(r"\(.*", "", given[1]))) == set(MATH)


def test_numbers_are_those_of_the_compiled_kernels(record_property):
    compare(calls_of(40, seed=20_261_129), record_property)


@pytest.mark.slow
def test_numbers_are_those_of_the_compiled_kernels_in_hundreds_of_designs(record_property):
    compare(calls_of(300, seed=20_261_130), record_property)


def compare(calls: list[Call], record_property) -> None:
    """Each to `EXACT`."""
    assert {call.kernel for call in calls} == set(ENTRIES)
    sizes = {len(call.before["size"]) for call in calls if "size" in call.before}
    assert sizes == {len(size) for size in SIZES}
    answers, stack = replayed(calls)
    assert 0 < stack < STACK / 16
    worst = defaultdict(float)
    for call, answer in zip(calls, answers, strict=True):
        for name, own in gaps(call, answer).items():
            worst[call.kernel, name] = max(worst[call.kernel, name], own)
    print(f"\n{len(calls)} calls; worst: {max(worst.values()):.1e}; stack {stack}")
    record_property("worst", max(worst.values()))
    assert {where: own for where, own in worst.items() if own > EXACT} == {}


@pytest.mark.slow
def test_another_process_makes_the_same_module(tmp_path: Path):
    """The same bytes by the same versions; by others, and another Python, at least the same digits."""
    try:
        linker()
    except FileNotFoundError as missing:
        if os.environ.get("CI"):
            raise
        pytest.skip(str(missing))
    seed = str(int.from_bytes(os.urandom(3), "little"))
    python("-m", "wasm", "--into", str(tmp_path), PYTHONHASHSEED=seed)
    made = tmp_path / MODULE.name
    if stamp.tools() == tools():
        assert made.read_bytes() == MODULE.read_bytes(), STALE
        assert (tmp_path / TABLE.name).read_bytes() == TABLE.read_bytes(), STALE
        return
    calls = calls_of(40, seed=3)
    for one, other in zip(replayed(calls)[0], replayed(calls, module=made)[0], strict=True):
        assert json.dumps(one.returned) == json.dumps(other.returned)
        for name, value in one.after.items():
            np.testing.assert_array_equal(value, other.after[name], strict=True)
