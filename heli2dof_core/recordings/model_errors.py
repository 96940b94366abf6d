"""What a model leaves out, looked for in the residuals of a fit: dead bands, offsets, curved thrust, dry friction."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import Wanted
from ..findings import Finding
from ..signals import Floats
from ..simulation.recorded import run_segments, turning
from .recording import Recording
from .time_axis import stretches
from .whiteness import autoregression, correlations

DEAD_BAND = 0.5
"""Half width of the dead band that is looked for, V; wider and narrower ones look alike."""
SURE, SPREAD, CERTAIN = 4.5, 2.5, 8.0
"""Standard deviations beyond which residuals follow a shape more than by chance, and how many of those of its parts,
segment by segment, or how many without that: noise that is correlated over more than the filter takes out is no
effect of the voltages."""
MATTERS = 0.5
"""Share of an interval's half width by which an unseen dead band may move a value."""
_SLOW = 0.02
_SMALL = 1e-3
_PARTS = 16
_ORDER = 16
_MOTORS = ("pitch", "yaw")


def unmodelled(
    p: Any,
    recording: Recording,
    bounds: NDArray[np.int64],
    starts: Floats,
    *,
    J: Floats,
    r: Floats,
    widths: Floats,
    names: Sequence[str],
    weights: Floats,
    step: float,
    acting: Floats | None = None,
    wanted: Wanted,
) -> list[Finding]:
    """What the residuals follow beyond chance; or else, which dead band they would not show though it matters.

    A score test on whitened residuals (Rao; Ljung, System Identification, 1999, section 16.6): residuals, and the
    response to a small addition to the voltages, pass the filter that makes the residuals white (an autoregression
    per axis); freed of what parameters and starting states could make up for, they must not be correlated.

    Args:
        p: the rig as it was found.
        recording: what was measured.
        bounds: of the segments.
        starts: states that they begin from, (segments, 4).
        J: weighted derivatives by the free parameters, starting states eliminated, (n, 2, k).
        r: weighted residuals, (n, 2).
        widths: half widths of the free parameters' intervals, in the units of J's columns.
        names: of the free parameters.
        weights: of θ and ψ, 1/rad.
        step: longest one of the integration, s.
        acting: rotors and friction as they were found, `rotors.Actuators.constants`; None: there are none.
        wanted: called now and then.
    """
    t, volts = recording.t, recording.voltages

    def simulated(volts: Floats) -> tuple[Floats, Floats]:
        rotors = None if acting is None else turning(acting, stretches(t), t, volts)
        return run_segments(p, starts, bounds, t, volts, step=step, rotors=rotors, wanted=wanted)

    base, slopes = simulated(volts)
    whitened = _Whitened(bounds, r, slopes[:, :, :4] * weights[:, None])
    shapes = list(_shapes(p, t, volts, base, bounds))
    columns = [J, r[:, :, None]]
    for _, added in shapes:
        out, _ = simulated(volts + _SMALL * added)
        columns.append(((out - base) / _SMALL * weights)[:, :, None])
    left = whitened.free_of_starts(np.concatenate(columns, axis=2))
    k = J.shape[-1]
    free, others = left[:, :k], left[:, k:]
    others = others - free @ np.linalg.lstsq(free, others, rcond=1e-10)[0]
    residuals, responses = others[:, 0], others[:, 1:]
    noise = float(np.linalg.norm(residuals)) / np.sqrt(max(1, len(left) - k - 4 * len(bounds)))
    sizes, whole = np.linalg.norm(responses, axis=0), np.linalg.norm(left[:, k + 1 :], axis=0)
    told = sizes > _SMALL * whole
    products = residuals[:, None] * responses
    scores = np.where(told, np.abs(np.sum(products, axis=0)) / np.where(told, noise * sizes, 1.0), 0.0)
    parts = np.add.reduceat(
        products, np.linspace(0, len(left), max(_PARTS, len(bounds)), endpoint=False).astype(int)
    )
    spread = np.sqrt(np.sum(parts**2, axis=0))
    steady = np.abs(np.sum(parts, axis=0)) >= SPREAD * np.where(spread > 0, spread, np.inf)
    scores = np.where((steady | (scores >= CERTAIN)) & np.isfinite(scores), scores, 0.0)
    best = int(np.argmax(scores))
    if scores[best] >= SURE:
        words = (
            f"The residuals follow {shapes[best][0]} more than by chance ({scores[best]:.1f} "
            "standard deviations), which the model leaves out: the values are "
            "biased, and the intervals may not hold the truth."
        )
        return [Finding("model_error", "warning", words)]
    flat = J.reshape(-1, k)
    found = []
    for motor, word in enumerate(_MOTORS):
        unseen = [
            columns[2 + i].ravel()
            for i, (words, _) in enumerate(shapes)
            if words == _band(word) and sizes[i] < (SURE + SPREAD) * noise
        ]
        shifts = [np.abs(np.linalg.lstsq(flat, column, rcond=1e-10)[0]) / widths for column in unseen]
        shifts = np.max([np.zeros(k), *shifts], axis=0)
        crossed = np.any(np.abs(recording.voltages[:, motor]) < DEAD_BAND)
        if crossed and np.max(shifts) > MATTERS:
            worst = int(np.argmax(shifts))
            words = (
                f"The {word} motor's voltage passes 0. A dead band of {DEAD_BAND:g} V there, which the "
                f"model does not have, would move {names[worst]} by {shifts[worst]:.1f} half widths of its interval "
                "without being seen in the residuals: the intervals hold for a motor without one."
            )
            found.append(Finding(f"{word}_dead_band_unseen", "info", words))
    return found


