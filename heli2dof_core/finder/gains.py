"""Gains of a search's designs: by the kernel itself, of all at once, or else by everybody's path, one by one."""

from __future__ import annotations

from functools import cached_property
from math import nan

import numpy as np
from numpy.typing import NDArray

from ..block import Task
from ..design import Design
from ..evaluate import place
from ..kernels.update_layout import (
    AIMS,
    GIVEN_INTEGRAL,
    GIVEN_INVERSE,
    GIVEN_K,
    K_GIVEN,
    L_GIVEN,
    OWN_INTEGRAL,
)
from ..many import Many
from ..placement.lqr import with_integrals
from ..placement.method import HEAVIEST, LIGHTEST
from ..placement.registry import method
from ..placement.regulators import regulators
from ..signals import Floats
from ..spec import Spec
from .ask import Find, Free
from .space import Space

_DECIDE_K: frozenset[Free] = frozenset(("poles", "rotor_poles", "structure", "shift"))
"""What K depends on, where no weights decide."""


class Gains:
    """Where K and L of a search's designs come from.

    Args:
        spec: the design that is there.
        ask: the search.
        space: its designs.
        many: what takes their rows.

    Attributes:
        closed_form: whether the kernel finds K itself.
        quadratic: whether K follows from weights that are free.
        one_by_one: whether each K takes everybody's path.
    """

    def __init__(self, spec: Spec, ask: Find, space: Space, many: Many) -> None:
        self._spec, self._space, self._many = spec, space, many
        self._placing = placing = method(spec.method)
        self.closed_form = Task.of(spec, each_axis=False).rest.has_closed_form
        self.quadratic = placing.weighted and "weights" in ask.free
        decided = not placing.weighted and bool(_DECIDE_K & set(ask.free))
        self.one_by_one = decided and not self.closed_form

    @cached_property
    def row(self) -> Floats:
        """The spec's numbers, (NUMBERS,), to be copied and changed.

        They hold K and L where the kernel does not find them: those of the spec, which stay where nothing that is
        free changes them. A Kalman filter's L depends on rig and noise alone.

        Raises:
            Heli2DofError: the design that is there does not exist.
        """
        row = self._many.row.copy()
        if self.closed_form:  # K is there where L had to be given
            row[K_GIVEN:L_GIVEN] = 0.0
            row[AIMS] = 1.0
        return row

    def give(self, rows: Floats, points: Floats) -> NDArray[np.bool_]:
        """Puts K, Ĝ(0)⁻¹ and an integral action of its own into rows of numbers.

        Args:
            rows: (n, NUMBERS), changed.
            points: (n, size), the designs.

        Returns:
            Of which designs the gain is not known this way, (n,).
        """
        if not self.quadratic:
            return np.full(len(rows), self.one_by_one)
        K, n = self._regulators(self._space.weights(points)), len(self._placed.model[0])
        own = np.zeros((len(rows), 2, 6))
        own[..., :n] = K[..., :n]
        rows[:, GIVEN_K:GIVEN_INVERSE] = own.reshape(-1, 12)
        rows[:, GIVEN_INVERSE:OWN_INTEGRAL] = self._placed.inverses(K[..., :n]).reshape(-1, 4)
        if self._placing.integrates:
            rows[:, GIVEN_INTEGRAL:AIMS] = K[..., n:].reshape(-1, 4)
        return np.isnan(K[:, 0, 0])

    @cached_property
    def _placed(self) -> Design:
        return place(self._spec)

    def _regulators(self, weights: Floats) -> Floats:
        """K of each row of weights, (n, 2, k); NaN where it is not known this way, or a weight is out of bounds."""
        states, inputs, integrals = weights[:, :4], weights[:, 4:6], weights[:, 6:]
        A, B = self._placed.model
        rotors = np.zeros((len(weights), len(A) - 4))  # whose speeds cost nothing
        model = with_integrals(A, B, np.eye(2, len(A))) if self._placing.integrates else (A, B)
        K = regulators(*model, np.hstack((states, rotors, integrals)), inputs)
        out = (weights.max(axis=1) > HEAVIEST) | (weights[:, 4:].min(axis=1) < LIGHTEST)
        K[out] = nan
        return K
