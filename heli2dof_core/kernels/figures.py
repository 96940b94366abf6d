"""Figures of merit of a course, piece by piece, while it is computed: no sample decides them.

A piece is a polynomial of degree 4 over x = 0 … 1 in the form of the integrator's continuous output,
p₀ + x (p₁ + z (p₂ + x (p₃ + z p₄))) with z = 1 − x. Its Bernstein ordinates bound it, which is all that most pieces
need; extrema and crossings are located on the others. Source of the bounds: Farouki, Comput. Aided Geom. Design
29 (2012) 379. The definitions stand in the registry of figures.
"""

from __future__ import annotations

from math import inf, nan, sqrt

from .jit import kernel
from .layout import (
    AREA,
    AT_HIGH,
    AT_LIMIT,
    AT_LOW,
    BAND,
    BOTTOM,
    BOTTOM_AT,
    BY,
    CALM,
    DEVIATION,
    EFFORT,
    FROM,
    MOMENT,
    PEAK_VOLTAGE,
    RISEN,
    SHARE,
    SINCE,
    STEPPED,
    TOP,
    TOP_AT,
    WITHIN,
)

RISE_TIME, SETTLING_TIME, OVERSHOOT, UNDERSHOOT, PEAK, PEAK_TIME, STEADY_STATE_ERROR, IAE, ITAE = range(9)
SETTLED = 9
"""Columns of an axis' row: the attributes of `AxisMetrics` in the registry of figures, in their order."""
ALIKE = 1e-15
"""Share of an extremum by which another must exceed it: less is rounding."""
LOW, HIGH = 0.1, 0.9
FOUND = 1e-12
"""Last step of Newton's method, or width of its bracket, as a share of a piece: a step leaves but its square."""


@kernel
def start_figures(f, start, reference, rest, pitch, yaw, t):
    """Nothing is known yet of a course that is at these angles at t; `start` is what its steps count from."""
    for i in range(2):
        a, step = f[i], reference[i] - start[i]
        a[FROM], a[STEPPED] = start[i], 1.0 if step != 0.0 else 0.0
        a[BY] = 1.0 / step if step != 0.0 else 1.0
        share = ((pitch if i == 0 else yaw) - start[i]) * a[BY]
        a[TOP] = a[BOTTOM] = share
        a[TOP_AT] = a[BOTTOM_AT] = a[AT_LOW] = a[AT_HIGH] = a[SINCE] = t
        a[RISEN] = (1.0 if share >= LOW else 0.0) + (1.0 if share >= HIGH else 0.0)
        a[WITHIN] = 1.0 if abs(share - 1.0) <= BAND else 0.0
        a[AREA] = a[MOMENT] = 0.0
        b = f[2 + i]
        b[PEAK_VOLTAGE] = b[EFFORT] = b[AT_LIMIT] = 0.0
        b[CALM] = rest[i]


@kernel
def quartic(p0, p1, p2, p3, p4, x):
    """The piece at x."""
    z = 1.0 - x
    return p0 + x * (p1 + z * (p2 + x * (p3 + z * p4)))


@kernel
def quartic_slope(p1, p2, p3, p4, x):
    """Its derivative by x."""
    return p1 + p2 + x * (2.0 * (p3 + p4 - p2) - x * (3.0 * (p3 + 2.0 * p4) - 4.0 * x * p4))


@kernel
def level_crossing(p0, p1, p2, p3, p4, level, low, high):
    """Where a piece that is monotone between low and high has the value: Newton's method, bisecting if it leaves."""
    first, last = quartic(p0, p1, p2, p3, p4, low), quartic(p0, p1, p2, p3, p4, high)
    if first == last:
        return low
    rising = last > first
    x = low + (high - low) * min(max((level - first) / (last - first), 0.0), 1.0)
    for _ in range(100):
        off, slope = quartic(p0, p1, p2, p3, p4, x) - level, quartic_slope(p1, p2, p3, p4, x)
        if (off > 0.0) == rising:
            high = x
        else:
            low = x
        step = off / slope if slope != 0.0 else inf
        if abs(step) <= FOUND or high - low <= FOUND:
            return min(max(x - step, low), high)
        x -= step
        if not low < x < high:
            x = 0.5 * (low + high)
    return x


