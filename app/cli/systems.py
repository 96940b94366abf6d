"""`heli2dof place` and `heli2dof system`: any system, in numbers or with letters, as REST has it."""

from __future__ import annotations

from typing import Any, TextIO

import click

from .output import print_json, refusals, show
from .values import Numbers, Poles


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


@click.command()
@click.argument("file", type=click.File(encoding="utf-8"))
@click.option("--poles", type=Poles(), help="n, as -1,-2±3j; those of the file where left out.")
@click.option("--observer-poles", type=Poles(), help="n, likewise; no observer where there are none.")
@click.option("--method", default=None, help="Of placement; full-rank where left out.")
@click.option(
    "--x0",
    type=Numbers(),
    help="n, as 1,0: where the states begin in the responses that --json prints; 1,0,… where left out.",
)
@click.option("--json", "as_json", is_flag=True, help="Print the REST API's replies, one a line.")
def system(
    file: TextIO,
    poles: list[Any] | None,
    observer_poles: list[Any] | None,
    method: str | None,
    x0: list[float] | None,
    *,
    as_json: bool,
) -> None:
    """Read a system from FILE (- for standard input), as MATLAB, Python or a page of text has it."""
    with refusals(as_json):
        from heli2dof_core.systems.analysis import analyse
        from heli2dof_core.systems.pasted import read_system

        from ..contract.system_replies import design_reply, read_reply
        from ..contract.systems import SystemDesignRequest

        text = file.read()
        pasted = read_system(text)
        looked = analyse(pasted.system)
        if as_json:
            print_json(read_reply(text))
        else:
            show(looked.tables(), looked.summary(), findings=(*pasted.findings, *looked.findings))
        wanted = poles or _as_asked(pasted.poles)
        if not wanted:
            return
        own = pasted.system
        body = {
            **{name: getattr(own, name).tolist() for name in ("AB" if not own.measured else "ABCD")},
            "poles": wanted,
            "observer_poles": observer_poles or _as_asked(pasted.observer_poles),
            **({"method": method} if method else {}),
            "x0": x0,
        }
        request = SystemDesignRequest.model_validate(body)
        if as_json:
            print_json(design_reply(request))
        else:
            loop = request.loop()
            show(loop.tables(), loop.summary(), findings=loop.findings)


def _as_asked(poles: tuple[complex, ...] | None) -> list[Any] | None:
    return None if poles is None else [{"re": p.real, "im": p.imag} for p in poles]
