"""Placement in symbols: the grammar, K against NumPy, and that the conditions are right and complete."""

from __future__ import annotations

import random
import re
import time
from fractions import Fraction

import numpy as np
import pytest
import sympy as sp
from sympy import QQ
from sympy.polys.matrices import DomainMatrix

from heli2dof_core import (
    InvalidInputError,
    UncontrollableError,
    UnpairedPolesError,
    full_rank,
    symbolic_place,
)
from heli2dof_core.placement.groups import Group
from heli2dof_core.symbolic import luenberger
from heli2dof_core.symbolic.budget import within_budget
from heli2dof_core.symbolic.entries import printable
from heli2dof_core.symbolic.grammar import parse

OSCILLATOR = [["0", "1"], ["-k/m", "-b/m"]], [["0"], ["1/m"]]
HELICOPTER = (
    [["0", "0", "1", "0"], ["0", "0", "0", "1"], ["a", "0", "-B_p/alpha", "0"], ["0", "0", "0", "-B_y/beta"]],
    [["0", "0"], ["0", "0"], ["K_pp/alpha", "K_py/alpha"], ["K_yp/beta", "K_yy/beta"]],
)
THREE = (
    [["a", "b", "0"], ["0", "c", "1/d"], ["e", "0", "a*c - 1"]],
    [["1", "0"], ["0", "f"], ["g", "2"]],
)
CHAIN = (
    [
        ["0", "0", "0", "1", "0", "0"],
        ["0", "0", "0", "0", "1", "0"],
        ["0", "0", "0", "0", "0", "1"],
        ["-k_1/m_1", "k_1/m_1", "0", "0", "0", "0"],
        ["k_1/m_2", "-(k_1 + k_2)/m_2", "k_2/m_2", "0", "0", "0"],
        ["0", "k_2/m_3", "-k_2/m_3", "0", "0", "0"],
    ],
    [["0"], ["0"], ["0"], ["1/m_1"], ["0"], ["0"]],
)
GENERAL = [["a", "b", "c"], ["d", "e", "f"], ["g", "h", "k"]], [["1", "0"], ["0", "1"], ["0", "p"]]
CANCELLED = [["(x^2 - 1)/(x - 1)", "1"], ["y", "x*y - 2"]], [["y"], ["x/x + 1"]]
PLANTS = (OSCILLATOR, HELICOPTER, THREE, CHAIN, GENERAL, CANCELLED)


def calculated(text, values):
    """An entry by Python's own arithmetic on fractions, which reads these texts as the grammar should."""
    names = {**values, "__builtins__": {}}
    return eval(
        _FRACTIONS.sub(r"Fraction('\g<0>')", text.replace("^", "**")), {**names, "Fraction": Fraction}
    )


_FRACTIONS = re.compile(r"(?<![\w.^*])\d+(?:\.\d+)?(?![\w.])")


def exact(rows, values):
    entries = [[Fraction(calculated(x, values)) for x in row] for row in rows]
    return DomainMatrix(
        [[QQ(x.numerator, x.denominator) for x in row] for row in entries], (len(rows), len(rows[0])), QQ
    )


def rational(matrix):
    return DomainMatrix.from_Matrix(matrix).convert_to(QQ).to_dense()


def random_values(placed, rng):
    return {name: Fraction(rng.randint(-40, 40), rng.randint(1, 9)) for name in placed.letters}


def numbers_of(placed, values):
    return {placed.letters[name]: sp.Rational(v.numerator, v.denominator) for name, v in values.items()}


