"""Exact responses of linear systems on a grid: one matrix exponential, then doubling.

Sources: Higham, Functions of Matrices (2008), 10.3 (scaling and squaring); what is known up to sample k
gives the next k samples by one product with the k-th power of the step's matrix.
"""

from __future__ import annotations

from ..layout import AUGMENTED
from .jit import kernel

TERMS = 16
"""Of the exponential's series; with a norm of at most 1/2 the first one left out is below 1e-19."""


@kernel
def respond(M, dt, outputs, w, states, traces):
    """x_k = exp(M dt)ᵏ x₀ into `states`, (7, samples), from its first column; y_k = `outputs` x_k.

    The last state is 1 throughout. `outputs` (rows, 7), `traces` (rows, samples). Scratch: `w`, (21, 7).
    """
    samples = states.shape[1]
    power, other = w[:AUGMENTED], w[AUGMENTED : 2 * AUGMENTED]
    exponential(M, dt, power, other, w[2 * AUGMENTED : 3 * AUGMENTED])
    done = 1
    while done < samples:
        more = min(done, samples - done)
        extend(power, states, done, more)
        done += more
        if done < samples:
            multiply(power, power, other)
            power, other = other, power
    for i in range(outputs.shape[0]):
        combine(outputs[i], states, samples, traces[i], 0)


@kernel
def extend(power, states, done, more):
    """The next `more` samples: `power` times the first ones."""
    for i in range(AUGMENTED - 1):
        combine(power[i], states, more, states[i], done)
    for k in range(done, done + more):
        states[AUGMENTED - 1, k] = 1.0


@kernel
def combine(row, states, count, out, first):
    """`row` times the first `count` samples, whose last state is 1, into `out` from `first` on."""
    a, b, c, d, e, f, one = row[0], row[1], row[2], row[3], row[4], row[5], row[6]
    for k in range(count):
        total = a * states[0, k] + b * states[1, k] + c * states[2, k] + d * states[3, k]
        out[first + k] = total + e * states[4, k] + f * states[5, k] + one


@kernel
def exponential(M, dt, result, scaled, scratch):
    """exp(M dt) into `result`, by its series for M dt / 2ˢ, squared s times."""
    norm = 0.0
    for j in range(AUGMENTED):
        total = 0.0
        for i in range(AUGMENTED):
            total += abs(M[i, j])
        norm = max(norm, total * dt)
    squarings = 0
    while norm > 0.5 and squarings < 1000:
        norm *= 0.5
        squarings += 1
    factor = dt * 0.5**squarings
    for i in range(AUGMENTED):
        for j in range(AUGMENTED):
            scaled[i, j] = M[i, j] * factor
            result[i, j] = scaled[i, j] / TERMS + (1.0 if i == j else 0.0)
    for term in range(TERMS - 1, 0, -1):
        multiply(scaled, result, scratch)
        for i in range(AUGMENTED):
            for j in range(AUGMENTED):
                result[i, j] = scratch[i, j] / term + (1.0 if i == j else 0.0)
    for _ in range(squarings):
        multiply(result, result, scratch)
        for i in range(AUGMENTED):
            for j in range(AUGMENTED):
                result[i, j] = scratch[i, j]


@kernel
def multiply(A, B, C):
    """A B into C, which is neither."""
    for i in range(AUGMENTED):
        for j in range(AUGMENTED):
            C[i, j] = 0.0
        for k in range(AUGMENTED):
            a = A[i, k]
            for j in range(AUGMENTED):
                C[i, j] += a * B[k, j]