@kernel
def turning_point(p1, p2, p3, p4, low, high):
    """The first x between low and high where the piece turns back; high if there is none.

    Between the zeros of its second derivative the first one is monotone: Newton's method, as in `level_crossing`.
    """
    a, b, c = 6.0 * p4, -3.0 * (p3 + 2.0 * p4), p3 + p4 - p2
    one = other = high
    square = b * b - 4.0 * a * c
    if square > 0.0:
        q = -0.5 * (b + (sqrt(square) if b >= 0.0 else -sqrt(square)))
        if a != 0.0:
            one = q / a
        if q != 0.0:
            other = c / q
        if one > other:
            one, other = other, one
    left, before = low, quartic_slope(p1, p2, p3, p4, low)
    for part in range(3):
        right = min(max(one if part == 0 else other if part == 1 else high, low), high)
        after = quartic_slope(p1, p2, p3, p4, right)
        if before * after < 0.0:
            x = left + (right - left) * before / (before - after)
            for _ in range(100):
                here, bend = quartic_slope(p1, p2, p3, p4, x), 2.0 * (c + x * (b + x * a))
                if here * before > 0.0:
                    left = x
                else:
                    right = x
                step = here / bend if bend != 0.0 else inf
                if abs(step) <= FOUND or right - left <= FOUND:
                    return min(max(x - step, left), right)
                x -= step
                if not left < x < right:
                    x = 0.5 * (left + right)
            return x
        left, before = right, after
    return high


@kernel
def update_axis(a, p0, p1, p2, p3, p4, t, h, end, integrals):
    """One axis, a row of f, along a piece of its angle from x = 0 to `end`, at t + h x; with integrals or without."""
    by = a[BY]
    p0, p1, p2, p3, p4 = (p0 - a[FROM]) * by, p1 * by, p2 * by, p3 * by, p4 * by
    b1, b3, b4 = p0 + 0.25 * (p1 + p2), p0 + 0.75 * p1 + 0.25 * (p2 + p3), p0 + p1
    b2 = p0 + 0.5 * p1 + (p2 + 0.5 * (p3 + p4)) / 3.0
    low, high = min(p0, b1, b2, b3, b4), max(p0, b1, b2, b3, b4)
    if a[STEPPED] == 0.0:
        integrals = False
    elif integrals and end == 1.0 and (low >= 1.0 or high <= 1.0):
        integrals = False
        mean = (p0 + b1 + b2 + b3 + b4) / 5.0
        weighted = (p0 + 2.0 * b1 + 3.0 * b2 + 4.0 * b3 + 5.0 * b4) / 30.0
        a[AREA] += h * abs(1.0 - mean)
        a[MOMENT] += h * abs(t * (1.0 - mean) + h * (0.5 - weighted))
    if not integrals and not (a[STEPPED] != 0.0 and may_cross_level(a, low, high)):
        if low >= a[BOTTOM] and high <= a[TOP]:
            return
        if end == 1.0 and low == min(p0, b4) and high == max(p0, b4):  # its extrema are its ends
            update_extrema(a, b4, t + h)
            return
    if (p0 <= b1 <= b2 <= b3 <= b4) or (p0 >= b1 >= b2 >= b3 >= b4):
        update_monotone(a, p0, p1, p2, p3, p4, t, h, 0.0, end, integrals)
        return
    x = 0.0
    for _ in range(4):
        following = turning_point(p1, p2, p3, p4, x + 1e-9 if x > 0.0 else 0.0, end)
        update_monotone(a, p0, p1, p2, p3, p4, t, h, x, following, integrals)
        x = following
        if x >= end:
            return


@kernel
def may_cross_level(a, low, high):
    """Whether a course between these shares of the step may reach a level of the rise or the edge of the band."""
    if a[RISEN] < 2.0 and high >= (LOW if a[RISEN] == 0.0 else HIGH):
        return True
    if a[WITHIN] != 0.0:
        return low < 1.0 - BAND or high > 1.0 + BAND
    return low <= 1.0 + BAND and high >= 1.0 - BAND


@kernel
def update_extrema(a, share, t):
    """The highest and the lowest share of the step, with one more that is reached at t.

    A stop or a held axis may be met again, up to rounding: the first time is the peak's.
    """
    if share > a[TOP] + ALIKE * abs(a[TOP]):
        a[TOP], a[TOP_AT] = share, t
    elif share < a[BOTTOM] - ALIKE * abs(a[BOTTOM]):
        a[BOTTOM], a[BOTTOM_AT] = share, t


