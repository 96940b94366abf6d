"""The page's flights beside the core's: a log that the page writes, the core flies to the same digits."""

from __future__ import annotations

import base64
import json
import math
import os
import random
import struct
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from heli2dof_core import Heli2DofError
from heli2dof_core.errors import InvalidInputError
from heli2dof_core.flight import FlightController, FlightLog, checksum, simulate_flight
from heli2dof_core.kernels.flight_layout import FLIGHT_ROW
from heli2dof_core.kernels.update_layout import RTOL
from heli2dof_core.request import spec_of
from tests.app.test_page_kernel import SERVED, random_part
from tests.children import ROOT

Ask = Callable[[dict[str, Any]], Any]
FLIGHTS = int(os.environ.get("HELI2DOF_RANDOM_FLIGHTS", "6"))
"""Random flights that are compared; 100 take a minute or two."""
AGREED = 1e-9


@pytest.fixture(scope="module")
def ask() -> Iterator[Ask]:
    """The page's modules in Node: one line for one line."""
    node = str(Path(sys.executable).with_name("node"))
    script = ROOT / "tests" / "page" / "flight_logs.mjs"
    with subprocess.Popen(
        [node, script], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, encoding="utf-8"
    ) as child:
        assert child.stdin is not None and child.stdout is not None
        to, back = child.stdin, child.stdout

        def asked(question: dict[str, Any]) -> Any:
            to.write(json.dumps(question) + "\n")
            to.flush()
            return json.loads(back.readline())

        yield asked
        to.close()


def floats(text: str) -> np.ndarray:
    return np.frombuffer(base64.b64decode(text), dtype="<f8")


def controller(body: dict[str, Any]) -> FlightController | None:
    """The core's; None where it refuses the design."""
    try:
        return FlightController.of(spec_of(body))
    except (Heli2DofError, ValueError, TypeError, np.linalg.LinAlgError):
        return None


class Designs:
    """Parts of designs of one rig that both sides know, and the numbers of those that only the server knows."""

    def __init__(self, draw: random.Random, ask: Ask, count: int) -> None:
        self.name = draw.choice(list(SERVED))
        self.parts: list[dict[str, Any]] = []
        self.numbers: dict[str, str] = {}
        self.noisy = self.served = 0
        while len(self.parts) < count:
            self._add(draw, ask)

    def _add(self, draw: random.Random, ask: Ask) -> None:
        part = flown_part(draw)
        found = ask({"preset": SERVED[self.name], "parts": [part]})
        (body,), (numbers,) = found["bodies"], found["numbers"]
        own = controller(body)
        if own is None:
            assert numbers is None, (self.name, part)  # nobody flies what the core refuses
            return
        if numbers is None:
            numbers = base64.b64encode(own.numbers.astype("<f8").tobytes()).decode()
            self.numbers[found["texts"][0]] = numbers
        else:
            alike = np.equal(floats(numbers), own.numbers) | np.isnan(own.numbers)
            alike[RTOL] = True  # of responses that no flight has
            assert alike.all(), (self.name, part, np.flatnonzero(~alike))
            self.served += 1
        self.noisy += any(own.spec.scenario.noises)
        self.parts.append(part)


def flown_part(draw: random.Random) -> dict[str, Any]:
    """As `random_part`, with more of what flights are about."""
    _, part = random_part(draw)
    if draw.random() < 0.1:  # unstable: it may leave what can be flown
        part["poles"] = [{"re": draw.uniform(0, 9), "im": 0.0} for _ in range(4)]
        part["limits"] = {"theta": None}
    if draw.random() < 0.5:
        scenario = part.setdefault("scenario", {"reference": {"theta": 0.1, "psi": 0.2}, "duration": 3})
        scenario["digital"] = {
            "sample_time": draw.choice((0.0005, 0.001, 0.002, 0.0033, 0.005, 0.01, 0.05)),
            "delay": draw.random() < 0.3,
            "rates": draw.choice(("filtered", "true")),
            "noise": draw.choice((0.0, 0.0, 2e-4)),
        }
        if draw.random() < 0.3:
            scenario["noise"] = {"theta": 1e-3, "psi": 3e-4}
    return part


