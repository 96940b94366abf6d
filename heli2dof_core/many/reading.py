"""From rows that the kernel `run_designs` has filled to figures of merit, as `measured` reads them from a report."""

from __future__ import annotations

from collections.abc import Sequence
from math import atan, inf, nan

import numpy as np
from numpy.typing import NDArray

from ..figures import AXIS, MARGINS
from ..kernels.layout import (
    COURSE,
    DEVIATION,
    DISK_FREQUENCY,
    DISK_MARGIN,
    ENDED,
    MOTOR_METRICS,
    OUT_OF_BOUNDS,
    OUTCOME,
    PEAK_FREQUENCY,
    SENSITIVITY_PEAK,
    SHARE,
)
from ..kernels.update_layout import (
    AIMS,
    ANGLE,
    ASKED,
    BEGINNING,
    CONDITION,
    DONE,
    FOUND_AXES,
    FOUND_COURSES,
    FOUND_FIGURES,
    FOUND_MARGINS,
    FOUND_MOTORS,
    FOUND_OUTCOME,
    FOUND_RUNS,
    FOUND_SENSITIVITY,
    LAG_MARGIN,
    NORM,
    POLE_ERROR,
    POLE_ERROR_BOUND,
    RELATIVE_GAIN,
    SPECTRAL_NORM,
    STABLE,
)
from ..measured import MEASURED, Measured, Where
from ..signals import Floats
from .measure import SHARES, Measure

Truths = NDArray[np.bool_]
Column = tuple[Floats, Truths]
"""Values of all designs, and of which this response is meant."""
_AXES, _MOTORS, _MODELS = ("theta", "psi"), ("V_p", "V_y"), ("linear", "nonlinear")
_OF_MOTOR = ("peak", "effort")
_OF_DESIGN = {
    "norm": NORM,
    "spectral_norm": SPECTRAL_NORM,
    "pole_error": POLE_ERROR,
    "pole_error_bound": POLE_ERROR_BOUND,
    "eigenvector_condition": CONDITION,
    "relative_gain": RELATIVE_GAIN,
}
_OF_SENSITIVITY = {
    "peak": SENSITIVITY_PEAK,
    "peak_frequency": PEAK_FREQUENCY,
    "disk_margin": DISK_MARGIN,
    "disk_frequency": DISK_FREQUENCY,
}


def values_of(measures: Sequence[Measure], rows: Floats, found: Floats, runs: Sequence[str | None]) -> Floats:
    """What was measured, (n, measures): NaN where there is none, ±∞ where it is unlimited, as which is better.

    Args:
        measures: what is asked for.
        rows: the designs' numbers, (n, NUMBERS).
        found: of these, (n, FOUND).
        runs: which experiments there are, in order: None is the scenario, theta and psi an axis alone.
    """
    out = np.empty((len(rows), len(measures)))
    for i, own in enumerate(measures):
        out[:, i] = _read(own, rows, found, runs)
    out[found[:, FOUND_OUTCOME] != DONE] = nan
    return out


def _read(measure: Measure, rows: Floats, found: Floats, runs: Sequence[str | None]) -> Floats:
    if measure.name in SHARES:
        return found[:, SHARES[measure.name]]
    known, where = MEASURED[measure.name], measure.where
    stable = found[:, FOUND_FIGURES + STABLE] != 0.0
    if known.may_have_model:
        columns = _of_responses(known, where, rows, found, runs)
    elif known.of == "margins":
        at, width = FOUND_MARGINS + list(MARGINS).index(known.own), len(MARGINS)
        columns = [(found[:, at + width * motor], stable) for motor in _motors(where)]
    elif known.of == "sensitivity":
        columns = [(_of_sensitivity(known.own, found), stable)]
    elif known.of == "loop":
        columns = [(found[:, FOUND_FIGURES + LAG_MARGIN], stable)]
    else:
        aims = rows[:, AIMS] != 0.0
        there = aims if known.own.startswith("pole_error") else np.ones(len(rows), dtype=bool)
        columns = [(found[:, FOUND_FIGURES + _OF_DESIGN[known.own]], there)]
    return _worse(known, columns)


