"""What the derivation's steps are made of: an equation as printed and as derived, with one plain sentence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Literal

from ..symbolic.names import latex

Status = Literal["reproduced", "corrected", "explained"]
Chapter = Literal["machine", "mechanics", "linear", "feedback", "interaction", "loops"]


@dataclass(frozen=True, kw_only=True)
class Equation:
    """One numbered equation, table or figure, or a step that the paper leaves out.

    Attributes:
        number: as in the paper, such as ``Eq. 13``; a few words in small letters where it has none.
        title: what it is.
        plain: what is done here, in one sentence that needs no formula.
        printed: LaTeX as printed in our copy; empty for a picture and for a step left out.
        derived: computes the LaTeX of what heli2dof derives or uses; None where the printed form is it.
        status: reproduced as printed, corrected, or explained in words.
        note: what a reader should know.
        errata: names of the errata that concern it.
        formulas: what of `symbolic.render.SymbolicReport.formulas` stands here, where it depends on
            the closed loop's structure; `derived` shows the paper's structure.
        chapter: where it stands in the derivation; `equations` says it for whole chapters.
    """

    number: str
    title: str
    plain: str
    printed: str = ""
    derived: Callable[[], str] | None = None
    status: Status = "reproduced"
    note: str = ""
    errata: tuple[str, ...] = ()
    formulas: tuple[str, ...] = ()
    chapter: Chapter | None = None


def named(name: str, value: Callable[[], Any]) -> Callable[[], str]:
    """Computes ``name = value``."""
    return lambda: f"{name} = {latex(value())}"
