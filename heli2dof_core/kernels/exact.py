"""Figures of merit of a linear course, from its exact states on a grid that its poles choose.

Nodes lie so close that the fastest pole that still matters is resolved, and farther apart as the fast ones die out:
each spacing is a part of the window halved again and again, and the powers of the step's matrix come from one another
by squaring. Between two nodes a course is the polynomial of degree 4 with its angles and rates at both and its angle
in the middle; integrals are those of degree 8 through nine nodes.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from math import ceil, inf, pi

import numpy as np

from .figures import (
    level_crossing,
    may_cross_level,
    quartic,
    quartic_peak,
    update_axis,
    update_extrema,
    update_motor,
)
from .jit import general, keep_apart, kernel
from .layout import (
    AREA,
    BY,
    DIVERGED,
    EFFORT,
    ENDED,
    FROM,
    MOMENT,
    NODES,
    OUT_OF_BOUNDS,
    OUT_OF_STEPS,
    PEAK_VOLTAGE,
    STEPPED,
)
from .linear import exponential_series, matrix_product, next_samples, row_times_samples, squarings_needed

SPACING = 0.2
"""Of two nodes, in 1/|λ| of the fastest pole that matters: the polynomial is off by 3e-8 of that pole's share."""
GONE = 40.0
"""Time constants after which a pole does not matter any more."""
GROUP = 8
"""Intervals that are integrated together."""


def _shares(group: int) -> list[list[Fraction]]:
    """Integrals of Lagrange's polynomials through 0 … `group` from each node to the next, group × (group + 1).

    As fractions: a linear solver's last digits are its machine's, and these numbers stand in the page's module.
    """
    columns = []
    for own in range(group + 1):
        powers = [Fraction(1)]
        for other in range(group + 1):
            if other != own:  # times (x − other)/(own − other)
                times_x, scale = [Fraction(0), *powers], own - other
                powers = [(up - other * same) / scale for up, same in zip(times_x, [*powers, 0], strict=True)]
        until = [sum(c * x ** (n + 1) / (n + 1) for n, c in enumerate(powers)) for x in range(group + 1)]
        columns.append([Fraction(end - begin) for begin, end in pairwise(until)])
    return [list(row) for row in zip(*columns, strict=True)]


_EXACT = _shares(GROUP)
SHARES = np.array(_EXACT, dtype=float)
WHOLE = np.array([sum(column) for column in zip(*_EXACT, strict=True)], dtype=float)
MOMENTS = WHOLE * np.arange(GROUP + 1)


@kernel
def fastest_pole(poles, t):
    """The largest |λ| of the poles that still matter at t, rad/s."""
    found = 0.0
    for p in poles:
        if p.real * t > -GONE:
            found = max(found, abs(p))
    return found


@kernel
def slowest_period(poles):
    """A period of the slowest pole, s: how long an axis must stay within its band to count as settled."""
    size, slowest = 0.0, inf
    for p in poles:
        size = max(size, abs(p))
    for p in poles:
        if abs(p) > 1e-9 * size:
            slowest = min(slowest, abs(p))
    return 2.0 * pi / slowest if slowest < inf else 0.0


@kernel
def settling_horizon(poles):
    """How long a linear course must stay within the band, s: until every pole has had its say; inf where one grows.

    Six time constants of each pole, or ten periods where it hardly decays.
    """
    size, longest = 0.0, 0.0
    for p in poles:
        size = max(size, abs(p))
    for p in poles:
        if p.real > 1e-9 * size:
            return inf
        if abs(p) > 1e-9 * size:
            periods = 20.0 * pi / abs(p)
            longest = max(longest, periods if p.real == 0.0 else min(periods, 6.0 / abs(p.real)))
    return longest


