"""The laboratory report: well-formed, without script, its numbers and curves those of the core."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from jinja2 import UndefinedError

from heli2dof_core import PRESETS, OuterLoop, PoleSet, Scenario, Spec, Structure, evaluate, preset
from heli2dof_core.evaluate import Report
from heli2dof_core.export import FORMATS, Beside
from heli2dof_core.export.report import _templates
from heli2dof_core.export.svg import HEIGHT, LEFT, WIDTH, Curve, chart, number, thinned
from heli2dof_core.figures.written import decibel, fixed, percent, seconds, significant
from heli2dof_core.findings import Finding
from heli2dof_core.ticks import ticks

BASE = Spec.from_preset(preset())
SPECS = {
    "default": BASE,
    "unstable": replace(
        BASE, poles=PoleSet([-3 + 4j, -3 - 4j, -5, -6]), scenario=Scenario(theta=0.6, duration=8.0)
    ),
    "shifted": replace(BASE, structure=Structure("triangular", "yaw", 0.2), outer=OuterLoop("none")),
    "lqr": replace(BASE, method="lqr-integral"),
    "at-rest": replace(BASE, scenario=Scenario()),
    "aero": Spec.from_preset(PRESETS["quanser-aero"]),
}


def tree(text: str) -> ET.Element:
    """The page as XML: void elements are closed first, all else has to be well-formed as it is."""
    text = text.removeprefix("<!doctype html>").replace("&nbsp;", " ")
    return ET.fromstring(re.sub(r"<meta ([^>]*)>", r"<meta \1/>", text))


@pytest.mark.parametrize("name", SPECS)
def test_the_report_is_well_formed_and_holds_the_design(name: str):
    spec = SPECS[name]
    text, report = FORMATS["report"].render(spec), evaluate(spec, each_axis=True)
    page = tree(text)
    words = " ".join(page.itertext())
    for value in (*report.design.K.ravel(), report.design.norm):
        assert number(value, 5)[:5] in words
    for finding in report.findings:
        assert finding.message in words
    assert not list(page.iter("script")) and not re.search(
        r"\son\w+=|javascript:|https?://(?!www.w3.org)", text
    )
    kinds = {element.tag.rpartition("}")[2] for element in page.iter()}
    assert {"math", "svg", "table", "polyline", "title"} <= kinds
    headings = [element.text for element in page.iter("h2")]
    what_follows = ["Responses", "Figures of merit", "Findings", "Answers", "Origin"]
    assert headings == ["Rig", "Design", "Formulas", *what_follows]
    assert "nan" not in words.lower().split() and "None°" not in words


HOSTILE = """</pre></title></style><script>alert(1)</script>{{ 7*7 }}{% if %}'"&amp;"""


def test_all_text_is_escaped(monkeypatch: pytest.MonkeyPatch):
    plain = [element.tag for element in tree(FORMATS["report"].render(BASE, "x")).iter()]
    hostile = replace(preset(), title=HOSTILE, source=HOSTILE)
    told = Finding("x", "warning", HOSTILE)
    monkeypatch.setattr(Report, "findings", (told, told))
    monkeypatch.setattr("heli2dof_core.export.report.preset_of", lambda _: hostile)
    page = tree(FORMATS["report"].render(BASE, HOSTILE))
    found = [element.tag for element in page.iter() if element.tag not in ("li", "b", "ul", "p")]
    assert found == [tag for tag in plain if tag not in ("li", "b", "ul", "p")]
    anchor, title = next(page.iter("a")), next(page.iter("title"))
    assert anchor.get("href") == anchor.text == HOSTILE and title.text == f"Pole placement: {HOSTILE}"
    assert [bold.tail for bold in page.iter("b")] == [f" {HOSTILE}"] * 2
    assert HOSTILE in "".join(next(page.iter("pre")).itertext())


def test_a_name_that_nobody_gave_is_an_error():
    with pytest.raises(UndefinedError):
        _templates().get_template("report.html.jinja").render(title="")


