"""The first half of an update: from the rig's and the design's numbers to K and what it does to the poles."""

from __future__ import annotations

from math import copysign, hypot, isfinite, nan, sqrt

from ..couplings import NEGLIGIBLE
from .derived import full_rank_gain, rig_model
from .derived_rotors import full_rank_gain_with_rotors
from .eigenvalues import EPS, balance, francis, in_range, to_hessenberg
from .eigenvectors import condition_in_2_norm, condition_in_frobenius_norm, schur_vectors, squared
from .jit import keep_apart, kernel
from .layout import ROUNDING
from .update_layout import (
    AIMS,
    ANGLE,
    AT_ONCE,
    AT_REST,
    CONDITION,
    DEAD_ZONES,
    DETERMINANT,
    DONE,
    DOUBTFUL,
    DOUBTFUL_SHARE,
    EXACT,
    FAMILY,
    FRICTION,
    GIVEN_INVERSE,
    GIVEN_K,
    K_GIVEN,
    LAGS,
    LIMITS,
    MATCHED,
    NEARLY_PARALLEL,
    NO_CURVE,
    NO_SLOPE,
    NO_STRUCTURE,
    NORM,
    PARAMETERS,
    POLE_ERROR,
    POLE_ERROR_BOUND,
    POLES,
    QUADRATIC,
    RELATIVE_GAIN,
    ROTOR_POLES,
    ROTORS_PLACED,
    SHIFT,
    SHIFTED,
    SMALLEST,
    SPECTRAL_NORM,
    UNCONTROLLABLE,
)

K_PP, K_PY, K_YP, K_YY = range(4)
"""Thrust constants in `Parameters`' order."""
TAU, DEAD_ZONE, SQUARE, COULOMB, BREAKAWAY, SLOPE = range(0, 12, 2)
"""Of the block's `actuators`, both motors' or both axes' each."""


@kernel
def is_plain(actuators):
    """Whether rotors and friction are the paper's: thrust follows the voltage at once and in a straight line."""
    for i in range(2):
        if actuators[TAU + i] != 0.0 or actuators[SQUARE + i] != 0.0 or actuators[BREAKAWAY + i] != 0.0:
            return False
    return True


@kernel
def place(numbers, A, B, trim, actuators, K, inverse, work):
    """A, B, trim, actuators, K and Ĝ(0)⁻¹; how it ended. Scratch: `work`, of 18."""
    keep_apart()
    p = numbers[PARAMETERS : PARAMETERS + 12]
    outcome = is_controllable(numbers)
    if outcome != DONE:
        return outcome
    rig_model(p, numbers[ANGLE], A, B, trim)
    outcome = actuate(numbers, trim, actuators)
    if outcome != DONE:
        return outcome
    if numbers[K_GIVEN] != 0.0:
        for i in range(2):
            for j in range(6):
                K[i, j] = numbers[GIVEN_K + 6 * i + j]
            for j in range(2):
                inverse[i, j] = numbers[GIVEN_INVERSE + 2 * i + j]
        return DONE
    family, shifted = int(numbers[FAMILY]), numbers[SHIFTED] != 0.0
    for i in range(2):
        K[i, 4] = K[i, 5] = 0.0
    d, scaled = work[:6], work[6:18]
    for pair in range(2):
        at = POLES + 4 * pair
        re, im = numbers[at], numbers[at + 1]
        if im == 0.0:
            d[2 * pair], d[2 * pair + 1] = re * numbers[at + 2], -(re + numbers[at + 2])
        else:
            d[2 * pair], d[2 * pair + 1] = re * re + im * im, -2.0 * re
    if numbers[ROTORS_PLACED] == 0.0:
        full_rank_gain(family, shifted, d, p, numbers[ANGLE], numbers[SHIFT], K, inverse)
    else:
        for i in range(2):
            if not (actuators[TAU + i] > 0.0 and actuators[SLOPE + i] > 0.0):
                return NO_SLOPE
        for k in range(12):
            scaled[k] = p[k]
        scaled[K_PP] *= actuators[SLOPE]
        scaled[K_YP] *= actuators[SLOPE]
        scaled[K_PY] *= actuators[SLOPE + 1]
        scaled[K_YY] *= actuators[SLOPE + 1]
        for pair in range(1, -1, -1):  # (s² + d₁ s + d₀)(s − p), the second first, as they stand in one row
            low, high, pole = d[2 * pair], d[2 * pair + 1], numbers[ROTOR_POLES + pair]
            d[3 * pair], d[3 * pair + 1], d[3 * pair + 2] = -pole * low, low - pole * high, high - pole
        angle, tau = numbers[ANGLE], actuators[TAU : TAU + 2]
        full_rank_gain_with_rotors(family, shifted, d, scaled, angle, tau, numbers[SHIFT], K, inverse)
    total = 0.0
    for i in range(2):
        for j in range(6):
            total += K[i, j]
        total += inverse[i, 0] + inverse[i, 1]
    return DONE if isfinite(total) else EXACT