@kernel
def update_monotone(a, p0, p1, p2, p3, p4, t, h, low, high, integrals):
    """The same along a part of a piece, in shares of the step, that is monotone."""
    first, last = quartic(p0, p1, p2, p3, p4, low), quartic(p0, p1, p2, p3, p4, high)
    update_extrema(a, last, t + h * high)
    if a[STEPPED] == 0.0:
        return
    if a[RISEN] == 0.0 and last >= LOW:
        a[RISEN], a[AT_LOW] = 1.0, t + h * level_crossing(p0, p1, p2, p3, p4, LOW, low, high)
    if a[RISEN] == 1.0 and last >= HIGH:
        a[RISEN], a[AT_HIGH] = 2.0, t + h * level_crossing(p0, p1, p2, p3, p4, HIGH, low, high)
    inside = abs(last - 1.0) <= BAND
    if inside and a[WITHIN] == 0.0:
        edge = 1.0 - BAND if first < 1.0 else 1.0 + BAND
        a[WITHIN], a[SINCE] = 1.0, t + h * level_crossing(p0, p1, p2, p3, p4, edge, low, high)
    elif not inside:
        a[WITHIN] = 0.0
    if integrals:
        at = high
        if (first - 1.0) * (last - 1.0) < 0.0:
            at = level_crossing(p0, p1, p2, p3, p4, 1.0, low, high)
            error_integrals(a, p0, p1, p2, p3, p4, t, h, at, high)
        error_integrals(a, p0, p1, p2, p3, p4, t, h, low, at)


@kernel
def error_integrals(a, p0, p1, p2, p3, p4, t, h, low, high):
    """∫ |1 − share| dt, also weighted with t, where its sign stays: three points of Gauss, exact to degree 5."""
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    off = half * sqrt(0.6)
    area = moment = 0.0
    for part in range(-1, 2):
        x = middle + part * off
        weight = (8.0 if part == 0 else 5.0) / 9.0 * (1.0 - quartic(p0, p1, p2, p3, p4, x))
        area += weight
        moment += weight * (t + h * x)
    a[AREA] += abs(h * half * area)
    a[MOMENT] += abs(h * half * moment)


@kernel
def update_held_motor(b, voltage, limit, span):
    """A motor, a row of f, whose voltage stays for a time."""
    b[PEAK_VOLTAGE] = max(b[PEAK_VOLTAGE], abs(voltage))
    b[EFFORT] += (voltage - b[CALM]) ** 2 * span
    if abs(voltage) >= limit:
        b[AT_LIMIT] += span


@kernel
def update_motor(b, p0, p1, p2, p3, p4, h, end):
    """A motor, a row of f, along a piece of its voltage from x = 0 to `end`."""
    b1, b3, b4 = p0 + 0.25 * (p1 + p2), p0 + 0.75 * p1 + 0.25 * (p2 + p3), p0 + p1
    b2 = p0 + 0.5 * p1 + (p2 + 0.5 * (p3 + p4)) / 3.0
    ends, rest = max(abs(p0), abs(b4)), b[CALM]
    bound = max(ends, abs(b1), abs(b2), abs(b3))
    if bound > b[PEAK_VOLTAGE]:
        peak = ends if bound == ends and end == 1.0 else quartic_peak(p0, p1, p2, p3, p4, end)
        b[PEAK_VOLTAGE] = max(b[PEAK_VOLTAGE], peak)
    if end < 1.0:
        b[EFFORT] += h * end * quartic_mean_square(p0 - rest, p1, p2, p3, p4, end)
        return
    a0, a1, a2, a3, a4 = p0 - rest, b1 - rest, b2 - rest, b3 - rest, b4 - rest
    total = a0 * a0 + a0 * a1 + a3 * a4 + a4 * a4
    total += (3.0 * (a0 * a2 + a2 * a4) + 4.0 * (a1 * a1 + a3 * a3)) / 7.0
    total += (a0 * a3 + a1 * a4 + 6.0 * (a1 * a2 + a2 * a3)) / 7.0
    b[EFFORT] += h * (total + (a0 * a4 + 16.0 * a1 * a3 + 18.0 * a2 * a2) / 35.0) / 9.0


