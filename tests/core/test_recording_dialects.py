"""Recordings as real tools write them: GNU Octave, SciPy, h5py, pandas, csv, openpyxl, and MATLAB's documented text forms.

Every file holds the same run; what is read must be it, with the units that the tool wrote, or be refused with a way out.
"""

from __future__ import annotations

import csv
import gzip
import io
import json
import shutil
import subprocess
from datetime import datetime, timedelta

import h5py
import numpy as np
import openpyxl
import pandas as pd
import pytest
from scipy.io import savemat

from heli2dof_core.errors import RecordingError
from heli2dof_core.recording_files import Dialect, joined_tables, read_table
from heli2dof_core.recording_files.opened import read_recording
from heli2dof_core.recording_guess import guess_columns
from heli2dof_core.recordings import recording_of

N, STEP = 60, 0.01
T = STEP * np.arange(N)
RUN = {
    "time": T,
    "theta": 0.2 * np.sin(3 * T),
    "psi": 0.3 * np.cos(2 * T),
    "V_p": 12.5 + np.sin(5 * T),
    "V_y": -3.25 + np.cos(5 * T),
}
DEGREES = {name: np.degrees(values) if name in ("theta", "psi") else values for name, values in RUN.items()}
FRAME = pd.DataFrame(RUN)
WRITTEN: dict[str, tuple[str, bytes]] = {}


def is_the_run(table, tolerance=1e-6):
    recording = recording_of(table, guess_columns(table))
    assert len(recording.t) == N
    np.testing.assert_allclose(recording.t, T, atol=1e-6)
    np.testing.assert_allclose(recording.angles, np.column_stack([RUN["theta"], RUN["psi"]]), atol=tolerance)
    np.testing.assert_allclose(
        recording.voltages, np.column_stack([RUN["V_p"], RUN["V_y"]]), atol=max(tolerance, 1e-6)
    )
    return recording


def rows_of(columns):
    return [list(map(float, row)) for row in zip(*columns.values(), strict=True)]


def written_by_csv(columns, header, **how):
    out = io.StringIO()
    writer = csv.writer(out, **how)
    for line in header:
        writer.writerow(line)
    writer.writerows(rows_of(columns))
    return out.getvalue().encode()


def saved_text(columns, **how):
    out = io.StringIO()
    np.savetxt(out, np.column_stack(list(columns.values())), **how)
    return out.getvalue().encode()


def with_commas(data: bytes) -> bytes:
    return data.replace(b".", b",")


def lines(head, form, columns=RUN):
    return "\n".join([*head, *(form(k, *row) for k, row in enumerate(rows_of(columns)))]).encode()


def to_csv(frame=FRAME, **how):
    return frame.to_csv(**how).encode(how.get("encoding") or "utf-8")