@pytest.mark.parametrize(("A", "B"), PLANTS, ids=lambda m: f"{len(m)}x{len(m[0])}")
def test_away_from_the_conditions_the_poles_are_placed(A, B):
    """K at random rational letters: characteristic polynomial exact, eigenvalues by NumPy, K as in numbers."""
    rng, placed, n = random.Random(7), symbolic_place(A, B), len(A)
    done = 0
    while done < 6:
        values = random_values(placed, rng)
        numbers = numbers_of(placed, values)
        if any(condition.subs(numbers) == 0 for condition in placed.holds_unless):
            continue
        done += 1
        exactly = exact(A, values), exact(B, values)
        assert luenberger.controllability_indices(*exactly) == placed.controllability_indices
        poles = [-sp.Rational(k + 2, 2) for k in range(n)]
        at = numbers | {sp.Symbol(f"p_{i + 1}"): p for i, p in enumerate(poles)}
        K = rational(placed.K.subs(at))
        closed = exactly[0] - exactly[1].matmul(K)
        assert closed.to_Matrix() == placed.closed_loop.subs(at)
        s = sp.Symbol("s")
        wanted = sp.Poly(sp.expand(sp.Mul(*(s - p for p in poles))), s)
        assert [sp.Rational(c) for c in closed.charpoly()] == wanted.all_coeffs()
        T, Q = (rational(m.subs(at)) for m in (placed.T, placed.Q))
        ends = np.cumsum(placed.controllability_indices) - 1
        assert T.matmul(exactly[1]).extract(ends.tolist(), list(range(len(B[0])))) == Q
        numeric = [np.array(m.to_Matrix().tolist(), dtype=float) for m in exactly]
        found = np.linalg.eigvals(numeric[0] - numeric[1] @ np.array(K.to_Matrix().tolist(), dtype=float))
        assert np.max(np.abs(np.sort(found.real) - np.sort([float(p) for p in poles]))) < 1e-2
        general = full_rank(*numeric, [float(p) for p in poles]).K
        np.testing.assert_allclose(
            np.array(K.to_Matrix().tolist(), dtype=float), general, rtol=1e-6, atol=1e-6
        )


@pytest.mark.parametrize(("A", "B"), PLANTS, ids=lambda m: f"{len(m)}x{len(m[0])}")
def test_on_each_condition_the_entries_do_not_exist_or_the_indices_are_others(A, B):
    rng, placed = random.Random(11), symbolic_place(A, B)
    assert len(set(placed.holds_unless)) == len(placed.holds_unless)
    for condition in placed.holds_unless:
        symbol = min(condition.free_symbols, key=lambda x: (sp.degree(condition, x), str(x)))
        assert sp.degree(condition, symbol) == 1, "these plants' conditions can be met by rational numbers"
        tried = 0
        while tried < 3:
            values = {name: v or Fraction(1) for name, v in random_values(placed, rng).items()}
            others = {s: x for s, x in numbers_of(placed, values).items() if s != symbol}
            line = sp.Poly(condition.subs(others), symbol)
            if line.degree() < 1:
                continue
            tried += 1
            root = -line.coeff_monomial(1) / line.coeff_monomial(symbol)
            name = next(name for name, own in placed.letters.items() if own == symbol)
            values[name] = Fraction(int(root.p), int(root.q))
            try:
                indices = luenberger.controllability_indices(exact(A, values), exact(B, values))
            except (ZeroDivisionError, UncontrollableError):
                continue
            assert indices != placed.controllability_indices


def test_the_helicopters_gain_is_that_of_its_own_derivation():
    from heli2dof_core.couplings import Structure
    from heli2dof_core.symbolic.full_rank import full_rank as derived
    from heli2dof_core.symbolic.names import COEFFICIENTS_OF_POLES, beta_0

    own = derived(Structure("input-diagonal")).K.to_Matrix().subs(COEFFICIENTS_OF_POLES)
    placed = symbolic_place(*HELICOPTER)
    K = placed.K.subs(placed.letters["beta"], beta_0)
    assert all(sp.cancel(x) == 0 for x in K - own)
    assert placed.controllability_indices == (2, 2)
    conditions = {sp.sympify(x) for x in ("alpha", "beta_", "K_pp*K_yy - K_py*K_yp")}
    assert set(placed.holds_unless) == conditions


def test_poles_as_numbers_are_decimals_and_conjugates_keep_k_real():
    placed = symbolic_place(*OSCILLATOR, poles=[-0.1 + 0.2j, -0.1 - 0.2j])
    k, m, b = sp.symbols("k m b")
    assert sp.simplify(placed.K - sp.Matrix([[m / 20 - k, m / 5 - b]])) == sp.zeros(1, 2)
    grouped = symbolic_place(*GENERAL, groups=[Group((1,), (0,)), Group((0,), (1, 2))])
    assert grouped.groups[0].inputs == (1,)
    joined = symbolic_place([["0", "a"], ["b", "0"]], [["1", "0"], ["0", "1"]], poles=[-1 + 1j, -1 - 1j])
    assert joined.groups == (Group((0, 1), (0, 1)),)
    assert joined.closed_loop.charpoly().all_coeffs() == [1, 2, 2]


