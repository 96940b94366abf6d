"""What pictures and rows read of a map; `design_map.DesignMap` is one, which knows them in turn."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from ..many import Measure
from ..robustness import Uncertainty
from ..signals import Floats
from ..spec import Spec
from .planes import Plane

Truths = NDArray[np.bool_]
Spot = tuple[float, float]
Valued = tuple[float, float, float]


class Mapped(Protocol):
    """A figure at every place of a plane; what each member is, `DesignMap` says."""

    @property
    def spec(self) -> Spec:
        """In the middle."""
        ...

    @property
    def plane(self) -> Plane:
        """The places."""
        ...

    @property
    def measure(self) -> Measure:
        """What was measured."""
        ...

    @property
    def uncertainty(self) -> Uncertainty | None:
        """Of shares."""
        ...

    @property
    def values(self) -> Floats:
        """(ny, nx)."""
        ...

    @property
    def stable(self) -> Truths:
        """(ny, nx)."""
        ...

    @property
    def abscissa(self) -> Floats:
        """(ny, nx), rad/s."""
        ...

    @property
    def own(self) -> float:
        """The spec's."""
        ...

    @property
    def x(self) -> Floats:
        """(nx,)."""
        ...

    @property
    def y(self) -> Floats:
        """(ny,)."""
        ...

    @property
    def valid(self) -> Truths:
        """(ny, nx)."""
        ...

    @property
    def unlimited(self) -> Truths:
        """(ny, nx)."""
        ...

    @property
    def unit(self) -> str:
        """Of `values`."""
        ...

    @property
    def title(self) -> str:
        """In words."""
        ...

    @property
    def here(self) -> Spot | None:
        """Where the spec stands."""
        ...

    @property
    def best(self) -> Valued | None:
        """The best place."""
        ...

    def written(self, value: float) -> str:
        """A value as it is shown."""
        ...

    def summary(self) -> str:
        """In one line."""
        ...
