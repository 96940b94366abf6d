"""Figures of merit of the nonlinear rig once more: polynomials between SciPy's steps, their roots, Gauss's sums.

DOP853's dense output is a polynomial of degree 7 on each step, so that its values at eight nodes are all of it:
extrema, crossings and integrals follow to the last digits, whatever kinks there are between two steps. The
definitions are those of the documentation, written down anew.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.polynomial import chebyshev, legendre
from scipy.optimize import brentq

from tests.digital_reference import DigitalReference
from tests.reference import FREE, Reference

DEGREE = 7
NODES = -np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE)
TO_SERIES = np.linalg.inv(chebyshev.chebvander(NODES, DEGREE))
POINTS, WEIGHTS = legendre.leggauss(DEGREE + 1)
BAND = 0.02


class Course:
    """Angles and voltages of a rig from 0 to `end` and on to `horizon`, as Chebyshev series per step.

    Attributes:
        a, b: ends of the steps, s.
        angles, volts: series, (steps, 8, 2).
        at_limit: whether a motor is at its limit, (steps, 2).
    """

    def __init__(self, loop, limits, scenario, horizon, rtol=1e-12):
        digital = scenario.digital is not None
        rig = (DigitalReference if digital else Reference)(loop, limits, scenario)
        self.trim, end = loop.design.plant.trim, scenario.duration
        a, b, angles, volts, at_limit = [], [], [], [], []
        for piece in rig.pieces(horizon, rtol):
            marks = piece.sol.ts
            if marks[0] < end < marks[-1]:
                marks = np.sort(np.append(marks, end)) if end not in marks else marks
            for first, last in pairwise(marks):
                if not last > first:
                    continue
                nodes = 0.5 * (first + last) + 0.5 * (last - first) * NODES
                part = np.searchsorted(piece.sol.ts, 0.5 * (first + last)) - 1
                y = piece.sol.interpolants[part](nodes)
                given = np.empty((2, DEGREE + 1))
                for i in range(2):
                    if digital:
                        given[i] = rig.held[i]
                    elif piece.mode[i] == FREE:
                        *law, constant = rig.law[i]
                        given[i] = np.array(law) @ y + constant
                    else:
                        given[i] = piece.side[i] * rig.limits[i]
                a.append(first), b.append(last)
                angles.append(y[:2].T), volts.append(given.T)
                at_limit.append([mode != FREE for mode in piece.mode])
        self.a, self.b = np.array(a), np.array(b)
        self.angles = np.einsum("ij,sjk->sik", TO_SERIES, np.array(angles))
        self.volts = np.einsum("ij,sjk->sik", TO_SERIES, np.array(volts))
        self.at_limit, self.end, self.wanted = np.array(at_limit), end, rig.wanted
        self.within = self.b <= end * (1 + 1e-12)

    def motor(self, i):
        """Largest |voltage|, share of time at the limit, ∫ (V − trim)² dt."""
        own, span = self.volts[self.within, :, i], (self.b - self.a)[self.within]
        size = max(np.max(np.abs(monotone(own, self.a[self.within], self.b[self.within])[2])), 0.0)
        values = own @ chebyshev.chebvander(POINTS, DEGREE).T - self.trim[i]
        effort = np.sum(0.5 * span * (values**2 @ WEIGHTS))
        share = np.sum(span[self.at_limit[self.within, i]]) / self.end
        return {"motor_peak": float(size), "saturated": float(share), "effort": float(effort)}

    def deviation(self, i, start):
        """The largest distance of an angle from its start."""
        values = monotone(self.angles[self.within, :, i], self.a[self.within], self.b[self.within])[2]
        return float(np.max(np.abs(values - start)))


def monotone(series, a, b):
    """Times and places (step, x) between which the series are monotone, with their values, all in order."""
    slopes = chebyshev.chebder(series, axis=1)
    still = np.abs(slopes[:, 0]) > np.sum(np.abs(slopes[:, 1:]), axis=1)
    steps, places = [], []
    for s in range(len(series)):
        inner = []
        if not still[s] and np.any(slopes[s]):
            roots = chebyshev.chebroots(np.trim_zeros(slopes[s], "b"))
            inner = sorted(r.real for r in roots if abs(r.imag) < 1e-7 and -1 < r.real < 1)
        marks = [-1.0, *inner, 1.0]
        steps += [s] * len(marks)
        places += marks
    steps, places = np.array(steps), np.array(places)
    values = np.sum(series[steps] * chebyshev.chebvander(places, DEGREE), axis=1)
    times = 0.5 * (a + b)[steps] + 0.5 * (b - a)[steps] * places
    return times, (steps, places), values


class Axis:
    """One stepped axis in shares of its step: s = 0 at the start, 1 at the reference."""

    def __init__(self, course, i, start, reference):
        self.course, self.start, self.step = course, start, reference - start
        self.series = course.angles[:, :, i] / self.step
        self.series[:, 0] -= start / self.step
        self.t, (self.s, self.x), self.v = monotone(self.series, course.a, course.b)
        self.inside = course.within[self.s]

    def share(self, t):
        """The share at a time."""
        s = int(np.clip(np.searchsorted(self.course.b, t), 0, len(self.course.b) - 1))
        a, b = self.course.a[s], self.course.b[s]
        return float(chebyshev.chebval((2 * t - a - b) / (b - a), self.series[s]))

    def rate(self, t):
        """Its derivative by time, 1/s."""
        s = int(np.clip(np.searchsorted(self.course.b, t), 0, len(self.course.b) - 1))
        a, b = self.course.a[s], self.course.b[s]
        slope = chebyshev.chebder(self.series[s])
        return float(chebyshev.chebval((2 * t - a - b) / (b - a), slope) * 2 / (b - a))

    def reached(self, j, level):
        """When a value is reached between the marks j − 1 and j."""
        s = self.s[j]
        if self.s[j - 1] != s:
            return self.t[j]
        off = lambda x: chebyshev.chebval(x, self.series[s]) - level  # noqa: E731
        low, high = self.x[j - 1], self.x[j]
        x = brentq(off, low, high, xtol=1e-15) if off(low) * off(high) < 0 else high
        return 0.5 * (self.course.a[s] + self.course.b[s]) + 0.5 * (self.course.b[s] - self.course.a[s]) * x

    def first_at(self, level):
        """When the share first is as large; None where it never is within the window."""
        found = np.flatnonzero((self.v >= level) & self.inside)
        if not len(found):
            return None
        return self.t[0] if found[0] == 0 else self.reached(found[0], level)

    def figures(self):
        """All of them, and `last` where the window ends."""
        v, t = self.v[self.inside], self.t[self.inside]
        low, high = self.first_at(0.1), self.first_at(0.9)
        outside = np.flatnonzero(np.abs(v - 1) > BAND)
        entered = None
        if not len(outside):
            entered = t[0]
        elif outside[-1] + 1 < len(v):
            j = outside[-1] + 1
            entered = self.reached(j, 1 + BAND if v[j - 1] > 1 else 1 - BAND)
        top, bottom = int(np.argmax(v)), int(np.argmin(v))
        below = -v[bottom] > v[top]
        iae, itae = self.integrals()
        return {
            "rise_time": None if high is None else high - low,
            "levels": (low, high),
            "entered": entered,
            "overshoot": 100 * max(v[top] - 1, 0.0),
            "undershoot": 100 * max(-v[bottom], 0.0),
            "peak": self.start + self.step * v[bottom if below else top],
            "peak_time": t[bottom if below else top],
            "steady_state_error": self.step * (1 - v[-1]),
            "iae": iae,
            "itae": itae,
        }

    def integrals(self):
        """∫ |e| dt and ∫ t |e| dt: Gauss's sums where the error's sign stays."""
        iae = itae = 0.0
        marks = [(s, x) for s, x, inside in zip(self.s, self.x, self.inside, strict=True) if inside]
        pieces = []
        for (s, low), (other, high) in pairwise(marks):
            if s != other or not high > low:
                continue
            off = lambda x, s=s: chebyshev.chebval(x, self.series[s]) - 1  # noqa: E731
            cut = [low, brentq(off, low, high, xtol=1e-15), high] if off(low) * off(high) < 0 else [low, high]
            pieces += [(s, p, q) for p, q in pairwise(cut)]
        s, p, q = (np.array(part) for part in zip(*pieces, strict=True))
        x = 0.5 * (p + q)[:, None] + 0.5 * (q - p)[:, None] * POINTS
        a, b = self.course.a[s][:, None], self.course.b[s][:, None]
        error = 1 - np.einsum("sij,sj->si", chebyshev.chebvander(x, DEGREE), self.series[s])
        t, weight = 0.5 * (a + b) + 0.5 * (b - a) * x, 0.25 * (b - a) * (q - p)[:, None] * WEIGHTS
        iae, itae = (np.sum(np.abs(np.sum(weight * part, axis=1))) for part in (error, t * error))
        return abs(self.step) * iae, abs(self.step) * itae


def settling_gap(axis, told, ahead):
    """By how much a settling time, or None, contradicts the course; a share of the step.

    It must lie on the band's edge, or at 0 within the band, and the course stay within from then on: until the window
    ends, and for `ahead` from then on in any case. None asks for a course that leaves the band, sooner or later.
    """
    off, end = np.abs(axis.v - 1) - BAND, axis.course.end
    if told is None:
        return max(-np.max(off[axis.t >= end * (1 - 1e-12)]), 0.0)
    edge = abs(axis.share(told) - 1) - BAND
    bound = (axis.t > told) & ((axis.t <= end) | (axis.t <= told + ahead))
    return max(edge if told == 0 else abs(edge), np.max(off[bound], initial=0.0), 0.0)
