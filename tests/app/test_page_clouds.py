"""The clouds that the page computes: its random rigs against what they must be, their poles and responses against the
server's of the same rigs."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy import stats

from heli2dof_core import evaluate
from heli2dof_core.kernels.update_layout import FACTORS
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.robustness import GRID, LAGS, SMALLEST, rigs_in_parts
from tests.app.test_page_kernel import AERO, MANUAL, SERVED, poles, spec_of, steps
from tests.children import ROOT

Ask = Callable[..., dict[str, Any]]


@pytest.fixture(scope="module")
def ask() -> Iterator[Ask]:
    """The page's modules in Node: one line for one line."""
    node = str(Path(sys.executable).with_name("node"))
    script = ROOT / "tests" / "page" / "rig_clouds.mjs"
    with subprocess.Popen(
        [node, script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    ) as child:
        assert child.stdin is not None and child.stdout is not None
        to, back = child.stdin, child.stdout

        def asked(name: str, part: dict[str, Any], spread: float, count: int, **more: Any) -> dict[str, Any]:
            question = {"preset": SERVED[name], "part": part, "spread": spread, "count": count, **more}
            to.write(json.dumps(question) + "\n")
            to.flush()
            return json.loads(back.readline())

        yield asked
        to.close()


@pytest.fixture(scope="module")
def deviations(ask: Ask) -> np.ndarray:
    """Of the rigs under ±10 %: between −1 and 1, of all parameters but g and of both time constants."""
    rotors = {axis: {"tau": 0.1} for axis in ("pitch", "yaw")}
    found = ask(MANUAL, {"rotors": rotors}, 0.1, 2000)
    names = [*PARAMETER_INFO, *LAGS]
    assert found["uncertainty"] == {name: 0.1 for name in names if name != "g"}
    factors = np.reshape(found["factors"], (2000, FACTORS))
    assert np.all(factors[:, names.index("g")] == 1)
    return np.delete((factors - 1) / 0.1, names.index("g"), axis=1)


def test_each_parameter_is_uniform(deviations: np.ndarray):
    """By Kolmogorov and Smirnov's test, of all rigs and of the first 200."""
    for count in (200, 2000):
        for column in deviations[:count].T:
            assert stats.kstest(column, "uniform", args=(-1, 2)).pvalue > 1e-3
    pooled = deviations.ravel()
    assert stats.kstest(pooled, "uniform", args=(-1, 2)).pvalue > 0.01
    assert np.max(np.abs(pooled)) > 0.9995


def test_parameters_are_independent_and_so_are_rigs(deviations: np.ndarray):
    """Spearman's rank correlation of each two parameters, and of a parameter in rigs that follow each other; and that
    pairs fill their square evenly."""
    n, columns = deviations.shape
    pairs = [(i, j) for i in range(columns) for j in range(i)]
    p = [by_rank(deviations[:, i], deviations[:, j]) for i, j in pairs]
    for lag in (1, 2, 7):
        p += [by_rank(column[:-lag], column[lag:]) for column in deviations.T]
    for i, j in pairs:
        counts, _, _ = np.histogram2d(deviations[:, i], deviations[:, j], bins=8, range=[(-1, 1)] * 2)
        p.append(stats.chisquare(counts.ravel()).pvalue)
    assert min(p) > 1e-2 / len(p)
    assert stats.kstest(p, "uniform").pvalue > 1e-3
    assert len(np.unique(deviations)) > 0.999 * n * columns


def by_rank(one: np.ndarray, other: np.ndarray) -> float:
    """How likely independent values are correlated as much."""
    return float(np.asarray(stats.spearmanr(one, other))[1])


ROTORS = {"pitch": {"tau": 0.12}, "yaw": {"tau": 0.08, "curve": "quadratic"}}
CASES: list[tuple[str, dict[str, Any], float, str]] = [
    (MANUAL, {}, 0.1, "both"),
    (AERO, {}, 0.2, "both"),
    (MANUAL, {"outer": "none", "poles": poles(-3 + 4j, -3 - 4j, -5, -6)}, 0.2, "theta"),
    (MANUAL, {"poles": poles(-3.6, -3.1, -3.4, -3.2)}, 0.5, "psi"),
    (MANUAL, {"poles": poles(1 + 4j, 1 - 4j, -5, -6)}, 0.05, "both"),
    (MANUAL, {"rotors": ROTORS, **steps(0.5, 1.5)}, 0.1, "both"),
    (MANUAL, {"rotors": {a: {"tau": 0.05} for a in ("pitch", "yaw")}, "place_rotors": True}, 0.1, "both"),
    (MANUAL, {"friction": {"pitch": {"coulomb": 0.02, "static": 0.03}}}, 0.1, "both"),
    (MANUAL, steps(measured="observer"), 0.1, "both"),
    (AERO, steps(measured="filtered", initial={"theta": 0.1}), 0.1, "both"),
    (MANUAL, steps(0.1, 0.2, digital={"sample_time": 0.01}, disturbance={"V_p": 3}), 0.1, "both"),
    (
        MANUAL,
        {"loops": {"pitch": {"kp": 0, "ti": 1}, "yaw": {"kp": 20, "ti": 0.3}}, "theta0": 0.2},
        0.2,
        "both",
    ),
]


@pytest.mark.parametrize(("name", "part", "spread", "motion"), CASES)
def test_a_cloud_is_the_servers_of_the_same_rigs(
    ask: Ask, name: str, part: dict[str, Any], spread: float, motion: str
):
    count = 120
    found = ask(name, part, spread, count, motion=motion)
    spec, own = spec_of(found["body"]), found["cloud"]
    assert own is not None
    factors = np.reshape(found["factors"], (count, FACTORS))
    assert np.min(factors) >= SMALLEST
    *_, server = rigs_in_parts(spec, evaluate(spec), factors)
    assert own["done"] == own["judged"] == server.done == count
    mine = np.reshape(own["poles"], (*server.loop_poles.shape, 2)).astype(float) @ np.array([1, 1j])
    for page, expected in zip(mine, server.loop_poles, strict=True):
        assert apart(page, expected) < 1e-9 * np.max(np.abs(expected))
    assert own["share_stable"] == server.share_stable
    assert own["share_within_limits"] == server.share_within_limits
    np.testing.assert_allclose(own["t"], server.t, rtol=1e-12)
    assert len(own["t"]) == GRID
    if server.share_stable == 1:
        for axis, bands in server.envelopes.items():
            np.testing.assert_allclose(own["envelopes"][axis], bands, atol=1e-7)


def apart(one: np.ndarray, other: np.ndarray) -> float:
    """How far the poles of one set lie from those of another, the nearest still free."""
    left = list(other)
    most = 0.0
    for p in one:
        nearest = min(left, key=lambda q, p=p: abs(p - q))
        left.remove(nearest)
        most = max(most, abs(p - nearest))
    return most


def test_what_the_kernel_does_not_find_has_no_cloud(ask: Ask):
    parallel = {"K_pp": 0.2, "K_py": 0.1, "K_yp": 0.4, "K_yy": 0.2}
    assert ask(MANUAL, {"parameters": parallel}, 0.1, 10)["cloud"] is None
    for part in ({"method": "lqr"}, steps(noise={"theta": 1e-3})):
        assert ask(MANUAL, part, 0.1, 10)["factors"] is None


def test_clouds_one_after_another_leave_nothing_behind(ask: Ask):
    """Of other sizes and counts in between, the same cloud again."""
    first = ask(MANUAL, {}, 0.1, 50)
    for part, count in (({"rotors": ROTORS}, 30), (steps(measured="observer"), 60), ({}, 10)):
        assert ask(MANUAL, part, 0.2, count)["cloud"]["done"] == count
    assert ask(MANUAL, {}, 0.1, 50) == first
