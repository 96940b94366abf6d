"""`heli2dof place`: any system, in numbers or with letters, as the REST calls place and symbolic/place."""

from __future__ import annotations

from typing import Any

import click

from .output import print_json, refusals, show
from .values import Poles


class Matrix(click.ParamType):
    """Rows with semicolons between them, entries with commas: ``0, 1; -k/m, -b/m``."""

    name = "matrix"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Rows of texts."""
        return [[entry.strip() for entry in row.split(",")] for row in value.split(";")]


@click.command()
@click.option(
    "--A", "-A", "A", type=Matrix(), required=True, help="n×n, rows with ; and entries with , between."
)
@click.option("--B", "-B", "B", type=Matrix(), required=True, help="n×p, likewise.")
@click.option("--poles", type=Poles(), help="n, as -1,-2±3j; p_1 … p_n, in formulas, where left out.")
@click.option("--json", "as_json", is_flag=True, help="Print the REST API's reply.")
def place(A: list[list[str]], B: list[list[str]], poles: list[Any] | None, *, as_json: bool) -> None:
    """Print K of u = −Kx + v for any system; with letters in A or B, or without poles, in formulas."""
    with refusals(as_json):
        numbers = None if poles is None else _numbers(A, B)
        if numbers is None:
            return _in_symbols(A, B, poles, as_json=as_json)
        from ..contract.placement import PlaceRequest, assessment_reply

        result = PlaceRequest.model_validate({**numbers, "poles": poles}).place()
        if as_json:
            return print_json(assessment_reply(result))
        show(result.tables(), findings=result.findings)
    return None


def _numbers(A: list[list[str]], B: list[list[str]]) -> dict[str, list[list[float]]] | None:
    try:
        return {
            name: [[float(entry.replace("−", "-")) for entry in row] for row in rows]
            for name, rows in (("A", A), ("B", B))
        }
    except ValueError:
        return None


def _in_symbols(A: list[list[str]], B: list[list[str]], poles: list[Any] | None, *, as_json: bool) -> None:
    from ..contract.symbols import SymbolicPlaceRequest, symbolic_placement_reply

    request = SymbolicPlaceRequest.model_validate({"A": A, "B": B, "poles": poles or "symbols"})
    placed = request.place()
    if as_json:
        return print_json(symbolic_placement_reply(placed))
    show((), placed.summary(), findings=placed.findings)
    for name in ("T", "Q", "K"):
        click.echo(f"{name} = {getattr(placed, name)}")
    return None
