"""Eigenvalues of a real matrix: balanced, brought to Hessenberg form by reflections, then by Francis' double steps.

Parlett and Reinsch, Numer. Math. 13 (1969) 293–304, with the stopping rule of James, Langou and Lowery, arXiv
1401.5766 (2014), so that balancing never makes a matrix worse; Golub and Van Loan, Matrix Computations, 4th ed.
(2013), sections 7.4 and 7.5. Backward stable: what comes out are eigenvalues of a matrix that differs by a few
roundings of its norm.
"""

from __future__ import annotations

from math import hypot, sqrt

from . import examples
from .jit import entry_point, keep_apart, kernel

EPS = 2.0**-52
RADIX = 2.0
ENOUGH = 0.95**0.5
"""A change of units that makes less than this of a row and a column is made."""
SWEEPS = 20
"""Most rounds of balancing; two or three are common."""
STEPS = 60
"""Most double steps for one eigenvalue or pair; two or three are common, and every tenth is an exceptional one."""


@entry_point(lambda: (examples.zeros(4, 4), examples.zeros(4), examples.zeros(4), examples.zeros(4)))
def eigenvalues(a, real, imaginary, v):
    """Fills `real` and `imaginary` with the eigenvalues of `a`, conjugates together, + first; False where it fails.

    a: n×n, overwritten. Scratch: v, (n,).
    """
    keep_apart()
    if not in_range(a):
        return False
    balance(a, v)
    to_hessenberg(a, v, a[:0])
    return francis(a, real, imaginary, a[:0])


@kernel
def in_range(a):
    """Whether all entries are numbers that may be squared and added."""
    for i in range(len(a)):
        for j in range(len(a)):
            if not abs(a[i, j]) < 1e300:
                return False
    return True


@kernel
def balance(a, units):
    """D⁻¹ a D, powers of 2 in D, so that rows and columns are of like size in the 2-norm; `units`: D's diagonal."""
    keep_apart()
    n = len(a)
    for i in range(n):
        units[i] = 1.0
    for _ in range(SWEEPS):
        settled = True
        for i in range(n):
            column = row = most_column = most_row = 0.0
            for j in range(n):
                if j != i:
                    most_column = max(most_column, abs(a[j, i]))
                    most_row = max(most_row, abs(a[i, j]))
            if most_column == 0.0 or most_row == 0.0:
                continue
            for j in range(n):
                if j != i:
                    column += (a[j, i] / most_column) ** 2
                    row += (a[i, j] / most_row) ** 2
            column, row = most_column * sqrt(column), most_row * sqrt(row)
            before, factor = hypot(column, row), 1.0
            while column < row / RADIX:
                column *= RADIX
                row /= RADIX
                factor *= RADIX
            while column >= row * RADIX:
                column /= RADIX
                row *= RADIX
                factor /= RADIX
            if hypot(column, row) < ENOUGH * before:
                settled = False
                units[i] *= factor
                for j in range(n):
                    a[i, j] /= factor
                for j in range(n):
                    a[j, i] *= factor
        if settled:
            return


@kernel
def to_hessenberg(a, v, z):
    """Zeros below the first subdiagonal, by reflections I − 2 v vᵀ on both sides; what z has by columns turns, too.

    z: n×n, or without rows where nobody wants it.
    """
    keep_apart()
    n = len(a)
    for k in range(n - 2):
        size = 0.0
        for i in range(k + 1, n):
            size = max(size, abs(a[i, k]))
        if size == 0.0:
            continue
        total = 0.0
        for i in range(k + 1, n):
            v[i] = a[i, k] / size
            total += v[i] * v[i]
        length = sqrt(total)
        if v[k + 1] < 0.0:
            length = -length
        total += length * v[k + 1]  # half of |v|² once the length is added
        if total == 0.0:
            continue
        v[k + 1] += length
        for j in range(k, n):
            product = 0.0
            for i in range(k + 1, n):
                product += v[i] * a[i, j]
            product /= total
            for i in range(k + 1, n):
                a[i, j] -= product * v[i]
        for i in range(n):
            product = 0.0
            for j in range(k + 1, n):
                product += a[i, j] * v[j]
            product /= total
            for j in range(k + 1, n):
                a[i, j] -= product * v[j]
        for i in range(len(z)):
            product = 0.0
            for j in range(k + 1, n):
                product += z[i, j] * v[j]
            product /= total
            for j in range(k + 1, n):
                z[i, j] -= product * v[j]
        for i in range(k + 2, n):
            a[i, k] = 0.0