TEXTS = {
    "pandas with its index": to_csv(),
    "pandas, German": to_csv(index=False, sep=";", decimal=","),
    "pandas, tab, UTF-16": FRAME.to_csv(index=False, sep="\t").encode("utf-16"),
    "pandas, quoted decimal commas": to_csv(index=False, decimal=",", quoting=csv.QUOTE_ALL),
    "pandas, time stamps": to_csv(FRAME.assign(time=pd.to_datetime(1.7e9 + T, unit="s").round("ms")), index=False),
    "pandas, time deltas": to_csv(FRAME.assign(time=pd.to_timedelta(T, unit="s")), index=False),
    "pandas, epoch in ns": to_csv(FRAME.assign(time=(1.7e9 * 1e9 + np.round(T * 1e9)).astype(np.int64)), index=False),
    "pandas, packed": gzip.compress(to_csv(index=False)),
    "csv, Excel's units in names": written_by_csv(
        DEGREES, [["Time (s)", "Pitch (deg)", "Yaw (deg)", "Vp (V)", "Vy (V)"]]
    ),
    "csv, a row of units": written_by_csv(
        {**DEGREES, "time": 1e3 * T}, [["time", "theta", "psi", "V_p", "V_y"], ["ms", "deg", "deg", "V", "V"]], delimiter=";"
    ),
    "csv, quoted, tabs": written_by_csv(RUN, [list(RUN)], delimiter="\t", quoting=csv.QUOTE_ALL),
    "csv, bars": written_by_csv(RUN, [list(RUN)], delimiter="|"),
    "NumPy, blanks, names in its comment": saved_text(RUN, header=" ".join(RUN)),
    "NumPy, names and units in comments": saved_text(DEGREES, header="time,theta,psi,V_p,V_y\ns,deg,deg,V,V", comments="% ", delimiter=","),
    "Excel's sep=": b"sep=;\r\n" + with_commas(to_csv(index=False, sep=";")).replace(b"\n", b"\r\n"),
    "MATLAB's writetimetable": lines(
        ["Time,theta,psi,V_p,V_y"], lambda k, t, *v: f"{t:g} sec," + ",".join(map(repr, v))
    ),
    "MATLAB's writetimetable, duration as hh:mm:ss": lines(
        ["Time,theta,psi,V_p,V_y"], lambda k, t, *v: f"00:00:{t:06.3f}," + ",".join(map(repr, v))
    ),
    "MATLAB's writetable, date and time": lines(
        ["time,theta,psi,V_p,V_y"],
        lambda k, t, *v: (datetime(2024, 5, 1, 12) + timedelta(seconds=t)).strftime("%d-%b-%Y %H:%M:%S.%f")[:-3]
        + "," + ",".join(map(repr, v)),
    ),
    "LabVIEW-like preamble": lines(
        ["Writer_Version\t2", "Operator: somebody", "Date\t2024/05/01", "***End_of_Header***", "time\ttheta\tpsi\tV_p\tV_y"],
        lambda k, *v: "\t".join(map(repr, v)),
    ),
    "Arduino's serial monitor": lines(
        ["millis,pitch_deg,yaw_deg,u_p,u_y"], lambda k, t, *v: f"{4294960000 + round(1e3 * t)}, " + ", ".join(map(repr, v)), DEGREES
    ),
    "R's write.table": lines(
        [" ".join(f'"{name}"' for name in RUN)], lambda k, *v: f'"{k + 1}" ' + " ".join(map(repr, v))
    ),
    "a column of text": lines(
        ["time;state;theta;psi;V_p;V_y"], lambda k, t, *v: f"{t};run;" + ";".join(map(repr, v))
    ),
    "JSON, columns": json.dumps({name: list(values) for name, values in RUN.items()}).encode(),
    "JSON, rows by pandas": FRAME.to_json(orient="records").encode(),
    "JSON lines by pandas": FRAME.to_json(orient="records", lines=True, double_precision=12).encode(),
}  # fmt: skip


@pytest.mark.parametrize("name", TEXTS)
def test_text_is_read(name):
    is_the_run(read_table(TEXTS[name], "run"))


def test_text_columns_are_named_and_left_out():
    table = read_table(TEXTS["a column of text"])
    assert [f.message for f in table.findings] == ["Left out of the file: state (no numbers)."]


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
        mat({name: np.array([T, RUN[role]]) for name, role in (("pitch", "theta"), ("yaw", "psi"), ("Vp", "V_p"), ("Vy", "V_y"))}),
        "",
    ),
    "structures with time": (
        mat({name: {"time": T[:, None], "signals": {"values": RUN[role][:, None], "label": ""}} for name, role in (("pitch", "theta"), ("yaw", "psi"), ("V_p", "V_p"), ("V_y", "V_y"))}),
        "",
    ),
    "a structure with time and several signals": (
        mat({"simout": {"time": T[:, None], "signals": [{"values": RUN[name][:, None], "label": name} for name in RUN if name != "time"]}}),
        "",
    ),
    "fields of timeseries": (
        mat({name: {"Name": "", "Time": T[:, None], "Data": RUN[name].reshape(1, 1, -1)} for name in RUN if name != "time"}), ""
    ),
    "one row longer": (mat({**VECTORS, "theta": np.append(RUN["theta"], 9.0)[:, None]}), "one_row_longer"),
}  # fmt: skip


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
    """As MATLAB's save(…, '-v7.3') lays it out: 512 bytes of its own, dimensions turned round, classes as attributes."""
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
        {"simout": {"time": T[:, None], "signals": {"values": [RUN[n][:, None] for n in list(RUN)[1:]], "label": list(RUN)[1:]}}},
        {"log": VECTORS, "cells": [T[:3], "text"]},
    ],
    ids=("vectors", "a structure with time and several signals", "a structure beside cells"),
)  # fmt: skip
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
        sheet([["Time (ms)", "Pitch (deg)", "Yaw (deg)", "Vp", "Vy"], *([1e3 * r[0], *r[1:]] for r in rows_of(DEGREES))]),
        sheet([["Recorded by me"], [], [None, *RUN], [None, "s", "rad", "rad", "V", "V"], *([None, *row] for row in rows_of(RUN))], "about"),
        sheet([list(RUN), *([datetime(2024, 5, 1) + timedelta(seconds=r[0]), *r[1:]] for r in rows_of(RUN))]),
    ],
    ids=("pandas", "units in names", "a title, shifted, units in a row, two sheets", "dates"),
)  # fmt: skip
def test_spreadsheets_are_read(data):
    is_the_run(read_table(data, "run.xlsx"), 2e-6)