def test_roots_of_letters_are_exact():
    placed = symbolic_place([["0", "sqrt(k/m)"], ["-sqrt(k/m)", "4^(1/2)*k^0.5"]], [["0"], ["1"]])
    k, m = (sp.Symbol(x, positive=True) for x in "km")
    K = placed.K.subs({"k": k, "m": m})
    p_1, p_2 = sp.symbols("p_1 p_2")
    w = sp.sqrt(k / m)
    expected = sp.Matrix([[p_1 * p_2 / w - w, 2 * sp.sqrt(k) - p_1 - p_2]])
    assert all(sp.simplify(x) == 0 for x in K - expected)
    assert set(map(str, placed.holds_unless)) == {"k", "m"}
    assert [f.code for f in placed.findings] == ["positive_letters"]
    # √x √x − x is 0, so that this input does nothing: found only if roots are no letters of their own
    with pytest.raises(InvalidInputError):
        symbolic_place([["0", "1"], ["0", "0"]], [["0"], ["sqrt(x)*sqrt(x) - x"]])
    assert symbolic_place([["0", "1"], ["0", "0"]], [["0"], ["1 + sqrt(x)"]]).holds_unless == ()


GRAMMAR = [
    "1 - 2 - 3", "2^3^2/100", "-2^2", "2^-1", "(-2)^2", "1/2/2", "2*-3", "--3", "+4", "1.5e2", ".5", "3.", "((2))",
    "a - (b - c)*a/b", "a^2*b - 1/(a*b)", "-a^-2", "-(a + b)^3", "a*b/c*b", "a/b/c", "1e-3*a",
]  # fmt: skip


@pytest.mark.parametrize("text", GRAMMAR)
def test_texts_mean_what_sympy_reads_in_them(text):
    value = symbolic_place([["0", "1"], ["0", "0"]], [["0"], [text]]).B[1, 0]
    assert sp.cancel(value - sp.nsimplify(sp.sympify(text.replace("^", "**")), rational=True)) == 0


def test_other_ways_to_write_the_same():
    for text, same in (("a−b", "a-b"), ("a·b×c÷d", "a*b*c/d"), ("α_1", "alpha_1"), ("ω₀**2", "omega_0^2")):
        found = [symbolic_place([["0", "1"], ["0", "0"]], [["0"], [x]]).B for x in (text, same)]
        assert found[0] == found[1]


@pytest.mark.parametrize(
    "name", ["gamma", "beta", "S", "N", "E", "I", "Q", "lambda", "pi", "print", "zeta", "K_pp"]
)
def test_letters_parse_back_as_letters(name):
    placed = symbolic_place([["0", "1"], ["0", "0"]], [["0"], [name]])
    symbol = placed.letters[name]
    assert sp.sympify(str(symbol)) == symbol == placed.B[1, 0]
    assert str(symbol) == printable(name)


REFUSED = [
    ("", 1), ("a b", 3), ("2a", 2), ("a(b)", 2), ("sin(a)", 4), ("a +", 4), ("(a", 3), ("a)", 2), ("sqrt a", 6),
    ("a^b", 3), ("a^(1/3)", 3), ("a^99", 3), ("1/0", 3), ("1/(a-a)", 4), ("0^-1", 1), ("a__b", 1), ("a_", 1),
    ("_a", 1), ("a.b", 2), ("__import__('os')", 1), ("a if b else c", 3), ("1e999999999", 1), ("[a]", 1), ("a;b", 2),
    ("lambda: 1", 7), ("(" * 40 + "a" + ")" * 40, 18), ("-" * 60 + "a", 17), ("a" * 60, 1), ("1" * 60, 1),
    ("a+" * 150 + "a", 201), ("(a+b+c+d+e+f+g)^12", 2), ("((9^12)^12)^12", 3), ("sqrt(a+b)", 1), ("sqrt(2)", 1),
    ("sqrt(-1)", 1), ("1.2.3", 4), ("a\x00", 2), ("😀", 1), ("٣", 1),
]  # fmt: skip


