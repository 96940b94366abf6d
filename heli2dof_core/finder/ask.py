"""What a search is asked for: what is free and how far, what is required, what is to be small or large."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Literal, get_args

from ..checks import require_one_of
from ..errors import InvalidInputError, within_field
from ..exclusion import meant, require_distinct
from ..many import SHARES, Measure
from ..measured import MEASURED
from ..placement.registry import method
from ..poles import LARGEST
from ..quantities import Quantity, documented, require_valid
from ..requirements import Requirement, measure_of, requirements_of
from ..robustness import Uncertainty
from ..spec import Spec

Free = Literal[
    "poles", "rotor_poles", "loops", "structure", "shift", "pairing", "decoupler", "observer", "weights"
]
FREE: tuple[Free, ...] = get_args(Free)
MOST_MINIMIZED = 3
MOST_DESIGNS = 1_000_000
MOST_RIGS = 1000
"""Uncertain rigs, on all of which every design that is told is put."""
SHORTEST_SEARCH, LONGEST_SEARCH = 0.1, 600.0
Range = tuple[float, float]


@dataclass(frozen=True)
class Bounds:
    """How far what is free may go; what is None follows from the design that is there.

    Attributes:
        poles: least and largest size of a pole, rad/s.
        damping: least damping ratio of a complex pair, 0 to 1.
        rotor_poles: as `poles`.
        kp: least and largest proportional gain of either loop, V/rad.
        ti: of the integral times, s.
        shift: of Luenberger's shift.
        observer: as `poles`, of the observer's.
        weights: factors on the present weights.
    """

    poles: Range | None = None
    damping: float = 0.3
    rotor_poles: Range | None = None
    kp: Range | None = None
    ti: Range | None = None
    shift: Range = (-1.0, 1.0)
    observer: Range | None = None
    weights: Range = (1e-2, 1e2)

    def __post_init__(self) -> None:
        for name, most in _LARGEST.items():
            own = getattr(self, name)
            if own is None:
                continue
            low, high = (float(value) for value in own)
            least = -most if name == "shift" else 1e-6
            if not least <= low < high <= most:
                raise InvalidInputError(
                    f"{name} goes from {low:g} to {high:g}",
                    field=f"bounds.{name}",
                    value=str(own),
                    hint=f"Give two values, the smaller one first, between {least:g} and {most:g}.",
                )
            object.__setattr__(self, name, (low, high))
        if not 0.0 < self.damping <= 1.0:
            raise InvalidInputError(
                f"the damping is {self.damping:g}, not above 0 and at most 1",
                field="bounds.damping",
                value=self.damping,
                hint="Give a value up to 1.",
            )


_LARGEST = {
    "poles": LARGEST,
    "rotor_poles": LARGEST,
    "observer": LARGEST,
    "kp": 1e6,
    "ti": 1e6,
    "shift": 1e6,
    "weights": 1e6,
}


@documented
@dataclass(frozen=True)
class Find:
    """A search.

    `free`: what may change. `require`: what a design has to meet; its loop has to be stable in any case.
    `minimize`: figures that are made as good as they can be, at most three: small, or large where more is better.
    `uncertainty`: how far the rigs differ on which shares are required; None where none is. `bounds`: how far what is
    free may go. Requirements and figures may be given as a request has them, too:
    ``Find(require={"overshoot": {"max": 5}}, minimize=("settling_time",))``.
    """

    free: tuple[Free, ...] = ("poles",)
    require: tuple[Requirement, ...] = ()
    minimize: tuple[Measure, ...] = ()
    uncertainty: Uncertainty | None = None
    bounds: Bounds = field(default_factory=Bounds)
    designs: Annotated[int, Quantity("how many designs are tried, at most", "", 100, MOST_DESIGNS)] = 20_000
    seconds: Annotated[
        float,
        Quantity("after which it ends even where fewer were tried", "s", SHORTEST_SEARCH, LONGEST_SEARCH),
    ] = 60.0
    seed: Annotated[int, Quantity("of the search's random numbers", "", 0, 2**32 - 1)] = 0

    def _read(self) -> None:
        """Makes of a request's words what they stand for."""
        require = requirements_of(self.require) if isinstance(self.require, Mapping) else tuple(self.require)
        figures = (own if isinstance(own, Measure) else measure_of(own) for own in self.minimize)
        object.__setattr__(self, "require", require)
        object.__setattr__(self, "minimize", tuple(figures))

    def __post_init__(self) -> None:
        self._read()
        require_valid(self)
        if not self.free:
            raise InvalidInputError(
                "nothing is free", field="free", hint="Known are " + ", ".join(FREE) + "."
            )
        for i, name in enumerate(self.free):
            with within_field(f"free.{i}"):
                require_one_of(name, Free, "")
        object.__setattr__(self, "free", tuple(name for name in FREE if name in self.free))
        if not self.require and not self.minimize:
            raise InvalidInputError(
                "nothing is required and nothing is to be minimized",
                field="require",
                hint="Give one at least.",
            )
        if len(self.minimize) > MOST_MINIMIZED:
            raise InvalidInputError(
                f"{len(self.minimize)} figures are to be minimized",
                field="minimize",
                hint=f"Give {MOST_MINIMIZED} at most, and limits for the others.",
            )
        require_distinct(self.require)
        said: set[Measure] = set()
        for i, own in enumerate(self.minimize):
            if meant(own) in said:
                raise InvalidInputError(
                    f"{own.words} is to be minimized twice",
                    field=f"minimize.{i}",
                    value=own.name,
                    hint="Name each figure once.",
                )
            said.add(meant(own))
            known = MEASURED.get(own.name)
            if known is not None and known.figure.better == "none":
                raise InvalidInputError(
                    f"{own.name} is neither better small nor large",
                    field=f"minimize.{i}",
                    value=own.name,
                    hint="Require limits of it instead.",
                )
        if self.uncertainty is not None and self.uncertainty.samples > MOST_RIGS:
            raise InvalidInputError(
                f"{self.uncertainty.samples} uncertain rigs are too many for a search",
                field="uncertainty.samples",
                value=self.uncertainty.samples,
                hint=f"Give {MOST_RIGS} at most; a design that was found can be put on more.",
            )
        if self.uncertainty is None and (share := self.of_rigs):
            raise InvalidInputError(
                f"{share} is of uncertain rigs, and none are described",
                field="uncertainty",
                hint="Say how far the rigs differ.",
            )

    @property
    def of_rigs(self) -> str | None:
        """What needs uncertain rigs; None where nothing does."""
        own = (*(need.measure for need in self.require if need.uncertain), *self.minimize)
        shares = [need.measure.name for need in self.require if need.share is not None]
        return next(
            (name for name in (*shares, *(m.name for m in own)) if name in SHARES or name in shares), None
        )

    def require_possible(self, spec: Spec) -> None:
        """Raises InvalidInputError where something is free that the design does not have, or that has no effect."""
        placing, outer = method(spec.method), spec.outer.outer
        misses: dict[Free, tuple[bool, str, str]] = {
            "poles": (
                placing.places_poles,
                f"{placing.title} chooses its own poles",
                "Let its weights be free, or choose another method.",
            ),
            "rotor_poles": (
                spec.place_rotors,
                "the rotors are not placed",
                "Place them, or leave rotor_poles out.",
            ),
            "loops": (
                outer == "pi" and not placing.integrates,
                "there are no PI loops",
                'Set outer to "pi" with a method that has no integral action of its own, or leave loops out.',
            ),
            "structure": (
                placing.structured,
                f"{placing.title} knows of no structure",
                "Choose full-rank placement, or leave structure out.",
            ),
            "shift": (
                placing.structured
                and (spec.structure.coupling != "axis-decoupled" or "structure" in self.free),
                "there is no shift in this structure",
                "Choose full-rank placement with a triangular or input-diagonal structure, or leave shift out.",
            ),
            "observer": (
                spec.scenario.measured == "observer"
                and (spec.observer is None or spec.observer.method == "full-rank"),
                "no observer's poles are placed",
                "Let a full-rank observer estimate the states, or leave observer out.",
            ),
            "weights": (
                placing.weighted,
                f"{placing.title} has no weights",
                "Choose a quadratic method, or leave weights out.",
            ),
        }
        misses["pairing"] = misses["decoupler"] = misses["loops"]
        for name in self.free:
            there, message, hint = misses[name]
            if not there:
                raise InvalidInputError(message, field="free", value=name, hint=hint)
