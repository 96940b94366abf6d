"""Pictures of maps: what their colours, regions, lines, words and legend say is what the map holds."""

from __future__ import annotations

import json
import re
import subprocess
import xml.etree.ElementTree as ET
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from heli2dof_core import Spec, Uncertainty, design_map
from heli2dof_core.maps.canvas import LEFT, SIDE, TOP, Canvas
from heli2dof_core.maps.colors import css, ramp
from heli2dof_core.maps.labels import APART, Labels
from heli2dof_core.maps.levels import levels_of
from heli2dof_core.maps.numbers import request_of
from heli2dof_core.maps.regions import Grid, extended

SVG = "{http://www.w3.org/2000/svg}"
COLORS = Path(__file__).parents[2] / "static" / "maps" / "colors.js"
PSI = {"measure": "settling_time", "axis": "psi"}


def linear(color: str) -> np.ndarray:
    parts = np.array([int(color[i : i + 2], 16) / 255 for i in (1, 3, 5)])
    return np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)


def grey(color: str) -> float:
    """CIE lightness of a print in grey, 0 to 100."""
    y = float(linear(color) @ [0.2126, 0.7152, 0.0722])
    return 116 * np.cbrt(y) - 16 if y > 0.008856 else 903.3 * y


BLIND = {
    "protanopia": [
        [0.152286, 1.052583, -0.204868],
        [0.114503, 0.786281, 0.099216],
        [-0.003882, -0.048116, 1.051998],
    ],
    "deuteranopia": [
        [0.367322, 0.860646, -0.227968],
        [0.280085, 0.672501, 0.047413],
        [-0.011820, 0.042940, 0.968881],
    ],
    "tritanopia": [
        [1.255528, -0.076749, -0.178779],
        [-0.078411, 0.930809, 0.147602],
        [0.004733, 0.691367, 0.303900],
    ],
}
"""Of linear sRGB, by Machado, Oliveira and Fernandes (2009), all of one kind of cone missing."""


@pytest.mark.parametrize("count", [2, 5, 8, 12, 16])
def test_colours_fall_in_grey_and_stay_apart_for_the_colour_blind(count):
    colors = [css(color) for color in ramp(count)]
    greys = np.array([grey(color) for color in colors])
    assert np.all(np.diff(greys) < -60 / count / 2)
    assert greys[0] > 90 and greys[-1] < 40
    steps = np.linalg.norm(np.diff(ramp(count), axis=0), axis=1)
    assert np.ptp(steps) < 0.05 * np.mean(steps)
    for matrix in BLIND.values():
        seen = np.clip(np.array(matrix) @ np.array([linear(color) for color in colors]).T, 0, 1)
        light = np.cbrt([0.2126, 0.7152, 0.0722] @ seen)
        assert np.all(np.diff(light) < 0)


def test_the_page_has_the_same_colours():
    program = (
        f"import {{ ramp, css }} from {json.dumps(COLORS.as_uri())};"
        "console.log(JSON.stringify(ramp(9, false).map(css)))"
    )
    told = subprocess.run(
        ["node", "--input-type=module", "-e", program], capture_output=True, text=True, check=True
    )
    for one, other in zip(json.loads(told.stdout), map(css, ramp(9)), strict=True):
        assert np.max(np.abs(linear(one) - linear(other))) < 0.03  # by a step of the page's table


def inside(path: str, x: float, y: float) -> bool:
    """Whether a point is in a path by the even-odd rule."""
    crossed = False
    for ring in path.split("M")[1:]:
        points = np.array([[float(v) for v in p.split(",")] for p in ring.rstrip("Z").split("L")])
        for (x0, y0), (x1, y1) in zip(points, np.roll(points, -1, axis=0), strict=True):
            if (y0 > y) != (y1 > y) and x < (x1 - x0) * (y - y0) / (y1 - y0) + x0:
                crossed = not crossed
    return crossed


def test_regions_hold_the_places_that_they_say():
    rng = np.random.default_rng(6)
    x, y = np.linspace(100, 500, 14), np.linspace(400, 60, 11)
    coarse = rng.uniform(0, 1, (11, 14))
    values = (coarse + np.roll(coarse, 1, 0) + np.roll(coarse, 1, 1)) / 3
    grid = Grid(x, y)
    for level in (0.3, 0.5, 0.7):
        above, below = grid.above(values, level), grid.below(values, level)
        for (j, i), value in np.ndenumerate(values[1:-1, 1:-1]):
            if abs(value - level) > 0.02:
                at = float(x[i + 1]) + 0.05, float(y[j + 1]) + 0.05
                assert inside(above, *at) == (value > level)
                assert inside(below, *at) == (value < level)
    truths = values > 0.5
    path = grid.where(truths)
    for (j, i), own in np.ndenumerate(truths[1:-1, 1:-1]):
        assert inside(path, float(x[i + 1]) + 0.05, float(y[j + 1]) + 0.05) == own
    assert grid.where(np.zeros((11, 14), dtype=bool)) == ""


