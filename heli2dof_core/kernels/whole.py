"""The loop as polynomials where rotors take time, their speeds are fed back, or rates and states are estimated.

Motor i's speed v_i, as a voltage, and its command u_i meet in ℓ_i v_i = u_i, ℓ_i = 1 + τ_i s. The rig is D q = B v,
the law u = −N ξ − K_v v, with ξ = q; or ξ = (q, q̂) where an observer F̂ q̂ − E q = B̂ v̂ is told the command, ℓ̂_i
v̂_i = u_i, and feeds back its own v̂. Filters of the rates leave q = a(s) ξ, a = s² + 2ζω s + ω², and an integrated
error q = s ξ, as in `polynomials`. With δ = det B and Y = adj(B) D = δ v/q the motors' rows are H Y + δ N, H =
diag(ℓ) + K_v, and their determinant is a sum over pairs of the rows y_p, y_y, n_p, n_y, by which one can divide by δ
beforehand:

    det/δ = det H [D] + H_pp [y_p n_y] + H_py [y_y n_y] + H_yp [n_p y_p] + H_yy [n_p y_y] + δ [n_p n_y]

where [..] is the determinant of two rows, by Laplace's rule with the observer's rows below: these are expanded alike.
So nothing is divided and no B inverted (one term apart, see `law_by_speeds`), and rotors with τ = 0 or equal ones are
no special case. The sizes of terms go along, as `polynomials` says.
"""

from __future__ import annotations

from . import examples
from .jit import copy_into, entry_point, keep_apart, kernel
from .layout import (
    BY_ANGLES,
    BY_INTEGRALS,
    CONTROLLER,
    FILTERED_RATES,
    K_SPEEDS,
    K_STATES,
    KIND,
    KIND_ROW,
    OBSERVED,
    OBSERVER_ROW,
    OMEGA,
    OWN_A,
    OWN_B,
    OWN_L,
    OWN_L_ANGLES,
    OWN_TAU,
    ROUNDING,
    TERMS,
    VALUE,
    WHOLE,
    WHOLE_ACROSS,
    WHOLE_CLOSED,
    WHOLE_LAG,
    WHOLE_MINORS,
    WHOLE_OPENED,
    WHOLE_POLYNOMIALS,
    WHOLE_ROWS,
    ZETA,
)
from .polynomials import WHOLE_HALF, add_product

# Rows of polynomials, two each, by q_p, q_y, q̂_p, q̂_y: D; adj(B) D; the law as the motors' rows have it; the
# observer's F̂ q̂ − E q, the same times adj(B̂), and the law as its own rows have it
PLANT, MOTOR, LAW, GUESS, SPEED, COMMAND = 0, 2, 4, 6, 8, 10
# Minors: six of the observer's rows, by columns; one at a time of the others; then determinants
UPPER, FREE, MIXED, CROSSED, SAME, REST = 6, 7, 8, 10, 12, 13
LEFT, RIGHT = (0, 0, 0, 1, 1, 2), (1, 2, 3, 2, 3, 3)
SIGNS = (1.0, -1.0, 1.0, 1.0, -1.0, 1.0)
"""Of Laplace's rule for these pairs of columns; the complement of the nth is the (5 − n)th."""


@kernel
def add_number(entry, power, number):
    """Entry += number sᵖᵒʷᵉʳ."""
    entry[VALUE, power] += number
    entry[TERMS, power] += abs(number)


@kernel
def add_multiple(p, factor, size, shift, r):
    """R += factor sˢʰⁱᶠᵗ p; `size` is that of the factor's own rounding, 0 of an exact one."""
    for k in range(p.shape[1] - shift):
        if p[TERMS, k] != 0.0:
            r[VALUE, k + shift] += factor * p[VALUE, k]
            r[TERMS, k + shift] += abs(factor) * p[TERMS, k] + size * abs(p[VALUE, k])


@kernel
def add_by_speed(p, i, j, K_v, tau, r):
    """R += H_ij p, H = diag(1 + τ s) + K_v."""
    add_multiple(p, K_v[i, j], abs(K_v[i, j]), 0, r)
    if i == j:
        add_lagged(p, tau[i], 1.0, r)


@kernel
def add_lagged(p, tau, sign, r):
    """R ± = (1 + τ s) p."""
    add_multiple(p, sign, 0.0, 0, r)
    add_multiple(p, sign * tau, abs(tau), 1, r)