def test_one_signal_per_file_is_joined(tmp_path):
    """Names by the files; each with its own times, of which the finest counts."""
    tables = []
    for name, role in (("pitch", "theta"), ("yaw", "psi"), ("Vp", "V_p"), ("Vy", "V_y")):
        own = slice(None, None, 2) if role == "psi" else slice(None)
        path = tmp_path / f"{name}.csv"
        path.write_bytes(to_csv(pd.DataFrame({"time": 1e3 * T[own], "value": RUN[role][own]}), index=False))
        tables.append((path.name, read_table(path.read_bytes(), path.name)))
    joined = joined_tables(tables)
    assert joined.names == ("time", "pitch", "yaw", "Vp", "Vy")
    assert [f.code for f in joined.findings] == ["joined_times"]
    recording = read_recording(*(tmp_path / name for name, _ in tables))
    np.testing.assert_allclose(recording.t, T[:59], atol=1e-9)
    np.testing.assert_allclose(recording.angles[:, 1], RUN["psi"][:59], atol=1e-4)
    np.testing.assert_allclose(recording.voltages[:, 0], RUN["V_p"][:59], atol=1e-12)
    untimed = [
        (name, read_table(b"\n".join(b"%.6f" % v for v in RUN[role])))
        for name, role in (("pitch", "theta"), ("yaw", "psi"))
    ]
    assert joined_tables(untimed).names == ("pitch", "yaw")
    with pytest.raises(RecordingError, match="equally many"):
        joined_tables([untimed[0], ("Vp.txt", read_table(b"1\n2\n3\n"))])


@pytest.mark.parametrize(
    ("data", "words", "hint"),
    [
        (b"time,theta\n" + b"0,5,1,2\n" * 30, "row 2 has 4 values, the header 2 .separator taken: comma", "semicolons"),
        (b"\xd0\xcf\x11\xe0" + bytes(100), "old kind", ".xlsx"),
        (b"<!DOCTYPE html><html>", "web page", "csv"),
        (b"PK\x03\x04" + bytes(60), "spreadsheet is damaged", "CSV"),
        (b"\x93NUMPY" + bytes(40), "NumPy", "savetxt"),
        (b'{"a": [1, 2', "no JSON", "CSV"),
        (b'{"a": "text"}', "no columns of numbers", "vectors"),
        (b"x = 1;\nfor k = 1:3\n  disp(k)\nend\ny = [1, 2\n 3, 4];\n" * 5, "lines are rows of numbers|no rows", "Give"),
    ],
    ids=range(8),
)  # fmt: skip
def test_what_cannot_be_read_says_what_to_do(data, words, hint):
    with pytest.raises(RecordingError, match=words) as caught:
        read_table(data, "run")
    assert caught.value.hint
    assert hint in caught.value.hint


def test_the_user_may_say_how_text_is_split():
    data = b"1,5 2,5\n2,5 3,5\n" * 15
    assert read_table(data).values[0].tolist() == [1.5, 2.5]
    assert read_table(data, dialect=Dialect("blank", "comma")).values[1].tolist() == [2.5, 3.5]
    odd = b"1,2;3\n" * 30
    assert read_table(odd, dialect=Dialect("semicolon", "comma")).values[0].tolist() == [1.2, 3.0]
    with pytest.raises(RecordingError) as caught:
        Dialect("slash")  # pyright: ignore[reportArgumentType]
    assert caught.value.field == "separator"
