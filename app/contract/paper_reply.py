"""The paper's reproduction as a reply; SymPy is imported here, so this module is imported on demand."""

from __future__ import annotations

from dataclasses import asdict
from functools import cache
from typing import Any

from heli2dof_core.paper.consequence import consequence
from heli2dof_core.paper.equation import Equation
from heli2dof_core.paper.equations import EQUATIONS
from heli2dof_core.paper.errata import ERRATA, Erratum
from heli2dof_core.paper.figures import figures
from heli2dof_core.paper.glossary import TERMS
from heli2dof_core.paper.reproduce import Row, reproduce, significant_digits
from heli2dof_core.symbolic.mathml import mathml
from heli2dof_core.symbolic.names import latex

from . import paper as models
from .model import Reply, reply_of

TITLE = "Symbolic Pole Assignment of 2DoF Conventional Helicopter"
AUTHORS = "T. V. Mumcu, K. K. Çandır, İ. Üstoğlu"


@cache
def paper_reply() -> Reply:
    """Steps, symbols, numbers, errata with their proofs, figures, and where the printed K puts the poles."""
    return {
        "title": TITLE,
        "authors": AUTHORS,
        "equations": [_equation(equation) for equation in EQUATIONS],
        "symbols": [{**asdict(term), "mathml": mathml(term.latex)} for term in TERMS],
        "numbers": [_row(row) for row in reproduce()],
        "errata": [_erratum(erratum) for erratum in ERRATA],
        "consequence": [reply_of(models.Outcome, outcome) for outcome in consequence()],
        "figures": [reply_of(models.Figure, figure) for figure in figures()],
    }


def _typeset(latex: str) -> Reply:
    return {"latex": latex, "mathml": mathml(latex)}


def _equation(equation: Equation) -> Reply:
    return reply_of(
        models.Equation,
        equation,
        printed=_typeset(equation.printed) if equation.printed else None,
        derived=_typeset(equation.derived()) if equation.derived else None,
    )


def _row(row: Row) -> Reply:
    printed = row.printed
    digits = significant_digits(printed.text)
    own = {**vars(printed), "printed": printed.text, "digits_printed": digits}
    return reply_of(models.PrintedNumber, row, **own)


def _erratum(erratum: Erratum) -> Reply:
    proof, evidence = erratum.prove(), erratum.evidence
    return reply_of(
        models.Erratum,
        erratum,
        printed=_typeset(erratum.printed),
        correct=_typeset(erratum.correct),
        standing="unclear" if evidence is None else "confirmed",
        evidence=None if evidence is None else evidence.words,
        proof=reply_of(
            models.Proof, proof, correct=_evidence(proof.correct), printed=_evidence(proof.printed)
        ),
    )


def _evidence(value: Any) -> Reply:
    """A residual as a formula, or a figure in words."""
    if isinstance(value, str):
        return {"text": value}
    return {"text": str(value), **_typeset(latex(value))}