def test_lines_of_a_cone_are_circles():
    x = np.linspace(-2, 2, 81)
    (line,) = Grid(x, x).lines(np.hypot(*np.meshgrid(x, x)), 1.5)
    np.testing.assert_allclose(np.hypot(*line.T), 1.5, atol=2e-3)


def test_values_reach_beyond_what_is_known_and_change_nothing_of_it():
    values = np.arange(30.0).reshape(5, 6)
    known = np.zeros((5, 6), dtype=bool)
    known[1:3, 1:3] = True
    found = extended(np.where(known, values, np.nan), known)
    assert np.array_equal(found[known], values[known])
    assert found.min() >= values[known].min() and found.max() <= values[known].max()
    assert np.all(extended(values, np.zeros((5, 6), dtype=bool)) == 0)


@pytest.mark.parametrize("higher", [False, True])
def test_levels_are_round_few_and_lie_among_the_values(higher):
    rng = np.random.default_rng(9)
    for _ in range(200):
        scale = 10 ** rng.uniform(-4, 4)
        values = scale * (rng.uniform(-1, 1) + rng.exponential(rng.uniform(0.1, 3), 400))
        levels, wide = levels_of(values, higher=higher)
        assert 3 <= len(levels) <= 16
        assert levels == sorted(set(levels))
        assert np.min(values) < levels[0] and levels[-1] < np.max(values)
        digits = {f"{abs(v):.6e}".split("e")[0].rstrip("0") for v in levels if v}
        assert all(len(d) <= 5 for d in digits)
        if wide:
            assert digits <= {"1.", "2.", "5."}
    assert levels_of(np.full(9, 2.0), higher=higher) == ([], False)
    assert levels_of(np.full(9, np.nan), higher=higher) == ([], False)
    shares, _ = levels_of(np.r_[0.0, np.full(99, 100.0)], higher=True, whole=True)
    assert shares == [10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0, 90.0]


def test_names_of_lines_keep_clear_of_each_other():
    labels = Labels((0.0, 0.0, 400.0, 300.0), [(200.0, 100.0)])
    found = []
    for k in range(12):
        line = np.column_stack((np.linspace(5, 395, 60), 20 + 22.0 * k + 4 * np.sin(np.linspace(0, 6, 60))))
        label = labels.on(line, 40.0, k)
        if label is not None:
            found.append(label)
            assert abs(label.angle) <= 90
            assert np.min(np.hypot(*(line - (label.x, label.y)).T)) < 5
    assert len(found) > 5
    points = [(label.x, label.y) for label in found] + [(200.0, 100.0)]
    for i, one in enumerate(points):
        assert all(np.hypot(one[0] - a, one[1] - b) > APART for a, b in points[:i])
    assert labels.on(np.array([[0.0, 0.0], [30.0, 0.0]]), 40.0, 0) is None


def maps(spec: Spec):
    rigs = Uncertainty(samples=5)
    yield design_map(spec, "yaw-pair", PSI, size=(24, 18))
    yield design_map(spec, "pitch-pi", {"measure": "overshoot", "axis": "theta"}, size=(16, 12))
    yield design_map(spec, "pitch-pair", "disk_margin", size=(14, 14), real=True)
    yield design_map(spec, "yaw-pair", "gain_margin", [[-6, 2], [0, 4]], (12, 9))
    yield design_map(spec, "yaw-pair", "share_stable", size=(8, 6), uncertainty=rigs)
    yield design_map(spec.changed(outer="none"), "yaw-pair", "gain_margin", [[-3, -1], [0, 1]], (6, 5))
    yield design_map(spec, "yaw-pair", "norm", [[1, 4], [0, 3]], (5, 4))  # all unstable
    yield design_map(replace(spec, method="knv0"), "yaw-pair", "norm", [[-6, -2], [0, 2]], (5, 4))
    yield design_map(spec, "yaw-pair", "effort", size=(12, 9))


