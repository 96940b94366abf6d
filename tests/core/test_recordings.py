"""Recordings read from CSV and .mat: dialects, names, units, signs, and errors that name row and column."""

from __future__ import annotations

import io

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.io import savemat

from heli2dof_core.errors import Heli2DofError, InvalidInputError, RecordingError
from heli2dof_core.recording_files import read_table, write_csv
from heli2dof_core.recordings import Columns, Table, guess_columns, recording_of

T = 0.002 * np.arange(50)
DATA = {
    "time": T,
    "theta": 0.1 * np.sin(T),
    "psi": 0.2 * np.cos(T),
    "V_p": 12 + np.sin(5 * T),
    "V_y": -3 + np.cos(5 * T),
    "theta_ref": np.full(50, 0.1),
    "psi_ref": np.zeros(50),
}
ROLES = {name: name for name in DATA}


def csv_of(separator=",", comma=False, header=True):
    lines = [separator.join(DATA)] if header else []
    for row in zip(*DATA.values(), strict=True):
        cells = [repr(float(v)) for v in row]
        lines.append(separator.join(c.replace(".", ",") if comma else c for c in cells))
    return "\n".join(lines)


@pytest.mark.parametrize(
    "data",
    [
        csv_of().encode(),
        csv_of(";").encode("utf-8-sig"),
        csv_of(";", comma=True).encode(),
        csv_of("\t").encode("utf-16"),
        csv_of("   ").encode(),
        ("# made in a laboratory\n% on a Monday\n\n" + csv_of().replace("\n", "\r\n")).encode(),
        csv_of().replace("time", '"time"').encode(),
        "\n".join(line + "," for line in csv_of().splitlines()).replace("psi_ref,", "psi_ref", 1).encode(),
    ],
)
def test_csv_in_its_dialects(data):
    table = read_table(data, "run.csv")
    assert table.names == tuple(DATA)
    np.testing.assert_array_equal(table.values, np.column_stack(list(DATA.values())))
    assert guess_columns(table) == Columns(ROLES)


def test_csv_without_names():
    table = read_table(csv_of(header=False).encode())
    assert table.names[:2] == ("column 1", "column 2")
    assert table.values.shape == (50, 7)
    assert guess_columns(table).names == {}


def test_what_is_written_is_read():
    table = read_table(write_csv(DATA, ("a remark, with a comma",)))
    np.testing.assert_allclose(table.values, np.column_stack(list(DATA.values())), rtol=1e-8)
    assert table.first_row == 3


def mat_of(content, **how):
    file = io.BytesIO()
    savemat(file, content, **how)
    return file.getvalue()


@pytest.mark.parametrize("compressed", [True, False])
def test_mat_with_vectors_structs_and_matrices(compressed):
    columns = {name: values[:, None] for name, values in DATA.items()}
    table = read_table(mat_of(columns, do_compression=compressed))
    assert guess_columns(table) == Columns(ROLES)
    table = read_table(mat_of({"log": np.array(list(DATA.values())), "gain": 3.0}, do_compression=compressed))
    assert table.names == tuple(f"log({i})" for i in range(1, 8))
    signals = [{"values": DATA["theta"], "label": "theta"}, {"values": DATA["psi"], "label": "psi"}]
    table = read_table(mat_of({"out": {"time": T, "signals": signals}}, do_compression=compressed))
    assert table.names == ("out.time", "theta", "psi")
    np.testing.assert_array_equal(table.values[:, 2], DATA["psi"])


@pytest.mark.parametrize(
    ("data", "words"),
    [
        (b"", "empty"),
        (b"\n# nothing\n", "no rows"),
        (csv_of().replace("0.1,0.0", "0.1,abc", 1).encode(), "row 2, column 'psi_ref' holds 'abc'"),
        ((csv_of() + "\n1,2,3").encode(), "row 52 has 3 cells"),
        (b"\0\1\2\3" * 20, "no text"),
        (b"a,b\n" * 3 + b"1,2\n", "row 2, column 'a' holds 'a'"),
        (b"\x89HDF\r\n" + bytes(100), "7.3"),
        (b"MATLAB 5.0 MAT-file" + bytes(400), "damaged"),
        (mat_of({"x": DATA["theta"]})[:300], "damaged"),
        (mat_of({"name": "a text"}), "no columns"),
        (mat_of({"x": np.zeros(20_000_000)}, do_compression=True), "too large when unpacked"),
        (b"1\n" * 300_001, "too many"),
    ],
    ids=lambda value: value if isinstance(value, str) else "file",  # MATLAB's files hold the time of writing
)
def test_malformed_files_name_the_place(data, words):
    with pytest.raises(RecordingError, match=words.replace("(", r"\(")):
        read_table(data)


