"""Every number that the paper prints, typed off it with all its digits."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..signals import Floats


@dataclass(frozen=True)
class Printed:
    """One printed number.

    Attributes:
        where: equation, table or section.
        name: the quantity, with our symbol.
        text: the number as printed; its digits are what a recomputation must meet.
        unit: the unit as it should be.
        printed_unit: the unit as printed, where it differs.
    """

    where: str
    name: str
    text: str
    unit: str
    printed_unit: str | None = None

    @property
    def value(self) -> float:
        """The printed number."""
        return float(self.text)


_TABLE_I = (
    ("g", "9.81", "m/s²", None),
    ("l", "0.1855", "m", "ms"),
    ("m", "1.3872", "kg", None),
    ("J_p", "0.0384", "kg·m²", None),
    ("J_y", "0.0431", "kg·m²", None),
    ("B_p", "0.8", "N·m·s/rad", "N/V"),
    ("B_y", "0.318", "N·m·s/rad", "N/V"),
    ("K_pp", "0.2041", "N·m/V", None),
    ("K_py", "0.0068", "N·m/V", None),
    ("K_yp", "0.0219", "N·m/V", None),
    ("K_yy", "0.0720", "N·m/V", None),
)
TABLE_I = {name: Printed("Table I", name, text, unit, wrong) for name, text, unit, wrong in _TABLE_I}
"""Body parameters."""
VOLTAGE_LIMITS = tuple(
    Printed("Table I", f"|{name}| ≤", text, "V") for name, text in (("V_p", "24"), ("V_y", "15"))
)
OPEN_LOOP_POLES = tuple(
    Printed("Section IV", f"open-loop pole {i + 1}", text, "rad/s")
    for i, text in enumerate(("0", "0", "-9.24979", "-8.76343"))
)
DESIRED_POLES = tuple(
    Printed("Section IV", f"p_{i + 1}", text, "rad/s")
    for i, text in enumerate(("-12", "-10", "-9.25", "-8.76"))
)
_K = (("51.227", "-3.278", "5.446", "-0.374"), ("-10.556", "98.333", "-1.205", "11.221"))
GAIN = tuple(
    tuple(
        Printed("Section IV", f"k_{i + 1}{j + 1}", text, "V/rad" if j < 2 else "V·s/rad")
        for j, text in enumerate(row)
    )
    for i, row in enumerate(_K)
)
RGA_COEFFICIENT = (Printed("Eq. 23", "numerator", "73", "1"), Printed("Eq. 23", "denominator", "7127", "1"))
"""λ₁₁ = 1 + (73/7127) p₃p₄/(p₁p₂)."""
PI = (Printed("Section IV", "k_p", "30", "V/rad"), Printed("Section IV", "T_i", "0.1", "s"))
"""PI(s) = 30 (1 + 1/(0.1 s)), on both axes."""
UNIT_STEP = Printed("Section IV", "step of the reference", "1", "rad")


def printed_poles() -> tuple[float, float, float, float]:
    """The desired poles, rad/s."""
    p_1, p_2, p_3, p_4 = (p.value for p in DESIRED_POLES)
    return p_1, p_2, p_3, p_4


def printed_gain() -> Floats:
    """The printed K, 2×4."""
    return np.array([[k.value for k in row] for row in GAIN])
