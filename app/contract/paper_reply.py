"""The paper's reproduction as a reply; SymPy is imported here, so this module is imported on demand."""

from __future__ import annotations

from dataclasses import asdict
from functools import cache
from typing import Any

import sympy as sp
from latex2mathml.converter import convert

from heli2dof_core.paper.consequence import consequence
from heli2dof_core.paper.equation import Equation
from heli2dof_core.paper.equations import EQUATIONS
from heli2dof_core.paper.errata import ERRATA, Erratum
from heli2dof_core.paper.figures import Figure, figures
from heli2dof_core.paper.glossary import TERMS
from heli2dof_core.paper.printed import Printed
from heli2dof_core.paper.reproduce import Row, reproduce, significant_digits
from heli2dof_core.symbolic.names import LATEX

from .model import Reply, poles_reply, present

TITLE = "Symbolic Pole Assignment of 2DoF Conventional Helicopter"
AUTHORS = "T. V. Mumcu, K. K. Çandır, İ. Üstoğlu"


@cache
def paper_reply() -> Reply:
    """Steps, symbols, numbers, errata with their proofs, figures, and where the printed K puts the poles."""
    return {
        "title": TITLE,
        "authors": AUTHORS,
        "equations": [_equation(equation) for equation in EQUATIONS],
        "symbols": [{**asdict(term), "mathml": convert(term.latex)} for term in TERMS],
        "numbers": [_row(row) for row in reproduce()],
        "errata": [_erratum(erratum) for erratum in ERRATA],
        "consequence": [
            {
                "plant": outcome.plant,
                "poles": poles_reply(outcome.poles),
                "unrounded": poles_reply(outcome.unrounded),
            }
            for outcome in consequence()
        ],
        "figures": [_figure(figure) for figure in figures()],
    }


def _typeset(latex: str) -> Reply:
    return {"latex": latex, "mathml": convert(latex)}


def _equation(equation: Equation) -> Reply:
    return {
        "number": equation.number,
        "title": equation.title,
        "chapter": equation.chapter,
        "plain": equation.plain,
        "status": equation.status,
        "note": equation.note,
        "errata": list(equation.errata),
        "formulas": list(equation.formulas),
        **({"printed": _typeset(equation.printed)} if equation.printed else {}),
        **({"derived": _typeset(equation.derived())} if equation.derived else {}),
    }


def _row(row: Row) -> Reply:
    return present(
        {
            **_printed(row.printed),
            "formula": row.formula,
            "recomputed": row.recomputed,
            "corrected": row.corrected,
            "on_rig": row.on_rig,
            "digits": row.digits,
            "digits_printed": significant_digits(row.printed.text),
            "verdict": row.verdict,
            "note": row.note,
        }
    )


def _printed(printed: Printed) -> Reply:
    return {
        "where": printed.where,
        "name": printed.name,
        "printed": printed.text,
        "unit": printed.unit,
        "printed_unit": printed.printed_unit,
    }


def _erratum(erratum: Erratum) -> Reply:
    proof, evidence = erratum.prove(), erratum.evidence
    return {
        "name": erratum.name,
        "where": erratum.where,
        "printed": _typeset(erratum.printed),
        "correct": _typeset(erratum.correct),
        "why": erratum.why,
        "effect": erratum.effect,
        "standing": "unclear" if evidence is None else "confirmed",
        **({} if evidence is None else {"evidence": evidence.words}),
        "proof": {
            "statement": proof.statement,
            "correct": _evidence(proof.correct),
            "printed": _evidence(proof.printed),
            "holds": proof.holds,
            "labels": list(proof.labels),
        },
    }


def _evidence(value: Any) -> Reply:
    """A residual as a formula, or a figure in words."""
    if isinstance(value, str):
        return {"text": value}
    return {"text": str(value), **_typeset(sp.latex(value, symbol_names=LATEX, mat_delim="["))}


def _figure(figure: Figure) -> Reply:
    return {
        "number": figure.number,
        "output": figure.output,
        "t": figure.t,
        "curves": [asdict(curve) for curve in figure.curves],
    }
