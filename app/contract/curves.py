"""The curves of an update: its arrays as they are, for JSON, or their places in a binary frame, and its data."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np

from heli2dof_core import Report

from .encoding import array_at
from .model import Reply, fixed

Curves = Sequence[tuple[Reply, Reply]]
"""Per experiment what linear model and rig reply of their curves, by name."""
_NAMES = ("theta", "psi", "V_p", "V_y", "v_p", "v_y")


def curves_of(report: Report) -> Curves:
    """The block's own arrays."""
    block, lags = report.block, _lags(report)
    t, found = block["t"], []
    for n in range(report.task.rest.runs):
        both = []
        for m, states in enumerate((block["linear"][n], block["nonlinear"][n])):
            rows = [states[0], states[1], *block["voltages"][n, m]]
            rows += [states[6 + j] if own else rows[2 + j] for j, own in enumerate(lags)]
            both.append(_by_name(t, rows))
        found.append((both[0], both[1]))
    return found


def placed_curves(report: Report) -> tuple[Curves, memoryview]:
    """Their places in a frame, and what stands there: t, then per experiment and model one curve after the other."""
    block, lags, runs = report.block, _lags(report), report.task.rest.runs
    samples, rows = len(block["t"]), 4 + len(lags)
    data = np.empty(samples * (1 + 2 * runs * rows), "<f4")
    data[:samples] = block["t"]
    curves = data[samples:].reshape(runs, 2, rows, samples)
    linear, rig, voltages = block["linear"][:runs], block["nonlinear"][:runs], block["voltages"][:runs]
    curves[:, 0, :2], curves[:, 1, :2], curves[:, :, 2:4] = linear[:, :2], rig[:, :2], voltages
    for j, own in enumerate(lags):
        if own:
            curves[:, 0, 4 + j], curves[:, 1, 4 + j] = linear[:, 6 + j], rig[:, 6 + j]
        else:
            curves[:, :, 4 + j] = voltages[:, :, j]
    return _places(samples, runs, rows), data.data


@lru_cache(maxsize=64)
def _places(samples: int, runs: int, rows: int) -> Curves:
    t, found = fixed(array_at(0, samples)), []
    for n in range(runs):
        first = [samples * (1 + (2 * n + m) * rows) for m in range(2)]
        both = [
            _by_name(t, [fixed(array_at(at + samples * k, samples)) for k in range(rows)]) for at in first
        ]
        found.append((both[0], both[1]))
    return found


def _lags(report: Report) -> tuple[bool, ...]:
    """Which rotors take time, where either does: then both speeds are replied."""
    own = report.spec.actuators
    return () if own is None or not own.lags else tuple(tau > 0.0 for tau in own.tau.tolist())


def _by_name(t: object, rows: Sequence[object]) -> Reply:
    own = dict(zip(_NAMES, rows, strict=False))
    rotors = {name: own.pop(name) for name in _NAMES[4 : len(rows)]}
    return {"t": t, **own, **({"rotors": rotors} if rotors else {})}