@kernel
def is_controllable(numbers):
    """Whether the motors act unlike enough, and the family is the rig's; a given K asks for less."""
    k_pp, k_py = numbers[PARAMETERS + K_PP], numbers[PARAMETERS + K_PY]
    k_yp, k_yy = numbers[PARAMETERS + K_YP], numbers[PARAMETERS + K_YY]
    gamma, products = abs(k_py * k_yp - k_pp * k_yy), abs(k_pp * k_yy) + abs(k_py * k_yp)
    independence = gamma / products if products > 0.0 else 0.0
    if independence <= NEGLIGIBLE:
        return UNCONTROLLABLE
    if numbers[K_GIVEN] != 0.0:
        return DONE
    if numbers[FAMILY] < 2.0 and numbers[SHIFTED] == 0.0:
        own = abs(k_pp if numbers[FAMILY] == 0.0 else k_yy)
        if own <= NEGLIGIBLE * max(abs(k_pp), abs(k_py), abs(k_yp), abs(k_yy)):
            return NO_STRUCTURE
    return EXACT if independence < NEARLY_PARALLEL or gamma < SMALLEST else DONE


@kernel
def actuate(numbers, trim, actuators):
    """Rotors and friction as numbers; the linear rig's trim becomes the one of the thrust curves (`rotors`)."""
    for i in range(2):
        tau, coulomb = numbers[LAGS + i], numbers[FRICTION + i]
        actuators[TAU + i] = tau if tau >= AT_ONCE else 0.0
        actuators[COULOMB + i], actuators[BREAKAWAY + i] = coulomb, max(coulomb, numbers[FRICTION + 2 + i])
        actuators[DEAD_ZONE + i], actuators[SQUARE + i], actuators[SLOPE + i] = 0.0, 0.0, 1.0
        if numbers[QUADRATIC + i] == 0.0:
            continue
        u, limit, v_d, v_m = trim[i], numbers[LIMITS + i], numbers[DEAD_ZONES + i], numbers[MATCHED + i]
        if v_m == 0.0:
            v_m = abs(u) if abs(u) > max(v_d, AT_REST * limit) else limit
        if not v_m > v_d:
            return NO_CURVE
        s = v_m / ((v_m - v_d) * (v_m - v_d))
        actuators[DEAD_ZONE + i], actuators[SQUARE + i] = v_d, s
        actuators[SLOPE + i] = 2.0 * sqrt(s * abs(u))
        trim[i] = copysign(v_d + sqrt(abs(u) / s), u) if u != 0.0 else 0.0
    return DONE


@kernel
def aimed_pole(numbers, i):
    """The pole asked for, number i from 0: four, then the rotors'."""
    if i < 4:
        return complex(numbers[POLES + 2 * i], numbers[POLES + 2 * i + 1])
    return complex(numbers[ROTOR_POLES + i - 4], 0.0)


@kernel
def static_entries(A, thrust):
    """The four entries of B₂⁻¹ A₂₁, row by row: −1 times the voltages that hold one radian."""
    determinant = thrust[2, 0] * thrust[3, 1] - thrust[2, 1] * thrust[3, 0]
    a = (thrust[3, 1] * A[2, 0] - thrust[2, 1] * A[3, 0]) / determinant
    b = (thrust[3, 1] * A[2, 1] - thrust[2, 1] * A[3, 1]) / determinant
    c = (thrust[2, 0] * A[3, 0] - thrust[3, 0] * A[2, 0]) / determinant
    d = (thrust[2, 0] * A[3, 1] - thrust[3, 0] * A[2, 1]) / determinant
    return a, b, c, d


