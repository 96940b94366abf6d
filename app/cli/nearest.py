"""`heli2dof nearest`: the smallest moves with which a design meets what is required of it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import IO, Any

import click

from .fields import DESIGN, LOOPS, SCENARIO, Option, body, require_asked, takes
from .output import load_kernels, print_json, refusals, show
from .values import Limits, Name, Words


class _Free(Name):
    convert = Words.convert


def _free() -> Iterator[str]:
    from heli2dof_core.nearest import GROUPS, HANDLES

    yield from (*GROUPS, *HANDLES)


_NEAREST = (
    Option(
        "--require",
        "nearest.require",
        Limits(),
        "Limits: settling_time<=0.8,overshoot:theta<=5,V_peak:V_p:linear<=20,lag_margin>=0.2.",
    ),
    Option("--free", "nearest.free", _Free(_free), "What may move, with commas; poles,loops by default."),
    Option("--within", "nearest.within", click.FLOAT, "How far is near; 1.5 by default."),
)


@click.command()
@takes(*DESIGN, *LOOPS, *SCENARIO, *_NEAREST)
def nearest(as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Print the smallest moves of poles or loops with which a design meets what is required of it."""
    from ..contract.nearest import NearestRequest, nearest_reply

    with refusals(as_json):
        asked = body(base, values)
        require_asked(
            asked, "nearest.require", 'heli2dof nearest --require "settling_time<=0.8,overshoot<=5"'
        )
        request = NearestRequest.model_validate(asked)
        load_kernels()
        found = request.to_nearest(lambda: None)
        if as_json:
            return print_json(nearest_reply(found))
        show(found.tables(), found.summary())
    return None
