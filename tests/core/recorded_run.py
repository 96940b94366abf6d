"""One run that every tool writes, and the check that it is what was read."""

from __future__ import annotations

import numpy as np
import pandas as pd

from heli2dof_core.recordings.guess import guess_columns
from heli2dof_core.recordings.recording import recording_of

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
