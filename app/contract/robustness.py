"""The cloud of uncertain rigs: what is asked and what is replied."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Annotated

from pydantic import BaseModel, Field

from heli2dof_core.errors import Heli2DofError
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.robustness import LAGS, MOST_SPREAD, Cloud, Uncertainty

from .experiment import StepRequest
from .fields import Whole, asked
from .model import Complex, Model, Reply, poles_reply
from .places import UNCERTAINTY

UNCERTAIN = (*PARAMETER_INFO, *LAGS)
MOST_POLES = 2000
"""Rigs whose poles are sent; more make no other picture."""


Spreads = dict[str, Annotated[float, Field(json_schema_extra={"minimum": 0.0, "maximum": MOST_SPREAD})]]


class UncertainRigs(asked(UNCERTAINTY)):
    """How far the rigs may differ from the nominal one, where other calls put designs on them."""

    spread: Spreads | None = Field(
        default=None,
        max_length=len(UNCERTAIN),
        json_schema_extra={"propertyNames": {"enum": [*UNCERTAIN]}},
        description="relative, per parameter and per rotor's lag; by default 0.1 for all parameters but g",
    )

    def to_uncertainty(self) -> Uncertainty:
        """The core's uncertainty."""
        own = UNCERTAINTY.given(self.model_dump(exclude_unset=True))
        return Uncertainty(**own) if self.spread is None else Uncertainty(self.spread, **own)


@contextmanager
def within_part(name: str, part: type[BaseModel]) -> Iterator[None]:
    """Calls what is refused of a part of a request by its path there; what is the design's keeps its own.

    Args:
        name: of the part, whose `uncertainty` is an `UncertainRigs`.
        part: whose fields are meant.
    """
    try:
        yield
    except Heli2DofError as error:
        first = error.field.partition(".")[0]
        if first in part.model_fields:
            error.name_field(f"{name}.{error.field}")
        elif first in UncertainRigs.model_fields:
            error.name_field(f"{name}.uncertainty.{error.field}")
        raise


class RobustnessRequest(StepRequest, asked(UNCERTAINTY)):
    """A design, an experiment, and how far the rigs may differ from the nominal one."""

    uncertainty: Spreads | None = Field(
        default=None,
        max_length=len(UNCERTAIN),
        json_schema_extra={"propertyNames": {"enum": [*UNCERTAIN]}},
        description="relative, per parameter and per rotor's lag; by default 0.1 for all parameters but g",
    )

    def to_uncertainty(self) -> Uncertainty:
        """The core's uncertainty."""
        own = UNCERTAINTY.given(self.model_dump(exclude_unset=True))
        return Uncertainty(**own) if self.uncertainty is None else Uncertainty(self.uncertainty, **own)


class Envelope(Model):
    """One output's percentiles over t, rad: a row per percentile."""

    theta: list[list[float]] = Field(description="pitch, rad; a row per percentile")
    psi: list[list[float]] = Field(description="yaw, rad; a row per percentile")


class RobustnessReply(Model):
    """After `done` of `samples` rigs; poles of the whole loop of the first of them, rad/s."""

    done: int = Field(description="rigs so far")
    samples: Whole = Field(description="rigs in all")
    loop_poles: list[list[Complex]]
    t: list[float] = Field(description="s")
    percentiles: list[float] = Field(description="%, of `envelopes`")
    envelopes: Envelope
    share_stable: float = Field(description="0 to 1")
    share_within_limits: float = Field(description="0 to 1")


def cloud_reply(result: Cloud) -> Reply:
    """A cloud, or what is known of it so far."""
    return {
        "done": result.done,
        "samples": result.samples,
        "loop_poles": [poles_reply(poles) for poles in result.loop_poles[:MOST_POLES]],
        "t": result.t,
        "percentiles": list(result.percentiles),
        "envelopes": result.envelopes,
        "share_stable": result.share_stable,
        "share_within_limits": result.share_within_limits,
    }
