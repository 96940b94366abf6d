"""What a recording's file may cost: limits hold before anything is unpacked, whatever its headers claim."""

from __future__ import annotations

import gzip
import io
import struct
import tracemalloc
import zipfile
import zlib
from functools import cache

import h5py
import numpy as np
import openpyxl
import pytest
from scipy.io import savemat

from heli2dof_core.errors import CancelledError, RecordingError
from heli2dof_core.recordings.files import MOST_BYTES, read_table

HEAD = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
OCTAVE = b"# Created by Octave\n# name: t\n# type: "


def mat(content, **how):
    file = io.BytesIO()
    savemat(file, content, **how)
    return file.getvalue()


def element(kind, data):
    return struct.pack("<II", kind, len(data)) + data + bytes(-len(data) % 8)


def matrix(kind, shape, rest=b"", name=b"x"):
    flags = element(6, struct.pack("<II", kind, 0))
    return element(14, flags + element(5, struct.pack(f"<{len(shape)}i", *shape)) + element(1, name) + rest)


def hdf5(fill):
    file = io.BytesIO()
    with h5py.File(file, "w") as out:
        fill(out)
    return file.getvalue()


def zipped(parts):
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as out:
        for name, data in parts.items():
            out.writestr(name, data)
    return file.getvalue()


def outside(out):
    out.create_dataset("x", (100,), "u1", external=[("others.bin", 0, 100)])
    out["y"] = h5py.ExternalLink("others.h5", "/")
    out["z"] = h5py.SoftLink("/x")


def circle(out):
    out.create_group("a/b")
    out["a/b/c"] = out["a"]


@cache
def zeros():
    return zlib.compress(bytes(300 * 2**20))


LARGE = {
    "compressed .mat": lambda: HEAD + element(15, zeros())[: 8 + len(zeros())],
    "compressed .mat with other words in its head": lambda: (
        b"MAT-file v.5".ljust(124) + HEAD[124:] + struct.pack("<II", 15, len(zeros())) + zeros()
    ),
    "compressed .mat of a real matrix": lambda: mat({"x": np.zeros(20_000_000)}, do_compression=True),
    "a matrix that claims much": lambda: HEAD + matrix(6, (30000, 30000), element(9, bytes(64))),
    "cells without end": lambda: HEAD + matrix(1, (2**11, 2**11)),
    "structures without fields": lambda: (
        HEAD + matrix(2, (2**11, 2**11), element(5, struct.pack("<i", 32)) + element(1, b""))
    ),
    "nested without end": lambda: (
        HEAD + element(14, b"".join(struct.pack("<II", 14, 2**20) for _ in range(1000)))
    ),
    "more numbers than claimed": lambda: HEAD + matrix(6, (1, 1), element(2, bytes(2**20))),
    "dimensions without end": lambda: HEAD + matrix(6, (1,) * 100_000, element(9, bytes(8))),
    "fields without end": lambda: (
        HEAD + matrix(2, (1, 1), element(5, struct.pack("<i", 1)) + element(1, b"a" * 100_000))
    ),
    "variables without end": lambda: (struct.pack("<5i", 0, 1, 1, 0, 2) + b"x\0" + bytes(8)) * 20_000,
    "version 4 that claims much": lambda: struct.pack("<5i", 0, 20000, 20000, 0, 2) + b"x\0" + bytes(100),
    "HDF5 that claims much": lambda: hdf5(
        lambda out: out.create_dataset("x", (20000, 20000), "f8", chunks=True, compression="gzip")
    ),
    "HDF5 of another file's bytes": lambda: hdf5(outside),
    "HDF5 in a circle": lambda: hdf5(circle),
    "Octave's range without end": lambda: OCTAVE + b"range\n# base, limit, increment\n0 1e15 1\n",
    "Octave's many ranges": lambda: (OCTAVE + b"range\n# base, limit, increment\n0 9e5 1\n") * 30,
    "Octave's lines without end": lambda: OCTAVE + b"matrix\n" + b"1\n" * 2_100_000,
    "HDF5 whose least part claims much": lambda: hdf5(
        lambda out: out.create_dataset(
            "x", (10,), "f8", maxshape=(None,), chunks=(2**26,), compression="gzip"
        )
    ),
    "Octave's matrix without rows": lambda: OCTAVE + b"matrix\n# rows: 100000000\n# columns: 9\n 1\n",
    "spreadsheet": lambda: zipped({"xl/workbook.xml": bytes(200 * 2**20)}),
    "spreadsheet with entities": lambda: zipped(
        {"xl/workbook.xml": '<!DOCTYPE a [<!ENTITY b "bb">]><a>&b;</a>'}
    ),
    "another archive": lambda: zipped({"run.csv": "1,2"}),
    "packed twice": lambda: gzip.compress(gzip.compress(b"1,2\n3,4\n")),
    "packed": lambda: gzip.compress(bytes(40 * 2**20)),
    "a file that is too large": lambda: bytes(MOST_BYTES + 1),
    "JSON nested without end": lambda: b"[{" + b'"a":[' * 100_000,
    "many columns": lambda: ",".join(["1"] * 5000).encode(),
}


