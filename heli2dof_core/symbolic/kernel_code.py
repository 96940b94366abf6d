"""The derivation as kernels: the source of `kernels/derived.py` and `kernels/derived_rotors.py`.

K is written in the letters of the plant's entries (`reading`), where it is shortest: what can be divided out is, so
that only those differences are left that the matter has. Δ, the determinant of B₂, is that of the thrust constants
as they are given. An entry is Σ polynomial × (thrusts and c, over thrusts and Δ), and what recurs within a function
is computed once.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.polys.matrices import DomainMatrix
from sympy.printing.precedence import precedence
from sympy.printing.pycode import PythonCodePrinter

from ..couplings import STRUCTURES, Structure
from .full_rank import FullRank, steady_state_inverse
from .linearization import linear_model
from .names import PARAMETERS, Delta, a, alpha, beta_0, cos_0, phi_p, phi_y, sin_0, tau_p, tau_y, theta_0
from .reading import (
    ENTRIES,
    RATES,
    collected,
    gain_in_letters,
    monomial_out,
    observer_in_letters,
    paper_gain_in_letters,
    parts,
    plant_in_letters,
)
from .rotors import COEFFICIENTS

_HEAD = '''"""{about}

Made of the derivation by `python -m tests.kernel_formulas`; not to be changed by hand.

p: the parameters, in the order of `parameters.PARAMETER_INFO`; theta_0: rad; d: coefficients of the desired
polynomials, d₁₀, d₁₁ …, d₂₀, d₂₁ …, the leading 1 left out; tau: both rotors' time constants, s; family: where the
structure stands in `couplings.STRUCTURES`; c: the basis' shift, looked at where `shifted`. Nothing is checked: where
there is no such structure something is divided by zero.
"""

from __future__ import annotations

{imports}
'''
_LETTERS = (a, *ENTRIES, Delta)
"""What the rig is in all formulas."""
_ANGLES = {sin_0: sp.sin(theta_0), cos_0: sp.cos(theta_0)}
_PARAMETERS = ("p", tuple(PARAMETERS.values()))
_RIG = ("rig", _LETTERS)
_PAPER = ("d", COEFFICIENTS[0][:2] + COEFFICIENTS[1][:2])
_SIX = ("d", COEFFICIENTS[0] + COEFFICIENTS[1])
_TAU = ("tau", (tau_p, tau_y))
_IN_A_LINE = 6
Read = tuple[str, Sequence[sp.Symbol]]
"""An argument that is indexed, and the symbols that it holds."""


def modules() -> dict[str, str]:
    """The files' texts by their names, before they are formatted."""
    paper = _HEAD.format(
        about="The rig's linear model, K of the paper's four states and L of the observer, in closed form.",
        imports="from .jit import keep_apart, kernel\nfrom .trigonometry import sine_and_cosine",
    )
    rotors = _HEAD.format(
        about="K of the six states, those of both rotors among them, in closed form.",
        imports="from .derived import entries\nfrom .jit import keep_apart, kernel",
    )
    return {
        "derived.py": "\n\n".join((paper, _entries(), _rig_model(), *_paper_gains(), _observer())),
        "derived_rotors.py": "\n\n".join((rotors, *_gains_with_rotors())),
    }


def _entries() -> str:
    own = {x: value.subs({phi_p: 1, phi_y: 1}) for x, value in ENTRIES.items()}
    (b_11, b_12), (b_21, b_22) = plant_in_letters()[1].to_Matrix().tolist()[2:]
    known = linear_model().definitions
    values = {
        **{x: known[x] for x in (alpha, beta_0, a)},
        **own,
        Delta: sp.factor((b_11 * b_22 - b_12 * b_21).subs(own)),
    }
    given = {str(x): value.subs(_ANGLES) for x, value in values.items()}
    return _function(
        "entries(p, theta_0)",
        f"{', '.join(map(str, _LETTERS))}: what A and B are made of; Delta is B₂'s determinant.",
        [_PARAMETERS],
        [*_assigned(given), f"return {', '.join(map(str, _LETTERS))}"],
    )