@kernel
def add_twice_lagged(p, one, other, r):
    """R += (1 + τ₁ s)(1 + τ₂ s) p."""
    add_lagged(p, one, 1.0, r)
    add_multiple(p, other, abs(other), 1, r)
    add_multiple(p, one * other, abs(one * other), 2, r)


@kernel
def clear(r):
    """A polynomial with nothing in it."""
    for k in range(r.shape[1]):
        r[VALUE, k] = r[TERMS, k] = 0.0


@kernel
def add_minor(rows, one, other, n, r):
    """R += the determinant of two rows in the nth pair of columns."""
    a, b = rows[one, LEFT[n]], rows[one, RIGHT[n]]
    c, d = rows[other, LEFT[n]], rows[other, RIGHT[n]]
    add_product(WHOLE_HALF, a[VALUE], a[TERMS], d[VALUE], d[TERMS], 1.0, 0, r[VALUE], r[TERMS])
    add_product(WHOLE_HALF, b[VALUE], b[TERMS], c[VALUE], c[TERMS], -1.0, 0, r[VALUE], r[TERMS])


@kernel
def pair_into(rows, one, other, observed, minors, place):
    """[one other]: the determinant of two rows, above the observer's where there is one."""
    r = minors[place]
    clear(r)
    if not observed:
        add_minor(rows, one, other, 0, r)
        return
    for n in range(6):
        upper, lower = minors[UPPER], minors[5 - n]
        clear(upper)
        add_minor(rows, one, other, n, upper)
        add_product(
            WHOLE_HALF,
            upper[VALUE],
            upper[TERMS],
            lower[VALUE],
            lower[TERMS],
            SIGNS[n],
            0,
            r[VALUE],
            r[TERMS],
        )


@kernel
def adjugate_rows(rows, source, target, B, first):
    """Adj(B) times two rows: B are the columns from `first` on of the last two rows of an array."""
    i = len(B) - 2
    for c in range(rows.shape[1]):
        add_multiple(rows[source, c], B[i + 1, first + 1], 0.0, 0, rows[target, c])
        add_multiple(rows[source + 1, c], -B[i, first + 1], 0.0, 0, rows[target, c])
        add_multiple(rows[source, c], -B[i + 1, first], 0.0, 0, rows[target + 1, c])
        add_multiple(rows[source + 1, c], B[i, first], 0.0, 0, rows[target + 1, c])


@kernel
def determinant_of(B, first):
    """Det B, as above, and the size of its terms."""
    i = len(B) - 2
    one, other = B[i, first] * B[i + 1, first + 1], B[i, first + 1] * B[i + 1, first]
    return one - other, abs(one) + abs(other)


@kernel
def rig_and_law(A, controller, rows):
    """D and N into their rows, by q alone; N's part by q̂ with an observer."""
    kind = controller[KIND_ROW, KIND]
    observed = kind == OBSERVED
    constant, linear, square, rate = 1.0, 0.0, 0.0, 1.0  # a(s), and the measured rate's s or ω² s
    if kind == FILTERED_RATES:
        omega = controller[KIND_ROW, OMEGA]
        rate = omega * omega
        constant, linear, square = rate, 2.0 * controller[KIND_ROW, ZETA] * omega, 1.0
    for j in range(2):
        integrates = controller[0, BY_INTEGRALS + j] != 0.0 or controller[1, BY_INTEGRALS + j] != 0.0
        shift = 1 if integrates else 0
        for i in range(2):
            plant, law = rows[PLANT + i, j], rows[LAW + i, j]
            for k in range(3):
                by = -A[2 + i, 2 * k + j] if k < 2 else 1.0 if i == j else 0.0
                add_number(plant, shift + k, by * constant)
                add_number(plant, shift + k + 1, by * linear)
                add_number(plant, shift + k + 2, by * square)
            for k in range(2):  # angles and, of z = −q/s, their integrals
                if k == 0 or integrates:
                    power = shift if k == 0 else 0
                    by = -controller[i, BY_ANGLES + j] if k == 0 else controller[i, BY_INTEGRALS + j]
                    if k == 0 and not observed:
                        by += controller[i, K_STATES + j]
                    add_number(law, power, by * constant)
                    add_number(law, power + 1, by * linear)
                    add_number(law, power + 2, by * square)
            if not observed:
                add_number(law, shift + 1, controller[i, K_STATES + 2 + j] * rate)
                continue
            add_number(rows[LAW + i, 2 + j], 0, controller[i, K_STATES + j])
            add_number(rows[LAW + i, 2 + j], 1, controller[i, K_STATES + 2 + j])
            for k in range(2):  # r̂ = s q̂ − L₁ (q − q̂)
                by = controller[i, K_STATES + 2 + k] * controller[OBSERVER_ROW + k, OWN_L_ANGLES + j]
                add_number(law, shift, -by)
                add_number(rows[LAW + i, 2 + j], 0, by)
            observer_entry(controller, rows, i, j, shift)


