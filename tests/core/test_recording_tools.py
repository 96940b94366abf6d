"""Recordings as binary files of real tools: SciPy, GNU Octave, h5py, pandas and openpyxl.

Every file holds the same run; what is read must be it, or be refused with a way out.
"""

from __future__ import annotations

import io
import shutil
import subprocess
import warnings
from datetime import datetime, timedelta
from pathlib import Path

import h5py
import numpy as np
import openpyxl
import pandas as pd
import pytest
from scipy.io import savemat

from heli2dof_core.errors import RecordingError
from heli2dof_core.recordings.files import matlab_tables, read_table
from heli2dof_core.recordings.guess import guess_columns
from tests.core.recorded_run import DEGREES, FRAME, RUN, T, is_the_run, rows_of


def mat(content, **how):
    file = io.BytesIO()
    savemat(file, content, **how)
    return file.getvalue()


VECTORS = {name: values[:, None] for name, values in RUN.items()}
STRUCTURE = {
    "time": T[:, None],
    "signals": {"values": np.column_stack([RUN[name] for name in ("theta", "psi")]), "label": "angles"},
}
MATS = {
    "version 4": (mat(VECTORS, format="4"), ""),
    "version 5": (mat(VECTORS), ""),
    "version 7": (mat(VECTORS, do_compression=True), ""),
    "a structure of columns": (mat({"data": VECTORS}), ""),
    "To File, [t; value] each": (
        mat(
            {
                name: np.array([T, RUN[role]])
                for name, role in (("pitch", "theta"), ("yaw", "psi"), ("Vp", "V_p"), ("Vy", "V_y"))
            }
        ),
        "",
    ),
    "structures with time": (
        mat(
            {
                name: {"time": T[:, None], "signals": {"values": RUN[role][:, None], "label": ""}}
                for name, role in (("pitch", "theta"), ("yaw", "psi"), ("V_p", "V_p"), ("V_y", "V_y"))
            }
        ),
        "",
    ),
    "a structure with time and several signals": (
        mat(
            {
                "simout": {
                    "time": T[:, None],
                    "signals": [
                        {"values": RUN[name][:, None], "label": name} for name in RUN if name != "time"
                    ],
                }
            }
        ),
        "",
    ),
    "fields of timeseries": (
        mat(
            {
                name: {"Name": "", "Time": T[:, None], "Data": RUN[name].reshape(1, 1, -1)}
                for name in RUN
                if name != "time"
            }
        ),
        "",
    ),
    "one row longer": (mat({**VECTORS, "theta": np.append(RUN["theta"], 9.0)[:, None]}), "one_row_longer"),
}


@pytest.mark.parametrize("name", MATS)
def test_scipys_mat_files_are_read(name):
    data, code = MATS[name]
    table = read_table(data)
    is_the_run(table)
    assert code in ("", *(f.code for f in table.findings))


def test_to_file_with_all_in_one_says_what_is_the_time():
    table = read_table(mat({"theta": np.array(list(RUN.values()))}))
    assert guess_columns(table).names == {"time": "theta(1)"}


def matlab_hdf5(content):
    """As MATLAB's save(…, '-v7.3') lays it out: a head, dimensions turned round, classes as attributes."""
    file = io.BytesIO()
    with h5py.File(file, "w", userblock_size=512) as out:
        refs = out.create_group("#refs#")

        def put(group, name, value):
            if isinstance(value, dict):
                inner = group.create_group(name)
                inner.attrs["MATLAB_class"] = np.bytes_("struct")
                for key, item in value.items():
                    put(inner, key, item)
            elif isinstance(value, str):
                data = group.create_dataset(name, data=np.array([[ord(c)] for c in value], dtype=np.uint16))
                data.attrs["MATLAB_class"] = np.bytes_("char")
            elif isinstance(value, list):
                cells = []
                for item in value:
                    put(refs, key := f"r{len(refs)}", item)
                    cells.append(refs[key].ref)
                data = group.create_dataset(name, data=np.array([cells], dtype=h5py.ref_dtype))
                data.attrs["MATLAB_class"] = np.bytes_("cell")
            else:
                data = group.create_dataset(name, data=np.atleast_2d(value).T, compression="gzip")
                data.attrs["MATLAB_class"] = np.bytes_("double")

        for name, value in content.items():
            put(out, name, value)
        string = out.create_dataset("note", data=np.zeros((1, 6), dtype=np.uint32))
        string.attrs["MATLAB_class"], string.attrs["MATLAB_object_decode"] = np.bytes_("string"), 3
    head = b"MATLAB 7.3 MAT-file, Platform: GLNXA64".ljust(124) + b"\x00\x02IM"
    return head + file.getvalue()[len(head) :]


