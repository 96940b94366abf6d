"""Requirements on uncertain rigs: of each design the share of the rigs that meet them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..errors import Heli2DofError, within_field
from ..kernels.update_layout import ASKED, NUMBERS, WITHOUT_MARGINS
from ..many import SHARES, Many
from ..on_rigs import OnRigs
from ..requirements import Requirement
from ..robustness import random_factors, require_continuous, require_lags
from ..signals import Floats
from ..spec import Spec
from .ask import Find

_EXPERIMENT = [ASKED, ASKED + 1, *range(WITHOUT_MARGINS, NUMBERS)]
"""Of a row, what says which experiments are wanted."""
SEARCHED = 48
"""Rigs, at most, on which a design is put while others are sought; what is told at the end is of all of them."""


class OnAll:
    """Designs on uncertain rigs.

    Args:
        spec: the design that is there, with rig and experiment.
        ask: the search, whose uncertainty is not None.
        threads: that compute shares, at most.

    Raises:
        InvalidInputError: the experiment has what uncertain rigs do not take.
    """

    def __init__(self, spec: Spec, ask: Find, threads: int = 1) -> None:
        assert ask.uncertainty is not None  # `Find` has seen to it
        require_continuous(spec.scenario)
        with within_field("uncertainty"):
            require_lags(spec.actuators, ask.uncertainty)
        self._factors = random_factors(ask.uncertainty)
        self.needs = tuple(need for need in ask.require if need.share is not None)
        wanted = (*(need.measure for need in ask.require), *ask.minimize)
        self.shares = tuple(dict.fromkeys(own for own in wanted if own.name in SHARES))
        stepped = [axis for axis in ("theta", "psi") if getattr(spec.scenario, axis) is not None]
        self._parts = [need.apart(stepped) for need in self.needs]
        self.measures = tuple(dict.fromkeys(need.measure for parts in self._parts for need in parts))
        self._spec, self._threads = spec, threads
        self._each = Many(spec, self.measures, unstable=False)
        self._many: dict[int, Many] = {}

    @property
    def rigs(self) -> int:
        """How many there are."""
        return len(self._factors)

    def of(
        self,
        spec_of: Callable[[int], Spec],
        rows: Floats,
        rigs: int | None = None,
        check: Callable[[], None] = lambda: None,
    ) -> tuple[Floats, Floats]:
        """Of designs the shares of the rigs that meet each of `needs`, (n, needs), and `shares`, (n, shares).

        Args:
            spec_of: each design.
            rows: their numbers, (n, NUMBERS).
            rigs: how many are looked at, the first ones; None: all.
            check: called now and then; what it raises ends the work.
        """
        factors = self._factors[:rigs]
        met = np.zeros((len(rows), len(self.needs)))
        if self.needs:
            for i in range(len(rows)):
                met[i] = self._met(rows[i], factors, check)
        told = np.zeros((len(rows), len(self.shares)))
        if self.shares and len(rows):
            many = self._many.get(len(factors))
            if many is None:
                many = self._many[len(factors)] = Many(
                    self._spec, self.shares, factors=factors, threads=self._threads
                )
            own = rows.copy()
            own[:, _EXPERIMENT] = many.row[_EXPERIMENT]
            told = np.nan_to_num(many.values(own, many.run(own, spec_of, check)))
        return met, told

    def _met(self, row: Floats, factors: Floats, check: Callable[[], None]) -> Floats:
        own = row.copy()
        own[_EXPERIMENT] = self._each.row[_EXPERIMENT]
        try:
            values = OnRigs.of(self._each, own).values(factors, check)
        except Heli2DofError:
            return np.zeros(len(self.needs))
        met = np.ones((len(factors), len(self.needs)), dtype=bool)
        for i, parts in enumerate(self._parts):
            for need in parts:
                met[:, i] &= need.met(values[:, self.measures.index(need.measure)])
        return met.mean(axis=0)


def missed_share(need: Requirement, share: Floats) -> Floats:
    """By how much a share of the rigs is missed, 0 … 1."""
    least = need.share if need.share is not None else need.min
    if least is None:
        return np.asarray(need.excess(share))
    short = np.clip((least - share) / max(least, 1e-9), 0.0, 1.0)
    met = share >= least - 1e-9 if need.share is not None else need.met(share)
    return np.where(met, 0.0, np.maximum(short, 1e-6)).astype(np.float64)
