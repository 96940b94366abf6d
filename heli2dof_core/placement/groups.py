"""Which poles go into which block of the closed loop: groups that keep conjugates together."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from ..errors import InvalidInputError, UnpairedPolesError
from ..signals import Complexes

PAIRED = 1e-9
"""Conjugates may differ by this share of their size."""


@dataclass(frozen=True)
class Group:
    """One block of the closed loop.

    Attributes:
        inputs: whose chains form the block, from 0; several where odd chains had to be joined.
        poles: which of the desired poles it has, by position from 0.
    """

    inputs: tuple[int, ...]
    poles: tuple[int, ...]


Unit = tuple[int, ...]


def conjugate_units(poles: Complexes) -> list[Unit]:
    """The poles by position as units that must stay together: (i,) real, (i, j) conjugates.

    Raises:
        UnpairedPolesError: a complex pole has no conjugate; the field names it.
    """
    units: list[Unit] = []
    left = list(range(len(poles)))
    while left:
        i = left.pop(0)
        if poles[i].imag == 0:
            units.append((i,))
            continue
        mirrored = np.conj(poles[i])
        partner = min(
            (j for j in left if poles[j].imag), key=lambda j: abs(poles[j] - mirrored), default=None
        )
        if partner is None or abs(poles[partner] - mirrored) > PAIRED * abs(mirrored):
            raise UnpairedPolesError(
                f"pole {i + 1}, {poles[i]:g}, has no conjugate",
                field=f"poles.{i}",
                value=str(poles[i]),
                hint=f"Give {mirrored:g} too.",
            )
        left.remove(partner)
        units.append((i, partner))
    return units


def assign(poles: Complexes, indices: Sequence[int]) -> tuple[Group, ...]:
    """Fills blocks of sizes σ_i with the poles in the order given, conjugates together.

    A block of odd size needs a real pole; where there are not enough, odd blocks are joined two by
    two. (theory: step 5.)

    Raises:
        UnpairedPolesError: the poles are not closed under conjugation.
    """
    units = conjugate_units(poles)
    lonely = sum(len(unit) == 1 for unit in units)
    odd = [i for i, index in enumerate(indices) if index % 2]
    joined = odd[: max(len(odd) - lonely, 0)]
    blocks = [(i,) for i in range(len(indices)) if i not in joined]
    blocks += list(zip(joined[::2], joined[1::2], strict=True))
    groups = []
    blocks.sort()
    sizes = [sum(indices[i] for i in inputs) for inputs in blocks]
    for k, (inputs, size) in enumerate(zip(blocks, sizes, strict=True)):
        chosen: list[int] = []
        later = sum(other % 2 for other in sizes[k + 1 :])  # real poles that odd blocks still need
        for unit in list(units):
            room = size - len(chosen) - len(unit)
            spare = sum(len(other) == 1 for other in units) - (len(unit) == 1)
            if room >= 0 and spare >= room % 2 + later:
                chosen.extend(unit)
                units.remove(unit)
        groups.append(Group(inputs, tuple(chosen)))
    return tuple(groups)


def require_groups(groups: Sequence[Group], poles: Complexes, indices: Sequence[int]) -> tuple[Group, ...]:
    """The groups as given, if they fit.

    Raises:
        InvalidInputError: an input or a pole is missing or named twice, or a size does not fit.
        UnpairedPolesError: a group separates conjugates.
    """
    for name, wanted, given in (
        ("inputs", len(indices), [i for group in groups for i in group.inputs]),
        ("poles", len(poles), [i for group in groups for i in group.poles]),
    ):
        if sorted(given) != list(range(wanted)):
            raise InvalidInputError(
                f"the groups name the {name} {sorted(given)}, not each of 0 … {wanted - 1} once",
                field="groups",
                value=str(sorted(given)),
                hint=f"Name each of the {name} once, by position from 0.",
            )
    for k, group in enumerate(groups):
        size = sum(indices[i] for i in group.inputs)
        if size != len(group.poles):
            raise InvalidInputError(
                f"group {k + 1} has {len(group.poles)} poles, but its inputs have chains of {size} states",
                field=f"groups.{k}.poles",
                value=len(group.poles),
                hint="The controllability indices are " + ", ".join(map(str, indices)) + ".",
            )
        conjugate_units(poles[list(group.poles)])
    return tuple(groups)


def splits(poles: Complexes, sizes: Sequence[int]) -> Iterator[tuple[tuple[int, ...], ...]]:
    """All ways to deal the poles, by position, into groups of these sizes, conjugates together.

    Four distinct real poles and sizes (2, 2) give six.
    """
    units = conjugate_units(poles)
    yield from _deal(units, tuple(sizes))


def _deal(units: list[Unit], sizes: tuple[int, ...]) -> Iterator[tuple[tuple[int, ...], ...]]:
    if not sizes:
        yield ()
        return
    for count in range(len(units) + 1):
        for chosen in combinations(units, count):
            if sum(map(len, chosen)) == sizes[0]:
                rest = [unit for unit in units if unit not in chosen]
                first = tuple(sorted(i for unit in chosen for i in unit))
                for others in _deal(rest, sizes[1:]):
                    yield first, *others