def _band(word: str) -> str:
    return f"a dead band of the {word} motor"


class _Whitened:
    """Columns through a filter that makes the residuals white, axis by axis, within segments.

    An autoregression of order `_ORDER` by the equations of Yule and Walker: the sum of a slow disturbance and of
    white noise takes many coefficients, though either alone takes one or none.
    """

    def __init__(self, bounds: NDArray[np.int64], r: Floats, own: Floats) -> None:
        self.bounds, self.own = bounds, own
        self.order = max(1, min(_ORDER, int(np.min(np.diff(bounds, axis=1))) // 3))
        self.filter = np.array([autoregression(rho) for rho in correlations(bounds, r, self.order).T]).T

    def free_of_starts(self, columns: Floats) -> Floats:
        """Filtered columns (n, 2, c) without what starting states could make, (rows, c)."""
        left = []
        for a, b in self.bounds.tolist():
            own = self._filtered(self.own[a:b])
            part = self._filtered(columns[a:b])
            Q, _ = np.linalg.qr(own)
            left.append(part - Q @ (Q.T @ part))
        return np.concatenate(left)

    def _filtered(self, part: Floats) -> Floats:
        rows = len(part) - self.order
        out = part[self.order :].copy()
        for k in range(self.order):
            first = self.order - 1 - k
            out -= self.filter[k][:, None] * part[first : first + rows]
        return out.reshape(-1, part.shape[-1])


def _shapes(
    p: Any, t: Floats, volts: Floats, angles: Floats, bounds: NDArray[np.int64]
) -> Iterator[tuple[str, Floats]]:
    """What is left out, in words, and the voltages that would act likewise, (n, 2)."""
    for motor, word in enumerate(_MOTORS):
        V = volts[:, motor]
        for words, values in (
            (_band(word), -np.clip(V, -DEAD_BAND, DEAD_BAND)),
            (_band(word), np.where(np.abs(V) < DEAD_BAND, -V, 0.0)),
            (f"an offset of the {word} motor", np.ones_like(V)),
            (
                f"a curved characteristic of the {word} motor",
                V * np.abs(V) / max(1e-9, float(np.max(np.abs(V)))),
            ),
        ):
            added = np.zeros_like(volts)
            added[:, motor] = values
            yield words, added
    rates = np.zeros_like(angles)
    for first, end in bounds.tolist():
        rates[first:end] = np.gradient(angles[first:end], t[first:end], axis=0)
    thrust = np.array([[p.K_pp, p.K_py], [p.K_yp, p.K_yy]])
    if abs(np.linalg.det(thrust)) > 1e-9 * float(np.max(np.abs(thrust))) ** 2:
        for axis, word in enumerate(_MOTORS):
            torque = np.zeros_like(volts)
            torque[:, axis] = -float(np.max(np.abs(thrust))) * np.tanh(rates[:, axis] / _SLOW)
            yield f"dry friction in {word}", np.asarray(np.linalg.solve(thrust, torque.T).T, dtype=np.float64)
