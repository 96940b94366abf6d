"""What is kept of a study: a folder with one Parquet file for each part, each whole or not there at all."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from ..measured import MEASURED
from ..version import package_version
from .part import Part
from .problems import StudyError
from .study import Study

ABOUT = "study.json"
PARTS = "parts"
_FIXED = ("design", "rig", "exists", "stable")


class Folder:
    """A study's folder; made where there is none.

    Args:
        path: of the folder.
        study: whose numbers are kept there.

    Raises:
        StudyError: another study's numbers, or another version's, are there, or pyarrow is not installed.
    """

    def __init__(self, path: Path, study: Study) -> None:
        _arrow()
        self.path, self.study = path, study
        self._parts = path / PARTS
        own = {"fingerprint": study.fingerprint, "heli2dof": package_version(), "study": study.told}
        known = self._about()
        if known is None:
            if path.exists() and (not path.is_dir() or any(path.iterdir())):
                raise StudyError(f"{path} holds something else", hint="Name another folder.")
            self._parts.mkdir(parents=True, exist_ok=True)
            _write_whole(path / ABOUT, json.dumps(own, indent=1).encode())
        elif known.get("fingerprint") != study.fingerprint:
            raise StudyError(
                f"{path} holds the numbers of another study",
                hint="The file has been changed since. Name another folder, or delete this one.",
            )
        elif known.get("heli2dof") != own["heli2dof"]:
            raise StudyError(
                f"{path} was begun by heli2dof {known.get('heli2dof')}, and this is {own['heli2dof']}",
                hint="Go on with that version, or name another folder.",
            )
        self._parts.mkdir(exist_ok=True)

    def _about(self) -> dict[str, Any] | None:
        try:
            known = json.loads((self.path / ABOUT).read_text(encoding="utf-8"))
        except (FileNotFoundError, NotADirectoryError):
            return None
        except (OSError, ValueError) as error:
            raise StudyError(f"{self.path / ABOUT} cannot be read: {error}") from None
        return known if isinstance(known, dict) else {}

    @contextmanager
    def alone(self) -> Iterator[None]:
        """Keeps other processes from computing the same study into it; a process that dies lets go.

        Raises:
            StudyError: another one does.
        """
        try:
            from fcntl import LOCK_EX, LOCK_NB, flock
        except ImportError:  # Windows: whole files make two of them merely wasteful
            yield
            return
        with (self.path / "lock").open("w") as lock:
            try:
                flock(lock, LOCK_EX | LOCK_NB)
            except OSError:
                raise StudyError(
                    f"another process computes in {self.path}", hint="Wait until it has ended, or stop it."
                ) from None
            yield

    def file(self, number: int) -> Path:
        """Of a part."""
        return self._parts / f"part-{number:07d}.parquet"

    def done(self) -> set[int]:
        """Parts that are there."""
        found = set()
        for file in self._parts.glob("part-*.parquet"):
            digits = file.stem.removeprefix("part-")
            if digits.isdecimal() and int(digits) < self.study.parts:
                found.add(int(digits))
        return found

    def write(self, part: Part) -> None:
        """Keeps a part; once this has returned, it outlives a loss of power."""
        pa, parquet = _arrow()
        arrays = [pa.array(getattr(part, name)) for name in _FIXED]
        fields = [pa.field(name, own.type, nullable=False) for name, own in zip(_FIXED, arrays, strict=True)]
        for column, measure, values in zip(
            self.study.columns, self.study.measures, part.values.T, strict=True
        ):
            arrays.append(pa.array(values, mask=np.isnan(values)))
            figure = MEASURED[measure.name]
            about = {"unit": figure.figure.unit, "words": figure.words(measure.where)}
            fields.append(pa.field(column, pa.float64(), metadata=about))
        about = {"study": self.study.title, "fingerprint": self.study.fingerprint}
        table = pa.Table.from_arrays(arrays, schema=pa.schema(fields, metadata=about))
        sink = pa.BufferOutputStream()
        parquet.write_table(table, sink, compression="zstd")
        _write_whole(self.file(part.number), sink.getvalue())

    def read(self, number: int) -> Part:
        """A part that is there.

        Raises:
            StudyError: its file is damaged, or of something else.
        """
        pa, parquet = _arrow()
        file = self.file(number)
        try:
            table = parquet.read_table(file, columns=[*_FIXED, *self.study.columns])
            columns = [table.column(name).to_numpy() for name in table.column_names]
        except (OSError, pa.ArrowException) as error:
            raise StudyError(
                f"{file} cannot be read: {error}",
                hint="Delete it and start the study again: only it is missing then.",
            ) from None
        if table.num_rows != self.study.size(number) or len(columns) != len(_FIXED) + len(self.study.columns):
            raise StudyError(f"{file} is not of this study", hint="Delete it and start the study again.")
        values = (
            np.column_stack(columns[len(_FIXED) :]) if self.study.columns else np.empty((table.num_rows, 0))
        )
        design, rig, exists, stable = columns[: len(_FIXED)]
        return Part(number, design, rig, exists, stable, values)


def _write_whole(path: Path, data: Any) -> None:
    """A file that is there whole or not at all, whatever happens meanwhile."""
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    with beside.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())
    beside.replace(path)


def _arrow() -> Any:
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError:
        raise StudyError(
            "studies are kept as Parquet, and pyarrow is not installed",
            hint="Install it: pip install 'heli2dof[study]'.",
        ) from None
    return pyarrow, parquet