def _rig_model() -> str:
    A, B = (matrix.to_Matrix() for matrix in plant_in_letters())
    trim = linear_model().trim.subs(_ANGLES)
    return _function(
        "rig_model(p, theta_0, A, B, trim)",
        "A, 4×4, B, 4×2, and the voltages that hold the rig, (2,), into the arrays given.",
        [_RIG, _PARAMETERS],
        _assigned({**_cells("A", A), **_cells("B", B), "trim[0]": trim[0], "trim[1]": trim[1]}),
    )


def _paper_gains() -> Iterator[str]:
    yield _choice(
        "full_rank_gain",
        "K, into the first four columns of what is given, and Ĝ(0)⁻¹, 2×2, of four states.",
        [_PAPER],
    )
    for structure, shifted in _members():
        yield _gain(structure, shifted, paper_gain_in_letters(structure, shifted=shifted), [_PAPER])


def _gains_with_rotors() -> Iterator[str]:
    yield _choice(
        "full_rank_gain_with_rotors",
        "K, 2×6, and Ĝ(0)⁻¹, 2×2, of six states; the thrust constants in p are times the curves' slopes φ′.",
        [_SIX, _TAU],
    )
    for structure, shifted in _members():
        yield _gain(structure, shifted, gain_in_letters(structure, shifted=shifted), [_SIX, _TAU])


def _observer() -> str:
    """All structures have the same L, since neither A nor C couples the axes; only a shift would give another."""
    L, *others = (observer_in_letters(structure).K.transpose() for structure in STRUCTURES)
    if any(other != L for other in others):
        raise AssertionError("the observer's gain is not the same for all structures")
    return _function(
        "full_rank_observer(d, p, theta_0, L)",
        "L, 4×2, whatever the structure; d are the coefficients of the observer's polynomials.",
        [_RIG, _PAPER],
        _shared(_cells("L", _written(L))),
    )


def _members() -> Iterator[tuple[Structure, bool]]:
    """Those that need a function: an input-diagonal one without shift has the shift 0."""
    for structure in STRUCTURES:
        if structure.coupling != "input-diagonal":
            yield structure, False
        if structure.coupling != "axis-decoupled":
            yield structure, True


def _call(structure: Structure, shifted: bool, read: Sequence[Read], shift: str = "c") -> str:
    triangular = structure.coupling == "triangular"
    name = f"{structure.lead}_leads" if triangular else structure.coupling.replace("-", "_")
    own = ["rig", *(array for array, _ in read), *([shift] if shifted else []), "K", "inverse"]
    return f"{name}{'_shifted' if shifted else ''}({', '.join(own)})"


def _gain(structure: Structure, shifted: bool, placed: FullRank, read: Sequence[Read]) -> str:
    K, inverse = placed.K, steady_state_inverse(placed.K, *plant_in_letters())
    return _function(
        _call(structure, shifted, read),
        f"{structure.title.capitalize()}{', with a shift' if shifted else ''}; rig as `entries` gives it.",
        [_RIG, *read],
        _shared({**_cells("K", _written(K)), **_cells("inverse", _written(inverse))}),
    )


def _choice(name: str, about: str, read: Sequence[Read]) -> str:
    """The function that calls the one for a structure."""
    (d, _), *others = read
    arguments = ["family", "shifted", d, "p", "theta_0", *(array for array, _ in others), "c", "K", "inverse"]
    lines = ["keep_apart()", "rig = entries(p, theta_0)"]
    for i, structure in enumerate(STRUCTURES):
        lines.append(f"{'elif' if i else 'if'} family == {i}:")
        own = {
            shifted: _call(structure, shifted, read) for member, shifted in _members() if member == structure
        }
        if len(own) > 1:
            lines += ["    if shifted:", f"        {own[True]}", "    else:", f"        {own[False]}"]
        elif True in own:
            lines.append(f"    {_call(structure, True, read, 'c if shifted else 0.0')}")
        else:
            lines.append(f"    {own[False]}")
    return _function(f"{name}({', '.join(arguments)})", about, [], lines)