def test_pictures_are_whole_and_say_what_they_show(spec):
    names = set()
    for found in maps(spec.changed(poles=[-12, -10, -3 + 4j, -3 - 4j])):
        text = found.svg()
        root = ET.fromstring(text)
        assert root.find(f"{SVG}title").text == found.title
        assert "NaN" not in text.upper().replace("NANO", "") and "inf" not in text.lower().split("<desc>")[0]
        assert "script" not in text and "http" not in text.replace("http://www.w3.org/2000/svg", "")
        about = root.find(f"{SVG}desc").text.split("\n")
        assert about[0] == found.summary()
        assert json.loads(about[-1]) == request_of(found)
        words = [each.text for each in root.iter(f"{SVG}text")]
        canvas = Canvas(found)
        assert words[0].startswith(found.title) and words[0].endswith(canvas.unit)
        for level in canvas.levels:
            assert canvas.text_of(level) in words
        for what, word in (
            (np.any(~found.stable & np.isfinite(found.abscissa)), "unstable"),
            (np.any(found.unlimited), "no limit"),
            (
                found.best is not None and canvas.best is not None,
                f"best {found.written((found.best or (0, 0, 0))[2])}",
            ),
        ):
            assert (word in words) == bool(what), (found, word)
        fills = re.findall(r'<rect x="[\d.]+" y="[\d.]+" width="16" height="[\d.]+" fill="(#\w+)"', text)
        if np.any(found.valid):
            assert len(fills) == len(canvas.colors)
            lights = [grey(color) for color in fills]  # from the lowest value up
            better = found.measure.figure.better
            assert lights == sorted(lights, reverse=better != "higher")
        names |= set(re.findall(r' id="(m\w{8})\w"', text))
    assert len(names) == 9  # several pictures may stand in one page


def test_places_have_the_colour_of_their_value(spec):
    found = design_map(spec, "yaw-pair", PSI, size=(24, 18))
    canvas, text = Canvas(found), found.svg()
    regions = re.findall(r'<path fill-rule="evenodd" fill="(#\w+)" d="([^"]*)"', text)
    assert [color for color, _ in regions] == [css(color) for color in canvas.colors[1:]]
    for (j, i), value in np.ndenumerate(canvas.shown):
        if not np.isfinite(value) or min(abs(value - level) for level in canvas.levels) < 0.01 or j * i == 0:
            continue
        x, y = float(canvas.across(found.x[i])) - 0.05, float(canvas.up(found.y[j])) + 0.05
        shown = sum(inside(path, x, y) for _, path in regions)
        assert shown == sum(value > level for level in canvas.levels)


def test_numbers_stand_where_they_are(spec):
    found = design_map(spec, "pitch-pi", "norm", size=(8, 6))
    canvas = Canvas(found)
    assert float(canvas.across(found.x[0])) == LEFT and float(canvas.across(found.x[-1])) == LEFT + SIDE
    assert float(canvas.up(found.y[-1])) == pytest.approx(TOP)
    middle = float(np.sqrt(found.x[0] * found.x[-1]))
    assert float(canvas.across(middle)) == pytest.approx(LEFT + SIDE / 2)
    marks = re.findall(r'class="m" d="M([\d.]+),([\d.]+)a6,6', found.svg())
    kp, ti = found.here
    assert [float(v) for v in marks[0]] == pytest.approx(
        [float(canvas.across(kp)) - 6, float(canvas.up(ti))], abs=0.06
    )


def test_rows_say_why_there_is_no_value(spec):
    for found, states in (
        (design_map(spec, "yaw-pair", PSI, [[-20, 3], [0, 9]], (14, 9)), {"ok", "none", "unstable"}),
        (
            design_map(spec.changed(outer="none"), "yaw-pair", "gain_margin", [[-3, -1], [0, 1]], (6, 5)),
            {"unlimited"},
        ),
        (
            design_map(replace(spec, method="knv0"), "yaw-pair", "norm", [[-6, -2], [0, 2]], (5, 4)),
            {"no design"},
        ),
    ):
        *comments, _, _ = [line for line in found.csv().split("\n") if line.startswith("#")] + ["", ""]
        assert json.loads(comments[2].removeprefix("# ")) == request_of(found)
        rows = [line.split(",") for line in found.csv().split("\n") if line and line[0] != "#"][1:]
        assert len(rows) == found.values.size
        assert {row[3] for row in rows} >= states
        for row, value in zip(rows, found.values.ravel().tolist(), strict=True):
            assert (float(row[2]) == value) if row[3] == "ok" else row[2] == ""