@kernel
def propagate_measured(size, M, outputs, slopes, poles, t, length, theta_0, most, f, ladder, nodes, w):
    """Follows the course from the state in the first column of `nodes` at t for a time `length`.

    `outputs` and `slopes`, (2, n), n one more than the size: voltages and their rates by state. The state at the end
    is left in the first column, of a course that leaves ±DIVERGED the angles alone. Given up after `most` groups of
    intervals. Returns the outcome and the time reached. Scratch: `ladder` and `w`, (6 n, n).
    """
    keep_apart()
    end = t + length
    # intervals at this spacing: `parts` times a power of 2
    wanted = length * fastest_pole(poles, t) / SPACING
    level = 3
    while wanted > 8.0 * 2.0**level:
        level += 1
    parts = max(ceil(wanted / 2.0**level), 1)
    spacing = length / (parts * 2.0**level)
    deepest = max(squarings_needed(size, M, length / parts), level + 1)
    at = deepest - level  # the place of the spacing's matrix in the ladder
    if level > 55 or deepest + 10 > len(ladder):
        return OUT_OF_STEPS, t
    exponential_series(size, M, length / parts * 0.5**deepest, ladder[0], w)
    built, left, groups = 1, parts * 2**level, 0
    while left > 0:
        limit = fastest_pole(poles, t) / SPACING
        while left % (2 * GROUP) == 0 and 2.0 * spacing * limit <= 1.0:
            spacing *= 2.0
            left //= 2
            at += 1
        count = min(NODES, left)
        if left % (2 * GROUP) == GROUP and 2.0 * spacing * limit <= 1.0:
            count = GROUP  # then the spacing can be doubled
        groups += count // GROUP
        if groups > most:
            return OUT_OF_STEPS, t
        done, power = 1, at
        while done <= count:
            while built <= power:
                matrix_product(size, ladder[built - 1], ladder[built - 1], ladder[built])
                built += 1
            more = min(done, count + 1 - done)
            next_samples(size, ladder[power], nodes, done, more)
            done += more
            power += 1
        for i in range(2):
            row_times_samples(size, outputs[i], nodes, count + 1, nodes[len(size) + 1 + i], 0)
        good = intervals_in_bounds(size, nodes, theta_0, count)
        for i in range(2):
            measure_axis(size, f[i], nodes, i, good, t, spacing, ladder[at - 1], theta_0 if i == 0 else 0.0)
            measure_motor(size, f[2 + i], nodes, i, good, spacing, ladder[at - 1], outputs, slopes)
        if good < count:
            t += good * spacing
            return OUT_OF_BOUNDS, measure_to_divergence(
                size, f, nodes, good, t, spacing, ladder[at - 1], theta_0, outputs, slopes
            )
        left -= count
        t = end - left * spacing
        for i in range(len(size) + 1):
            nodes[i, 0] = nodes[i, count]
    return ENDED, end


@kernel
def intervals_in_bounds(size, nodes, theta_0, count):
    """How many intervals begin and end within ±DIVERGED."""
    for k in range(1, count + 1):
        good = abs(nodes[0, k] + theta_0) < DIVERGED and abs(nodes[1, k]) < DIVERGED
        if not (good and abs(nodes[len(size) + 1, k]) < inf and abs(nodes[len(size) + 2, k]) < inf):
            return k - 1
    return count


@kernel
def midpoint_state(size, row, nodes, k):
    """An entry of the state half an interval after node k, by the matrix' row."""
    total = row[len(size)]
    for i in range(len(size)):
        total += row[i] * nodes[i, k]
    return total


@kernel
def quartic_between(y, y1, rate, rate1, half):
    """Coefficients p₁ … p₄ of the polynomial between two nodes, of rates times the spacing, and the value halfway."""
    change = y1 - y
    bend = rate - change
    twist = change - rate1 - bend
    return change, bend, twist, 16.0 * (half - y - 0.5 * change - 0.25 * bend - 0.125 * twist)


@kernel
def measure_axis(size, a, nodes, axis, count, t, d, half, base):
    """One axis, a row of f, along `count` intervals of length d; its angle is `base` above the state."""
    y, slope = nodes[axis], nodes[2 + axis]
    start, by, stepped = a[FROM] - base, a[BY], a[STEPPED] != 0.0
    full = count - count % GROUP
    for first in range(0, full, GROUP):
        fell = rose = False
        area = moment = 0.0
        for j in range(GROUP + 1):
            rose = rose or slope[first + j] > 0.0
            fell = fell or slope[first + j] < 0.0
            area += WHOLE[j] * y[first + j]
            moment += MOMENTS[j] * y[first + j]
        before, after = (y[first] - start) * by, (y[first + GROUP] - start) * by
        crosses = stepped and (before - 1.0) * (after - 1.0) <= 0.0
        if (
            (rose and fell)
            or crosses
            or (stepped and may_cross_level(a, min(before, after), max(before, after)))
        ):
            crosses = measure_axis_by_interval(
                size, a, y, slope, first, first + GROUP, t, d, half[axis], nodes, base, False
            )
        else:
            update_extrema(a, after, t + (first + GROUP) * d)
        if crosses:
            error_integrals_by_interval(a, y, first, t, d, start, by)
        elif stepped:  # ∫ (1 − share) dt, and with t, in the group's own time
            area = GROUP - by * (area - GROUP * start)
            moment = 0.5 * GROUP * GROUP - by * (moment - 0.5 * GROUP * GROUP * start)
            a[AREA] += d * abs(area)
            a[MOMENT] += d * abs((t + first * d) * area + d * moment)
    if full < count:
        measure_axis_by_interval(size, a, y, slope, full, count, t, d, half[axis], nodes, base, True)


@general
def measure_axis_by_interval(size, a, y, slope, first, last, t, d, half, nodes, base, integrals):
    """The same from node to node, events located; whether the error changes its sign, whose integrals are done then.

    `half` is the matrix' row that leads to the middle of an interval.
    """
    start, by, stepped = a[FROM] - base, a[BY], a[STEPPED] != 0.0
    crosses, share = False, (y[first] - start) * by
    for k in range(first, last):
        after = (y[k + 1] - start) * by
        crossing = stepped and (share - 1.0) * (after - 1.0) < 0.0
        turns = slope[k] * slope[k + 1] < 0.0
        if (
            integrals
            or crossing
            or turns
            or (stepped and may_cross_level(a, min(share, after), max(share, after)))
        ):
            p1, p2, p3, p4 = quartic_between(
                y[k], y[k + 1], d * slope[k], d * slope[k + 1], midpoint_state(size, half, nodes, k)
            )
            update_axis(a, y[k] + base, p1, p2, p3, p4, t + k * d, d, 1.0, crossing or integrals)
            crosses = crosses or crossing
        else:
            update_extrema(a, after, t + (k + 1) * d)
        share = after
    return crosses


