"""The desired poles: two pairs, each closed under conjugation; and matching of pole sets."""

from __future__ import annotations

import cmath
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from .errors import InvalidInputError, UnpairedPolesError
from .signals import Complexes
from .tables import number

LARGEST = 1e5
"""Largest magnitude of a pole's real or imaginary part, rad/s."""
ZERO = 1e-9
"""Real or imaginary parts below this count as 0, rad/s."""


_PAIRS = (("pitch", 0, 1), ("yaw", 2, 3))


@dataclass(frozen=True, repr=False)
class PoleSet:
    """Four desired poles in rad/s: (p₁, p₂) is pitch's pair and (p₃, p₄) yaw's.

    Each pair is two real poles or two conjugates, so that its polynomial, and with it K, is real.

    Raises:
        InvalidInputError: not four finite numbers within ±`LARGEST`.
        UnpairedPolesError: a pair is neither real nor conjugate.
    """

    values: tuple[complex, complex, complex, complex]

    def __init__(self, values: Iterable[complex]) -> None:
        poles = tuple(_checked(p, i) for i, p in enumerate(values))
        if len(poles) != 4:
            raise InvalidInputError(
                f"{len(poles)} poles given, this rig has four",
                field="poles",
                value=len(poles),
                hint="Give four poles: pitch's pair, then yaw's.",
            )
        for axis, i, j in _PAIRS:
            p, q = poles[i], poles[j]
            if abs(p.imag + q.imag) > ZERO or (p.imag and abs(p.real - q.real) > ZERO):
                raise UnpairedPolesError(
                    f"poles {i + 1} and {j + 1} ({axis}'s pair) are {p:g} and {q:g}: "
                    "neither both real nor conjugates",
                    field=f"poles.{j}",
                    value=str(q),
                    hint=f"With pole {i + 1} at {p:g}, pole {j + 1} must be {p.conjugate():g}."
                    if p.imag
                    else "Make both real, or give conjugates.",
                )
        object.__setattr__(self, "values", poles)

    @classmethod
    def dealt(cls, values: Sequence[complex], split: Sequence[Sequence[int]]) -> PoleSet:
        """The poles with those of `split[0]`, by position from 0, as pitch's pair, the others as yaw's.

        Raises:
            InvalidInputError: `split` is not two pairs that name each of 0 … 3 once.
            UnpairedPolesError: it separates conjugates.
        """
        order = [i for pair in split for i in pair]
        if [len(pair) for pair in split] != [2, 2] or sorted(order) != [0, 1, 2, 3] or len(values) != 4:
            raise InvalidInputError(
                f"the split {[list(pair) for pair in split]} does not deal four poles into two pairs",
                field="split",
                value=str([list(pair) for pair in split]),
                hint="Name each of 0, 1, 2, 3 once: [[0, 2], [1, 3]] gives poles 1 and 3 to pitch.",
            )
        return cls(values[i] for i in order)

    def __repr__(self) -> str:
        return f"PoleSet([{', '.join(number(p, 6, minus='-', gap='') for p in self.values)}])"

    @property
    def coefficients(self) -> tuple[float, float, float, float]:
        """(d₁₀, d₁₁, d₂₀, d₂₁) of d₁ = s² + d₁₁ s + d₁₀ with roots p₁, p₂ and d₂ with p₃, p₄."""
        d10, d11 = _quadratic(*self.values[:2])
        d20, d21 = _quadratic(*self.values[2:])
        return d10, d11, d20, d21

    @property
    def array(self) -> Complexes:
        """The poles as a complex array of shape (4,), rad/s."""
        return np.array(self.values)


def _checked(pole: complex, index: int) -> complex:
    if isinstance(pole, bool) or not isinstance(pole, (int, float, complex)) or not cmath.isfinite(pole):
        raise InvalidInputError(
            f"pole {index + 1} is {pole!r}, not a finite number",
            field=f"poles.{index}",
            value=str(pole),
            hint="Give rad/s as a number, or as a complex number.",
        )
    value = complex(pole)
    re, im = value.real, value.imag
    if not (-LARGEST <= re <= LARGEST and -LARGEST <= im <= LARGEST):
        raise InvalidInputError(
            f"pole {index + 1} is {value:g} rad/s, beyond ±{LARGEST:g}",
            field=f"poles.{index}",
            value=str(pole),
            hint=f"Keep real and imaginary part within ±{LARGEST:g} rad/s.",
        )
    return complex(0.0 if -ZERO < re < ZERO else re, 0.0 if -ZERO < im < ZERO else im)


def _quadratic(p: complex, q: complex) -> tuple[float, float]:
    """(d₀, d₁) of (s − p)(s − q) for a conjugate-closed pair, without complex rounding."""
    if p.imag == 0.0:
        return p.real * q.real, -(p.real + q.real)
    return p.real**2 + p.imag**2, -2.0 * p.real


def match_poles(wanted: Sequence[complex] | Complexes, found: Sequence[complex] | Complexes) -> list[int]:
    """One-to-one matching of two pole sets that keeps the largest distance smallest.

    Returns:
        For each of `wanted`, the index in `found` of its partner (bottleneck assignment: the
        smallest threshold under which a perfect matching exists, by augmenting paths).
    """
    a, b = [poles.tolist() if isinstance(poles, np.ndarray) else list(poles) for poles in (wanted, found)]
    if len(a) != len(b):
        raise ValueError(f"{len(a)} and {len(b)} poles cannot be matched")
    rows = [[abs(p - q) for q in b] for p in a]
    nearest = [row.index(min(row)) for row in rows]
    if len(set(nearest)) == len(nearest):  # each has its nearest: no matching can do better
        return nearest
    distance = np.array(rows)
    levels = np.unique(distance)
    low, high = 0, len(levels) - 1
    while low < high:
        middle = (low + high) // 2
        if _perfect_matching(distance <= levels[middle]) is None:
            low = middle + 1
        else:
            high = middle
    matching = _perfect_matching(distance <= levels[low])
    if matching is None:
        raise ValueError("pole sets that are not finite cannot be matched")
    return matching


def pole_error(wanted: Sequence[complex] | Complexes, found: Sequence[complex] | Complexes) -> float:
    """Largest distance of two pole sets, matched one to one, in their unit (rad/s)."""
    order = match_poles(wanted, found)
    return float(np.max(np.abs(np.asarray(wanted) - np.asarray(found)[order])))


def _perfect_matching(allowed: np.ndarray) -> list[int] | None:
    n = len(allowed)
    partner = [-1] * n  # column → row

    def augment(row: int, seen: set[int]) -> bool:
        for column in range(n):
            if allowed[row, column] and column not in seen:
                seen.add(column)
                if partner[column] < 0 or augment(partner[column], seen):
                    partner[column] = row
                    return True
        return False

    if not all(augment(row, set()) for row in range(n)):
        return None
    return [partner.index(row) for row in range(n)]