@given(
    st.binary(max_size=300),
    st.sampled_from([b"", b"MATLAB 5.0 MAT-file" + bytes(105) + b"\0\1IM", b"a,b\n1,2\n"]),
)
def test_no_bytes_raise_anything_else(data, head):
    try:
        assert read_table(head + data).values.ndim == 2
    except Heli2DofError as error:
        assert error.field == "file"


def table_of(**changes):
    columns = {**DATA, **changes}
    return Table(tuple(columns), np.column_stack(list(columns.values())), 2)


def test_units_signs_and_offsets():
    degrees = {name: np.degrees(DATA[name]) for name in ("theta", "psi", "theta_ref", "psi_ref")}
    table = table_of(
        **{**degrees, "theta": -degrees["theta"] + 40.5, "theta_ref": -degrees["theta_ref"] + 40.5}
    )
    own = recording_of(table, Columns(ROLES, "deg", (-1, 1), (40.5, 0.0)))
    np.testing.assert_allclose(own.angles, np.column_stack([DATA["theta"], DATA["psi"]]), atol=1e-14)
    np.testing.assert_allclose(
        own.references, np.column_stack([DATA["theta_ref"], DATA["psi_ref"]]), atol=1e-14
    )
    assert own.sample_time == pytest.approx(0.002)
    assert own.findings == ()


@pytest.mark.parametrize(
    ("changes", "field", "words"),
    [
        ({"theta": np.where(T[7] == T, np.nan, 0.1)}, "columns.theta", "row 9, column 'theta'"),
        ({"time": np.where(T[30] == T, 0.0, T)}, "columns.time", "row 32, column 'time' does not come after"),
        ({"V_p": np.where(T[0] == T, 1e9, 0.0)}, "columns.V_p", "row 2, column 'V_p' is beyond"),
    ],
)
def test_bad_rows_are_named(changes, field, words):
    with pytest.raises(RecordingError, match=words) as caught:
        recording_of(table_of(**changes), Columns(ROLES))
    assert caught.value.field == field


def test_bad_mappings_are_named():
    for columns, field in (
        ({**ROLES, "psi": "yaw"}, "columns.psi"),
        ({k: v for k, v in ROLES.items() if k != "V_y"}, "columns.V_y"),
        ({k: v for k, v in ROLES.items() if k != "time"}, "columns.time"),
    ):
        with pytest.raises(RecordingError) as caught:
            recording_of(table_of(), Columns(columns))
        assert caught.value.field == field
    timed = recording_of(table_of(), Columns({**ROLES, "time": ""}, sample_time=0.01))
    assert timed.t[-1] == pytest.approx(0.49)
    with pytest.raises(RecordingError, match="few"):
        recording_of(Table(tuple(DATA), np.zeros((5, 7))), Columns(ROLES))
    with pytest.raises(InvalidInputError):
        Columns(ROLES, unit="grad")  # pyright: ignore[reportArgumentType]
    with pytest.raises(RecordingError):
        Columns(ROLES, signs=(0, 1))


def test_oddities_are_told():
    jumpy = T + np.where(np.arange(50) > 20, 0.05, 0.0)
    codes = {f.code for f in recording_of(table_of(time=jumpy, V_y=np.zeros(50)), Columns(ROLES)).findings}
    assert codes == {"irregular_samples", "yaw_not_excited"}


@pytest.mark.parametrize(
    ("names", "unit"),
    [
        (("t", "θ [deg]", "ψ [deg]", "Vp", "Vy", "r_theta", "r_psi"), "deg"),
        (("Time (s)", "pitch_rad", "yaw_rad", "u_p", "u_y", "pitch_ref", "yaw_des"), "rad"),
        (("time", "theta", "psi", "Vm_p", "Vm_y", "theta_d", "psi_d"), "deg"),
    ],
)
def test_columns_are_guessed(names, unit):
    values = np.full((30, 7), 20.0 if unit == "deg" else 0.3)
    guess = guess_columns(Table(names, values))
    assert guess.names == dict(zip(ROLES, names, strict=True))
    assert guess.unit == unit


def test_angles_and_voltages_are_needed_and_references_are_not():
    """Each of the four left out is named; without the references the recording is the same, and has none."""
    table = read_table(csv_of().encode(), "run.csv")
    needed = {name: ROLES[name] for name in ("time", "theta", "psi", "V_p", "V_y")}
    bare = recording_of(table, Columns(names=needed))
    assert bare.references is None
    np.testing.assert_array_equal(bare.angles, recording_of(table, Columns(names=ROLES)).angles)
    for name in ("theta", "psi", "V_p", "V_y"):
        with pytest.raises(RecordingError) as caught:
            recording_of(table, Columns(names={**ROLES, name: ""}))
        assert caught.value.field == f"columns.{name}"