@kernel
def error_integrals_by_interval(a, y, first, t, d, start, by):
    """∫ |1 − share| dt, also weighted with t, over the intervals of a group on which the error keeps its sign."""
    for k in range(GROUP):
        if ((y[first + k] - start) * by - 1.0) * ((y[first + k + 1] - start) * by - 1.0) < 0.0:
            continue
        area = moment = 0.0
        for j in range(GROUP + 1):
            off = SHARES[k, j] * (1.0 - (y[first + j] - start) * by)
            area += off
            moment += off * (t + (first + j) * d)
        a[AREA] += d * abs(area)
        a[MOMENT] += d * abs(moment)


@kernel
def measure_motor(size, b, nodes, motor, count, d, half, outputs, slopes):
    """One motor, a row of f, along `count` intervals of length d; at rest its voltage is 0."""
    u = nodes[len(size) + 1 + motor]
    highest, total, full = max(b[PEAK_VOLTAGE], abs(u[0])), 0.0, count - count % GROUP
    for k in range(1, count + 1):
        highest = max(highest, abs(u[k]))
    peak = highest
    for k in range(count + 1):  # only beside a node that nearly is the highest can it be higher
        if abs(u[k]) <= (1.0 - SPACING) * highest:
            continue
        if 0 < k < count and (u[k] - u[k - 1]) * (u[k + 1] - u[k]) > 0.0:
            continue
        for j in range(max(k - 1, 0), min(k + 1, count)):
            p1, p2, p3, p4 = voltage_quartic(size, outputs[motor], slopes[motor], half, nodes, u, j, d)
            peak = max(peak, quartic_peak(u[j], p1, p2, p3, p4, 1.0))
    for first in range(0, full, GROUP):
        for j in range(GROUP + 1):
            total += WHOLE[j] * u[first + j] * u[first + j]
    b[PEAK_VOLTAGE] = peak
    b[EFFORT] += d * total
    for k in range(full, count):
        p1, p2, p3, p4 = voltage_quartic(size, outputs[motor], slopes[motor], half, nodes, u, k, d)
        update_motor(b, u[k], p1, p2, p3, p4, d, 1.0)


@kernel
def voltage_quartic(size, output, slope, half, nodes, u, k, d):
    """The same of a voltage between the nodes k and k + 1, by the rows that make it and its rate of the state."""
    between, first, last = output[len(size)], slope[len(size)], slope[len(size)]
    for i in range(len(size)):
        between += output[i] * midpoint_state(size, half[i], nodes, k)
        first += slope[i] * nodes[i, k]
        last += slope[i] * nodes[i, k + 1]
    return quartic_between(u[k], u[k + 1], d * first, d * last, between)


@kernel
def measure_to_divergence(size, f, nodes, k, t, d, half, theta_0, outputs, slopes):
    """The last interval of a course, on which an angle leaves ±DIVERGED; until when.

    Where the angles are then stands in the first column.
    """
    for i in range(len(size) + 3):
        if not abs(nodes[i, k + 1]) < inf:
            nodes[0, 0], nodes[1, 0] = nodes[0, k], nodes[1, k]
            return t
    x = 1.0
    for i in range(2):
        base = theta_0 if i == 0 else 0.0
        y, slope = nodes[i], nodes[2 + i]
        if abs(y[k + 1] + base) >= DIVERGED:
            p1, p2, p3, p4 = quartic_between(
                y[k], y[k + 1], d * slope[k], d * slope[k + 1], midpoint_state(size, half[i], nodes, k)
            )
            level = DIVERGED if y[k + 1] > 0.0 else -DIVERGED
            x = min(x, level_crossing(y[k] + base, p1, p2, p3, p4, level, 0.0, 1.0))
    pitch = yaw = 0.0
    for i in range(2):
        base = theta_0 if i == 0 else 0.0
        y, slope = nodes[i], nodes[2 + i]
        p1, p2, p3, p4 = quartic_between(
            y[k], y[k + 1], d * slope[k], d * slope[k + 1], midpoint_state(size, half[i], nodes, k)
        )
        update_axis(f[i], y[k] + base, p1, p2, p3, p4, t, d, x, True)
        if i == 0:
            pitch = quartic(y[k], p1, p2, p3, p4, x)
        else:
            yaw = quartic(y[k], p1, p2, p3, p4, x)
        u = nodes[len(size) + 1 + i]
        p1, p2, p3, p4 = voltage_quartic(size, outputs[i], slopes[i], half, nodes, u, k, d)
        update_motor(f[2 + i], u[k], p1, p2, p3, p4, d, x)
    nodes[0, 0], nodes[1, 0] = pitch, yaw
    return t + d * x