@pytest.mark.parametrize("name", LARGE)
def test_what_would_fill_the_memory_is_refused_at_once(name):
    file = LARGE[name]()
    tracemalloc.start()
    try:
        with pytest.raises(RecordingError) as caught:
            read_table(file, "run.mat" if "mat" in name else "run")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert caught.value.hint
    assert peak < 300 * 2**20


def test_no_bytes_of_other_files_are_told():
    with h5py.File(io.BytesIO(hdf5(outside))) as file:
        assert file["x"].external
    with pytest.raises(RecordingError, match=r"x \(stored in another file\), y \(a link\), z \(a link\)"):
        read_table(hdf5(outside))


def test_a_spreadsheets_lone_far_cell_costs_little():
    book = openpyxl.Workbook()
    for k in range(30):
        book.active.append([k, k * 2.5])
    book.active["XFD40"] = 1
    file = io.BytesIO()
    book.save(file)
    rows, columns = read_table(file.getvalue()).values.shape
    assert rows >= 30 and columns <= 64  # not the 16,384 that the sheet spans


REAL = {
    "mat": mat({"t": np.arange(50.0)[:, None], "s": {"a": np.arange(50.0)}}, do_compression=True),
    "mat 5": mat(
        {"t": np.arange(50.0)[:, None], "s": {"a": np.arange(50.0)}, "c": np.array([1, "x"], dtype=object)}
    ),
    "mat 4": mat({"t": np.arange(50.0)[:, None]}, format="4"),
    "hdf5": hdf5(
        lambda out: out.create_dataset("g/x", data=np.arange(50.0), chunks=(10,), compression="gzip")
    ),
    "octave": b"# Created by Octave 7\n# name: t\n# type: matrix\n# rows: 3\n# columns: 1\n 1\n 2\n 3\n\n\n",
    "json": b'{"a": [1, 2, 3], "b": [[1, 2], [3, 4]]}',
    "csv": b"time,theta\n" + b"0.5,1\n" * 9,
}


def refused_or_read(content, name="run.mat"):
    try:
        assert read_table(content, name).values.ndim == 2
    except RecordingError as error:
        assert error.field == "file"
        assert error.hint
        return True
    return False


def damaged(rng, content):
    """With bytes changed, a number overwritten, cut off or doubled."""
    changed = bytearray(content)
    for _ in range(rng.integers(1, 7)):
        changed[rng.integers(len(changed))] = rng.integers(256)
    if rng.random() < 0.5:
        place = 4 * rng.integers(len(changed) // 4)
        changed[place : place + 4] = struct.pack("<i", rng.choice([-1, 0, 1, 14, 2**16, 2**31 - 1]))
    cut = rng.integers(1, len(changed) + 1)
    return bytes((changed, changed[:cut], changed + changed[:cut])[rng.integers(3)])


@pytest.mark.parametrize("kind", [kind for kind in REAL if kind != "hdf5"])
def test_damaged_files_are_refused_and_nothing_else_happens(kind):
    rng = np.random.default_rng(1)
    assert (
        sum(
            refused_or_read(damaged(rng, REAL[kind]), "run.mat" if "mat" in kind else "run")
            for _ in range(300)
        )
        > 10
    )


def test_damage_within_the_packing_is_refused():
    rng = np.random.default_rng(2)
    whole = zlib.decompress(REAL["mat"][136:])
    refusals = 0
    for _ in range(300):
        packed = zlib.compress(damaged(rng, whole))
        refusals += refused_or_read(HEAD + struct.pack("<II", 15, len(packed)) + packed)
    assert refusals > 100


@pytest.mark.parametrize("kept", [8, 20, 96, 500, 0.5, 0.9])
def test_an_hdf5_file_that_is_cut_off_is_refused_with_the_way_out(kept):
    whole = REAL["hdf5"]
    cut = whole[: int(kept * len(whole)) if kept < 1 else kept]
    with pytest.raises(RecordingError, match="HDF5 file is damaged") as caught:
        read_table(cut, "run.mat")
    assert "-v7" in caught.value.hint


@pytest.mark.parametrize("kind", REAL)
def test_reading_ends_where_nobody_waits(kind):
    def leave():
        raise CancelledError("called off")

    with pytest.raises(CancelledError):
        read_table(REAL[kind], "run", wanted=leave)