def _function(signature: str, about: str, read: Sequence[Read], body: Sequence[str]) -> str:
    """A kernel that takes from its arguments what its body needs."""
    words = set(re.findall(r"\w+", "\n".join(body)))
    lines = [f'"""{about}"""']
    for array, symbols in read:
        used = [(str(x), f"{array}[{i}]") for i, x in enumerate(symbols) if str(x) in words]
        if array == "rig" and "rig" not in signature.partition("(")[2]:
            lines.append("rig = entries(p, theta_0)")
        rows = (used[i : i + _IN_A_LINE] for i in range(0, len(used), _IN_A_LINE))
        lines += [" = ".join(map(", ".join, zip(*row, strict=True))) for row in rows]
    angles = [name if name in words else "_" for name in ("sin_0", "cos_0")]
    if angles != ["_", "_"]:
        lines.append(f"{', '.join(angles)} = sine_and_cosine(theta_0)")
    return "\n".join(("@kernel", f"def {signature}:", *(f"    {line}" for line in (*lines, *body))))


def _cells(name: str, matrix: Any) -> dict[str, sp.Expr]:
    rows, columns = matrix.shape
    return {f"{name}[{i}, {j}]": matrix[i, j] for i in range(rows) for j in range(columns)}


def _written(matrix: DomainMatrix) -> sp.Matrix:
    return sp.Matrix([[_entry(element) for element in row] for row in matrix.to_list()])


def _entry(element: Any) -> sp.Expr:
    """Σ polynomial × (thrusts and c, over thrusts and Δ), each polynomial once."""
    sums: dict[Any, tuple[sp.Expr, sp.Expr]] = {}
    for coefficient, outer in parts(element):
        content, rest, shared = monomial_out(coefficient)
        own, rates = shared.as_independent(*RATES)
        key = (frozenset(rest.terms()), own)
        inner, before = sums.get(key, (own * collected(rest), sp.S.Zero))
        sums[key] = inner, before + content * (rates * outer).subs(RATES)
    return sp.Add(*(inner * sp.factor(outer) for inner, outer in sums.values()))


def _shared(targets: Mapping[str, sp.Expr]) -> list[str]:
    """Assignments; what recurs has a name of its own."""
    found: Any
    left: Any
    found, left = sp.cse([*targets.values()], symbols=sp.numbered_symbols("y_"))
    own: dict[str, Any] = {}
    known: dict[Any, Any] = {}
    numbered = sp.numbered_symbols("x_", start=1)
    for symbol, value in found:
        if (-value).is_Symbol:  # a sign is not worth a name
            known[symbol] = value.xreplace(known)
        else:
            name = next(numbered)
            own[str(name)] = value.xreplace(known)
            known[symbol] = name
    return _assigned({**own, **dict(zip(targets, (value.xreplace(known) for value in left), strict=True))})


def _assigned(targets: Mapping[str, sp.Expr]) -> list[str]:
    """Assignments in this order."""
    return [f"{name} = {_Printer().doprint(value)}" for name, value in targets.items()]


class _Printer(PythonCodePrinter):
    """Floats' arithmetic: squares are products, which are rounded once wherever they are computed."""

    def _print_Pow(self, expr: Any, rational: bool = False) -> str:
        if abs(expr.exp) == 2:
            base = self.parenthesize(expr.base, precedence(expr))
            return f"({base}*{base})" if expr.exp == 2 else f"1.0/({base}*{base})"
        return super()._print_Pow(expr, rational)

    def _print_sin(self, expr: Any) -> str:
        return "sin_0"

    def _print_cos(self, expr: Any) -> str:
        return "cos_0"

    def _print_Integer(self, expr: Any) -> str:
        return f"{expr}.0" if expr in (0, 1) else str(expr)