def test_a_curve_is_where_its_numbers_are():
    x, y = np.linspace(0, 2, 5), np.array([0.0, 1.0, 4.0, 9.0, 10.0])
    svg = ET.fromstring(chart("a & b", "x", "y", [Curve(x, y, "pitch")]))
    assert svg[0].text == "a & b"
    points = np.array([p.split(",") for p in next(svg.iter("polyline")).get("points").split()], dtype=float)
    labels = {e.text: e for e in svg.iter("text") if e.get("text-anchor") == "middle"}
    left, right = (float(labels[text].get("x")) for text in ("0", "2"))
    assert (left, right) == (LEFT, WIDTH - 10)
    np.testing.assert_allclose(points[:, 0], left + x / 2 * (right - left), atol=0.06)
    upright = [e for e in svg.iter("text") if e.get("text-anchor") == "end"]  # of the y axis
    (low, bottom), *_, (high, top) = sorted((float(e.text), float(e.get("y")) - 3.5) for e in upright)
    slope = (top - bottom) / (high - low)
    np.testing.assert_allclose(points[:, 1], bottom + slope * (y - low), atol=0.15)
    assert np.all((points >= 0) & (points <= [WIDTH, HEIGHT]))


@pytest.mark.parametrize(("low", "high"), [(0, 1), (-3.2, 17), (1e-7, 3e-7), (-1e6, 1e6), (12.1, 12.2)])
def test_ticks_are_round_and_inside(low: float, high: float):
    found = ticks(low, high)
    assert 2 <= len(found) <= 7
    slack = 1e-9 * (high - low)
    assert all(low - slack <= value <= high + slack for value in found)
    step = found[1] - found[0]
    assert step / 10 ** np.floor(np.log10(step) + 1e-9) == pytest.approx(1) or round(
        step / 10 ** np.floor(np.log10(step) + 1e-9)
    ) in (2, 5)


def test_thinning_keeps_every_peak():
    x = np.linspace(0, 1, 20_001)
    y = np.sin(30 * x)
    y[12_345], y[777] = 7.0, -9.0
    short_x, short_y = thinned(x, y)
    assert len(short_x) <= 402 and np.all(np.diff(short_x) > 0)
    assert short_y.max() == 7.0 and short_y.min() == -9.0 and (short_x[0], short_x[-1]) == (0, 1)


def rows_of(spec: Spec, head: str) -> dict[str, list[str]]:
    """The cells of the table whose header names `head`, by the row's name."""
    page = tree(FORMATS["report"].render(spec))
    for table in page.iter("table"):
        if head in [cell.text for cell in table.iter("th")]:
            return {row[0].text or "": [c.text or "" for c in row[1:]] for row in table.iter("tr")}
    raise AssertionError(head)


@pytest.mark.parametrize("name", ["default", "unstable", "aero", "lqr"])
def test_each_axis_is_stepped_alone_and_told_in_degrees(name: str):
    spec = SPECS[name]
    rows = rows_of(spec, "pitch step")
    for axis, (own, ideal) in {"theta": (0, 1), "psi": (2, 3)}.items():
        alone = replace(
            spec, scenario=replace(spec.scenario, **{"psi" if axis == "theta" else "theta": None})
        )
        for column, model in ((own, "nonlinear"), (ideal, "linear")):
            metrics = evaluate(alone).step[model].metrics
            m = metrics.axes.get(axis)
            if m is None:
                assert rows["Overshoot"][column] == "–"
                continue
            assert rows["Overshoot"][column] == f"{m.overshoot:.1f} %"
            settling = rows["Settling time"][column]
            assert settling == (f"{m.settling_time:.2f} s" if m.settled else "not settled")
            iae = float(rows["IAE, °s"][column].replace("−", "-"))
            assert iae == pytest.approx(np.degrees(m.iae), rel=0.01, abs=5e-4)
            assert metrics.coupling_peak is not None
            moved = float(rows["Other axis moves"][column].rstrip("°"))
            assert moved == pytest.approx(np.degrees(metrics.coupling_peak), abs=0.0051)


def test_the_curves_are_both_steps_by_both_models():
    page = tree(FORMATS["report"].render(BASE))
    kinds = [line.get("class") for line in page.iter("polyline")]
    assert all(kinds.count(kind) == 4 for kind in ("pitch", "yaw", "pitch-linear", "yaw-linear"))


