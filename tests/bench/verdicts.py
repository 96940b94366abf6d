"""Random systems in units 1e±6 apart, nearly singular ones and multiple poles: is any verdict wrong?

    python -m tests.bench.verdicts [systems of each kind] [seed]

Judges are mpmath with 100 digits and exact ranks over the rationals; every kind's function returns what is wrong.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace

import mpmath
import numpy as np
from scipy.linalg import block_diag
from sympy import QQ
from sympy.polys.matrices import DomainMatrix

from heli2dof_core import (
    Heli2DofError,
    InvalidInputError,
    MethodUnavailableError,
    PoleSet,
    Spec,
    Structure,
    UncontrollableError,
    Weights,
    match_poles,
    place,
    place_poles,
    relative_gain_array,
)
from heli2dof_core.rank import numeric_rank
from heli2dof_core.walkthrough import walk_through

DIGITS = 100
STRUCTURES = [
    Structure("triangular", "pitch"),
    Structure("triangular", "yaw"),
    Structure("input-diagonal"),
    Structure("axis-decoupled"),
    Structure("triangular", "pitch", 0.5),
    Structure("triangular", "yaw", -2.0),
    Structure("input-diagonal", shift=0.5),
]


def exact_rank(matrix: np.ndarray) -> int:
    rows = [[QQ(*float(x).as_integer_ratio()) for x in row] for row in matrix]
    return DomainMatrix(rows, matrix.shape, QQ).rank()


def powers(rng: np.random.Generator, n: int) -> np.ndarray:
    """Units as powers of 2, within 1e±6: scaling by them rounds nothing."""
    return 2.0 ** rng.integers(-20, 21, n)


def true_poles(A: np.ndarray, B: np.ndarray, K: np.ndarray) -> list:
    with mpmath.workdps(DIGITS):
        closed = mpmath.matrix(A.tolist()) - mpmath.matrix(B.tolist()) * mpmath.matrix(K.tolist())
        return [closed[0, 0]] if len(A) == 1 else list(mpmath.eig(closed, left=False, right=False))


def farthest(poles, found: list) -> float:
    """Largest distance of two pole sets, in mpmath's digits."""
    order = match_poles(list(map(complex, poles)), [complex(p) for p in found])
    with mpmath.workdps(DIGITS):
        pairs = zip(poles, order, strict=True)
        return max(float(abs(mpmath.mpc(complex(p)) - found[i])) for p, i in pairs)


def ranks(rng: np.random.Generator) -> str:
    """Integer matrices of any rank in any units; and their relative gains."""
    n, m = rng.integers(1, 7, 2)
    r = int(rng.integers(0, min(n, m) + 1))
    G = (rng.integers(-5, 6, (n, r)) @ rng.integers(-5, 6, (r, m))).astype(float)
    G = G * powers(rng, n)[:, None] * powers(rng, m)
    if rng.random() < 0.5:  # and with every entry rounded
        G = G / 3.0 if exact_rank(G) == min(n, m) else G
    if numeric_rank(G) != exact_rank(G):
        return f"rank {numeric_rank(G)} of {G.tolist()}"
    if n == m:
        try:
            rga = relative_gain_array(G)
        except InvalidInputError:
            return "" if exact_rank(G) < n else f"refused: {G.tolist()}"
        with mpmath.workdps(DIGITS):
            inverse = mpmath.matrix(G.tolist()) ** -1
            true = np.array([[float(G[i, j] * inverse[j, i]) for j in range(n)] for i in range(n)])
        if exact_rank(G) < n or not np.allclose(rga, true, rtol=1e-6, atol=1e-9 * np.max(np.abs(true))):
            return f"RGA of {G.tolist()}"
    return ""


