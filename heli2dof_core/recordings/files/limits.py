"""What a file may hold at most, and how a file is refused."""

from __future__ import annotations

from ...errors import RecordingError

MOST_BYTES = 32 * 2**20
MOST_UNPACKED = 128 * 2**20
"""Bytes of a file's variables after decompression."""
MOST_ROWS = 300_000
MOST_COLUMNS = 64
MOST_VARIABLES = 10_000
DEEPEST = 8
"""Structures within structures that are followed."""


def refused(words: str, value: object = None, hint: str = "") -> RecordingError:
    """The error of a file that cannot be read."""
    return RecordingError(words, field="file", value=value, hint=hint)


def check_size(rows: int, columns: int) -> None:
    """Raises RecordingError where there are too many."""
    if rows > MOST_ROWS:
        raise refused(
            f"{rows} rows are too many",
            rows,
            f"At most {MOST_ROWS} are read: cut the file where it is of interest, or record at a lower rate. If you "
            "thin rows out, average the voltages over those that are dropped.",
        )
    if columns > MOST_COLUMNS:
        raise refused(
            f"{columns} columns are too many",
            columns,
            f"At most {MOST_COLUMNS} are read: keep time, both angles, both voltages and the references.",
        )


def check_unpacked(size: float, name: str = "") -> None:
    """Raises RecordingError where that many bytes are too many."""
    if size > MOST_UNPACKED:
        raise refused(
            "the file is too large when unpacked",
            name,
            f"At most {MOST_UNPACKED // 2**20} MiB: save only the variables of the recording.",
        )
