"""The registry of figures of merit: whole, and all that is made of it or reads it is current."""

from __future__ import annotations

import json
import re
import subprocess
import sys
from dataclasses import fields
from pathlib import Path
from types import ModuleType

import pytest

from app.contract.experiment import AxisMetrics, MotorMetrics
from app.contract.frequency import Margins
from app.contract.frequency import Sensitivity as SensitivityReply
from app.contract.model import Model
from heli2dof_core import figures
from heli2dof_core.export.report_figures import ROWS
from heli2dof_core.figures import KINDS, RESPONSE, Figure
from heli2dof_core.figures.written import told
from heli2dof_core.kernels import figures as kernel
from heli2dof_core.sensitivity import Sensitivity
from tests import page_figures, page_flight_tasks, page_methods

ALL = {f"{kind}.{name}": figure for kind, known in KINDS.items() for name, figure in known.items()}


@pytest.mark.parametrize(
    "made", [page_figures, page_flight_tasks, page_methods], ids=lambda made: made.__name__
)
def test_the_pages_modules_are_current(made: ModuleType):
    """`make contract` writes them anew."""
    assert made.PAGE.read_text("utf-8") == made.module()


@pytest.mark.parametrize("name", ALL)
def test_a_figure_says_what_it_is(name: str):
    figure = ALL[name]
    assert figure.term and figure.meaning and not figure.meaning.endswith(".")
    assert (
        figure.meaning[0].islower()
        or not figure.meaning[0].isalpha()
        or figure.meaning.startswith("Frobenius")
    )
    assert not (figure.hint and not figure.short), "a hint is said of a column"
    assert not figure.in_head or figure.shown
    if figure.title or figure.short:
        assert figure.notation != "flag"


def test_the_kernels_columns_are_the_axis_attributes():
    """By name: their numbers are held to outsiders elsewhere."""
    columns = {
        name.lower(): value
        for name, value in vars(kernel).items()
        if name.lower() in figures.AXIS and name.isupper()
    }
    assert columns == {name: i for i, name in enumerate(figures.AXIS)}
    assert len(figures.AXIS) == figures.AXIS_METRICS


@pytest.mark.parametrize(
    ("model", "known"),
    [
        (AxisMetrics, figures.AXIS),
        (MotorMetrics, figures.MOTOR),
        (Margins, figures.MARGINS),
        (SensitivityReply, figures.SENSITIVITY),
    ],
)
def test_the_schema_says_what_the_registry_says(model: type[Model], known: dict[str, Figure]):
    schema = model.model_json_schema()
    assert list(schema["properties"]) == list(known)
    assert {name: told["description"] for name, told in schema["properties"].items()} == {
        name: figure.described for name, figure in known.items()
    }
    assert set(schema.get("required", ())) == {n for n, f in known.items() if not f.absent}


def test_the_loops_figures_are_those_of_its_sensitivity():
    own = {field.name for field in fields(Sensitivity)} | {"gain_low", "gain_high", "phase"}
    assert set(figures.SENSITIVITY) == own


def test_absent_is_what_may_be_none():
    for cls, known in ((figures.AxisMetrics, figures.AXIS), (figures.Margins, figures.MARGINS)):
        optional = {field.name for field in fields(cls) if "None" in str(field.type)}
        assert optional == {name for name, figure in known.items() if figure.absent}


def test_the_report_has_the_pages_rows():
    """All titled figures of the step in the page's order, then each motor's."""
    own = [({**figures.AXIS, **figures.STEP})[name].titled for name in RESPONSE]
    motors = [f"{v} {f.titled}" for v in ("V_p", "V_y") for f in figures.MOTOR.values() if f.title]
    assert [row.name for row in ROWS] == own + motors
    text = page_figures.PAGE.read_text("utf-8")
    assert re.findall(r"^  \w+: (?:AXIS|STEP)\.(\w+),$", text, re.MULTILINE) == [
        ({**figures.AXIS, **figures.STEP})[name].key or name for name in RESPONSE
    ]


VALUES = (0.0, 1e-9, 0.0123, 0.0951, 0.7, 1.0, 1.0049, 2.347, 12.347, 99.96, 1234.7, 2.5e7, None)


def test_the_page_and_the_report_write_alike():
    """Every figure that both write, small and large and absent, by the page's own module."""
    values = [*VALUES, *(-value for value in VALUES if value is not None)]
    texts = (page_figures.PAGE.with_name("figure_texts.js")).as_uri()
    script = f"""
        const known = await import({json.dumps(page_figures.PAGE.as_uri())});
        const {{ textOf }} = await import({json.dumps(texts)});
        const values = {json.dumps(values)}.map((v) => v ?? undefined);
        const kinds = {json.dumps([kind.upper() for kind in KINDS])};
        console.log(JSON.stringify(kinds.flatMap((kind) =>
          Object.values(known[kind]).flatMap((f) => values.map((v) => textOf(f, v))))));
    """
    node = str(Path(sys.executable).with_name("node"))
    found = subprocess.run(
        [node, "--input-type=module", "-e", script], capture_output=True, text=True, check=True
    )
    written = iter(json.loads(found.stdout))
    for name, figure in ALL.items():
        for value in values:
            text = next(written)
            if figure.notation in ("fixed", "significant", "seconds", "decibel"):
                assert told(figure, value) == text, (name, value)