def placed(rng: np.random.Generator) -> str:
    """Any method on systems in any units, with multiple poles, some nearly uncontrollable: the pole error told."""
    n = int(rng.integers(1, 6))
    p = int(rng.integers(1, min(n, 2) + 1))
    A, B = rng.normal(size=(n, n)), rng.normal(size=(n, p))
    if rng.random() < 0.3 and n > 1:  # an input near an eigenvector
        B = np.linalg.eig(A)[1][:, :p].real + 10.0 ** rng.uniform(-9, -3) * rng.normal(size=(n, p))
    units, seconds = powers(rng, n), float(powers(rng, 1)[0])
    A, B = seconds * A * units / units[:, None], seconds * B / units[:, None] * powers(rng, p)
    poles = -np.round(rng.uniform(0.5, 5, n), 2)
    if rng.random() < 0.4:
        poles[:] = poles[0]
    elif rng.random() < 0.4:
        poles[: n // 2] = poles[0]
    poles = seconds * poles
    name = str(rng.choice(["full-rank", "ackermann", "bass-gura", "varga", "tits-yang", "knv0"]))
    try:
        own = place_poles(A, B, poles, name)
    except Heli2DofError as error:
        return "" if str(error) else "refused without a word"
    found = true_poles(A, B, own.placement.K)
    true, size = farthest(poles, found), float(np.max(np.abs(poles)))
    gap = abs(own.pole_error - true)
    if gap > own.pole_error_bound + 1e-12 * size:
        return f"{name}: told {own.pole_error:.3g} ± {own.pole_error_bound:.1g}, true {true:.3g}"
    if farthest(own.closed_loop_poles, found) > max(own.pole_error_bound, 1e-12 * size):
        return f"{name}: poles told are off"
    told = "pole_error" in {f.code for f in own.findings}
    return f"{name}: finding {told}, true error {true / size:.2g}" if told != (true > 1e-6 * size) else ""


def single_input(rng: np.random.Generator) -> str:
    """Jordan blocks behind two inputs, in any units: one input can do it if no eigenvalue has two blocks."""
    sizes = rng.integers(1, 3, int(rng.integers(2, 4)))
    values = rng.integers(-1, 2, len(sizes)).astype(float)
    n = int(np.sum(sizes))
    A = block_diag(
        *(v * np.eye(size) + np.diag(np.ones(size - 1), 1) for size, v in zip(sizes, values, strict=True))
    )
    lower = np.tril(rng.integers(-2, 3, (n, n)), -1) + np.eye(n)
    inverse = np.rint(np.linalg.inv(lower))
    units = powers(rng, n)
    A = (lower @ A @ inverse) * units / units[:, None]
    B = rng.normal(size=(n, 2)) / units[:, None]
    blocks = max(int(np.sum(values == value)) for value in values)
    if blocks > 2:  # not controllable by two inputs either
        return ""
    for name in ("ackermann", "bass-gura"):
        try:
            place_poles(A, B, -np.arange(1.0, n + 1), name)
        except MethodUnavailableError as error:
            if blocks == 1 or f"{blocks} independent" not in str(error):
                return f"{name} refused {sizes} {values}: {error}"
        except UncontrollableError as error:
            return f"{name}: {error}"
        else:
            if blocks > 1:
                return f"{name} took {sizes} {values}"
    return ""


def regulated(rng: np.random.Generator) -> str:
    """Chains, oscillators and unstable modes, some out of reach, some without weight: is LQR rightly refused?"""
    blocks = [
        np.array([[0.0, 1], [0, 0]]),
        np.array([[0.0, 1], [-4, 0]]),
        np.array([[1.0]]),
        np.array([[-1.0]]),
        np.array([[0.0]]),
    ]
    chosen = [blocks[i] for i in rng.integers(0, len(blocks), int(rng.integers(1, 4)))]
    n = sum(len(block) for block in chosen)
    A = block_diag(*chosen)
    B = rng.integers(-2, 3, (n, int(rng.integers(1, min(n, 2) + 1)))).astype(float)
    if not np.all(np.any(B, axis=0)) or exact_rank(B) < B.shape[1]:
        return ""
    Q = rng.choice([0.0, 1.0, 1e-4], n)
    units = powers(rng, n)
    A, B, Q = A * units / units[:, None], B / units[:, None], Q * units**2
    with mpmath.workdps(DIGITS):
        H = mpmath.zeros(2 * n)
        for i in range(n):
            for j in range(n):
                H[i, j], H[n + i, n + j] = A[i, j], -A[j, i]
                H[i, n + j] = -sum(mpmath.mpf(B[i, k]) * B[j, k] for k in range(B.shape[1]))
            H[n + i, i] = -mpmath.mpf(float(Q[i]))
        values = mpmath.eig(H, left=False, right=False)
        on_axis = min(float(abs(mpmath.re(v))) for v in values) < 1e-12
        stable = [v for v in values if mpmath.re(v) < 0]
    growing = {value for value in np.diag(A).tolist() if value > 0}
    reached = all(exact_rank(np.hstack([A - value * np.eye(n), B])) == n for value in growing)
    exists = reached and not on_axis
    try:
        own = place_poles(A, B, -np.ones(n), "lqr", weights=Weights(tuple(Q), (1.0,) * B.shape[1]))
    except MethodUnavailableError as error:
        return f"refused {A.tolist()} {B.tolist()} {Q}: {error}" if exists else ""
    if not exists:
        return f"took {A.tolist()} {B.tolist()} {Q}"
    gap = farthest(own.closed_loop_poles, stable)
    return f"poles off by {gap:.2g}" if gap > 1e-5 else ""


def rigs(rng: np.random.Generator) -> str:
    """Rigs whose motors push nearly alike, or hardly, in every structure, shifted or not."""
    spec = Spec.from_preset()
    p, kind = spec.parameters, rng.integers(3)
    if kind == 0:
        p = p.replaced({"K_yy": p.K_py * p.K_yp / p.K_pp * (1 + 10.0 ** rng.uniform(-9.5, -1))})
    elif kind == 1:
        name = str(rng.choice(["K_pp", "K_py", "K_yp", "K_yy"]))
        p = p.replaced({name: float(rng.choice([-1, 0, 1])) * 10.0 ** rng.uniform(-15, -3)})
    else:
        factor = 10.0 ** rng.uniform(-70, 5)
        p = p.replaced({name: getattr(p, name) * factor for name in ("K_pp", "K_py", "K_yp", "K_yy")})
    structure = STRUCTURES[rng.integers(len(STRUCTURES))]
    poles = -np.round(10.0 ** rng.uniform(-1, 2, 4), 3)
    if rng.random() < 0.3:
        poles[:] = poles[0]
    try:
        own = place(replace(spec, parameters=p, structure=structure, poles=PoleSet(poles.tolist())))
    except Heli2DofError as error:
        return "" if str(error) else "refused without a word"
    if not np.all(np.isfinite(own.K)) or walk_through(own).K_bar is None:
        return f"K of {p} {structure}"
    found = true_poles(own.plant.A, own.plant.B, own.K)
    true, size = farthest(poles, found), float(np.max(np.abs(poles)))
    if abs(own.pole_error - true) > own.pole_error_bound + 1e-12 * size:
        return f"told {own.pole_error:.3g} ± {own.pole_error_bound:.1g}, true {true:.3g}"
    return ""


KINDS: dict[str, Callable[[np.random.Generator], str]] = {
    kind.__name__: kind for kind in (ranks, placed, single_input, regulated, rigs)
}


def wrong(kind: str, count: int, seed: int = 0) -> list[str]:
    """What was wrong in `count` random systems of a kind."""
    rng = np.random.default_rng([seed, list(KINDS).index(kind)])
    return [f"{i}: {words}" for i in range(count) if (words := KINDS[kind](rng))]


if __name__ == "__main__":
    count, seed = int((sys.argv[1:] or ["1000"])[0]), int((sys.argv[2:] or ["0"])[0])
    for kind in KINDS:
        bad = wrong(kind, count, seed)
        print(f"{kind}: {len(bad)} of {count} wrong", *bad[:5], sep="\n  ")
