"""What is told of a study's designs, against the same told from its files by pandas."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest

from heli2dof_core.engine import warm_up
from heli2dof_core.many import Measure
from heli2dof_core.measured import Where
from heli2dof_core.study import Alone, Folder, read_study, run, summarize
from heli2dof_core.study import study as study_module
from heli2dof_core.study import summary as summary_module
from heli2dof_core.study.summary import PERCENTILES

TEXT = """
study = 1
title = "Gains"
measures = ["overshoot"]
[design]
scenario.duration = 3.0
[designs.grid]
"loops.pitch.kp" = [3, 6]
"pitch-pair.re" = [-3, -6, -12]
[rigs]
count = 100
[require]
settling_time = { max = 2.8, share = 0.6 }
disk_margin = { min = 0.4, share = 0.95 }
V_peak = { max = 24, motor = "V_p" }
"""


@pytest.fixture(scope="module")
def summary(tmp_path_factory):
    warm_up()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(study_module, "PART", 40)
        folder = Folder(tmp_path_factory.mktemp("summary") / "a", read_study(TEXT))
        run(folder, Alone())
        yield summarize(folder), pd.read_parquet(folder.path / "parts")


def test_percentiles_are_values_that_occur_and_what_has_none_is_the_worst(summary):
    told, rows = summary
    for own in told.designs:
        rigs = rows[(rows.design == own.design) & (rows.rig > 0)]
        for k, column in enumerate(told.study.columns):
            worst = -math.inf if column == "disk_margin" else math.inf
            values = rigs[column].fillna(worst).to_numpy()
            expected = np.percentile(values, PERCENTILES, method="inverted_cdf")
            expected[~np.isfinite(expected)] = math.nan
            np.testing.assert_array_equal(own.percentiles[:, k], expected)
    assert any(np.isnan(own.percentiles).any() for own in told.designs)
    assert any(np.isfinite(own.percentiles).all() for own in told.designs)


def test_shares_are_those_of_the_rigs_that_meet(summary):
    told, rows = summary
    verdicts = []
    for own in told.designs:
        rigs = rows[rows.design == own.design]
        met = [
            [required.meets(None if math.isnan(v) else v) for v in rigs[column].tolist()]
            for required, column in zip(
                told.study.requirements, ("settling_time", "disk_margin", "V_peak_V_p"), strict=True
            )
        ]
        assert own.shares.tolist() == [sum(one[1:]) / 100 for one in met]
        assert own.all_met == sum(map(all, zip(*(one[1:] for one in met), strict=True))) / 100
        nominal = all(one[0] for one in met)
        assert own.meets == (nominal and own.shares[0] >= 0.6 and own.shares[1] >= 0.95)
        assert own.stable == rigs.stable.iloc[1:].mean()
        verdicts.append(own.meets)
    assert True in verdicts and False in verdicts


def test_the_best_come_first(summary):
    told, _ = summary
    ranked = told.ranked
    assert [own.meets for own in ranked] == sorted((own.meets for own in ranked), reverse=True)
    shares = [own.all_met for own in ranked if own.meets]
    assert shares == sorted(shares, reverse=True)
    assert told.meeting == tuple(own for own in ranked if own.meets)


def test_tables_say_what_is_told(summary):
    told, _ = summary
    designs, _missing, required = told.tables()
    figures = ("overshoot 95 %", "settling time 95 %", "disk margin 5 %", "V_peak V_p 95 %")
    assert designs.columns == (
        *("design", "loops pitch kp", "pitch pair re"), *figures, *("stable", "meet all", "meets")
    )  # fmt: skip
    assert [row[0] for row in designs.rows] == [str(own.design) for own in told.ranked]
    assert [row[1] for row in required.rows] == ["≤ 2.80 s", "≥ 0.40", "≤ 24.0 V"]
    assert f"{len(told.meeting)} meet all requirements" in told.summary()
    heads, *rows = told.rows()
    assert len({*heads}) == len(heads)
    assert {len(row) for row in rows} == {len(heads)}


def test_what_has_no_value_is_told_in_words_and_how_many(summary):
    told, rows = summary
    missing = told.tables()[1]
    assert missing.columns == ("figure", "shown as", "because", "uncertain rigs under the designs above")
    of = {row[0]: row[1:] for row in missing.rows}
    count = rows[rows.rig > 0].settling_time.isna().sum()
    assert count > 0
    because = "the loop is not stable, or the response has not settled when the run ends"
    assert of["Settling time, either step"] == ("not settled", because, f"{count} of 600")
    assert "not reached" not in {cell for row in told.tables()[0].rows for cell in row}  # of overshoot


def test_a_design_alone_is_told_figure_by_figure(tmp_path):
    warm_up()
    folder = Folder(tmp_path / "one", read_study('study = 1\ntitle = "One"\n[rigs]\ncount = 40'))
    run(folder, Alone())
    (table,) = summarize(folder).tables()
    assert (table.title, table.columns) == ("One", ("", "nominal", "5 %", "50 %", "95 %"))
    assert [row[0] for row in table.rows][:2] == ["Settling time, either step", "Overshoot, either step"]
    folder = Folder(tmp_path / "none", read_study("study = 1\n[require]\nsettling_time = { max = 9 }"))
    run(folder, Alone())
    summary = summarize(folder)
    table, required = summary.tables()
    assert table.columns == ("", "value")
    assert len(summary.meeting) == 1
    assert required.columns == ("requirement", "limit", "nominal")


def test_values_of_which_only_the_size_counts_are_ranked_by_it():
    measure = Measure("steady_state_error", Where("both"))
    values = np.array([-3.0, 1.0, 2.0, np.nan])
    assert summary_module._percentiles(measure, values).tolist()[:2] == [1.0, 2.0]
    assert math.isnan(summary_module._percentiles(measure, values)[2])
    unlimited = Measure("gain_margin")
    found = summary_module._percentiles(unlimited, np.array([np.inf] * 19 + [np.nan]))
    assert math.isnan(found[0]) and found[1:].tolist() == [math.inf] * 2


def test_a_share_is_never_rounded_up_to_all():
    assert summary_module._percent(0.99999) == "99.9 %"
    assert summary_module._percent(1.0) == "100 %"


def test_a_margin_that_an_unstable_loop_lacks_is_not_told_as_unlimited(tmp_path):
    warm_up()
    text = """
study = 1
[design]
poles = [1, -5, -6, -7]
outer = "none"
[require]
gain_margin = { min = 2 }
"""
    folder = Folder(tmp_path / "unstable", read_study(text))
    run(folder, Alone())
    table, missing, required = summarize(folder).tables()
    assert [row[1] for row in table.rows] == ["none"]
    assert [row[2] for row in required.rows] == ["none"]
    assert [row[1:] for row in missing.rows] == [("none", "the loop is not stable", "1 of 1")]