def _of_responses(
    known: Measured, where: Where, rows: Floats, found: Floats, runs: Sequence[str | None]
) -> list[Column]:
    """A figure of each response that is meant; a response that was given up has none."""
    model = _MODELS.index(where.model)
    moves = [_moves(axis, rows) for axis in range(2)]
    every = np.ones(len(rows), dtype=bool)
    axes = (_AXES.index(where.axis),) if where.axis in _AXES else (0, 1)
    together, columns = where.steps == "together", list[Column]()
    for axis in (None,) if together and known.of == "motor" else axes:
        run = (
            runs.index(None) if together else runs.index(_AXES[axis or 0]) if _AXES[axis or 0] in runs else -1
        )
        if run < 0:
            columns.append((np.full(len(rows), nan), ~every))  # no design's is stepped
            continue
        stepped = every if axis is None else moves[axis]
        n = 2 * run + model
        course = found[:, FOUND_COURSES + n * COURSE : FOUND_COURSES + (n + 1) * COURSE]
        whole = (course[:, OUTCOME] == ENDED) | (course[:, OUTCOME] == OUT_OF_BOUNDS)
        whole &= run < found[:, FOUND_RUNS]
        if known.of == "axis":
            at = FOUND_AXES + (2 * n + (axis or 0)) * len(AXIS) + list(AXIS).index(known.own)
            own = [found[:, at]]
        elif known.of == "step":
            own = [course[:, DEVIATION + 1 - (axis or 0)]]
            whole &= ~_starts_away(1 - (axis or 0), rows)
        elif known.own == "saturated":
            own = [course[:, SHARE + m] if model else np.zeros(len(rows)) for m in _motors(where)]
        else:
            at = FOUND_MOTORS + 2 * n * MOTOR_METRICS + _OF_MOTOR.index(known.own)
            own = [found[:, at + m * MOTOR_METRICS] for m in _motors(where)]
        columns += [(np.where(whole, values, nan), stepped) for values in own]
    return columns


def _moves(axis: int, rows: Floats) -> Truths:
    """Whether an axis is to go elsewhere than where it starts."""
    base = _rest(axis, rows)
    asked, begins = rows[:, ASKED + axis], rows[:, BEGINNING + axis]
    return np.where(np.isnan(asked), base, asked) != np.where(np.isnan(begins), base, begins)


def _starts_away(axis: int, rows: Floats) -> Truths:
    """Whether an axis without a reference moves all the same, since it does not start where it rests."""
    begins = rows[:, BEGINNING + axis]
    return ~np.isnan(begins) & (begins != _rest(axis, rows))


def _rest(axis: int, rows: Floats) -> Floats:
    return rows[:, ANGLE] if axis == 0 else np.zeros(len(rows))


def _motors(where: Where) -> tuple[int, ...]:
    return (_MOTORS.index(where.motor),) if where.motor in _MOTORS else (0, 1)


def _of_sensitivity(name: str, found: Floats) -> Floats:
    alpha = found[:, FOUND_SENSITIVITY + DISK_MARGIN]
    if name == "gain_low":
        return (2 - alpha) / (2 + alpha)
    if name == "gain_high":
        with np.errstate(divide="ignore", invalid="ignore"):
            return np.where(alpha < 2, (2 + alpha) / (2 - alpha), nan)
    if name == "phase":
        return np.array([2 * atan(own / 2) for own in alpha.tolist()])  # NumPy's may differ in the last digit
    own = found[:, FOUND_SENSITIVITY + _OF_SENSITIVITY[name]]
    return np.where(np.isinf(own), nan, own) if name.endswith("frequency") else own


def _worse(known: Measured, columns: Sequence[Column]) -> Floats:
    """Of several values the least good one, as `measured.worse` has it."""
    table, meant = (np.array(part) for part in zip(*columns, strict=True))
    if known.figure.signed:
        table = np.where(np.sum(meant, axis=0) > 1, np.abs(table), table)
    best = inf if known.figure.better == "higher" else -inf
    lacking = meant & (~np.isfinite(table) if known.unlimited else np.isnan(table))
    table = np.where(meant, np.where(lacking, best if known.unlimited else nan, table), nan)
    pick = np.fmin if known.figure.better == "higher" else np.fmax
    out = pick.reduce(table, axis=0)
    if not known.unlimited:
        out[np.any(lacking, axis=0)] = nan
    return out