@pytest.mark.parametrize(("text", "position"), REFUSED, ids=lambda x: str(x)[:20])
def test_what_is_no_expression_is_refused_with_its_place(text, position):
    with pytest.raises(InvalidInputError) as caught:
        symbolic_place([["0", "1"], [text, "0"]], [["0"], ["1"]])
    assert caught.value.field == "A.1.0"
    assert str(caught.value).startswith("A, row 2, column 1, position ")
    assert f"position {position}:" in str(caught.value)


def test_random_texts_are_read_or_refused_and_never_more():
    rng = random.Random(3)
    pieces = [
        "a",
        "b_1",
        "2",
        ".5",
        "+",
        "-",
        "*",
        "/",
        "^",
        "(",
        ")",
        "sqrt(",
        "**",
        " ",
        "e",
        "−",
        "π",
        "[",
        "'",
        "_",
    ]
    for _ in range(4000):
        text = "".join(rng.choices(pieces, k=rng.randint(0, 25)))
        try:
            parse(text)
        except InvalidInputError as error:
            assert 1 <= error.position <= len(text) + 1


@pytest.mark.parametrize(
    ("A", "B", "more", "field"),
    [
        ([["0", "1"], ["0"]], [["1"], ["0"]], {}, "A"),
        ([["0", "1"]], [["1"], ["0"]], {}, "A"),
        ([["0"] * 7] * 7, [["1"]] * 7, {}, "A"),
        ("0", [["1"]], {}, "A"),
        ([["a"]], [["0"]], {}, "B"),
        ([["0", "a"], ["1", "0"]], [["b", "2*b"], ["1", "2"]], {}, "B"),
        ([["p_1"]], [["1"]], {}, "A"),
        ([["a"]], [["1"]], {"poles": [-1, -2]}, "poles"),
        ([["a"]], [["1"]], {"poles": [float("nan")]}, "poles"),
        ([["a"]], [["1"]], {"poles": "letters"}, "poles"),
        ([["a"]], [["1"]], {"groups": [Group((0,), (1,))]}, "groups"),
        ([[float("inf")]], [["1"]], {}, "A.0.0"),
        ([[True]], [["1"]], {}, "A.0.0"),
        ([[sp.sin(sp.Symbol("x"))]], [[1]], {}, "A.0.0"),
        ([[sp.Symbol("x") + sp.Symbol("x", positive=True)]], [[1]], {}, "A"),
    ],
    ids=str,
)
def test_what_does_not_fit_is_refused_with_its_field(A, B, more, field):
    with pytest.raises(InvalidInputError) as caught:
        symbolic_place(A, B, **more)
    assert caught.value.field == field


def test_a_plant_that_no_letter_makes_controllable():
    with pytest.raises(UncontrollableError):
        symbolic_place([["a", "0"], ["0", "a"]], [["b"], ["c"]])
    with pytest.raises(UnpairedPolesError):
        symbolic_place(*OSCILLATOR, poles=[-1 + 1j, -1])


def test_matrices_of_sympy_and_numpy_are_read_and_keep_their_symbols():
    m, k = sp.symbols("m k", positive=True)
    placed = symbolic_place(sp.Matrix([[0, 1], [-k / m, sp.Rational(-1, 3)]]), np.array([[0.0], [0.1]]))
    assert placed.K.free_symbols <= {m, k, *sp.symbols("p_1 p_2")}
    assert placed.B[1, 0] == sp.Rational(1, 10)


def test_no_input_costs_more_than_a_few_seconds():
    """Sixteen letters in a full matrix of six states: given up, not computed for hours."""
    names = [f"x_{i}" for i in range(16)]
    A = [
        [f"{names[(5 * i + j) % 16]}*{names[(i + 3 * j) % 16]} + {names[(i * j) % 16]}" for j in range(6)]
        for i in range(6)
    ]
    began = time.thread_time()
    with pytest.raises(InvalidInputError) as caught:
        symbolic_place(A, [["1"], ["0"], ["0"], ["0"], ["0"], ["0"]])
    assert time.thread_time() - began < 6
    assert "longer" in str(caught.value)


def test_the_budget_ends_work_for_whoever_has_left():
    class LeftError(Exception):
        pass

    def wanted():
        raise LeftError

    with pytest.raises(LeftError), within_budget(60.0, wanted):
        while True:
            sp.Symbol("x")
