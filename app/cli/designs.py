"""`heli2dof gains`, `rga` and `step`: one design, as the REST calls of these names."""

from __future__ import annotations

from typing import IO, Any

import click

from .fields import DESIGN, FREQUENCIES, LOOPS, MODEL, SCENARIO, body, takes
from .output import print_json, refusals, show


@click.command()
@takes(*DESIGN)
def gains(as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Print K of u = −Kx + v and the poles that it gives."""
    from heli2dof_core import loop_of, place
    from heli2dof_core.loop import lag_table

    from ..contract.design import DesignRequest, gains_of

    with refusals(as_json):
        spec = DesignRequest.model_validate(body(base, values)).to_spec()
        if as_json:
            return print_json(gains_of(spec))
        design = place(spec)
        show((*design.tables(), lag_table(loop_of(spec, design))), findings=design.findings)
    return None


@click.command()
@takes(*DESIGN, *LOOPS, FREQUENCIES)
def rga(as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Print the relative gain array at s = 0, what it advises, and |RGA(jω)|."""
    from heli2dof_core import interaction, place
    from heli2dof_core.tables import Table, number

    from ..contract.frequency import RgaRequest, rga_reply

    with refusals(as_json):
        request = RgaRequest.model_validate(body(base, values))
        spec = request.to_spec()
        design = place(spec)
        gains = interaction(design, spec.outer.pairing)
        reply = rga_reply(design, gains, request.frequencies)
        if as_json:
            return print_json(reply)
        pairs = zip(request.frequencies, reply.get("rga_magnitude", ()), strict=False)
        rows = [(number(w), number(rows[0][0]), number(rows[0][1])) for w, rows in pairs]
        heads = ("ω (rad/s)", "|λ₁₁|", "|λ₁₂|")
        over = (Table.of("over frequency", heads, rows),) if rows else ()
        show((*gains.tables(), *over), gains.summary(), findings=gains.findings)
    return None


@click.command()
@takes(*DESIGN, *LOOPS, *SCENARIO, MODEL)
def step(as_json: bool, base: IO[str] | None, **values: Any) -> None:
    """Print the metrics of a step response; with --json its trajectories too."""
    from heli2dof_core import loop_of, simulate

    from ..contract.experiment import ResponseRequest, states_reply, step_reply

    with refusals(as_json):
        request = ResponseRequest.model_validate(body(base, values))
        spec = request.to_spec()
        loop = loop_of(spec)
        result = simulate(loop, spec, request.scenario.model)
        if as_json:
            return print_json(step_reply(result, loop) | (states_reply(result) if request.states else {}))
        show((*result.tables(), *loop.tables()), result.response.summary(), findings=result.findings)
    return None
