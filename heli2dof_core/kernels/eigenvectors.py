"""Eigenvectors of a real matrix from its Schur form, and how far rounding can move its eigenvalues.

Golub and Van Loan, Matrix Computations, 4th ed. (2013), section 7.6.4 (back substitution); Bauer and Fike, Numer.
Math. 2 (1960) 137 (an eigenvalue moves by κ(V) ‖E‖ at most); Demmel and Veselić, SIAM J. Matrix Anal. Appl. 13 (1992)
1204 (one-sided Jacobi: small singular values keep their digits).
"""

from __future__ import annotations

from math import nan, sqrt

from .eigenvalues import EPS
from .jit import keep_apart, kernel

SWEEPS = 40
"""Most rounds of rotations; five or six are common."""


@kernel
def schur_vectors(t, z, real, imaginary, y, vectors):
    """Eigenvectors of length 1 into the first n columns of `vectors`, complex.

    t: n×n, real Schur form as `eigenvalues.francis` leaves it; z: n×n, what turned the matrix into it; `real` and
    `imaginary`: (n,). Scratch: y, complex, (n,).
    """
    keep_apart()
    n = len(t)
    norm = 0.0
    for i in range(n):
        for j in range(n):
            norm = max(norm, abs(t[i, j]))
    least = max(EPS * norm, 1e-290)
    k = 0
    while k < n:
        last = k + 1 if k + 1 < n and t[k + 1, k] != 0.0 else k  # a block of two, complex or real
        for own in range(k, last + 1):
            if imaginary[own] < 0.0:
                for i in range(n):
                    vectors[i, own] = vectors[i, own - 1].conjugate()
                continue
            value = complex(real[own], imaginary[own])
            for i in range(n):
                y[i] = 0.0
            y[k] = 1.0
            if last > k:
                # of the block's two rows the larger one tells its null vector
                if abs(t[k, k] - value) + abs(t[k, last]) >= abs(t[last, last] - value) + abs(t[last, k]):
                    y[k], y[last] = t[k, last], value - t[k, k]
                else:
                    y[k], y[last] = value - t[last, last], t[last, k]
            substitute(t, value, k, least, y)
            total = 0.0
            for i in range(n):
                entry = complex(0.0, 0.0)
                for j in range(last + 1):
                    entry += z[i, j] * y[j]
                vectors[i, own] = entry
                total += squared(entry)
            for i in range(n):
                vectors[i, own] /= sqrt(total)
        k = last + 1


@kernel
def substitute(t, value, k, least, y):
    """Solves (T − λ) y = 0 upwards from row k − 1, what stands from k on being known."""
    n = len(t)
    row = k - 1
    while row >= 0:
        block = row > 0 and t[row, row - 1] != 0.0
        top = row - 1 if block else row
        one = other = complex(0.0, 0.0)
        for j in range(row + 1, n):
            one -= t[row, j] * y[j]
            if block:
                other -= t[top, j] * y[j]
        if block:
            a, b, c, d = t[top, top] - value, t[top, row], t[row, top], t[row, row] - value
            determinant = a * d - b * c
            floor = least * (abs(a) + abs(b) + abs(c) + abs(d))
            if abs(determinant) < floor:
                determinant = complex(floor, 0.0)
            y[top] = (other * d - b * one) / determinant
            y[row] = (a * one - c * other) / determinant
        else:
            under = t[row, row] - value
            if abs(under) < least:
                under = complex(least, 0.0)
            y[row] = one / under
        size = 0.0
        for j in range(top, n):
            size = max(size, abs(y[j].real) + abs(y[j].imag))
        if size > 1e100:
            for j in range(top, n):
                y[j] /= size
        row = top - 1


@kernel
def squared(z):
    """|z|²."""
    return z.real * z.real + z.imag * z.imag


@kernel
def condition_in_frobenius_norm(n, vectors, work):
    """‖V‖ ‖V⁻¹‖ of the first n rows and columns; infinite where V is singular. Scratch: `work`, complex, n×n."""
    keep_apart()
    size = total = 0.0
    for i in range(n):
        for j in range(n):
            work[i, j] = vectors[i, j]
            size += squared(vectors[i, j])
    if not invert(n, work):
        return float("inf")
    for i in range(n):
        for j in range(n):
            total += squared(work[i, j])
    return sqrt(size) * sqrt(total)


@kernel
def invert(n, a):
    """The inverse in place, by Gauss and Jordan, the rows scaled to pivots; False where it is singular.

    Full pivoting, so that the order of columns undoes itself at the end.
    """
    for step in range(n):
        # rows and columns before `step` are done
        best, r, c = 0.0, step, step
        for i in range(step, n):
            for j in range(step, n):
                if squared(a[i, j]) > best:
                    best, r, c = squared(a[i, j]), i, j
        if best == 0.0:
            return False
        # the exchanges are kept in the last rows of a, n×2 integers as numbers
        a[n, step] = complex(float(r), float(c))
        for j in range(n):
            a[step, j], a[r, j] = a[r, j], a[step, j]
        for i in range(n):
            a[i, step], a[i, c] = a[i, c], a[i, step]
        pivot = 1.0 / a[step, step]
        a[step, step] = complex(1.0, 0.0)
        for j in range(n):
            a[step, j] *= pivot
        for i in range(n):
            if i != step:
                factor = a[i, step]
                a[i, step] = complex(0.0, 0.0)
                for j in range(n):
                    a[i, j] -= factor * a[step, j]
    for step in range(n - 1, -1, -1):
        r, c = int(a[n, step].real), int(a[n, step].imag)
        for i in range(n):
            a[i, step], a[i, r] = a[i, r], a[i, step]
        for j in range(n):
            a[step, j], a[c, j] = a[c, j], a[step, j]
    return True


@kernel
def condition_in_2_norm(n, a):
    """κ₂ of the first n rows and columns of a, complex, which are overwritten; NaN where it is 1/EPS or more."""
    keep_apart()
    for _ in range(SWEEPS):
        settled = True
        for p in range(n - 1):
            for q in range(p + 1, n):
                alpha = beta = 0.0
                gamma = complex(0.0, 0.0)
                for i in range(n):
                    alpha += squared(a[i, p])
                    beta += squared(a[i, q])
                    gamma += a[i, p].conjugate() * a[i, q]
                size = abs(gamma)
                if size <= EPS * sqrt(alpha * beta) or size == 0.0:
                    continue
                settled = False
                zeta = (beta - alpha) / (2.0 * size)
                tangent = (1.0 if zeta >= 0.0 else -1.0) / (abs(zeta) + sqrt(1.0 + zeta * zeta))
                cosine = 1.0 / sqrt(1.0 + tangent * tangent)
                sine = cosine * tangent
                phase = gamma.conjugate() / size
                for i in range(n):
                    one, other = a[i, p], a[i, q] * phase
                    a[i, p] = cosine * one - sine * other
                    a[i, q] = sine * one + cosine * other
        if settled:
            break
    largest, smallest = 0.0, float("inf")
    for j in range(n):
        total = 0.0
        for i in range(n):
            total += squared(a[i, j])
        largest, smallest = max(largest, total), min(smallest, total)
    if not smallest > 0.0:
        return nan
    condition = sqrt(largest / smallest)
    return condition if condition < 1.0 / EPS else nan
