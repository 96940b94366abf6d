"""The page's kernel room beside the server: its numbers are those of the request, its replies the server's own."""

from __future__ import annotations

import json
import math
import random
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

from app.contract.encoding import json_text
from app.contract.evaluation import EvaluateRequest, report_reply
from app.contract.presets import preset_reply
from heli2dof_core import Heli2DofError, Spec, evaluate
from heli2dof_core.block import Task, fill_block, given_numbers
from heli2dof_core.kernels import layout
from heli2dof_core.presets import PRESETS
from heli2dof_core.scenario import AntiWindup, Measured
from heli2dof_core.simulation.experiment import WINDUP
from tests import page_kernel
from tests.children import ROOT

Ask = Callable[[dict[str, Any]], dict[str, Any]]
STEPS = 10_000
SERVED = {name: json.loads(json_text(preset_reply(preset))) for name, preset in PRESETS.items()}
MANUAL, AERO = "quanser-2dof-manual", "quanser-aero-2"


@pytest.fixture(scope="module")
def ask() -> Iterator[Ask]:
    """The page's modules in Node: one line for one line."""
    node = str(Path(sys.executable).with_name("node"))
    script = ROOT / "tests" / "page" / "kernel_replies.mjs"
    with subprocess.Popen(
        [node, script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    ) as child:
        assert child.stdin is not None and child.stdout is not None
        to, back = child.stdin, child.stdout

        def asked(question: dict[str, Any]) -> dict[str, Any]:
            to.write(json.dumps(question) + "\n")
            to.flush()
            return json.loads(back.readline())

        yield asked
        to.close()


def poles(*values: complex) -> list[dict[str, float]]:
    return [{"re": complex(p).real, "im": complex(p).imag} for p in values]


def spec_of(body: dict[str, Any]) -> Spec:
    """As the server reads a request."""
    return EvaluateRequest.model_validate(body).to_spec()


def steps(theta: float = 0.2, psi: float = 0.3, duration: float = 2.0, **more: Any) -> dict[str, Any]:
    """A part of a design: its experiment."""
    return {"scenario": {"reference": {"theta": theta, "psi": psi}, "duration": duration, **more}}


@pytest.mark.parametrize(
    ("path", "made"),
    [
        (page_kernel.PAGE, page_kernel.module),
        (page_kernel.SHAPES, page_kernel.shapes),
        (page_kernel.FLIGHT, page_kernel.flights),
    ],
)
def test_the_pages_layout_is_current(path: Path, made: Callable[[], str]):
    """`make contract` writes it anew."""
    assert path.read_text("utf-8") == made()


def test_words_have_the_kernels_numbers():
    assert [WINDUP[kind] for kind in get_args(AntiWindup)] == [0, 1, 2]
    kinds = dict(zip(get_args(Measured), (0.0, 1.0, 2.0), strict=True))
    assert kinds == {
        "states": layout.ALL_STATES,
        "filtered": layout.FILTERED_RATES,
        "observer": layout.OBSERVED,
    }


def random_part(draw: random.Random) -> tuple[str, dict[str, Any]]:
    """A preset's name and a part of a design: mostly in range, sometimes not, sometimes at the very edge."""

    def pair() -> tuple[complex, complex]:
        re, im = -draw.uniform(-2, 30), draw.choice((0.0, 1e-10, draw.uniform(0.1, 20)))
        if im:
            return complex(re, im), complex(re + draw.choice((0, 0, 0, 1e-10, 1e-3)), -im)
        return complex(re), complex(-draw.choice((0.0, 1e-12, draw.uniform(0, 30), 1.0e5, 1.1e5)))

    def number(low: float, high: float, *edges: float) -> float:
        return draw.choice((draw.uniform(low, high),) * 8 + edges)

    def some(**given: Callable[[], Any]) -> dict[str, Any]:
        return {name: value() for name, value in given.items() if draw.random() < 0.3}

    def one_of(*words: Any) -> Callable[[], Any]:
        return lambda: draw.choice(words)

    def rotor() -> dict[str, Any]:
        return some(
            tau=lambda: number(0, 0.4, 0.0, 1e-7, 10.5),
            curve=one_of("linear", "quadratic"),
            dead_zone=lambda: number(0, 2, 0.0, 30.0),
            matched_at=one_of(None, 5.0, 0.5),
        )

    def friction() -> dict[str, Any]:
        return some(coulomb=lambda: number(0, 0.1, -0.1), static=one_of(None, 0.05))

    def scenario() -> dict[str, Any]:
        said = some(
            saturation=one_of(True, False),
            anti_windup=one_of("none", "clamping", "back-calculation"),
            tracking_time=lambda: number(0.1, 2, 0.0),
            travel_stops=one_of(True, False),
            trim_feedforward=one_of(True, False),
            rtol=one_of(1e-8, 1e-6, 0.1),
            measured=one_of("states", "filtered", "observer"),
            noise=one_of({}, {"theta": 0.0}, {"psi": 1e-3}),
            initial=lambda: some(theta=lambda: number(-0.3, 0.3, 200.0), psi=one_of(0.1)),
            digital=lambda: some(
                sample_time=lambda: number(1e-3, 0.02, 1e-4, 2.0),
                delay=one_of(True, False),
                rates=one_of("filtered", "true"),
                noise=one_of(0.0, 1e-3),
                encoders=one_of({"theta": 0, "psi": 512}, {"theta": 0.5, "psi": 512}, {"psi": 100}),
            ),
            disturbance=lambda: some(V_p=lambda: number(-5, 5, 2e3), time=lambda: number(0, 1)),
        )
        return {
            "reference": draw.choice(
                ({"theta": number(-0.5, 0.5, 0.0), "psi": number(-1, 1, 101.0)}, {"theta": 0.1}, {})
            ),
            "duration": number(0.5, 20, 600.0, 601.0),
            **said,
        }

    part = some(
        parameters=lambda: some(K_pp=lambda: number(0, 0.3), m=lambda: number(0, 2, -1.0), odd=one_of(1.0)),
        limits=lambda: some(V_p=lambda: number(5, 30, 0.0), theta=one_of(None, 0.5, 4.0)),
        theta0=lambda: number(-0.6, 0.6, 1.6),
        poles=lambda: poles(*pair(), *pair()),
        coupling=one_of("triangular", "input-diagonal", "axis-decoupled"),
        lead=one_of("pitch", "yaw"),
        shift=lambda: number(-1, 1, 2e6),
        outer=one_of("pi", "none"),
        pairing=one_of("diagonal", "cross"),
        decoupler=one_of(True, False),
        loops=lambda: {
            "pitch": {"kp": number(0, 60), "ti": number(0.05, 2, 0.0)},
            "yaw": {"kp": number(0, 60, 0.0), "ti": number(0.05, 2)},
        },
        rotors=lambda: some(pitch=rotor, yaw=rotor),
        friction=lambda: some(pitch=friction, yaw=friction),
        place_rotors=one_of(True, False),
        rotor_poles=lambda: [number(-40, -5), number(-40, -5, 2e5)],
        observer=lambda: {
            "poles": poles(*pair(), *pair()),
            **some(
                coupling=one_of("triangular", "axis-decoupled"), lead=one_of("yaw"), method=one_of("kalman")
            ),
        },
        method=one_of("full-rank", "full-rank", "lqr"),
        scenario=scenario,
    )
    return draw.choice(list(SERVED)), part


def test_the_numbers_are_those_of_the_request_and_what_is_refused_is_not_served(ask: Ask):
    draw, served, refused = random.Random(5), 0, 0
    for _ in range(1500):
        name, part = random_part(draw)
        found = ask({"preset": SERVED[name], "part": part})
        body = {k: v for k, v in found["body"].items() if k != "each_axis"}
        if not found["served"]:
            try:
                spec_of(body)
            except (Heli2DofError, ValueError):
                refused += 1
            continue
        served += 1
        spec = spec_of(body)
        wanted = given_numbers(Task.of(spec, each_axis=True), None, None, STEPS)
        numbers = [float(v) for v in found["numbers"]]
        assert np.array_equal(numbers, wanted, equal_nan=True), (name, part)
        assert found["size"] == (14 if spec.scenario.measured != "states" else 8 if spec.actuators else 6)
    assert served > 250 and refused > 250


CASES: list[tuple[str, dict[str, Any]]] = [
    *((name, {}) for name in SERVED),
    (MANUAL, {"poles": poles(-3 + 4j, -3 - 4j, -5, -6), "outer": "none"}),
    (MANUAL, {"poles": poles(1 + 4j, 1 - 4j, -5, -6)}),
    (MANUAL, {"poles": poles(0, -4, -5, -6)}),
    (MANUAL, {"coupling": "input-diagonal", "theta0": 0.3, "pairing": "cross", "decoupler": True}),
    (MANUAL, {"loops": {"pitch": {"kp": 0, "ti": 1}, "yaw": {"kp": 20, "ti": 0.3}}}),
    (MANUAL, {"poles": poles(-5, -5, -5, -5), "limits": {"theta": None, "V_p": 10}, "shift": 0.3}),
    (MANUAL, steps(0, 0.3)),
    (MANUAL, steps(0.7, 1.5, 1.0, anti_windup="none", saturation=True)),
    (MANUAL, steps(measured="filtered", duration=1.0, digital={"delay": True, "sample_time": 0.01})),
    (
        MANUAL,
        steps(
            0,
            0.3,
            disturbance={"V_p": 3, "V_y": 0, "time": 1},
            initial={"theta": 0.1},
            anti_windup="back-calculation",
            tracking_time=0.3,
        ),
    ),
    (
        MANUAL,
        {
            "friction": {"pitch": {"coulomb": 0.05, "static": 0.08}},
            "rotors": {"pitch": {"tau": 0.1}, "yaw": {"curve": "quadratic", "dead_zone": 1}},
            "theta0": 0.2,
            **steps(),
        },
    ),
    (AERO, {"place_rotors": True}),
    (AERO, {"observer": {"poles": poles(-30, -31, -32, -33)}}),
    (AERO, steps(measured="observer")),
    (
        AERO,
        {
            "place_rotors": True,
            "observer": {
                "poles": poles(-30, -31, -32 + 1j, -32 - 1j),
                "coupling": "triangular",
                "lead": "yaw",
            },
            **steps(measured="observer"),
        },
    ),
]


def told(array: np.ndarray) -> list[float | str]:
    """Numbers as JSON can have them; complex ones as pairs."""
    flat = np.ascontiguousarray(array).view(np.float64).ravel().tolist()
    return [
        v if math.isfinite(v) else {"inf": "Infinity", "-inf": "-Infinity"}.get(str(v), "NaN") for v in flat
    ]


def keys(value: Any, above: str = "") -> set[str]:
    """The paths of all that an object holds."""
    if not isinstance(value, dict):
        return {above}
    return {path for name, own in value.items() for path in keys(own, f"{above}.{name}")}


@pytest.mark.parametrize("case", CASES, ids=lambda case: f"{case[0]} {json.dumps(case[1])[:60]}")
def test_the_pages_reply_is_the_servers(case: tuple[str, dict[str, Any]], ask: Ask):
    """Of the native kernel's block and of the module's."""
    name, part = case
    asked = {"preset": SERVED[name], "part": part}
    found = ask(asked)
    assert found["served"]
    spec = spec_of({k: v for k, v in found["body"].items() if k != "each_axis"})
    reply = reply_to(spec)
    block = fill_block(Task.of(spec, each_axis=True), placed=None, L=None, most_steps=STEPS, passing=False)
    for more in ({"block": {own: told(v) for own, v in block.items()}}, {}):
        answer = ask({**asked, **more, "reply": reply})
        assert answer["difference"] is None
        doubtful = {f".gains.{own}" for own in ("pole_error", "pole_error_bound", "eigenvector_condition")}
        assert keys(answer["own"]) - keys(reply) <= {".gains.eigenvector_condition"}
        assert keys(reply) - keys(answer["own"]) <= doubtful


def reply_to(spec: Spec) -> dict[str, Any]:
    return json.loads(json_text(report_reply(evaluate(spec, each_axis=True), spec)))


def test_random_designs_are_alike_here_and_there(ask: Ask):
    """What the module says of whatever it serves is what the server says."""
    draw, compared = random.Random(8), 0
    while compared < 60:
        name, part = random_part(draw)
        found = ask({"preset": SERVED[name], "part": part})
        if not found["served"]:
            continue
        try:
            reply = reply_to(spec_of({k: v for k, v in found["body"].items() if k != "each_axis"}))
        except Heli2DofError:  # the kernel says so as well
            assert ask({"preset": SERVED[name], "part": part, "reply": EMPTY})["own"] is None, (name, part)
            continue
        answer = ask({"preset": SERVED[name], "part": part, "reply": reply})
        assert answer["difference"] is None, (name, part)
        compared += answer["own"] is not None


EMPTY = {
    "gains": {"findings": [], "controllability_indices": []},
    "rga": {"findings": []},
    "findings": [],
    "axis_steps": {},
    "open_loop_poles": [],
}
"""A reply of which nothing is known."""
