"""A study: designs times rigs, what is measured of each, and the parts in which it is computed."""

from __future__ import annotations

import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from typing import Any

from ..many import Measure
from ..measured import MEASURED
from ..request import Body, spec_of
from ..requirements import Requirement, told_measure
from ..spec import Spec
from .designs import Changes, Designs
from .rigs import Rigs

PART = 2000
"""Pairs of a design and a rig that are computed, kept and, where a worker is lost, begun again together."""
FORMAT = 1
NOMINAL = 0
"""Number of the nominal rig among a design's; the uncertain ones follow."""


@dataclass(frozen=True)
class Segment:
    """Rigs of one design: those numbered from `first` to before `last`."""

    design: int
    body: Body
    first: int
    last: int


@dataclass(frozen=True)
class Task:
    """One part of a study: all that a worker needs, and nothing of a file.

    Attributes:
        number: of the part.
        segments: what is to be computed, in this order.
        rigs: the uncertain ones; None where there is the nominal one alone.
        measures: of each.
        unstable: as in `Study`.
    """

    number: int
    segments: tuple[Segment, ...]
    rigs: Rigs | None
    measures: tuple[Measure, ...]
    unstable: bool


@dataclass(frozen=True)
class Study:
    """Designs times rigs, and what is to be known of each pair.

    Attributes:
        title: in words.
        base: body of a request, what all designs share.
        designs: what each of them changes.
        rigs: uncertain ones, the same under every design; None: the nominal rig alone.
        measures: the figures that are kept.
        requirements: what designs are judged by; their figures are among the measures.
        unstable: whether responses of unstable loops are computed; else these have no figures of responses.
    """

    title: str
    base: Body
    designs: Designs
    rigs: Rigs | None
    measures: tuple[Measure, ...]
    requirements: tuple[Requirement, ...] = ()
    unstable: bool = False

    @property
    def each(self) -> int:
        """Rigs of a design, the nominal one within."""
        return 1 if self.rigs is None else 1 + self.rigs.count

    @property
    def pairs(self) -> int:
        """Designs times rigs."""
        return self.designs.count * self.each

    @property
    def parts(self) -> int:
        """How many parts there are."""
        return -(-self.pairs // PART)

    def size(self, number: int) -> int:
        """Pairs of a part."""
        return min(PART, self.pairs - number * PART)

    def changes(self, design: int) -> Changes:
        """What a design sets, by path."""
        return self.designs.changes(design)

    def spec(self, design: int) -> Spec:
        """A design with its experiment.

        Raises:
            Heli2DofError: a value is out of its range.
        """
        return spec_of(self.designs.body(self.base, design))

    def task(self, number: int) -> Task:
        """What a part is."""
        return Task(number, tuple(self._segments(number)), self.rigs, self.measures, self.unstable)

    def _segments(self, number: int) -> Iterator[Segment]:
        at, end = number * PART, number * PART + self.size(number)
        while at < end:
            design, first = divmod(at, self.each)
            last = min(self.each, first + end - at)
            yield Segment(design, self.designs.body(self.base, design), first, last)
            at += last - first

    @cached_property
    def columns(self) -> tuple[str, ...]:
        """The measures' names in tables: the figure's, then what differs from the usual."""
        return tuple(map(column_of, self.measures))

    @property
    def told(self) -> dict[str, Any]:
        """What the numbers depend on, as JSON: not the title, nor what is required."""
        return {
            "format": FORMAT,
            "part": PART,
            "base": self.base,
            "designs": {"kind": type(self.designs).__name__.lower(), **vars(self.designs)},
            "rigs": None if self.rigs is None else _told_rigs(self.rigs),
            "measures": [told_measure(own) for own in self.measures],
            "unstable": self.unstable,
        }

    @cached_property
    def fingerprint(self) -> str:
        """Of all that the numbers depend on, hexadecimal."""
        return sha256(json.dumps(self.told, sort_keys=True).encode()).hexdigest()


def _told_rigs(rigs: Rigs) -> dict[str, Any]:
    own = rigs.uncertainty
    spread = {name: share for name, share in sorted(own.spread.items()) if share}
    return {"count": rigs.count, "seed": own.seed, "distribution": own.distribution, "spread": spread}


def column_of(measure: Measure) -> str:
    """A measure's name in tables.

    >>> from heli2dof_core.measured import Where
    >>> column_of(Measure("settling_time", Where("theta", model="linear")))
    'settling_time_theta_linear'
    """
    known, where = MEASURED[measure.name], measure.where
    parts = [measure.name]
    if known.may_have_axis and where.axis not in (None, "both"):
        parts.append(where.axis)
    if known.may_have_motor and where.motor not in (None, "both"):
        parts.append(where.motor)
    if known.may_have_model:
        parts += ["linear"] * (where.model == "linear") + ["together"] * (where.steps == "together")
    return "_".join(parts)
