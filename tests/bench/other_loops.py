"""Six loops that students meet, as the rig with other parameters, and what is exact about them (mpmath).

Five are a motor's loop: opened at the pitch motor, all else closed. With K_py = K_yp = 0 and an inertia of 1 pitch
is on its own, and L(s) is the textbook's. The sixth is the rig's inner loop, two inputs and two outputs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import mpmath as mp
import numpy as np

from heli2dof_core import Loop, Spec, close_loop, place

DIGITS = 60
STEP = 0.1  # rad, of pitch
DURATION, SAMPLES = 10.0, 501
_ALONE = {"K_pp": 1, "K_py": 0, "K_yp": 0, "K_yy": 1, "J_p": 1, "J_y": 1, "m": 0, "l": 0, "B_p": 0, "B_y": 0}
Pair = tuple[float, float]


@dataclass(frozen=True)
class Case:
    """A loop by name, its L(s) in words, and the spec that it is."""

    name: str
    words: str
    spec: Spec

    @cached_property
    def loop(self) -> Loop:
        """Closed, by ours."""
        return close_loop(place(self.spec), self.spec.outer)

    @cached_property
    def opened(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(A, b, c) of L(s) = c (sI − A)⁻¹ b at the pitch motor; structural zeros are exact zeros."""
        n, plant = len(self.loop.A), self.loop.design.plant
        A, B = np.zeros((n, n)), np.zeros((n, 2))
        A[:4, :4], B[:4] = plant.A, plant.B
        if n == 6:
            A[4, 0] = A[5, 1] = -1.0
        law = self.loop.voltage_from_state
        return A + np.outer(B[:, 1], law[1]), B[:, [0]], -law[[0]]

    @cached_property
    def closed(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(A, b, c) from the pitch reference to pitch."""
        return self.loop.A, self.loop.B[:, [0]], np.eye(1, len(self.loop.A))

    @cached_property
    def axis(self) -> tuple[np.ndarray, np.ndarray, list[complex]]:
        """Pitch alone with the pitch motor, (A, b), and the two poles asked for."""
        plant = self.loop.design.plant
        return plant.A[np.ix_([0, 2], [0, 2])], plant.B[np.ix_([0, 2], [0])], list(self.spec.poles.values[:2])


def cases() -> list[Case]:
    """The six."""

    def alone(poles: Sequence[complex], **changes: Any) -> Spec:
        parameters = {**_ALONE, **changes.pop("parameters", {})}
        return _rig(poles=poles, parameters=parameters, **changes)

    quick = [-1, -2, -3, -4]
    return [
        Case("rig", "the default rig with its PI loops", _rig()),
        Case(
            "conditional",
            "3(s + 1)²/s³",
            alone(quick, pitch=(4.0, 4 / 3), yaw=(4.0, 4 / 3)),
        ),
        Case("integrators", "(3s + 2)/s²", alone(quick, outer="none")),
        Case(
            "static",
            "the default rig at θ₀ = 0.8 rad, inner loop alone: L(0) < −1",
            _rig(theta_0=0.8, outer="none", poles=[-1, -2, -1.5, -2.5], reference=(0.8 + STEP, None)),
        ),
        Case(
            "light",
            "(0.38s − 0.47)/(s² + 0.02s + 1)",
            alone([-0.2 + 0.7j, -0.2 - 0.7j, -3, -4], outer="none", parameters={"K_s": 1, "B_p": 0.02}),
        ),
        Case("2×2", "the default rig's inner loop, both motors and both angles", _rig(outer="none")),
    ]


def _rig(**changes: Any) -> Spec:
    return Spec.from_preset("quanser-2dof-manual").changed(
        **{"reference": (STEP, None), "duration": DURATION, **changes}
    )


def exact_margins(A: np.ndarray, b: np.ndarray, c: np.ndarray) -> tuple[list[Pair], list[Pair]]:
    """All (gain margin, ω), ω = 0 included, and (phase margin in degrees, ω), by roots at 60 digits."""
    with mp.workdps(DIGITS):
        n, d = polynomials(A, b, c)
        n_even, n_odd, d_even, d_odd = *_halves(n), *_halves(d)
        circle = _sum(*_squares(n_even, n_odd), *([-v for v in p] for p in _squares(d_even, d_odd)))
        axis = _sum(_product(n_odd, d_even), [-v for v in _product(n_even, d_odd)])

        def L(w: Any) -> Any:
            return mp.polyval(n[::-1], 1j * w) / mp.polyval(d[::-1], 1j * w)

        turns = [mp.sqrt(x) for x in _positive(axis)] + ([mp.mpf(0)] if abs(d[0]) > 1e-30 else [])
        gains = [(float(-1 / mp.re(L(w))), float(w)) for w in turns if mp.re(L(w)) < 0]
        at = [mp.sqrt(x) for x in _positive(circle)]
        return sorted(gains), sorted((float(mp.degrees(mp.arg(-L(w)))), float(w)) for w in at)


def polynomials(A: np.ndarray, b: np.ndarray, c: np.ndarray) -> tuple[list[Any], list[Any]]:
    """Numerator and denominator of c (sI − A)⁻¹ b, lowest power first, common factors s taken out."""
    d = _characteristic(mp.matrix(A.tolist()))
    closed = _characteristic(mp.matrix(A.tolist()) - mp.matrix(b.tolist()) * mp.matrix(c.tolist()))
    n = [
        v - w if abs(v - w) > mp.mpf(10) ** (20 - DIGITS) else mp.mpf(0)
        for v, w in zip(closed, d, strict=True)
    ]
    d = [v if abs(v) > mp.mpf(10) ** (20 - DIGITS) else mp.mpf(0) for v in d]
    while n[0] == 0 and d[0] == 0:
        n, d = n[1:], d[1:]
    return n, d


def exact_step(A: np.ndarray, b: np.ndarray, c: np.ndarray) -> dict[str, float]:
    """Rise and settling time, overshoot and peak time of the unit step, from the modes; distinct poles only."""
    with mp.workdps(30):
        a, vector = mp.matrix(A.tolist()), mp.matrix(b.tolist())
        values, vectors = mp.eig(a)
        weights = mp.lu_solve(vectors, vector)
        out = mp.matrix(c.tolist()) * vectors
        rates = list(values)
        shares = [out[0, i] * weights[i] / rates[i] for i in range(len(rates))]
        final = -mp.re(sum(shares))

        def y(t: Any) -> Any:  # in units of the final value
            return 1 + mp.re(sum(s * mp.exp(r * t) for s, r in zip(shares, rates, strict=True))) / final

        def dy(t: Any) -> Any:
            return mp.re(sum(s * r * mp.exp(r * t) for s, r in zip(shares, rates, strict=True))) / final

        slowest = max(float(mp.re(r)) for r in rates)
        t = np.linspace(0, -25 / slowest, 200_001)
        terms = [complex(s) * np.exp(complex(r) * t) for s, r in zip(shares, rates, strict=True)]
        course = 1 + np.real(sum(terms)) / float(final)

        def at(index: int, level: float) -> float:
            bracket = (t[index], t[index + 1])
            return float(mp.findroot(lambda x: y(x) - level, bracket, solver="anderson"))

        lower, upper = (at(int(np.argmax(course >= level)) - 1, level) for level in (0.1, 0.9))
        last = int(np.flatnonzero(np.abs(course - 1) > 0.02)[-1])
        settled = at(last, 1.02 if course[last] > 1 else 0.98)
        top = int(np.argmax(course))
        peak = float(mp.findroot(dy, t[top])) if 0 < top < len(t) - 1 and course[top] > 1 + 1e-9 else np.nan
        overshoot = 100 * float(y(peak) - 1) if np.isfinite(peak) else 0.0
        return {"rise": upper - lower, "settling": settled, "overshoot": overshoot, "peak": peak}


def pole_error(A: np.ndarray, B: np.ndarray, K: np.ndarray, poles: list[complex]) -> float:
    """Largest distance of A − BK's eigenvalues, at 60 digits, from the poles, each matched with its nearest."""
    with mp.workdps(DIGITS):
        closed = mp.matrix(A.tolist()) - mp.matrix(B.tolist()) * mp.matrix(np.atleast_2d(K).tolist())
        found = mp.polyroots(_characteristic(closed)[::-1], maxsteps=500, extraprec=400)
        worst = 0.0
        for p in poles:
            nearest = min(found, key=lambda v: abs(v - mp.mpc(p)))
            found.remove(nearest)
            worst = max(worst, float(abs(nearest - mp.mpc(p))))
        return worst


def _characteristic(a: Any) -> list[Any]:
    """det(sI − a), lowest power first, by Faddeev and Le Verrier."""
    n = a.rows
    coefficients, m = [mp.mpf(1)], mp.eye(n)
    for k in range(1, n + 1):
        product = a * m
        coefficients.append(-sum(product[i, i] for i in range(n)) / k)
        m = product + coefficients[-1] * mp.eye(n)
    return coefficients[::-1]


def _halves(p: list[Any]) -> tuple[list[Any], list[Any]]:
    """p(jω) = E(ω²) + jω O(ω²)."""
    signed = [v * (1 if k % 4 < 2 else -1) for k, v in enumerate(p)]
    return signed[::2], signed[1::2]


def _product(p: list[Any], q: list[Any]) -> list[Any]:
    out = [mp.mpf(0)] * max(len(p) + len(q) - 1, 1)
    for i, v in enumerate(p):
        for k, w in enumerate(q):
            out[i + k] += v * w
    return out


def _squares(even: list[Any], odd: list[Any]) -> tuple[list[Any], list[Any]]:
    return _product(even, even), [mp.mpf(0), *_product(odd, odd)]


def _sum(*polynomials: list[Any]) -> list[Any]:
    length = max(map(len, polynomials))
    return [sum(p[k] for p in polynomials if k < len(p)) for k in range(length)]


def _positive(p: list[Any]) -> list[Any]:
    """Positive real roots."""
    p = [v if abs(v) > mp.mpf(10) ** (20 - DIGITS) else mp.mpf(0) for v in p]
    while p and p[-1] == 0:
        p.pop()
    while p and p[0] == 0:
        p.pop(0)
    roots = mp.polyroots(p[::-1], maxsteps=500, extraprec=400) if len(p) > 1 else []
    return [mp.re(r) for r in roots if abs(mp.im(r)) < 1e-20 * abs(r) and mp.re(r) > 0]
