"""Exact responses of linear systems on a grid: one matrix exponential, then doubling.

Sources: Higham, Functions of Matrices (2008), 10.3 (scaling and squaring); what is known up to sample k
gives the next k samples by one product with the k-th power of the step's matrix.
"""

from __future__ import annotations

from .jit import keep_apart, kernel
from .layout import PLAIN

TERMS = 16
"""Of the exponential's series; with a norm of at most 1/2 the first one left out is below 1e-19."""


@kernel
def exact_response(size, M, dt, outputs, w, states, traces):
    """x_k = exp(M dt)ᵏ x₀ into `states`, (n, samples), from its first column; y_k = `outputs` x_k.

    The last state is 1 throughout; n is one more than the size. `outputs` (rows, n), `traces` (rows, samples).
    Scratch: `w`, (7 n, n).
    """
    keep_apart()
    n = len(size) + 1
    samples = states.shape[1]
    power, other = w[6 * n : 7 * n], w[:n]
    matrix_exponential(size, M, dt, power, w)
    done = 1
    while done < samples:
        more = min(done, samples - done)
        next_samples(size, power, states, done, more)
        done += more
        if done < samples:
            matrix_product(size, power, power, other)
            power, other = other, power
    for i in range(outputs.shape[0]):
        row_times_samples(size, outputs[i], states, samples, traces[i], 0)


@kernel
def next_samples(size, power, states, done, more):
    """The next `more` samples: `power` times the first ones."""
    for i in range(len(size)):
        row_times_samples(size, power[i], states, more, states[i], done)
    for k in range(done, done + more):
        states[len(size), k] = 1.0


@kernel
def row_times_samples(size, row, states, count, out, first):
    """`row` times the first `count` samples, whose last state is 1, into `out` from `first` on."""
    if len(size) > PLAIN:
        for k in range(count):
            total = row[len(size)]
            for i in range(len(size)):
                total += row[i] * states[i, k]
            out[first + k] = total
        return
    a, b, c, d, e, f, one = row[0], row[1], row[2], row[3], row[4], row[5], row[6]
    for k in range(count):
        total = a * states[0, k] + b * states[1, k] + c * states[2, k] + d * states[3, k]
        out[first + k] = total + e * states[4, k] + f * states[5, k] + one


@kernel
def matrix_exponential(size, M, dt, result, w):
    """exp(M dt) into `result`, by its series for M dt / 2ˢ, squared s times. Scratch: `w`, (6 n, n)."""
    keep_apart()
    squarings = squarings_needed(size, M, dt)
    exponential_series(size, M, dt * 0.5**squarings, result, w)
    n = len(size) + 1
    scratch = w[:n]
    for _ in range(squarings):
        matrix_product(size, result, result, scratch)
        for i in range(n):
            for j in range(n):
                result[i, j] = scratch[i, j]


@kernel
def squarings_needed(size, M, dt):
    """How often M dt must be halved for a 1-norm of at most 1/2."""
    n = len(size) + 1
    norm = 0.0
    for j in range(n):
        total = 0.0
        for i in range(n):
            total += abs(M[i, j])
        norm = max(norm, total * dt)
    count = 0
    while norm > 0.5 and count < 1000:
        norm *= 0.5
        count += 1
    return count


@kernel
def exponential_series(size, M, factor, result, w):
    """Σ (M `factor`)ⁿ/n! up to n = TERMS into `result`, in four polynomials of degree 3 (Paterson and Stockmeyer)."""
    keep_apart()
    n = len(size) + 1
    A, A2, A3, A4, total, product = (
        w[:n],
        w[n : 2 * n],
        w[2 * n : 3 * n],
        w[3 * n : 4 * n],
        w[4 * n : 5 * n],
        w[5 * n :],
    )
    for i in range(n):
        for j in range(n):
            A[i, j] = M[i, j] * factor
    matrix_product(size, A, A, A2)
    matrix_product(size, A, A2, A3)
    matrix_product(size, A2, A2, A4)
    weight = 1.0  # 1/TERMS!
    for term in range(1, TERMS + 1):
        weight /= term
    for i in range(n):
        for j in range(n):
            total[i, j] = weight * A4[i, j]
    for block in range(3, -1, -1):
        first = 4 * block
        w3 = weight * (first + 4)
        w2 = w3 * (first + 3)
        w1 = w2 * (first + 2)
        weight = w1 * (first + 1)
        for i in range(n):
            for j in range(n):
                total[i, j] += w1 * A[i, j] + w2 * A2[i, j] + w3 * A3[i, j]
            total[i, i] += weight
        if block > 0:
            matrix_product(size, total, A4, product)
            for i in range(n):
                for j in range(n):
                    total[i, j] = product[i, j]
    for i in range(n):
        for j in range(n):
            result[i, j] = total[i, j]


@kernel
def matrix_product(size, A, B, C):
    """A B into C, which is neither."""
    if len(size) > PLAIN:
        for i in range(len(size) + 1):
            row = C[i]
            for j in range(len(size) + 1):
                row[j] = A[i, 0] * B[0, j]
            for k in range(1, len(size) + 1):
                factor = A[i, k]
                for j in range(len(size) + 1):
                    row[j] += factor * B[k, j]
        return
    for i in range(PLAIN + 1):
        a, b, c, d, e, f, g = A[i, 0], A[i, 1], A[i, 2], A[i, 3], A[i, 4], A[i, 5], A[i, 6]
        for j in range(PLAIN + 1):
            total = a * B[0, j] + b * B[1, j] + c * B[2, j] + d * B[3, j]
            C[i, j] = total + e * B[4, j] + f * B[5, j] + g * B[6, j]
