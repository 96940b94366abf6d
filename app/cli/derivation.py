"""`heli2dof symbolic` and `paper`: the formulas, and what becomes of the printed numbers."""

from __future__ import annotations

from typing import get_args

import click

from heli2dof_core.couplings import Modelled, Sought

from .fields import DESIGN
from .output import print_json, refusals, show

_NOTATIONS = ("sympy", "latex", "mathml")
_STRUCTURE = [option for option in DESIGN if option.path in ("coupling", "lead")]


@click.command()
@click.argument("names", nargs=-1)
@click.option("--model", type=click.Choice(get_args(Modelled)), default="paper", help="Four states, or six.")
@click.option("--what", type=click.Choice(get_args(Sought)), default="K", help="State feedback, or observer.")
@click.option("--shifted", is_flag=True, help="Leave the shift c of the basis a symbol.")
@click.option("--notation", type=click.Choice(_NOTATIONS), default="sympy", help="How formulas are written.")
@click.option("--json", "as_json", is_flag=True, help="Print the REST API's reply, with all of them.")
def symbolic(
    names: tuple[str, ...],
    *,
    model: Modelled,
    what: Sought,
    shifted: bool,
    notation: str,
    as_json: bool,
    coupling: str | None,
    lead: str | None,
) -> None:
    """Print the derived formulas NAMES, such as K, RGA or G_0; the gain if none is named.

    With --model rotors or --what L the gain is written in letters and groups, which can be named as well: b_11, h_1.
    """
    with refusals(as_json):
        from heli2dof_core import InvalidInputError, Structure
        from heli2dof_core.symbolic.render import symbolic_report

        from ..contract.derivation import symbolic_reply

        structure = Structure(coupling or "triangular", lead or "pitch")  # pyright: ignore[reportArgumentType]
        report = symbolic_report(structure, shifted=shifted, model=model, what=what)
        formulas = {**report.formulas, **report.definitions}
        for name in names:
            if name not in formulas:
                known = ", ".join(formulas)
                raise InvalidInputError(
                    f"there is no formula {name!r}", field="names", hint=f"Known are {known}."
                )
        if as_json:
            return print_json(symbolic_reply(report))
        for name in names or (what,):
            text = getattr(formulas[name], notation)
            click.echo(f"{name} = {text}" if notation == "sympy" else text)
    return None


for _option in reversed(_STRUCTURE):
    _option.decorate(symbolic)


@click.command()
@click.option("--json", "as_json", is_flag=True, help="Print the REST API's reply.")
def paper(as_json: bool) -> None:
    """Print every printed number beside what the formulas give, and every erratum with its proof."""
    from heli2dof_core.paper.errata import CONFIRMED, ERRATA
    from heli2dof_core.paper.reproduce import reproduce
    from heli2dof_core.tables import Table, number

    if as_json:
        from ..contract.paper_reply import paper_reply

        return print_json(paper_reply())
    rows = reproduce()
    numbers = (
        (
            r.printed.where,
            r.printed.name,
            r.printed.text,
            number(r.recomputed, 6),
            number(r.corrected, 6),
            r.verdict,
        )
        for r in rows
    )
    slips = [
        (
            e.name,
            e.where,
            "unclear in our copy" if e.evidence is None else "confirmed",
            e.why,
            "holds" if e.prove().holds else "FAILS",
        )
        for e in ERRATA
    ]
    tables = (
        Table.of("numbers", ("where", "what", "printed", "recomputed", "corrected", "verdict"), numbers),
        Table.of("slips", ("name", "where", "standing", "what is wrong", "proof"), slips),
    )
    reproduced = sum(row.verdict == "reproduced" for row in rows)
    show(
        tables,
        f"{reproduced} of {len(rows)} printed numbers are reproduced to the last digit. {len(CONFIRMED)} errata are "
        f"confirmed by the paper's own numbers; {len(ERRATA) - len(CONFIRMED)} places are unclear in our copy.",
    )
    return None