@pytest.mark.parametrize(
    ("told", "expected"),
    [
        (fixed(-0.001), "0.00"),
        (fixed(-1.2345, 1), "−1.2"),
        (fixed(None), "–"),
        (significant(123456789.0, 3), "1.2e8"),
        (significant(0.00001234, 3), "1.2e−5"),
        (significant(12.345, 3), "12.3"),
        (seconds(0.0123), "12 ms"),
        (seconds(0.0017), "1.7 ms"),
        (seconds(1.5), "1.50 s"),
        (decibel(2.0), "6.0 dB"),
        (percent(0.0003), "< 0.1 %"),
        (percent(0.004), "0.4 %"),
        (percent(0.0), "0.0 %"),
    ],
)
def test_numbers_are_written_as_on_the_page(told: str, expected: str):
    assert told == expected


def test_fields_can_be_typed_in_without_a_script():
    page = tree(FORMATS["report"].render(BASE))
    boxes = {box.get("aria-label"): box for box in page.iter("div") if box.get("role") == "textbox"}
    assert set(boxes) == {"Name", "Date", "Answers"}
    assert {box.get("contenteditable") for box in boxes.values()} == {"true"}


def test_pins_are_rows_with_the_cores_figures():
    beside = Beside([("A", SPECS["aero"]), ("B <b>", SPECS["unstable"])])
    text = FORMATS["report"].content(BASE, "", beside).decode()
    page = tree(text)
    assert "Pinned designs" in [element.text for element in page.iter("h2")]
    rows = {row[0].text: [cell.text or "" for cell in row[1:]] for row in page.iter("tr")}
    report = evaluate(SPECS["aero"], each_axis=True)
    steps = [report.axis_steps[name]["nonlinear"].metrics for name in ("theta", "psi")]
    overshoot = " · ".join(
        f"{m.axes[a].overshoot:.1f} %" for m, a in zip(steps, ("theta", "psi"), strict=True)
    )
    assert rows["A"][3] == overshoot
    volts = [max(m.motors[name].peak for m in steps) for name in ("V_p", "V_y")]
    assert rows["A"][4] == " · ".join(f"{v:.1f} V" for v in volts)
    assert rows["B <b>"][2] == "unstable"


@pytest.mark.parametrize("name", ["default", "unstable", "aero", "at-rest", "lqr"])
def test_requirements_are_judged_on_the_rigs_steps_and_its_loop(name: str):
    spec, asked = SPECS[name], {"settling": 2.0, "overshoot": 5.0, "lag": 0.2}
    page = _report(spec, asked)
    found = {"Settling time": ["≤ 2.00 s"], "Overshoot": ["≤ 5.0 %"], "Lag margin": ["≥ 0.20 s", "", ""]}
    report = evaluate(spec, each_axis=True)
    for axis in ("theta", "psi"):
        own = report.axis_steps.get(axis)
        metrics = own and own["nonlinear"].metrics.axes[axis]
        told = ["not stepped"] * 2
        if metrics:
            settled = metrics.settling_time is not None and metrics.settling_time <= 2.0
            time = "not settled" if metrics.settling_time is None else seconds(metrics.settling_time)
            told = [f"{'✓' if settled else '✕'} {time}"]
            told += [f"{'✓' if metrics.overshoot <= 5.0 else '✕'} {fixed(metrics.overshoot, 1)} %"]
        found["Settling time"].append(told[0])
        found["Overshoot"].append(told[1])
    margin = report.loop.lag_margin
    short = margin is not None and margin < 0.2
    known = "unlimited" if margin is None else seconds(margin)
    found["Lag margin"].append("✕ unstable" if not report.loop.stable else f"{'✕' if short else '✓'} {known}")
    for title, cells in found.items():
        assert [*cells, ""][:4] in _rows(page, title)


def test_without_remarks_the_report_has_no_findings():
    heads = [
        [element.text for element in tree(FORMATS["report"].content(BASE, "", own).decode()).iter("h2")]
        for own in (Beside(), Beside(remarks=False))
    ]
    assert "Findings" in heads[0] and [head for head in heads[0] if head != "Findings"] == heads[1]


def _report(spec: Spec, asked: dict[str, float]) -> ET.Element:
    return tree(FORMATS["report"].content(spec, "", Beside(required=asked)).decode())


def _rows(page: ET.Element, head: str) -> list[list[str]]:
    return [[cell.text or "" for cell in row[1:]] for row in page.iter("tr") if row[0].text == head]