@kernel
def quartic_peak(p0, p1, p2, p3, p4, end):
    """The largest size of a piece from x = 0 to `end`."""
    found, x = abs(p0), 0.0
    for _ in range(4):
        x = turning_point(p1, p2, p3, p4, x + 1e-9 if x > 0.0 else 0.0, end)
        found = max(found, abs(quartic(p0, p1, p2, p3, p4, x)))
        if x >= end:
            break
    return found


@kernel
def quartic_mean_square(p0, p1, p2, p3, p4, end):
    """The mean square of a piece from x = 0 to `end`: five points of Gauss, exact to degree 9."""
    outer, inner = sqrt(5.0 + 2.0 * sqrt(10.0 / 7.0)) / 3.0, sqrt(5.0 - 2.0 * sqrt(10.0 / 7.0)) / 3.0
    total = 128.0 / 225.0 * quartic(p0, p1, p2, p3, p4, 0.5 * end) ** 2
    for sign in range(-1, 2, 2):
        far, near = 0.5 * end * (1.0 + sign * outer), 0.5 * end * (1.0 + sign * inner)
        total += (322.0 - 13.0 * sqrt(70.0)) / 900.0 * quartic(p0, p1, p2, p3, p4, far) ** 2
        total += (322.0 + 13.0 * sqrt(70.0)) / 900.0 * quartic(p0, p1, p2, p3, p4, near) ** 2
    return 0.5 * total


@kernel
def settling_check_end(f, end, dwell):
    """Until when a course must be looked at to know whether its axes have settled; `end` where that is known."""
    until = end
    for i in range(2):
        if f[i, STEPPED] != 0.0 and f[i, WITHIN] != 0.0:
            until = max(until, f[i, SINCE] + dwell)
    return until


@kernel
def copy_figures(f, ahead):
    """A copy of f in `ahead`, to look beyond the end."""
    for i in range(4):
        for j in range(f.shape[1]):
            ahead[i, j] = f[i, j]


@kernel
def confirm_settling(f, ahead, whole):
    """Axes that left the settling band beyond the end, or of which that is not known, have not settled."""
    for i in range(2):
        if not whole or ahead[i, WITHIN] == 0.0 or ahead[i, SINCE] != f[i, SINCE]:
            f[i, WITHIN] = 0.0


@kernel
def figures_of_merit(f, reference, pitch, yaw, end, floor, axes, motors, course):
    """Figures of what was followed until `end`, where the axes are at these angles; nan is what did not happen.

    Into `axes`, (2, AXIS_METRICS), for each axis that is stepped, and `motors`, (2, MOTOR_METRICS); deviations and
    shares of time into `course`. An overshoot below `floor`, a share of the step, is no more than rounding; nor is a
    peak that stands out by less from where the course ends, as of one that creeps towards a value of its own.
    """
    for i in range(2):
        a, b, out = f[i], f[2 + i], axes[i]
        step = 1.0 / a[BY]
        course[DEVIATION + i] = abs(step) * max(a[TOP], -a[BOTTOM])
        course[SHARE + i] = min(b[AT_LIMIT] / end, 1.0) if end > 0.0 else 0.0
        motors[i, PEAK_VOLTAGE], motors[i, EFFORT] = b[PEAK_VOLTAGE], b[EFFORT]
        if a[STEPPED] == 0.0:
            continue
        out[RISE_TIME] = a[AT_HIGH] - a[AT_LOW] if a[RISEN] == 2.0 else nan
        out[SETTLED] = a[WITHIN]
        out[SETTLING_TIME] = a[SINCE] if a[WITHIN] != 0.0 else nan
        over, under = a[TOP] - 1.0, -a[BOTTOM]
        out[OVERSHOOT] = 100.0 * over if over > floor else 0.0
        out[UNDERSHOOT] = 100.0 * under if under > floor else 0.0
        below = -a[BOTTOM] > a[TOP]
        out[PEAK] = a[FROM] + step * (a[BOTTOM] if below else a[TOP])
        at, last = a[BOTTOM_AT] if below else a[TOP_AT], ((pitch if i == 0 else yaw) - a[FROM]) * a[BY]
        back = last - a[BOTTOM] if below else a[TOP] - last
        out[PEAK_TIME] = at if (under if below else over) > floor and back > floor else nan
        out[STEADY_STATE_ERROR] = reference[i] - (pitch if i == 0 else yaw)
        out[IAE], out[ITAE] = abs(step) * a[AREA], abs(step) * a[MOMENT]
