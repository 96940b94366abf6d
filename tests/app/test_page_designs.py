"""Many designs that the page computes for its maps: every figure of the registry against the core's, row by row."""

from __future__ import annotations

import json
import random
import subprocess
import sys
from collections.abc import Callable, Iterator
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from heli2dof_core.kernels.update_layout import FACTORS, PI_GAINS, POLES
from heli2dof_core.many import SHARES, Many, Measure
from heli2dof_core.measured import MEASURED, Where
from tests.app.test_page_kernel import AERO, MANUAL, SERVED, poles, spec_of, steps
from tests.children import ROOT

Ask = Callable[[dict[str, Any]], dict[str, Any] | None]
DESIGNS = 40
AT = [*range(POLES, POLES + 4), *range(PI_GAINS, PI_GAINS + 4)]
"""What differs: pitch's pair, and both loops' gains."""
LAGS = {"rotors": {"pitch": {"tau": 0.05}, "yaw": {"tau": 0.02, "curve": "quadratic"}}}
CASES: dict[str, tuple[str, dict[str, Any]]] = {
    "plain": (MANUAL, steps()),
    "no outer loop": (MANUAL, {"outer": "none", **steps()}),
    "rotors": (AERO, LAGS | steps()),
    "an observer": (MANUAL, steps(measured="observer")),
    "disturbed": (MANUAL, steps(disturbance={"V_p": 2.0, "time": 0.5})),
    "starts away": (MANUAL, steps(initial={"psi": 0.2})),
    "one axis rests": (MANUAL, steps(theta=0.0)),
    "digital": (MANUAL, steps(digital={"sample_time": 0.01, "delay": True})),
    "crosswise": (MANUAL, {"pairing": "cross", "decoupler": True, **steps()}),
    "at its limits": (MANUAL, {"limits": {"V_p": 14.0}, **steps(theta=0.5)}),
}


@pytest.fixture(scope="module")
def ask() -> Iterator[Ask]:
    """The page's modules in Node: one line for one line."""
    script = ROOT / "tests" / "page" / "design_rows.mjs"
    node = str(Path(sys.executable).with_name("node"))
    with subprocess.Popen(
        [node, script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    ) as child:
        assert child.stdin is not None and child.stdout is not None
        to, back = child.stdin, child.stdout

        def asked(question: dict[str, Any]) -> dict[str, Any] | None:
            to.write(json.dumps(question) + "\n")
            to.flush()
            return json.loads(back.readline())

        yield asked
        to.close()


def changes(draw: random.Random) -> list[list[float]]:
    """Rows of pairs, real and conjugate, some of them unstable, and of gains."""
    rows = []
    for _ in range(DESIGNS):
        re, im = -draw.uniform(-0.5, 12), draw.choice((0.0, draw.uniform(0.1, 8)))
        pair = [re, im, re, -im] if im else [re, 0.0, -draw.uniform(0.1, 12), 0.0]
        gains = [draw.uniform(1, 60), draw.uniform(0.05, 2), draw.uniform(1, 60), draw.uniform(0.05, 2)]
        rows.append([*pair, *gains])
    return rows


def measures(draw: random.Random) -> list[Measure]:
    """Every figure once, each of a response drawn for it."""

    def where(name: str) -> Where:
        known = MEASURED[name]
        axis = draw.choice(("theta", "psi", "both")) if known.may_have_axis else None
        motor = draw.choice((None, "V_p", "V_y", "both")) if known.may_have_motor else None
        if not known.may_have_model:
            return Where(motor=motor)
        model = draw.choice(("linear", "nonlinear"))
        steps_of = "alone" if known.of == "step" else draw.choice(("alone", "together"))
        return Where(axis=axis, motor=motor, model=model, steps=steps_of)

    return [Measure(name, where(name)) for name in MEASURED]


def flat(measure: Measure) -> dict[str, str]:
    """As the page has it."""
    where = measure.where
    own = {"axis": where.axis, "motor": where.motor, "model": where.model, "steps": where.steps}
    return {"name": measure.name} | {name: value for name, value in own.items() if value is not None}


@pytest.mark.parametrize("kind", CASES)
def test_every_figure_is_the_cores(kind: str, ask: Ask):
    name, part = CASES[kind]
    draw = random.Random(kind)
    own, rows = measures(draw), changes(draw)
    question = {"preset": SERVED[name], "part": part, "at": AT, "values": rows}
    found = ask(question | {"measures": [flat(m) for m in own], "unstable": True})
    assert found is not None
    many = Many(spec_of(found["body"]), own)
    table = np.tile(many.row, (DESIGNS, 1))
    table[:, AT] = rows
    there = many.run(table)
    expected = many.values(table, there)
    values = np.array(found["values"], dtype=float).reshape(DESIGNS, len(own))
    for k, measure in enumerate(own):
        np.testing.assert_allclose(
            values[:, k], expected[:, k], rtol=2e-5, atol=1e-7, err_msg=f"{kind}: {measure}"
        )
    assert [state == 2 for state in found["stable"]] == there.stable.tolist()
    np.testing.assert_allclose(np.array(found["abscissa"], dtype=float), there.abscissa, rtol=1e-6, atol=1e-6)


def test_shares_are_the_cores_of_the_same_rigs(ask: Ask):
    name, part = CASES["plain"]
    draw = random.Random(1)
    own, rows = [Measure(share) for share in SHARES], changes(draw)[:12]
    factors = np.random.default_rng(2).uniform(0.3, 1.7, (30, FACTORS))
    question = {"preset": SERVED[name], "part": part, "at": AT, "values": rows, "rigs": factors.tolist()}
    found = ask(question | {"measures": [flat(Measure(share)) for share in SHARES]})
    assert found is not None
    many = Many(spec_of(found["body"]), own, factors=factors)
    table = np.tile(many.row, (len(rows), 1))
    table[:, AT] = rows
    values = np.array(found["values"], dtype=float).reshape(len(rows), len(own))
    expected = many.values(table, many.run(table))
    assert np.all(np.abs(values - expected) <= 1 / len(factors) + 1e-9), "a rig at the very edge may differ"
    assert len(np.unique(expected)) > 3


def test_what_might_be_refused_is_not_served(ask: Ask):
    part = {"poles": poles(-1 + 2j, -3, -4, -5), **steps()}
    question = {"preset": SERVED[MANUAL], "part": part, "at": [], "values": [], "measures": []}
    assert ask(question) is None


def test_some_of_these_designs_are_unstable_and_some_lack_figures(ask: Ask):
    """What the comparison above would not notice if all of them were alike."""
    name, part = CASES["plain"]
    question = {"preset": SERVED[name], "part": part, "at": [], "values": [], "measures": []}
    answer = ask(question)
    assert answer is not None
    own = [Measure("settling_time", Where(axis="theta")), Measure("lag_margin")]
    many = Many(spec_of(answer["body"]), own)
    rows = changes(random.Random("plain"))
    table = np.tile(many.row, (DESIGNS, 1))
    table[:, AT] = rows
    found = many.run(table)
    values = many.values(table, found)
    assert 0 < np.sum(found.stable) < DESIGNS
    assert np.any(np.isnan(values[found.stable, 0])) and np.any(np.isfinite(values[:, 0]))
    assert not np.any(values[:, 1] == -inf)
