"""Goals on a cloud of uncertain rigs: ``{kind: cloud, share: within_limits, min: 95 %, spread: 10 %}``."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import floor
from typing import Any, ClassVar, Literal

from ...figures.written import percent
from ...parameters import PARAMETER_INFO
from ...robustness import LAGS, Uncertainty, cloud
from ..context import Context
from ..kinds import Amount, MapOf, Member, Number, OneOf, Reading, Record
from ..lab import Goal, Outcome
from ..nodes import Fields, Node
from .goal import SHARED, BaseGoal

Share = Literal["stable", "within_limits"]
RIGS = 200
"""How many rigs are tried, at most."""
MOST_TURNS = 5000.0
"""The fastest pole's size times the duration: beyond it, what rigs do takes seconds to compute."""
SHORT = 1e-3
_WORDS = {"stable": "stable", "within_limits": "within limits"}


@dataclass(frozen=True)
class CloudGoal(BaseGoal):
    """At least a share of uncertain rigs is stable, or stays within its limits.

    The rigs are the same at every attempt: their random numbers have a seed of their own.

    Attributes:
        share: of the rigs that are stable, or of those whose motors stay below their limits and whose pitch meets no
            stop as well.
        min: the least share.
        spread: relative uncertainty by parameter; one for all but g.
        rigs: how many.
        seed: of the random rigs.
    """

    kind: ClassVar[str] = "cloud"
    share: Share = "within_limits"
    min: float = 0.95
    spread: tuple[tuple[str, float], ...] = ()
    rigs: int = 100
    seed: int = 0

    @property
    def words(self) -> str:
        """Which share of which rigs."""
        sizes = {size for _, size in self.spread}
        how = f"±{_written(sizes.pop())}" if len(sizes) == 1 else "as uncertain as told"
        return (
            f"Rigs {_WORDS[self.share]}, of {self.rigs} that are {how} uncertain"
            if how[0] == "±"
            else (f"Rigs {_WORDS[self.share]}, of {self.rigs} uncertain ones")
        )

    @property
    def required_text(self) -> str:
        """The least share."""
        return f"≥ {_written(self.min)}"

    @property
    def uncertainty(self) -> Uncertainty:
        """How the rigs differ from the nominal one."""
        return Uncertainty(dict(self.spread), samples=self.rigs, seed=self.seed)

    def judge(self, context: Context) -> Outcome:
        """Whether enough rigs do."""
        spec = context.own.spec
        fastest = max((abs(p) for p in context.own.report.judged.connected), default=0.0)
        if fastest * spec.scenario.duration > MOST_TURNS:
            message = (
                f"The loop's fastest pole, {fastest:.3g} rad/s from 0, is too fast to be tried on many rigs."
            )
            return Outcome(False, None, "too fast", message)
        # whether loops are stable is seen without waiting for their responses
        duration = SHORT if self.share == "stable" else spec.scenario.duration
        calm = replace(spec.scenario, duration=duration, digital=None, disturbance=None, noise=(0.0, 0.0))
        found = cloud(replace(spec, scenario=calm), self.uncertainty, context.check)
        value = found.share_stable if self.share == "stable" else found.share_within_limits
        shown = floor(1000 * value + 1e-9) / 10  # rounded down: 99.96 % are not all
        return Outcome(shown >= 100 * self.min - 1e-9, value, f"{shown:g} %")

    def told(self) -> dict[str, Any]:
        """The cloud."""
        return {
            "share": self.share,
            "min": self.min,
            "spread": dict(self.spread),
            "rigs": self.rigs,
            "seed": self.seed,
        }


def _written(share: float) -> str:
    return percent(share) if 100 * share == round(100 * share) else f"{100 * share:.6g} %"


class Spread:
    """One share for all parameters but g, or a share for each that is uncertain."""

    _one, _each = Amount("", 0.0, 0.95), MapOf(Amount("", 0.0, 0.95), names="parameters")

    def read(self, node: Node, at: Reading, path: str) -> tuple[tuple[str, float], ...]:
        """By parameter."""
        if not isinstance(node, Fields):
            share = self._one.read(node, at, path)
            return tuple((name, share) for name in PARAMETER_INFO if name != "g")
        for name, (key, _) in node.fields.items():
            if name not in (*PARAMETER_INFO, *LAGS):
                hint = "Known are " + ", ".join((*PARAMETER_INFO, *LAGS)) + "."
                raise at.refuse(key, f"{path}.{name}", f"there is no parameter {name}", hint)
        return tuple(self._each.read(node, at, path).items())

    def schema(self) -> dict[str, Any]:
        """A share, or an object of them."""
        own = {name: self._one.schema() for name in (*PARAMETER_INFO, *LAGS)}
        each = {"type": "object", "properties": own, "additionalProperties": False}
        return {"anyOf": [*self._one.schema()["anyOf"], each]}


def _made(**values: Any) -> Goal:
    return CloudGoal(**values)


RECORD: Record[Goal] = Record(
    _made,
    (
        Member("share", OneOf(("stable", "within_limits")), "what is counted", required=True),
        Member("min", Amount("", 0.0, 1.0), "the least share", required=True),
        Member("spread", Spread(), "uncertainty: one for all parameters, or one for each", required=True),
        Member("rigs", Number(10, RIGS, whole=True), "how many rigs are tried, 100 where left out"),
        Member("seed", Number(0, 2**32 - 1, whole=True), "of the random rigs, 0 where left out"),
        *SHARED,
    ),
    "the goal",
)
