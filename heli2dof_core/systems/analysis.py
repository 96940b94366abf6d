"""What can be said of a system before anything is designed: modes, zeros, indices, canonical form, relative gains."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..controllability import Reach, in_own_units, reach
from ..errors import InvalidInputError
from ..findings import Finding
from ..frozen import Frozen
from ..placement.assess import NEARLY_DEPENDENT
from ..placement.full_rank import canonical
from ..rank import numeric_rank
from ..relative_gains import niederlinski_index, relative_gain_array
from ..signals import Complexes, Floats
from ..tables import Shown, Table, number
from ..tables import poles as pole_words
from .model import System
from .zeros import invariant_zeros

AXIS = 1e-9
"""Poles whose real part is less than this share of the largest one lie on the imaginary axis."""


@dataclass(frozen=True)
class Pair(Frozen):
    """How far the inputs reach; of (Aᵀ, Cᵀ) what the outputs tell.

    Attributes:
        indices: controllability indices, one per input; of the outputs observability indices.
        reached: dimension of what is reached.
        lost: the modes that are not, 1/s.
        weakest: smallest singular value that a kept column of the scan left, between 0 and 1.
        nearest: of the modes of A the one that is hardest to reach.
        distance: there the smallest singular value of [sI − A, B] in units of its own (Popov, Belevitch, Hautus): 0
            where the mode is not reached.
    """

    indices: tuple[int, ...]
    reached: int
    lost: Complexes
    weakest: float
    nearest: complex
    distance: float


@dataclass(frozen=True, repr=False)
class Analysis(Frozen, Shown):
    """A system looked at.

    Attributes:
        system: the system.
        poles: eigenvalues of A, rad/s, by real part.
        zeros: invariant zeros, rad/s (`zeros`).
        stable: whether all poles have negative real parts.
        inputs, outputs: controllability, and observability where C was given.
        T, Q, M: Luenberger's transformation x̄ = Tx, the nonzero rows of TB, and the columns of the controllability
            matrix that were kept, M = [b₁ … A^(σ₁−1)b₁ | b₂ …]; None where (A, B) is not controllable.
        dc_gain: Ĝ(0), q×p; None where A has an eigenvalue 0.
        rga: at ω = 0, None where it does not exist.
        niederlinski: index of the diagonal pairing.
        findings: remarks.
    """

    system: System
    poles: Complexes
    zeros: Complexes
    stable: bool
    inputs: Pair
    outputs: Pair | None
    T: Floats | None
    Q: Floats | None
    M: Floats | None
    dc_gain: Floats | None
    rga: Floats | None
    niederlinski: float | None
    findings: tuple[Finding, ...]

    def summary(self) -> str:
        """Size, poles, zeros, indices."""
        n, p, q = self.system.sizes
        zeros = pole_words(self.zeros.tolist()) or "none"
        indices = ", ".join(map(str, self.inputs.indices))
        return (
            f"{n} states, {p} inputs, {q} outputs; poles {pole_words(self.poles.tolist())}; zeros {zeros}; "
            f"controllability indices {indices}"
        )

    def tables(self) -> tuple[Table, ...]:
        """T, Q, and the relative gains."""
        n, p, q = self.system.sizes
        states, inputs, outputs = (
            [f"{letter}{i + 1}" for i in range(k)] for letter, k in zip("xuy", (n, p, q), strict=True)
        )
        found = []
        if self.T is not None and self.Q is not None:
            found += [
                Table.matrix("T, x̄ = Tx", self.T, [f"x̄{i + 1}" for i in range(n)], states),
                Table.matrix("Q", self.Q, inputs, inputs),
            ]
        if self.rga is not None:
            found.append(Table.matrix("RGA at ω = 0", self.rga, outputs, inputs))
        return tuple(found)


@lru_cache(maxsize=32)  # from one move of a pole to the next the system stays
def analyse(system: System) -> Analysis:
    """Looks at a system."""
    A, B, C, D = system.A, system.B, system.C, system.D
    poles = in_order(np.linalg.eigvals(A).astype(np.complex128))
    inputs = analyse_pair(A, B)
    outputs = analyse_pair(*_transposed(A, C)) if system.measured else None
    T, Q, M = canonical(A, B) if inputs.reached == len(A) and 0 not in inputs.indices else (None,) * 3
    zeros = invariant_zeros(system) if system.measured else np.zeros(0, dtype=np.complex128)
    dc_gain = rga = index = None
    if int(numeric_rank(A)) == len(A):
        dc_gain = D - C @ np.linalg.solve(A, B)
        rga = rga_or_none(dc_gain)
        if dc_gain.shape[0] == dc_gain.shape[1]:
            index = niederlinski_index(dc_gain)
    size = float(np.max(np.abs(poles), initial=0.0))
    stable = bool(np.all(poles.real < -AXIS * size))
    remarks = tuple(_remarks(poles, zeros, inputs, outputs, size))
    return Analysis(system, poles, zeros, stable, inputs, outputs, T, Q, M, dc_gain, rga, index, remarks)


def in_order(values: Complexes) -> Complexes:
    """By real part, conjugates side by side."""
    values = np.asarray(values, dtype=np.complex128)
    return values[np.lexsort((-values.imag, np.abs(values.imag), np.round(values.real, 12)))]


def rga_or_none(gain: NDArray[Any]) -> NDArray[Any] | None:
    """The relative gain array where it exists and is more than 1 by 1."""
    if gain.size < 2:
        return None
    try:
        return relative_gain_array(gain)
    except (InvalidInputError, np.linalg.LinAlgError):
        return None


def _transposed(A: Floats, C: Floats) -> tuple[Floats, Floats]:
    return np.ascontiguousarray(A.T), np.ascontiguousarray(C.T)


def analyse_pair(A: Floats, B: Floats) -> Pair:
    """How far the inputs of a pair reach."""
    found = reach(A, B)
    scaled, inputs, _, speed = in_own_units(A, B)
    values = np.linalg.eigvals(scaled)
    pencils = np.concatenate(
        [values[:, None, None] * np.eye(len(A)) - scaled, np.broadcast_to(inputs, (len(A), *inputs.shape))],
        axis=2,
    )
    distances = np.linalg.svd(pencils, compute_uv=False)[:, -1]
    weakest = int(np.argmin(distances))
    nearest = complex(values[weakest] * speed)
    return Pair(
        found.indices,
        found.basis.shape[1],
        in_order(_lost(scaled, found) * speed),
        found.weakest,
        nearest,
        float(distances[weakest]),
    )


def _lost(scaled: Floats, found: Reach) -> Complexes:
    """The modes that the inputs do not reach, in units of the scaled pair: A on what is beside the reached space."""
    n, r = found.basis.shape
    if r == n:
        return np.zeros(0, dtype=np.complex128)
    beside = np.linalg.qr(found.basis, mode="complete")[0][:, r:] if r else np.eye(n)
    return np.linalg.eigvals(beside.T @ scaled @ beside).astype(np.complex128)


def _remarks(
    poles: Complexes, zeros: Complexes, inputs: Pair, outputs: Pair | None, size: float
) -> Iterator[Finding]:
    for own, name, what, move in (
        (inputs, "uncontrollable", "Not controllable", "no input moves it"),
        (outputs, "unobservable", "Not observable", "no output shows it"),
    ):
        if own is None:
            continue
        if len(own.lost):
            modes = pole_words(own.lost.tolist())
            unstable = bool(np.any(own.lost.real >= -AXIS * size))
            many = len(own.lost) > 1
            yield Finding(
                name,
                "error" if name == "uncontrollable" or unstable else "warning",
                f"{what}: the mode{'s' * many} s = {modes} (Popov–Belevitch–Hautus test: "
                f"{move.replace('it', 'them') if many else move}). {_way_out(name, unstable=unstable)}",
            )
        elif own.weakest < NEARLY_DEPENDENT:
            yield Finding(
                f"nearly_{name}",
                "warning",
                f"Nearly {name}: the mode s = {number(own.nearest)} is hard to {'move' if own is inputs else 'see'}; "
                f"[sI − A, {'B' if own is inputs else 'C'}] is {own.distance:.1e} from losing rank, and gains grow "
                "as the inverse of that.",
            )
    right = zeros[zeros.real > AXIS * max(size, 1e-300)]
    if len(right):
        yield Finding(
            "zeros_right",
            "warning",
            f"Zeros in the right half plane, s = {pole_words(right.tolist())}: no state feedback moves them; a step "
            "of the output first goes the wrong way, or is slow.",
        )
    if np.any(poles.real > AXIS * size):
        yield Finding("open_loop_unstable", "info", "The system is unstable by itself.")


def _way_out(name: str, *, unstable: bool) -> str:
    if name == "uncontrollable":
        return (
            "It is unstable, so no feedback helps: add an input."
            if unstable
            else "Take it out of the model, or add an input, to place poles."
        )
    return (
        "It is unstable, so no observer follows it: add an output."
        if unstable
        else "An observer keeps it as it is."
    )