@kernel
def observer_entry(controller, rows, i, j, shift):
    """F̂ = s² + (L₁ − A₂₂) s − A₂₂ L₁ + L₂ − A₂₁ and −E = A₂₂ L₁ − L₂ − L₁ s."""
    measured, own = rows[GUESS + i, j], rows[GUESS + i, 2 + j]
    row = OBSERVER_ROW + i
    gain, rate_gain = controller[row, OWN_L_ANGLES + j], controller[row, OWN_L + j]
    add_number(measured, shift + 1, -gain)
    add_number(measured, shift, -rate_gain)
    add_number(own, 2, 1.0 if i == j else 0.0)
    add_number(own, 1, gain)
    add_number(own, 1, -controller[row, OWN_A + 2 + j])
    add_number(own, 0, rate_gain)
    add_number(own, 0, -controller[row, OWN_A + j])
    for k in range(2):
        by = controller[row, OWN_A + 2 + k] * controller[OBSERVER_ROW + k, OWN_L_ANGLES + j]
        add_number(measured, shift, by)
        add_number(own, 0, -by)


@kernel
def observer_minors(rows, K_v, tau, delta, size, minors):
    """The six minors of the observer's rows Ĥ Ŷ + δ̂ N, over δ̂."""
    for n in range(6):
        lower, free = minors[n], minors[FREE]
        clear(lower)
        clear(free)
        add_minor(rows, GUESS, GUESS + 1, n, free)
        add_twice_lagged(free, tau[0], tau[1], lower)
        for i in range(2):
            add_multiple(free, K_v[i, i], abs(K_v[i, i]), 0, lower)
            add_multiple(free, K_v[i, i] * tau[1 - i], abs(K_v[i, i] * tau[1 - i]), 1, lower)
        one, other = K_v[0, 0] * K_v[1, 1], K_v[0, 1] * K_v[1, 0]
        add_multiple(free, one - other, abs(one) + abs(other), 0, lower)
        for j in range(2):
            clear(free)
            add_minor(rows, SPEED + j, COMMAND + 1, n, free)
            add_by_speed(free, 0, j, K_v, tau, lower)
            clear(free)
            add_minor(rows, COMMAND, SPEED + j, n, free)
            add_by_speed(free, 1, j, K_v, tau, lower)
        clear(free)
        add_minor(rows, COMMAND, COMMAND + 1, n, free)
        add_multiple(free, delta, size, 0, lower)


@kernel
def law_by_speeds(rows, tau, delta, size):
    """U = ℓ̂ v̂ = ℓ̂ Ŷ/δ̂ into the motors' rows: what the observer's rows make of u = −N ξ − K_v v̂."""
    by, error = -1.0 / delta, size / (delta * delta)
    for i in range(2):
        for c in range(rows.shape[1]):
            law, speed = rows[LAW + i, c], rows[SPEED + i, c]
            clear(law)
            add_multiple(speed, by, error, 0, law)
            add_multiple(speed, by * tau[i], error * abs(tau[i]), 1, law)


