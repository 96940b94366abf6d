"""How results show themselves: short, without arrays, escaped, with the right numbers."""

from __future__ import annotations

import re

import numpy as np
import pytest

import heli2dof_core as heli
from heli2dof_core.tables import Shown, Table, latex_matrix, number, poles


@pytest.fixture(scope="module")
def results() -> list[Shown]:
    spec = heli.Spec.from_preset()
    report = heli.evaluate(spec, each_axis=True)
    return [
        *(heli.preset(), spec, report, report.design, report.design.plant, report.loop, report.interaction),
        *report.step.values(),
        *(report.step["linear"].response, report.step["linear"].metrics, heli.suggest_pi(report.design)),
        heli.cloud(spec, heli.Uncertainty(samples=20)),
        *((comparison := heli.compare(spec, ["full-rank", "ackermann"])), *comparison.rows),
        *heli.compare_splits(spec),
        *(heli.place_poles([[0, 1], [2, 3]], [[0], [1]], [-4, -5]), heli.formulas()),
    ]


def test_a_repr_is_one_short_line_without_arrays(results):
    for result in results:
        text = repr(result)
        assert text.startswith(f"<{type(result).__name__}: ") and text.endswith(">")
        assert "\n" not in text and "array" not in text and len(text) < 300, text


def test_every_row_of_every_table_is_full_and_its_cells_are_words(results):
    tables = [table for result in results for table in result.tables()]
    assert len(tables) > 25
    for table in tables:
        assert table.rows
        for row in table.rows:
            assert len(row) == len(table.columns), table.title
            assert all(isinstance(cell, str) and "nan" not in cell for cell in row)


def test_html_holds_the_numbers_of_k():
    design = heli.place(heli.Spec.from_preset())
    html = design._repr_html_()
    assert html is not None
    for entry in design.K.flat:
        assert f'<td style="text-align:right">{number(float(entry))}</td>' in html
    assert re.findall(r"<(\w+)[^>]*>", html).count("td") == 8 + 4 * 2


def test_numbers_align_to_the_right_and_words_to_the_left():
    table = Table.of("", ("name", "value", "unit"), [("a", "−1.5", "V"), ("b", "—", "rad")])
    assert table.numeric == (False, True, False)
    assert heli.preset().tables()[0].numeric == (False, True, False, False)


def test_html_is_escaped():
    class Risky(Shown):
        def summary(self) -> str:
            return "<script>"

        def tables(self) -> tuple[Table, ...]:
            return (Table.of("<b>", ("&", "<"), [("<i>", "<td>")]),)

    html = Risky()._repr_html_()
    assert html is not None
    assert not {"<script>", "<b><", "<i>", "<td><td>"} & set(re.findall(r"<script>|<b><|<i>|<td><td>", html))
    assert "&lt;script&gt;" in html


def test_latex_of_a_matrix_is_latex():
    text = latex_matrix("K", np.array([[1.5, -2e-7], [0, 3]]))
    assert text == r"$\displaystyle K = \begin{bmatrix} 1.5 & -2 \cdot 10^{-7} \\ 0 & 3 \end{bmatrix}$"


def test_poles_are_written_as_pairs_only_where_they_are():
    assert poles([-3 + 4j, -3 - 4j, -1 + 2j, 5]) == "−3 ± 4j, −1 + 2j, 5"
    assert number(None) == "—"


def test_a_pole_set_makes_itself_again():
    own = heli.PoleSet([-12, -0.5, -3 + 4j, -3 - 4j])
    assert eval(repr(own), {"PoleSet": heli.PoleSet}) == own


def test_results_cannot_be_changed(results):
    for result in results:
        with pytest.raises(AttributeError):
            result.anything = 1


def test_figures_of_merit_name_their_units_where_they_have_one(results):
    """Voltages in V, effort in V²·s, a share in nothing."""
    metrics = next(result for result in results if isinstance(result, heli.StepMetrics))
    axes, motors = metrics.tables()
    units = {"rise time": "s", "settling time": "s", "overshoot": "%", "undershoot": "%"}
    units |= {"peak": "rad", "peak time": "s", "steady-state error": "rad", "IAE": "rad·s", "ITAE": "rad·s²"}
    named = [row[0] for row in axes.rows]
    assert named[: len(units)] == [f"{name} ({unit})" for name, unit in units.items()]
    assert [row[0] for row in motors.rows] == [
        "largest |voltage| (V)",
        "share of time at the limit",
        "effort (V²·s)",
    ]