def frames(draw: random.Random, parts: int) -> list[list[list[Any]]]:
    """What a hand does, before each animation frame."""

    def torque(most: float) -> float:
        return draw.uniform(-most, most)

    def one() -> list[list[Any]]:
        acts: list[Callable[[], list[list[Any]]]] = [
            lambda: [["reference", torque(0.4), torque(1.5)]],
            lambda: [["turn", torque(0.5), torque(1.0)]],
            lambda: [["turn", 0, -0.0]],
            lambda: [["push", torque(0.3), torque(0.3)]],
            lambda: [["push", 0, 0]],
            lambda: [["gust", torque(0.5), torque(0.5), draw.randint(1, 900)]],
            lambda: [["thrust", draw.uniform(0.3, 1.1), draw.uniform(0.3, 1.1)]],
            lambda: [["thrust", 1, 1]],
            lambda: [["hung", draw.choice((0, draw.uniform(0, 0.3))), torque(0.2)]],
            lambda: [["stuck", draw.randint(0, 1), draw.randint(0, 1)]],
            lambda: [["stuck", 0, 0]],
            lambda: [["hands", 1], ["sticks", torque(12), torque(8)]],
            lambda: [["sticks", torque(12), torque(8)]],
            lambda: [["hands", 0]],
            lambda: [["part", draw.randrange(parts)]],
            lambda: [["part", draw.randrange(parts)], ["hands", 0]],
            lambda: [["part", draw.randrange(parts)], ["reference", torque(0.3), torque(1)]],
            lambda: [["rewind", draw.uniform(0, 2)]],
            lambda: [["speed", draw.choice((1, 0.5, 0.1, 1))]],
            lambda: [["freeze"], ["reference", torque(0.2), 0.1]],
            lambda: [["go"]],
            lambda: [["wait", draw.choice((50, 200, 400))]],
        ]
        return draw.choice(acts)()

    count = draw.randint(120, 600)
    return [one() if draw.random() < 0.08 else [["go"]] if draw.random() < 0.1 else [] for _ in range(count)]


@pytest.mark.parametrize("seed", range(FLIGHTS))
def test_random_flights_are_alike_here_and_there(seed: int, ask: Ask):
    """Designs of all kinds under hands, gusts and faults, rewound and slowed, are the core's within 1e-9 rad."""
    draw = random.Random(1000 + seed)
    designs = Designs(draw, ask, 4)
    plan = [{"time": draw.uniform(0, 3), "event": ["gust", 0.1, -0.2, 200]} for _ in range(3)]
    found = ask(
        {
            **{"preset": SERVED[designs.name], "parts": designs.parts, "numbers": designs.numbers},
            **{"seed": draw.randrange(2**32), "frames": frames(draw, 4)},
            "plan": sorted(plan, key=lambda own: own["time"]),
        }
    )
    log = found["log"]
    assert found["inOrder"] and found["ticks"] == log["ticks"] and not found["problem"]
    course = simulate_flight(FlightLog.read(log))
    rows = floats(found["rows"]).reshape(-1, FLIGHT_ROW)
    assert rows.shape == course.rows.shape
    assert np.abs(rows - course.rows).max() <= AGREED and course.apart <= AGREED
    assert found["again"] == pytest.approx(np.zeros(6), abs=AGREED)
    assert bool(course.ended) == bool(found["ended"])
    assert [own["tick"] for own in found["takeovers"]] == [own.tick for own in course.takeovers]
    for own, core in zip(found["takeovers"], course.takeovers, strict=True):
        assert own["bumpless"] == core.bumpless
        assert own["jump"] == pytest.approx(core.jump, abs=AGREED, rel=AGREED)
        assert own["jumpWithout"] == pytest.approx(core.jump_without, abs=AGREED, rel=AGREED)


@pytest.fixture(scope="module")
def log(ask: Ask) -> dict[str, Any]:
    """That of a flight in which all kinds of things happen."""
    part = {"poles": [{"re": -3, "im": 1}, {"re": -3, "im": -1}, {"re": -4, "im": 0}, {"re": -5, "im": 0}]}
    acts: dict[int, list[list[Any]]] = {
        10: [["reference", 0.1, 0.3], ["turn", 0.0, 0.2]],
        20: [["gust", 0.2, -0.1, 333], ["hung", 0.05, 0.12]],
        30: [["part", 1], ["thrust", 0.9, 1]],
        40: [["hands", 1], ["sticks", 4.5, -1.5]],
        50: [["hands", 0], ["stuck", 1, 0]],
    }
    asked = {"preset": SERVED["quanser-2dof-manual"], "parts": [{}, part], "numbers": {}, "plan": []}
    return ask({**asked, "seed": 3141592653, "frames": [acts.get(n, []) for n in range(80)]})["log"]