@entry_point(
    lambda: (
        *examples.plant(),
        examples.trim(),
        examples.given(*CONTROLLER),
        examples.zeros(*WHOLE_ROWS),
        examples.zeros(*WHOLE_MINORS),
        examples.zeros(*WHOLE_POLYNOMIALS),
    )
)
def whole_polynomials(A, inputs, tau, controller, rows, minors, f):
    """The loop's eight polynomials into f, (8, 2, 16), as `layout.WHOLE_CLOSED` and what follows say.

    A (4, 4) and inputs (4, 2), thrust curves' slopes within, of the rig; tau (2,), s; controller (5, 10), as
    `layout.CONTROLLER` says. Scratch: rows and minors.
    """
    keep_apart()
    for r in range(rows.shape[0]):
        for c in range(rows.shape[1]):
            clear(rows[r, c])
    for r in range(WHOLE):
        clear(f[r])
    observed = controller[KIND_ROW, KIND] == OBSERVED
    K_v, own_tau = controller[:2, K_SPEEDS : K_SPEEDS + 2], controller[KIND_ROW, OWN_TAU : OWN_TAU + 2]
    rig_and_law(A, controller, rows)
    adjugate_rows(rows, PLANT, MOTOR, inputs, 0)
    fed_back = K_v[0, 0] != 0.0 or K_v[0, 1] != 0.0 or K_v[1, 0] != 0.0 or K_v[1, 1] != 0.0
    if observed:
        observer = controller[OBSERVER_ROW : OBSERVER_ROW + 2]
        adjugate_rows(rows, GUESS, SPEED, observer, OWN_B)
        for i in range(2):
            for c in range(rows.shape[1]):
                copy_into(rows[LAW + i, c, VALUE], rows[COMMAND + i, c, VALUE])
                copy_into(rows[LAW + i, c, TERMS], rows[COMMAND + i, c, TERMS])
        delta, size = determinant_of(observer, OWN_B)
        observer_minors(rows, K_v, own_tau, delta, size, minors)
        if fed_back:
            law_by_speeds(rows, own_tau, delta, size)
    by_speeds = fed_back and not observed
    free, across, rest = minors[FREE], f[WHOLE_ACROSS : WHOLE_ACROSS + 2], minors[REST]
    pair_into(rows, PLANT, PLANT + 1, observed, minors, FREE)
    pair_into(rows, MOTOR, LAW + 1, observed, minors, MIXED)
    pair_into(rows, LAW, MOTOR + 1, observed, minors, MIXED + 1)
    pair_into(rows, MOTOR, LAW, observed, minors, CROSSED)
    pair_into(rows, LAW + 1, MOTOR + 1, observed, minors, CROSSED + 1)
    pair_into(rows, LAW, LAW + 1, observed, minors, SAME)
    # what det M is without ℓ, and by ℓ_p or ℓ_y alone
    clear(rest)
    delta, size = determinant_of(inputs, 0)
    add_multiple(minors[SAME], delta, size, 0, rest)
    if by_speeds:
        one, other = K_v[0, 0] * K_v[1, 1], K_v[0, 1] * K_v[1, 0]
        add_multiple(free, one - other, abs(one) + abs(other), 0, rest)
        for i in range(2):
            add_multiple(minors[MIXED + i], K_v[i, i], abs(K_v[i, i]), 0, rest)
            add_multiple(minors[CROSSED + i], -K_v[1 - i, i], abs(K_v[1 - i, i]), 0, rest)
        for i in range(2):
            add_multiple(free, K_v[1 - i, 1 - i], abs(K_v[1 - i, 1 - i]), 0, minors[MIXED + i])
            add_multiple(free, K_v[i, 1 - i], abs(K_v[i, 1 - i]), 0, minors[CROSSED + i])
    closed, both = f[WHOLE_CLOSED], minors[SAME]
    clear(both)
    add_twice_lagged(free, tau[0], tau[1], both)
    add_multiple(both, 1.0, 0.0, 0, closed)
    add_multiple(rest, 1.0, 0.0, 0, closed)
    for i in range(2):
        add_lagged(minors[MIXED + i], tau[i], 1.0, closed)
        add_multiple(both, 1.0, 0.0, 0, f[WHOLE_OPENED + i])
        add_lagged(minors[MIXED + i], tau[i], 1.0, f[WHOLE_OPENED + i])
        add_lagged(minors[CROSSED + i], tau[i], -1.0, across[i])
        for lag in range(2):  # both rotors alike: (1 + τ s)² [D] + (1 + τ s) mixed + rest
            add_multiple(minors[MIXED + i], 1.0, 0.0, 0, f[WHOLE_LAG + lag])
    add_multiple(rest, 1.0, 0.0, 0, f[WHOLE_LAG])
    add_multiple(free, 1.0, 0.0, 0, f[WHOLE_LAG])
    add_multiple(free, 2.0, 0.0, 0, f[WHOLE_LAG + 1])
    add_multiple(free, 1.0, 0.0, 0, f[WHOLE_LAG + 2])
    for r in range(WHOLE):
        for k in range(f.shape[2]):
            if abs(f[r, VALUE, k]) <= ROUNDING * f[r, TERMS, k]:
                f[r, VALUE, k] = 0.0
