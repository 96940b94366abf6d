"""The uncertain rigs of a study: any of them can be made without those before it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ..frozen import frozen
from ..parameters import PARAMETER_INFO
from ..quantities import Quantity, require_valid
from ..robustness import LAGS, SMALLEST, Uncertainty
from ..signals import Floats

MOST_RIGS = 10**9


@dataclass(frozen=True)
class Rigs:
    """Rigs that differ from the nominal one, numbered from 0.

    A rig's random numbers are those of its number, so that it is the same rig in whichever part and on whichever
    machine it is computed. Uniform ones are those that `robustness` draws of the same seed; normal ones are their
    quantiles.

    Attributes:
        uncertainty: spread, distribution and seed; its `samples` say nothing here.
        count: how many.
    """

    uncertainty: Uncertainty
    count: Annotated[int, Quantity("how many rigs", "", 1, MOST_RIGS)]

    def __post_init__(self) -> None:
        require_valid(self)

    def factors(self, first: int, last: int) -> Floats:
        """By which the rigs from `first` to before `last` differ, (last − first, FACTORS)."""
        seed = self.uncertainty.seed
        own = self._part(np.random.PCG64(seed), (*PARAMETER_INFO,), first, last)
        lags = self._part(np.random.PCG64((seed, 1)), LAGS, first, last)
        return frozen(np.hstack((own, lags)))

    def _part(self, numbers: np.random.PCG64, names: tuple[str, ...], first: int, last: int) -> Floats:
        spread = np.array([self.uncertainty.spread.get(name, 0.0) for name in names])
        numbers.advance(first * len(names))  # one number each
        deviations = np.random.Generator(numbers).uniform(-1.0, 1.0, (last - first, len(names)))
        if self.uncertainty.distribution == "normal":
            from scipy.special import ndtri

            deviations = np.clip(ndtri(0.5 + 0.5 * deviations), -3.0, 3.0)
        return np.maximum(1.0 + spread * deviations, SMALLEST)