@pytest.mark.parametrize(
    "content",
    [
        VECTORS,
        {
            "simout": {
                "time": T[:, None],
                "signals": {"values": [RUN[n][:, None] for n in list(RUN)[1:]], "label": list(RUN)[1:]},
            }
        },
        {"log": VECTORS, "cells": [T[:3], "text"]},
    ],
    ids=("vectors", "a structure with time and several signals", "a structure beside cells"),
)
def test_matlabs_hdf5_is_read_and_what_is_no_number_named(content):
    table = read_table(matlab_hdf5(content), "run.mat")
    is_the_run(table)
    assert any("note (MATLAB's string)" in f.message for f in table.findings)


def test_plain_hdf5_is_read():
    file = io.BytesIO()
    with h5py.File(file, "w") as out:
        for name, values in RUN.items():
            out[f"run/{name}"] = values
    is_the_run(read_table(file.getvalue()))


OCTAVE = """
t = 0:0.01:0.59; theta = 0.2*sin(3*t); psi = 0.3*cos(2*t); V_p = 12.5+sin(5*t); V_y = -3.25+cos(5*t);
note = "a run"; z = 1+2i; c = {1, "x"};
save -text text.txt
save -hdf5 hdf5.h5
save -binary binary.bin
save -v4 v4.mat t theta psi V_p V_y
save -v6 v6.mat
save -v7 v7.mat
simout.time = t';
simout.signals(1).values = theta'; simout.signals(1).label = 'theta';
simout.signals(2).values = psi'; simout.signals(2).label = 'psi';
simout.signals(3).values = V_p'; simout.signals(3).label = 'V_p';
simout.signals(4).values = V_y'; simout.signals(4).label = 'V_y';
save -text structure.txt simout
save -hdf5 structure.h5 simout
save -v7 structure.mat simout
all.time = t'; all.signals.values = [theta' psi' V_p' V_y']; all.signals.label = 'all';
save -hdf5 one_signal.h5 all
M = [t' theta' psi' V_p' V_y'];
save -ascii ascii.txt M
dlmwrite('dlm.csv', M, 'precision', 12);
csvwrite('csv.csv', M);
"""


@pytest.fixture(scope="module")
def octave(tmp_path_factory):
    program = shutil.which("octave-cli")
    if program is None:
        pytest.skip("GNU Octave is not installed")
    folder = tmp_path_factory.mktemp("octave")
    subprocess.run(
        [program, "--no-history", "--quiet", "--eval", OCTAVE], cwd=folder, check=True, timeout=120
    )
    return folder


@pytest.mark.parametrize(
    "name",
    ["text.txt", "hdf5.h5", "v4.mat", "v6.mat", "v7.mat", "structure.txt", "structure.h5", "structure.mat"],
)
def test_octaves_files_are_read(octave, name):
    is_the_run(read_table((octave / name).read_bytes()), 1e-5)


def test_octaves_one_signal_and_plain_matrices_keep_their_time(octave):
    table = read_table((octave / "one_signal.h5").read_bytes())
    assert table.names == ("all.time", "all(1)", "all(2)", "all(3)", "all(4)") or table.time == "all.time"
    np.testing.assert_allclose(table.values[:, 3], RUN["V_p"], atol=1e-12)
    for name in ("ascii.txt", "dlm.csv", "csv.csv"):
        table = read_table((octave / name).read_bytes(), name)
        np.testing.assert_allclose(table.values, np.column_stack(list(RUN.values())), atol=1e-4)
        assert guess_columns(table).names == {}


def test_octaves_binary_is_refused_with_a_way_out(octave):
    with pytest.raises(RecordingError, match="binary") as caught:
        read_table((octave / "binary.bin").read_bytes())
    assert "-v7" in caught.value.hint


