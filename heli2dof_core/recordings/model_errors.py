"""What a model leaves out, looked for in the residuals of a fit: dead bands, offsets, curved thrust, dry friction."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import Wanted
from ..findings import Finding
from ..frozen import Frozen
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
LAG = 0.05
"""Time constant of the rotors that are looked for, s; longer and shorter ones look alike."""
LIKELY = {"band": 0.5, "offset": 0.1, "curve": 0.2, "friction": 0.3, "lag": 0.1}
"""How large what is left out usually is on a laboratory's rig, as a standard deviation: of dead bands of `DEAD_BAND`
each, offsets in V, shares of a characteristic that are curved, dry friction in torques of a volt, lags in s. It
matters only for what the recording does not show."""
_SLOW = 0.02
_SMALL = 1e-3
_PARTS = 16
_ORDER = 16
_MOTORS = ("pitch", "yaw")


@dataclass(frozen=True)
class Missed(Frozen):
    """What a model leaves out, and what that does to the estimates.

    Attributes:
        findings: what is seen, or would not be.
        bias: by which the estimates are off, at most, if it is what it looks like, (k,), in the units of the
            derivatives.
        spread: covariance of that, (k, k).
    """

    findings: list[Finding]
    bias: Floats
    spread: Floats


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
) -> Missed:
    """What the residuals follow beyond chance; or else, which dead band they would not show though it matters.

    A score test on whitened residuals (Rao; Ljung, System Identification, 1999, section 16.6): residuals, and the
    response to a small addition to the voltages, pass the filter that makes the residuals white (an autoregression
    per axis); freed of what parameters and starting states could make up for, they must not be correlated.

    What they say of all shapes at once gives the estimates' bias. A shape x of amplitude a moves least squares by
    G a with G = (JᵀJ)⁻¹Jᵀx (Ljung, 1999, section 8.3: estimates of a model that is too small go where it fits best).
    The residuals show the part of x that J cannot make up for; amplitudes are thought to be around 0, as large as
    `LIKELY` says, and a is what the residuals leave of that (Goodwin, Gevers & Ninness, IEEE Trans. Autom. Control 37
    (1992) 913–928, "stochastic embedding"): cov a = (Λ⁻¹ + xᵀx/σ²)⁻¹, a = cov a · xᵀr/σ², all whitened.
    All this is of first order: what is larger than usual counts by as many times more as it is that.

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
    shapes = [
        *_shapes(p, t, volts, base, bounds),
        *_lags(t, volts, stretches(t)),
    ]
    columns = [J, r[:, :, None]]
    for _, added, _ in shapes:
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
    likely = [_likely(shape, names) for shape in shapes]
    bias, spread = bias_of(J, columns[2:], likely, responses=responses, residuals=residuals, noise=noise)
    best = int(np.argmax(scores))
    if scores[best] >= SURE:
        words = (
            f"The residuals follow {shapes[best][0]} more than by chance ({scores[best]:.1f} "
            "standard deviations), which the model leaves out: the values are biased. The intervals allow for what "
            "such effects usually do, no more."
            + "".join(f" Let {name} be free, too." for name in shapes[best][2][1:] if name not in names)
        )
        return Missed([Finding("model_error", "warning", words)], bias, spread)
    flat = J.reshape(-1, k)
    found = []
    for motor, word in enumerate(_MOTORS):
        unseen = [
            columns[2 + i].ravel()
            for i, (words, _, _) in enumerate(shapes)
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
    return Missed(found, bias, spread)


def bias_of(
    J: Floats,
    shapes: Sequence[Floats],
    likely: Sequence[float],
    *,
    responses: Floats,
    residuals: Floats,
    noise: float,
) -> tuple[Floats, Floats]:
    """The estimates' bias, at most, and its covariance, see `unmodelled`."""
    k = J.shape[-1]
    kept = [i for i, size in enumerate(likely) if size > 0]
    flat = J.reshape(-1, k)
    shifts = np.linalg.lstsq(flat, np.column_stack([shapes[i].ravel() for i in kept]), rcond=1e-10)[0]
    shown = responses[:, kept]
    prior = np.diag(np.array(likely)[kept] ** -2.0)
    within = max(noise, 1e-300)
    covariance = np.linalg.inv(prior + shown.T @ shown / within**2)
    amplitudes = covariance @ (shown.T @ residuals) / within**2
    beyond = np.abs(amplitudes) / np.array(likely)[kept]
    bias = np.abs(shifts @ amplitudes) + np.abs(shifts) @ (np.abs(amplitudes) * beyond)
    return np.asarray(bias), np.asarray(shifts @ covariance @ shifts.T)


def _likely(shape: tuple[str, Floats, tuple[str, ...]], names: Sequence[str]) -> float:
    """How large such an effect usually is; 0: it is free, and no effect of its own."""
    _, _, (kind, *own) = shape
    return 0.0 if any(name in names for name in own) else LIKELY[kind]


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
) -> Iterator[tuple[str, Floats, tuple[str, ...]]]:
    """What is left out, in words; the voltages that would act likewise, (n, 2); its kind, and any name."""
    for motor, word in enumerate(_MOTORS):
        V = volts[:, motor]
        for kind, words, values in (
            ("band", _band(word), -np.clip(V, -DEAD_BAND, DEAD_BAND)),
            ("band", _band(word), np.where(np.abs(V) < DEAD_BAND, -V, 0.0)),
            ("offset", f"an offset of the {word} motor", np.ones_like(V)),
            (
                "curve",
                f"a curved characteristic of the {word} motor",
                V * np.abs(V) / max(1e-9, float(np.max(np.abs(V)))),
            ),
        ):
            added = np.zeros_like(volts)
            added[:, motor] = values
            yield words, added, (kind,)
    rates = np.zeros_like(angles)
    for first, end in bounds.tolist():
        rates[first:end] = np.gradient(angles[first:end], t[first:end], axis=0)
    thrust = np.array([[p.K_pp, p.K_py], [p.K_yp, p.K_yy]])
    if abs(np.linalg.det(thrust)) > 1e-9 * float(np.max(np.abs(thrust))) ** 2:
        for axis, word in enumerate(_MOTORS):
            torque = np.zeros_like(volts)
            torque[:, axis] = -float(np.max(np.abs(thrust))) * np.tanh(rates[:, axis] / _SLOW)
            added = np.asarray(np.linalg.solve(thrust, torque.T).T, dtype=np.float64)
            yield f"dry friction in {word}", added, ("friction", f"friction.{word}.coulomb")


def _lags(
    t: Floats, volts: Floats, bounds: NDArray[np.int64]
) -> Iterator[tuple[str, Floats, tuple[str, ...]]]:
    """Likewise of rotors that take time: mean speed between two samples minus voltage, by the time constant."""
    constants = np.zeros(10)
    constants[:2] = LAG
    speeds = turning(constants, bounds, t, volts).speeds
    apart = np.diff(t, append=t[-1] + np.median(np.diff(t)))[:, None]
    mean = (speeds - volts) * LAG / apart * -np.expm1(-apart / LAG)
    for motor, word in enumerate(_MOTORS):
        added = np.zeros_like(volts)
        added[:, motor] = mean[:, motor] / LAG
        yield f"a lag of the {word} motor", added, ("lag", f"rotors.{word}.tau")
