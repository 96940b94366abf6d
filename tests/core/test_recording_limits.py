"""What a recording's file may cost: limits hold before anything is unpacked, whatever its headers claim."""

from __future__ import annotations

import gzip
import io
import struct
import time
import tracemalloc
import zipfile
import zlib

import h5py
import numpy as np
import openpyxl
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.io import savemat

from heli2dof_core.errors import CancelledError, Heli2DofError, RecordingError
from heli2dof_core.recording_files import MOST_BYTES, read_table

HEAD = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
OCTAVE = b"# Created by Octave\n# name: t\n# type: "
ZEROS = zlib.compress(bytes(300 * 2**20))


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
    out.create_dataset("x", (100,), "u1", external=[("/etc/hostname", 0, 100)])
    out["y"] = h5py.ExternalLink("/etc/hostname", "/")
    out["z"] = h5py.SoftLink("/x")


def circle(out):
    out.create_group("a/b")
    out["a/b/c"] = out["a"]


BOMBS = {
    "compressed .mat": HEAD + element(15, ZEROS)[: 8 + len(ZEROS)],
    "compressed .mat with other words in its head": b"MAT-file v.5".ljust(124)
    + HEAD[124:]
    + struct.pack("<II", 15, len(ZEROS))
    + ZEROS,
    "compressed .mat of a real matrix": mat({"x": np.zeros(20_000_000)}, do_compression=True),
    "a matrix that claims much": HEAD + matrix(6, (30000, 30000), element(9, bytes(64))),
    "cells without end": HEAD + matrix(1, (2**15, 2**15)),
    "structures without fields": HEAD
    + matrix(2, (2**15, 2**15), element(5, struct.pack("<i", 32)) + element(1, b"")),
    "nested without end": HEAD + element(14, b"".join(struct.pack("<II", 14, 2**20) for _ in range(1000))),
    "version 4 that claims much": struct.pack("<5i", 0, 20000, 20000, 0, 2) + b"x\0" + bytes(100),
    "HDF5 that claims much": hdf5(
        lambda out: out.create_dataset("x", (20000, 20000), "f8", chunks=True, compression="gzip")
    ),
    "HDF5 of another file's bytes": hdf5(outside),
    "HDF5 in a circle": hdf5(circle),
    "Octave's range without end": OCTAVE + b"range\n# base, limit, increment\n0 1e15 1\n",
    "Octave's matrix without rows": OCTAVE + b"matrix\n# rows: 100000000\n# columns: 9\n 1\n",
    "spreadsheet": zipped({"xl/workbook.xml": bytes(200 * 2**20)}),
    "spreadsheet with entities": zipped({"xl/workbook.xml": '<!DOCTYPE a [<!ENTITY b "bb">]><a>&b;</a>'}),
    "another archive": zipped({"run.csv": "1,2"}),
    "packed twice": gzip.compress(gzip.compress(b"1,2\n3,4\n")),
    "packed": gzip.compress(bytes(40 * 2**20)),
    "a file that is too large": bytes(MOST_BYTES + 1),
    "JSON nested without end": b"[{" + b'"a":[' * 100_000,
    "many columns": ",".join(["1"] * 5000).encode(),
}


@pytest.mark.parametrize("name", BOMBS)
def test_what_would_fill_the_memory_is_refused_at_once(name):
    tracemalloc.start()
    began = time.process_time()
    try:
        with pytest.raises(RecordingError) as caught:
            read_table(BOMBS[name], "run.mat" if "mat" in name else "run")
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert caught.value.hint
    assert peak < 300 * 2**20
    assert time.process_time() - began < 20


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
    began = time.process_time()
    assert read_table(file.getvalue()).values.shape[0] >= 30
    assert time.process_time() - began < 10


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


@pytest.mark.parametrize("kind", REAL)
@settings(max_examples=60, deadline=None)
@given(st.data())
def test_damaged_files_are_refused_and_nothing_else_happens(kind, data):
    """Real files with bytes changed, cut off or doubled."""
    content = bytearray(REAL[kind])
    for _ in range(data.draw(st.integers(1, 6))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    cut = data.draw(st.integers(1, len(content)))
    for own in (bytes(content), bytes(content[:cut]), bytes(content + content[:cut])):
        try:
            assert read_table(own, "run").values.ndim == 2
        except Heli2DofError as error:
            assert error.field == "file"
            assert error.hint


@pytest.mark.parametrize("kind", REAL)
def test_reading_ends_where_nobody_waits(kind):
    def leave():
        raise CancelledError("called off")

    with pytest.raises(CancelledError):
        read_table(REAL[kind], "run", wanted=leave)