def sheet(rows, *more):
    book = openpyxl.Workbook()
    book.active.title = "run"
    for row in rows:
        book.active.append(row)
    for title in more:
        book.create_sheet(title, 0).append(["nothing", "here"])
    file = io.BytesIO()
    book.save(file)
    return file.getvalue()


def by_pandas(frame):
    file = io.BytesIO()
    frame.to_excel(file)
    return file.getvalue()


@pytest.mark.parametrize(
    "data",
    [
        by_pandas(FRAME),
        sheet(
            [
                ["Time (ms)", "Pitch (deg)", "Yaw (deg)", "Vp", "Vy"],
                *([1e3 * r[0], *r[1:]] for r in rows_of(DEGREES)),
            ]
        ),
        sheet(
            [
                ["Recorded by me"],
                [],
                [None, *RUN],
                [None, "s", "rad", "rad", "V", "V"],
                *([None, *row] for row in rows_of(RUN)),
            ],
            "about",
        ),
        sheet([list(RUN), *([datetime(2024, 5, 1) + timedelta(seconds=r[0]), *r[1:]] for r in rows_of(RUN))]),
    ],
    ids=("pandas", "units in names", "a title, shifted, units in a row, two sheets", "dates"),
)
def test_spreadsheets_are_read(data):
    is_the_run(read_table(data, "run.xlsx"), 2e-6)


def as_matlab(path: Path, version: str, content: dict[str, object]) -> bytes:
    """A .mat with MATLAB's own tables, as mat-io writes them."""
    with (
        warnings.catch_warnings()
    ):  # of an option of pandas, and of units that MATLAB's durations do not have
        warnings.simplefilter("ignore")
        from matio import save_to_mat

        save_to_mat(str(path), content, version=version)
    return path.read_bytes()


FRAME_OF_ANGLES = pd.DataFrame(
    {own: RUN[role] for own, role in (("pitch", "theta"), ("yaw", "psi"), ("Vp", "V_p"), ("Vy", "V_y"))}
)


@pytest.mark.parametrize("version", ["v7", "v7.3"])
@pytest.mark.parametrize(
    "clock", [pd.to_timedelta(T, unit="s"), pd.Timestamp("2026-03-01") + pd.to_timedelta(T, unit="s")]
)
def test_matlabs_timetables_are_read(tmp_path: Path, version: str, clock: pd.Index):
    content = {"run": FRAME_OF_ANGLES.set_index(clock), "note": "of a rig"}
    table = read_table(as_matlab(tmp_path / "run.mat", version, content), "run.mat")
    assert table.names == ("run.Time", "run.pitch", "run.yaw", "run.Vp", "run.Vy")
    np.testing.assert_allclose(table.values[:, 0] - table.values[0, 0], T - T[0], atol=2e-3)
    for name, column in zip(("theta", "psi", "V_p", "V_y"), table.values.T[1:], strict=True):
        np.testing.assert_allclose(column, RUN[name])


def test_matlabs_tables_are_read_beside_other_variables(tmp_path: Path):
    content = {"run": FRAME_OF_ANGLES.assign(time=T), "gain": np.eye(2)}
    is_the_run(read_table(as_matlab(tmp_path / "run.mat", "v7", content), "run.mat"))


def test_where_no_mat_io_reads_them_they_are_named_with_a_way_out(tmp_path: Path, monkeypatch):
    data = as_matlab(tmp_path / "run.mat", "v7", {"run": FRAME_OF_ANGLES, "t": T, "theta": RUN["theta"]})
    monkeypatch.setattr(matlab_tables, "find_spec", lambda name: None)
    (finding,) = read_table(data, "run.mat").findings
    assert "run (MATLAB's table; pip install 'heli2dof[matlab]' reads it)" in finding.message


def test_a_reader_that_ends_takes_nobody_along(tmp_path: Path, monkeypatch):
    data = as_matlab(tmp_path / "run.mat", "v7", {"run": FRAME_OF_ANGLES, "t": T, "theta": RUN["theta"]})
    monkeypatch.setattr(matlab_tables, "_PROGRAM", "import os; os.abort()")
    table = read_table(data, "run.mat")
    assert table.names == ("t", "theta")
    assert "run (MATLAB's table)" in table.findings[0].message