@kernel
def steady_state_determinant(numbers, A, thrust, actuators, K, inverse):
    """Det Ĝ(0)⁻¹, 0 where a placed pole lies at 0 or the product is nothing but rounding of K.

    `thrust` is B times the thrust curves' slopes where the rotors are placed, else B.
    """
    a, b, c, d = inverse[0, 0], inverse[0, 1], inverse[1, 0], inverse[1, 1]
    p, q, r, s = thrust[2, 0], thrust[2, 1], thrust[3, 0], thrust[3, 1]
    chosen = numbers[K_GIVEN] == 1.0  # by a method that knows of no structure
    product = 1.0
    if numbers[ROTORS_PLACED] != 0.0:
        w, x, y, z = static_entries(A, thrust)
        w, x, y, z = abs(w), abs(x), abs(y), abs(z)
        e, f = 1.0 + abs(K[0, 4]), abs(K[0, 5])
        g, h = abs(K[1, 4]), 1.0 + abs(K[1, 5])
        one, two = abs(K[0, 0]) + e * w + f * y, abs(K[0, 1]) + e * x + f * z
        three, four = abs(K[1, 0]) + g * w + h * y, abs(K[1, 1]) + g * x + h * z
        size = one * abs(d) + abs(a) * four + two * abs(c) + abs(b) * three
        determinant = a * d - b * c
        if numbers[AIMS] != 0.0:
            every = complex(1.0, 0.0)
            for i in range(6):
                every *= aimed_pole(numbers, i)
            determinant = every.real / ((p * s - q * r) / (actuators[TAU] * actuators[TAU + 1]))
        return determinant if abs(determinant) > ROUNDING * size else 0.0
    w, x, y, z = p * a + q * c, p * b + q * d, r * a + s * c, r * b + s * d
    e = abs(A[2, 0]) + abs(p * K[0, 0]) + abs(q * K[1, 0])
    f = abs(p * K[0, 1]) + abs(q * K[1, 1])
    g = abs(A[2, 0]) + abs(r * K[0, 0]) + abs(s * K[1, 0])
    h = abs(r * K[0, 1]) + abs(s * K[1, 1])
    if not chosen:
        product = (aimed_pole(numbers, 0) * aimed_pole(numbers, 1)).real
        product *= (aimed_pole(numbers, 2) * aimed_pole(numbers, 3)).real
    else:
        product = w * z - x * y
        if numbers[AIMS] != 0.0:
            for i in range(4):
                if aimed_pole(numbers, i) == 0.0:
                    product = 0.0
    size = abs(w) * h + e * abs(z) + abs(x) * g + f * abs(y)
    return product / (p * s - q * r) if abs(product) > ROUNDING * size else 0.0


@kernel
def measure_gain(numbers, A, B, actuators, K, inverse, figures):
    """Norms of K, det Ĝ(0)⁻¹ and the relative gain λ₁₁."""
    a = b = d = 0.0
    for j in range(6):
        a += K[0, j] * K[0, j]
        b += K[0, j] * K[1, j]
        d += K[1, j] * K[1, j]
    figures[NORM] = sqrt(a + d)
    figures[SPECTRAL_NORM] = sqrt((a + d) / 2.0 + hypot((a - d) / 2.0, b))
    w, x, y, z = inverse[0, 0], inverse[0, 1], inverse[1, 0], inverse[1, 1]
    determinant = figures[DETERMINANT]
    figures[RELATIVE_GAIN] = nan
    if determinant == 0.0:
        return
    if numbers[ROTORS_PLACED] == 0.0 and not is_plain(actuators):
        # a change of voltage acts φ′ times as hard as the design knows
        a, b, c, d = static_entries(A, B)
        pitch, yaw = actuators[SLOPE], actuators[SLOPE + 1]
        one = 1.0 - 1.0 / pitch if pitch > 0.0 else 0.0
        two = 1.0 - 1.0 / yaw if yaw > 0.0 else 0.0
        w, x, y, z = w + one * a, x + one * b, y + two * c, z + two * d
        determinant = w * z - x * y
    if determinant != 0.0:
        figures[RELATIVE_GAIN] = w * z / determinant