def places(value: Any, *path: Any) -> Iterator[tuple[Any, ...]]:
    """The paths of all numbers and words."""
    if isinstance(value, (dict, list)):
        for name, own in value.items() if isinstance(value, dict) else enumerate(value):
            yield from places(own, *path, name)
    elif isinstance(value, (int, float, str)) and not isinstance(value, bool):
        yield path


def flipped(value: float | str, bit: int) -> Any:
    """A number, or a word's letters, with one bit the other way; numbers as JSON has them."""
    if isinstance(value, str):
        at, low = divmod(bit % (16 * len(value)), 16)
        return value[:at] + chr(ord(value[at]) ^ (1 << low)) + value[at + 1 :]
    (bits,) = struct.unpack("<Q", struct.pack("<d", value))
    (found,) = struct.unpack("<d", struct.pack("<Q", bits ^ (1 << bit % 64)))
    return int(found) if isinstance(value, int) and found.is_integer() else found


def with_value(value: Any, path: tuple[Any, ...], new: Any) -> Any:
    """A copy with another value at a path."""
    if not path:
        return new
    copy = dict(value) if isinstance(value, dict) else list(value)
    copy[path[0]] = with_value(copy[path[0]], path[1:], new)
    return copy


def test_a_log_edited_by_one_bit_is_told(log: dict[str, Any], ask: Ask):
    """Any bit of any number or word: both sides refuse the log."""
    draw, told = random.Random(7), 0
    assert ask({"log": log})["refused"] is None
    everywhere = list(places(log))
    for path in everywhere + draw.choices(everywhere, k=200):
        value: Any = log
        for name in path:
            value = value[name]
        new = flipped(value, draw.randrange(64)) if value != "" else "a"
        if new == value or (isinstance(new, float) and not math.isfinite(new)):
            continue  # −0 is 0, and JSON has no infinities
        edited = with_value(log, path, new)
        with pytest.raises(InvalidInputError) as refused:
            FlightLog.read(edited)
        assert refused.value.field in ("checksum", "flight"), path
        assert ask({"log": edited})["refused"] == "LogError", path
        told += 1
    assert told > 250


def test_a_bit_of_the_file_is_told_or_says_nothing(log: dict[str, Any], ask: Ask):
    """Of the text itself: it is no JSON any more, or refused, or it means the same."""
    text = json.dumps(log).encode()
    draw, told, same = random.Random(8), 0, 0
    for _ in range(400):
        bit = draw.randrange(8 * len(text))
        edited = bytearray(text)
        edited[bit // 8] ^= 1 << bit % 8
        try:
            body = json.loads(edited)
        except ValueError:
            continue
        if body == log:
            same += 1
            continue
        with pytest.raises(InvalidInputError):
            FlightLog.read(body)
        assert ask({"log": edited.decode()})["refused"] == "LogError"
        told += 1
    assert told > 100 and same < 20


def test_a_log_with_a_checksum_of_its_own_is_told_by_its_states(log: dict[str, Any]):
    """Whoever edits an event and makes the checksum anew has the states against him."""
    events = [*log["events"]]
    at = next(n for n, event in enumerate(events) if event[1] == "gust")
    events[at] = [events[at][0], "gust", events[at][2] * (1 + 1e-6), *events[at][3:]]
    edited = {**{name: own for name, own in log.items() if name != "checksum"}, "events": events}
    edited["checksum"] = checksum(edited)
    with pytest.raises(InvalidInputError) as refused:
        simulate_flight(FlightLog.read(edited))
    assert refused.value.field.startswith("checks[")


SUMS = (
    None,
    [True, False, [], {}, ""],
    [0, -0.0, 1, 1.0, 0.1, -1e-308, 5e-324, 1.7976931348623157e308, 2**53, 123456789.125],
    {"ψ": "θ̇ 𝄞", "a": {"z": 1, "Z": 2, "": 3}, "é": None, "\uffff": 1, "𝄞": 2, "b" * 70000: "\u0000"},
)


def test_checksums_are_alike_here_and_there(ask: Ask, log: dict[str, Any]):
    values = [*SUMS, log, list(range(300))]
    assert ask({"sums": values}) == [checksum(value) for value in values]
    assert checksum(values[1]) != checksum(values[2])
