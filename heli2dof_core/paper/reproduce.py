"""The paper's numbers one by one: printed, from the printed formula, corrected, digits that agree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from decimal import ROUND_HALF_EVEN, Decimal
from fractions import Fraction
from functools import cache
from typing import Literal

import numpy as np

from ..design import design
from ..parameters import Parameters
from ..plant import plant
from ..poles import PoleSet
from ..presets import preset
from . import as_printed
from .printed import (
    DESIRED_POLES,
    GAIN,
    OPEN_LOOP_POLES,
    PI,
    RGA_COEFFICIENT,
    TABLE_I,
    UNIT_STEP,
    VOLTAGE_LIMITS,
    Printed,
    printed_poles,
)

Verdict = Literal["reproduced", "differs", "given"]


@dataclass(frozen=True)
class Row:
    """One printed number and what becomes of it.

    Attributes:
        printed: the number.
        formula: which printed formula gives it; empty where it is given.
        recomputed: by that formula, from the values that the paper computed with; None where given.
        corrected: by the right formula, from the same values.
        on_rig: by the right formula, for the default rig.
        digits: how many of the printed significant digits the recomputation has.
        verdict: reproduced to the last digit, or not, or given without a formula.
        note: the reason where digits differ.
    """

    printed: Printed
    formula: str
    recomputed: float | None
    corrected: float | None
    on_rig: float | None
    digits: int | None
    verdict: Verdict
    note: str


@cache
def reproduce() -> tuple[Row, ...]:
    """Every printed number, in the order of the paper."""
    return (*_gain_coefficients(), *_body_parameters(), *_poles(), *_gain(), *_chosen())


def significant_digits(text: str) -> int:
    """Significant digits of a printed number."""
    return max(len(Decimal(text).as_tuple().digits), 1)


def digits_that_agree(text: str, value: float) -> int:
    """How many leading significant digits of a printed number survive a recomputation, rounded alike."""
    printed, found = Decimal(text), Decimal(value)
    last = printed.as_tuple().exponent
    places = last if isinstance(last, int) else 0
    total = significant_digits(text)
    for dropped in range(total):
        unit = Decimal(1).scaleb(places + dropped)
        if printed.quantize(unit, ROUND_HALF_EVEN) == found.quantize(unit, ROUND_HALF_EVEN):
            return total - dropped
    return 0


def _row(
    printed: Printed, formula: str, recomputed: float, corrected: float, on_rig: float, *, note: str = ""
) -> Row:
    digits = digits_that_agree(printed.text, recomputed)
    same = digits == significant_digits(printed.text)
    return Row(
        printed, formula, recomputed, corrected, on_rig, digits, "reproduced" if same else "differs", note
    )


def _gain_coefficients() -> Iterator[Row]:
    """Eq. 23's 73/7127, exactly, from the thrust constants as decimal fractions."""
    rigs = [preset(name).parameters for name in ("paper-as-computed", "quanser-2dof-manual")]
    k, on_rig = (_coupling(rig) for rig in rigs)
    for printed, own, other in zip(
        RGA_COEFFICIENT, k.as_integer_ratio(), on_rig.as_integer_ratio(), strict=True
    ):
        yield _row(printed, "Eq. 23", own, own, other, note="exact, as a fraction in lowest terms")


def _coupling(rig: Parameters) -> Fraction:
    K_pp, K_py, K_yp, K_yy = (Fraction(str(getattr(rig, n))) for n in ("K_pp", "K_py", "K_yp", "K_yy"))
    return K_py * K_yp / (K_pp * K_yy - K_py * K_yp)


_FROM_COMPONENTS = {"K_pp": "Eq. 8", "K_py": "Eq. 8", "K_yp": "Eq. 8", "K_yy": "Eq. 8", "l": "Eq. 1"}
_TABLE_NOTES = {
    "l": "Eq. 1 with the design file's masses gives 0.18567; the results used 0.186",
    "J_y": "the design file has 0.0431517; the results used 0.0432",
    "K_pp": "the results used 0.204",
    "m": "the results used 1.39",
    "B_y": "the results used 0.8",
}


def _given(
    printed: Printed, corrected: float | None = None, on_rig: float | None = None, note: str = ""
) -> Row:
    return Row(printed, "", None, corrected, on_rig, None, "given", note)


def _body_parameters() -> Iterator[Row]:
    """Table I against the design file, whose thrust constants and l come from Eqs. 1 and 8."""
    file, used, rig = (
        preset(name).parameters.as_dict()
        for name in ("quanser-2dof-design-file", "paper-as-computed", "quanser-2dof-manual")
    )
    for name, printed in TABLE_I.items():
        note = _TABLE_NOTES.get(name, "")
        if name in _FROM_COMPONENTS or name in ("J_p", "J_y"):
            formula = _FROM_COMPONENTS.get(name, "design file")
            yield _row(printed, formula, file[name], used[name], rig[name], note=note)
        else:
            yield _given(printed, used[name], rig[name], note)
    for printed in VOLTAGE_LIMITS:
        yield _given(printed, None, printed.value)


def _poles() -> Iterator[Row]:
    computed, rig = (preset(name).parameters for name in ("paper-as-computed", "quanser-2dof-manual"))
    printed_A = as_printed.number(as_printed.system_matrix(), computed)
    for i, printed in enumerate(OPEN_LOOP_POLES):
        index = (0, 1, 2, 3)[i]
        own, corrected, other = (
            float(A[index, index]) + 0.0 for A in (printed_A, plant(computed).A, plant(rig).A)
        )
        note = "" if i < 3 else "−0.8/β: the results take B_p for B_y; the rig's own is −B_y/β"
        yield _row(printed, "Eq. 13", own, corrected, other, note=note)
    for printed in DESIRED_POLES:
        yield _given(printed, note="chosen; see where the printed K really puts them")


def _gain() -> Iterator[Row]:
    computed, rig = (preset(name).parameters for name in ("paper-as-computed", "quanser-2dof-manual"))
    poles = printed_poles()
    own = as_printed.number(as_printed.gain(), computed, poles)
    corrected, other = (design(plant(p), PoleSet(poles)).K for p in (computed, rig))
    for i, j in np.ndindex(2, 4):
        note = "" if j in (0, 2) else "printed with α for β"
        yield _row(
            GAIN[i][j], "Eqs. 21, 22", float(own[i, j]), float(corrected[i, j]), float(other[i, j]), note=note
        )


def _chosen() -> Iterator[Row]:
    for printed in (*PI, UNIT_STEP):
        yield _given(printed, None, printed.value, "chosen")