@kernel
def closed_loop(A, thrust, placed, actuators, K, a, terms):
    """A − BK, and the sizes of its terms, into the first four or six rows and columns of both."""
    n = 6 if placed else 4
    for i in range(n):
        for j in range(n):
            entry = A[i, j] if i < 4 and j < 4 else 0.0
            if placed:
                if i < 4 and j >= 4:
                    entry = thrust[i, j - 4]
                if i >= 4 and i == j:
                    entry = -1.0 / actuators[TAU + i - 4]
            own, size = entry, abs(entry)
            for motor in range(2):
                if placed:
                    by = 1.0 / actuators[TAU + motor] if i == 4 + motor else 0.0
                else:
                    by = thrust[i, motor] if i < 4 else 0.0
                own -= by * K[motor, j]
                size += abs(by * K[motor, j])
            a[i, j], terms[i, j] = own, size
    return n


@kernel
def judge(numbers, n, closed, terms, column, squares, vectors, found, figures):
    """Poles of A − BK into `found`, in the order of those asked for, the error and its bound, and κ₂; False if none.

    `closed` and `terms`: n×n, overwritten. Scratch: `column` (4, n or more), `squares` (2, n or more, n or more), and
    `vectors` (3, 7, 6).
    """
    keep_apart()
    if not in_range(closed):
        return False
    units, real, imaginary = column[0, :n], column[1, :n], column[2, :n]
    t, z = squares[0, :n, :n], squares[1, :n, :n]
    balance(closed, units)
    size_of_terms = size = 0.0
    for i in range(n):
        for j in range(n):
            size_of_terms += (terms[i, j] * units[j] / units[i]) ** 2
            size += closed[i, j] * closed[i, j]
            t[i, j], z[i, j] = closed[i, j], 1.0 if i == j else 0.0
    to_hessenberg(t, column[3, :n], z)
    if not francis(t, real, imaginary, z):
        return False
    schur_vectors(t, z, real, imaginary, vectors[2, 0], vectors[0])
    error = 4.0 * EPS * sqrt(size_of_terms) + 2.0 * n * EPS * sqrt(size)
    bound = condition_in_frobenius_norm(n, vectors[0], vectors[1]) * error
    for j in range(n):  # the vectors of A − BK itself
        total = 0.0
        for i in range(n):
            vectors[0, i, j] *= units[i]
            total += squared(vectors[0, i, j])
        for i in range(n):
            vectors[0, i, j] /= sqrt(total)
    figures[CONDITION] = condition_in_2_norm(n, vectors[0])
    largest = farthest = 0.0
    for i in range(n):
        largest = max(largest, abs(aimed_pole(numbers, i)))
        farthest = max(farthest, hypot(real[i], imaginary[i]))
    if largest == 0.0:
        largest = farthest
    figures[POLE_ERROR_BOUND] = bound
    figures[DOUBTFUL] = 0.0 if bound <= DOUBTFUL_SHARE * largest else 1.0
    figures[POLE_ERROR] = match(numbers, n, real, imaginary, found)
    return True


@kernel
def match(numbers, n, real, imaginary, found):
    """The poles in the order of those asked for, each the nearest one left; the largest distance.

    Poles that rounding cannot have moved far (not `DOUBTFUL`) each have one nearest; else the order says nothing.
    """
    error = 0.0
    taken = 0
    for i in range(n):
        wanted, best, which = aimed_pole(numbers, i), float("inf"), -1
        for j in range(n):
            distance = abs(complex(real[j], imaginary[j]) - wanted)
            if distance < best and not (taken >> j) & 1:
                best, which = distance, j
        taken |= 1 << which
        found[i] = complex(real[which], imaginary[which])
        error = max(error, best)
    return error
