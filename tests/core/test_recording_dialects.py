"""Recordings as text that real tools write: pandas, csv, NumPy, and the documented forms of MATLAB and others."""

from __future__ import annotations

import csv
import gzip
import io
import json
from datetime import datetime, timedelta

import numpy as np
import pandas as pd
import pytest

from heli2dof_core.errors import RecordingError
from heli2dof_core.recordings.files import Dialect, joined_tables, read_table
from heli2dof_core.recordings.files.opened import read_recording
from tests.core.recorded_run import DEGREES, FRAME, RUN, T, is_the_run, rows_of


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
    "pandas, time stamps": to_csv(
        FRAME.assign(time=pd.to_datetime(1.7e9 + T, unit="s").round("ms")), index=False
    ),
    "pandas, time deltas": to_csv(FRAME.assign(time=pd.to_timedelta(T, unit="s")), index=False),
    "pandas, epoch in ns": to_csv(
        FRAME.assign(time=(1.7e9 * 1e9 + np.round(T * 1e9)).astype(np.int64)), index=False
    ),
    "pandas, packed": gzip.compress(to_csv(index=False)),
    "csv, Excel's units in names": written_by_csv(
        DEGREES, [["Time (s)", "Pitch (deg)", "Yaw (deg)", "Vp (V)", "Vy (V)"]]
    ),
    "csv, a row of units": written_by_csv(
        {**DEGREES, "time": 1e3 * T},
        [["time", "theta", "psi", "V_p", "V_y"], ["ms", "deg", "deg", "V", "V"]],
        delimiter=";",
    ),
    "csv, quoted, tabs": written_by_csv(RUN, [list(RUN)], delimiter="\t", quoting=csv.QUOTE_ALL),
    "csv, bars": written_by_csv(RUN, [list(RUN)], delimiter="|"),
    "NumPy, blanks, names in its comment": saved_text(RUN, header=" ".join(RUN)),
    "NumPy, names and units in comments": saved_text(
        DEGREES, header="time,theta,psi,V_p,V_y\ns,deg,deg,V,V", comments="% ", delimiter=","
    ),
    "Excel's sep=": b"sep=;\r\n" + with_commas(to_csv(index=False, sep=";")).replace(b"\n", b"\r\n"),
    "MATLAB's writetimetable": lines(
        ["Time,theta,psi,V_p,V_y"], lambda k, t, *v: f"{t:g} sec," + ",".join(map(repr, v))
    ),
    "MATLAB's writetimetable, duration as hh:mm:ss": lines(
        ["Time,theta,psi,V_p,V_y"], lambda k, t, *v: f"00:00:{t:06.3f}," + ",".join(map(repr, v))
    ),
    "MATLAB's writetable, date and time": lines(
        ["time,theta,psi,V_p,V_y"],
        lambda k, t, *v: (
            (datetime(2024, 5, 1, 12) + timedelta(seconds=t)).strftime("%d-%b-%Y %H:%M:%S.%f")[:-3]
            + ","
            + ",".join(map(repr, v))
        ),
    ),
    "LabVIEW-like preamble": lines(
        [
            "Writer_Version\t2",
            "Operator: somebody",
            "Date\t2024/05/01",
            "***End_of_Header***",
            "time\ttheta\tpsi\tV_p\tV_y",
        ],
        lambda k, *v: "\t".join(map(repr, v)),
    ),
    "Arduino's serial monitor": lines(
        ["millis,pitch_deg,yaw_deg,u_p,u_y"],
        lambda k, t, *v: f"{4294960000 + round(1e3 * t)}, " + ", ".join(map(repr, v)),
        DEGREES,
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
}


@pytest.mark.parametrize("name", TEXTS)
def test_text_is_read(name):
    is_the_run(read_table(TEXTS[name], "run"))


def test_text_columns_are_named_and_left_out():
    table = read_table(TEXTS["a column of text"])
    assert [f.message for f in table.findings] == ["Left out of the file: state (no numbers)."]


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
        (
            b"time,theta\n" + b"0,5,1,2\n" * 30,
            "row 2 has 4 values, the header 2 .separator taken: comma",
            "semicolons",
        ),
        (b"\xd0\xcf\x11\xe0" + bytes(100), "old kind", ".xlsx"),
        (b"<!DOCTYPE html><html>", "web page", "csv"),
        (b"PK\x03\x04" + bytes(60), "spreadsheet is damaged", "CSV"),
        (b"\x93NUMPY" + bytes(40), "NumPy", "savetxt"),
        (b'{"a": [1, 2', "no JSON", "CSV"),
        (b'{"a": "text"}', "no columns of numbers", "vectors"),
        (
            b"x = 1;\nfor k = 1:3\n  disp(k)\nend\ny = (1);\nz = 2;\n" * 5,
            "no rows of numbers",
            "time",
        ),
    ],
    ids=range(8),
)
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
