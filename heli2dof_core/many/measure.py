"""What is measured of each of many designs: a figure of merit of one response, or a share of uncertain rigs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import floor, isfinite
from types import MappingProxyType
from typing import get_args

from ..errors import InvalidInputError
from ..figures import Figure
from ..figures.written import DASH
from ..kernels.update_layout import SHARE_STABLE, SHARE_WITHIN
from ..measured import MEASURED, Axis, Motor, Steps, Where
from ..scenario import Model

SHARES: Mapping[str, int] = MappingProxyType(
    {"share_stable": SHARE_STABLE, "share_within_limits": SHARE_WITHIN}
)
"""Shares of uncertain rigs, 0 to 1, beside the figures of `measured.MEASURED`; where a row of found has them."""
SHARE_FIGURES: Mapping[str, Figure] = MappingProxyType(
    {
        name: Figure(title.lower(), meaning, better="higher", shown="%", digits=0, title=title)
        for name, title, meaning in (
            (
                "share_stable",
                "Uncertain rigs, stable",
                "share of the uncertain rigs whose linear loop is stable",
            ),
            (
                "share_within_limits",
                "Uncertain rigs, within limits",
                "share of the uncertain rigs whose motors stay below their limits and whose pitch meets no stop",
            ),
        )
    }
)
"""What there is to know of them, as of all figures."""
ANYWHERE = Where()
_KINDS = {"axis": Axis, "motor": Motor, "model": Model, "steps": Steps}


@dataclass(frozen=True)
class Measure:
    """What is measured of each design.

    Attributes:
        name: in `measured.MEASURED` or in `SHARES`.
        where: of which response; the worse one where both axes or motors are meant.

    Raises:
        InvalidInputError: there is no such figure, or one of an axis has none.
    """

    name: str
    where: Where = ANYWHERE

    def __post_init__(self) -> None:
        if self.name in SHARES:
            return
        known = MEASURED.get(self.name)
        if known is None:
            names = ", ".join((*MEASURED, *SHARES))
            raise InvalidInputError(
                f"there is no figure {self.name!r}", field="measure", hint=f"Known are {names}."
            )
        for name, kind in _KINDS.items():
            value, allowed = getattr(self.where, name), get_args(kind)
            if value is not None and value not in allowed:
                raise InvalidInputError(
                    f"{name} is {value!r}", field=name, value=value, hint=f"Known are {', '.join(allowed)}."
                )
        if known.has_axis and self.where.axis is None:
            raise InvalidInputError(
                f"{self.name} is of an axis, and none is named",
                field="axis",
                hint="Known are theta, psi, both.",
            )
        if known.of == "step" and self.where.steps == "together":
            raise InvalidInputError(
                f"{self.name} is of one axis stepped alone", field="steps", hint="Leave it out."
            )

    @property
    def figure(self) -> Figure:
        """What there is to know of it."""
        return SHARE_FIGURES[self.name] if self.name in SHARES else MEASURED[self.name].figure

    @property
    def words(self) -> str:
        """What is measured, and of which response."""
        if self.name in SHARES:
            return SHARE_FIGURES[self.name].title
        return MEASURED[self.name].words(self.where)

    @property
    def unlimited(self) -> bool:
        """Whether there may be designs that have no limit of it."""
        return self.name in MEASURED and MEASURED[self.name].unlimited

    def written(self, value: float | None) -> str:
        """A value as it is shown; words where there is none (None, NaN) or no limit, as `Measured.written`."""
        if self.name not in SHARES:
            return MEASURED[self.name].written(value)
        return DASH if value is None or not isfinite(value) else f"{self.shown(value):g} %"

    def shown(self, value: float) -> float:
        """The value as it is shown, a number in the unit that people read."""
        if self.name not in SHARES:
            return MEASURED[self.name].shown(value)
        return floor(1000 * value + 1e-9) / 10  # rounded down: 99.96 % are not all

    @property
    def runs(self) -> frozenset[str]:
        """The experiments that it is read from: both, theta, psi."""
        known = MEASURED.get(self.name)
        if known is None or not known.may_have_model:
            return frozenset()
        if self.where.steps == "together":
            return frozenset(("both",))
        return frozenset((self.where.axis,) if self.where.axis in ("theta", "psi") else ("theta", "psi"))