@kernel
def francis(h, real, imaginary, z):
    """The eigenvalues of a Hessenberg matrix; False where one does not come out.

    It becomes a triangle with two by two blocks on its diagonal (real Schur form), each of them a pair, and z, n×n or
    without rows, is multiplied by what has turned it.
    """
    keep_apart()
    n = len(h)
    norm = 0.0
    for i in range(n):
        for j in range(max(0, i - 1), n):
            norm = max(norm, abs(h[i, j]))
    end, steps = n - 1, 0
    while end >= 0:
        start = end
        while start > 0:
            beside = abs(h[start - 1, start - 1]) + abs(h[start, start])
            if beside == 0.0:
                beside = norm
            if abs(h[start, start - 1]) <= EPS * beside:
                h[start, start - 1] = 0.0
                break
            start -= 1
        if start == end:
            real[end], imaginary[end] = h[end, end], 0.0
            end, steps = end - 1, 0
        elif start == end - 1:
            pair_of(h, end, real, imaginary)
            end, steps = end - 2, 0
        else:
            if steps == STEPS:
                return False
            steps += 1
            double_step(h, start, end, steps, z)
    return True


@kernel
def pair_of(h, end, real, imaginary):
    """The eigenvalues of the two by two block that ends at `end`."""
    a, b, c, d = h[end - 1, end - 1], h[end - 1, end], h[end, end - 1], h[end, end]
    half = 0.5 * (a - d)
    size = max(abs(half), sqrt(abs(b)) * sqrt(abs(c)))
    under = (half / size) * (half / size) + (b / size) * (c / size) if size > 0.0 else 0.0
    root = size * sqrt(abs(under))
    if under >= 0.0:
        # the one farther from d is added up, the other follows from the product: neither loses digits
        far = half + root if half >= 0.0 else half - root
        real[end - 1] = d + far
        real[end] = d - b * c / far if far != 0.0 else d
        imaginary[end - 1] = imaginary[end] = 0.0
    else:
        real[end - 1] = real[end] = d + half
        imaginary[end - 1], imaginary[end] = root, -root


@kernel
def double_step(h, start, end, steps, z):
    """One implicit double step on the block from `start` to `end`, of three rows or more; z turns as in `francis`."""
    n = len(h)
    corner = h[end, end]
    if steps % 10 == 0:  # an exceptional one breaks cycles
        s = abs(h[end, end - 1]) + abs(h[end - 1, end - 2])
        shift = 0.75 * s + corner
        total, product = 2.0 * shift, shift * shift + 0.4375 * s * s
    else:
        half, mean = 0.5 * (h[end - 1, end - 1] - corner), 0.5 * (h[end - 1, end - 1] + corner)
        under = half * half + h[end - 1, end] * h[end, end - 1]
        total, product = 2.0 * mean, mean * mean - under
        if under > 0.0:  # of two real ones the nearer to the corner, twice
            shift = mean - sqrt(under) if half > 0.0 else mean + sqrt(under)
            total, product = 2.0 * shift, shift * shift
    a = h[start, start] * (h[start, start] - total) + h[start, start + 1] * h[start + 1, start] + product
    b = h[start + 1, start] * (h[start, start] + h[start + 1, start + 1] - total)
    c = h[start + 1, start] * h[start + 2, start + 1]
    for k in range(start, end):
        last = k == end - 1
        size = abs(a) + abs(b) + (0.0 if last else abs(c))
        if size > 0.0:
            p, q, r = a / size, b / size, 0.0 if last else c / size
            length = sqrt(p * p + q * q + r * r)
            if p < 0.0:
                length = -length
            p += length
            half = length * p  # of |v|²
            if k > start:
                h[k, k - 1] = -length * size
                h[k + 1, k - 1] = 0.0
                if not last:
                    h[k + 2, k - 1] = 0.0
            for j in range(k, n):
                along = p * h[k, j] + q * h[k + 1, j]
                if not last:
                    along += r * h[k + 2, j]
                along /= half
                h[k, j] -= along * p
                h[k + 1, j] -= along * q
                if not last:
                    h[k + 2, j] -= along * r
            for i in range(min(end, k + 3) + 1):
                along = p * h[i, k] + q * h[i, k + 1]
                if not last:
                    along += r * h[i, k + 2]
                along /= half
                h[i, k] -= along * p
                h[i, k + 1] -= along * q
                if not last:
                    h[i, k + 2] -= along * r
            for i in range(len(z)):
                along = p * z[i, k] + q * z[i, k + 1]
                if not last:
                    along += r * z[i, k + 2]
                along /= half
                z[i, k] -= along * p
                z[i, k + 1] -= along * q
                if not last:
                    z[i, k + 2] -= along * r
        if not last:
            a, b = h[k + 1, k], h[k + 2, k]
            c = h[k + 3, k] if k < end - 2 else 0.0
