"""Systems as people paste them: every notation the same system; what cannot be read is told by line and column."""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
import pytest
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from heli2dof_core.errors import InvalidInputError
from heli2dof_core.symbolic.grammar import parse
from heli2dof_core.systems.notation import latex_of
from heli2dof_core.systems.pasted import read_system
from heli2dof_core.systems.text import PastedError
from heli2dof_core.systems.values import complex_number, value_of

A, B, C = [[0.0, 1.0], [-2.0, -3.0]], [[0.0], [1.0]], [[1.0, 0.0]]
SAME = {
    "MATLAB": "A = [0 1; -2 -3]; B = [0; 1]; C = [1 0];",
    "MATLAB with commas": "A = [0, 1; -2, -3], B = [0; 1], C = [1, 0]",
    "MATLAB over lines": "A = [0  1   % first\n    -2 -3];\nB = [0\n1];\nC = [1 ...\n 0]",
    "MATLAB as it prints": "A =\n\n     0     1\n    -2    -3\n\nB =\n\n     0\n     1\n\nC =\n\n     1     0\n",
    "transposed": "A = [0 -2; 1 -3]'; B = [0 1]'; C = [1; 0].'",
    "NumPy": "import numpy as np\nA = np.array([[0, 1],\n [-2, -3]])  # rows\n"
    "B = np.array([[0.], [1]])\nC = np.array([[1, 0]], dtype=float)",
    "lists": "A = [[0, 1], [-2, -3]]; B = [[0], [1]]; C = [[1, 0]]",
    "NumPy as it prints": "[[ 0.  1.]\n [-2. -3.]]\n[[0.]\n [1.]]\n[[1. 0.]]",
    "one dimension": "A = np.matrix([[0,1],[-2,-3]])\nB = [0, 1]\nC = [1, 0]\nsys = ct.ss(A, B, C, 0)",
    "SymPy": "A = Matrix([[0, 1], [-2, -3]])\nB = sp.Matrix([0, 1])\nC = sp.Matrix([[1, 0]])",
    "headings": "A:\n 0 1\n -2 -3\nB:\n0\n1\nC: [1 0]",
    "blocks": "0 1\n-2 -3\n\n0\n1\n\n1 0",
    "a console": ">> A = [0 1; -2 -3];\n>> B = [0; 1];\n>> C = [1 0];\n>> K = place(A, B, [-1 -2])",
    "typography": "A = [0 1; −2 –3]\nB = [0; 1]\nC = [1 0]",
    "letters": "A = [0 1; -k/m -b/m]; B = [0; 1/m*m]; C = [1 0]; m = 2, k = 2*m; b = 3*m",
    "other letters": "F = [0 1; -2 -3]\nG = [0; 1]\nH = [1 0]\nJ = 0",
    "blanks around signs": "A = [ 0 1 ; - 2  -3 ]; B = [0 ; 2 - 1]; C = [ 2 - 1 0 ]",
    "made": "A = [0 1; -2 -3]; B = [0; 1]; C = [1 0]; D = zeros(1, 1)",
}


@pytest.mark.parametrize("name", SAME)
def test_one_system_in_every_notation(name):
    system = read_system(SAME[name]).system
    assert (system.A.tolist(), system.B.tolist(), system.C.tolist()) == (A, B, C)


def test_entries_are_told_apart_as_matlab_does():
    """As Octave counts them by size([ … ], 2)."""
    rows = {
        "[1 -2]": 2,
        "[1 - 2]": 1,
        "[1 -  2]": 1,
        "[1, -2]": 2,
        "[1 -2 - 3 +4]": 3,
        "[(1 + 2) 3]": 2,
        "[2 *3 4]": 2,
    }
    for text, count in rows.items():
        pasted = read_system(f"A = eye({count}); B = eye({count}); C = {text}")
        assert len(pasted.rows["C"][0]) == count, text


def test_what_is_read_besides():
    pasted = read_system(
        "A = [0 1; -k sqrt(2)*pi]\nB = [0 1]\nC = eye(2)\nJ = [-2+j*4 -2-j*4];\nq = [-8, -9]\nk = 3\n"
        "K = acker(A, B, J)"
    )
    assert pasted.letters == {"k": 3.0, "pi": pi}
    assert pasted.system.A[1].tolist() == [-3.0, sqrt(2) * pi]
    assert (pasted.poles, pasted.observer_poles) == ((-2 + 4j, -2 - 4j), (-8, -9))
    assert [f.code for f in pasted.findings] == ["B_turned", "passed_over"]
    assert read_system("A = [a 1; 2 b]; B = [0; 1]; a = 2").missing == ("b",)


@pytest.mark.parametrize(
    ("text", "line", "column", "says"),
    [
        ("", 1, 1, "there is no A"),
        ("A = [0 1; 2 3]", 1, 15, "there is no B"),
        ("A = [0 1;\n -2 -3 4]; B = [0; 1]", 2, 2, "row 2 of A has 3 entries, and row 1 has 2"),
        ("A = [0 1; -2 -3", 1, 5, "never closed"),
        ("A = [0 1; 2 3]\nB = [0; 2x]", 2, 10, "found 'x'"),
        ("A = [0 1; 2 3); B = [0; 1]", 1, 14, "expected ']'"),
        ("A = [0 1; 2 3]; B = [1/0; 1]", 1, 24, "division by 0"),
        ("A = [0 1; 2 sqrt(-2)]; B = [1; 1]", 1, 18, "not real"),
        ("A = [0 1; 2 3]*2; B = [0; 1]", 1, 15, "not computed with"),
        ("A = [0 1; 2 k]; k = m; m = k; B = [0; 1]", 1, 21, "given by itself"),
        ("A = [0 1; 2 3]; B = [0; 1]; C = [1 2 3]", 1, 29, "C has 1 rows and 3 columns"),
        ("A = [0 1; 2 3]; A = [1 2; 3 4]", 1, 17, "a second time"),
        ("A = [,1 2]", 1, 6, "missing"),
        ("A = expm([1 2; 3 4]); B = [1; 2]", 1, 5, "given by expm"),
        ("A = [1 2; 3 4]; B = [0; 0]", 1, 17, "that input does nothing"),
        ("A = [[[1]]]", 1, 7, "three brackets"),
        ("A = [1e400]; B = 1", 1, 6, "numbers have at most"),
        ("A = [a; 1 2]; a.b = 3", 1, 9, "row 2"),
        ("A = [0 1 2; 3 4 5]; B = [1; 2]", 1, 1, "A has 2 rows and 3 columns"),
        (")", 1, 1, "expected"),
        ("A = [1 2; 3 4]; B = [0; 1]; k =", 1, 29, "has no value"),
    ],
)
def test_what_cannot_be_read_is_told_by_its_place(text, line, column, says):
    with pytest.raises(PastedError) as refused:
        read_system(text)
    assert says in str(refused.value)
    assert (refused.value.line, refused.value.column, refused.value.field) == (line, column, "text")


@settings(max_examples=300, deadline=None)
@given(st.text("AB[](){};:,=\n .'+-*/^0123456789eijk_√%#\"\\np.array", max_size=60))
def test_any_text_is_read_or_refused(text):
    try:
        read_system(text)
    except InvalidInputError as error:
        assert str(error)


def test_texts_are_bounded():
    with pytest.raises(PastedError, match="at most 20000"):
        read_system("A = [" + "1 " * 20_000 + "]")
    deep = "(" * 5000 + "1" + ")" * 5000
    with pytest.raises(PastedError):
        read_system(f"A = {deep}; B = 1")
    chain = "".join(f"a{i} = a{i + 1}\n" for i in range(5000))
    with pytest.raises(InvalidInputError):
        read_system(f"{chain[:19_000]}\nA = a0; B = 1")


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("-2+4j", -2 + 4j),
        ("-2-j*4", -2 - 4j),
        ("4*i", 4j),
        ("-2+j2.5", -2 + 2.5j),
        ("-1e1", -10),
        ("-2*sqrt(3)*i", -2j * sqrt(3)),
    ],
)
def test_complex_numbers_as_books_write_them(text, value):
    assert complex_number(text) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(
    "text",
    ["-k/m", "-b/(M+m)", "a - (b - c)", "2*3*a^2/(4*sqrt(b))", "-(a+b)^-2", "1.5e-3*w_0", "a*-b", "a/b/c"],
)
def test_expressions_are_worth_what_sympy_makes_of_them(text):
    letters = {"k": 2.0, "m": 3.0, "b": 5.0, "M": 7.0, "a": 11.0, "c": 13.0, "w_0": 17.0}
    wanted = float(sp.sympify(text.replace("^", "**"), locals={}).subs(letters))
    assert value_of(parse(text), letters.__getitem__) == pytest.approx(wanted, rel=1e-14)
    latex = latex_of(parse(text))
    assert latex.count("{") == latex.count("}") and latex.count(r"\left(") == latex.count(r"\right)")


def test_notation():
    written = {
        "-k/m": r"-\frac{k}{m}",
        "a-(b-c)": r"a-\left(b-c\right)",
        "2*a": r"2 \, a",
        "a*2": r"a \cdot 2",
        "sqrt(a)^2": r"{\left(\sqrt{a}\right)}^{2}",
        "1e-9": r"1 \cdot 10^{-9}",
        "1/3": r"\frac{1}{3}",
        "gamma": r"\gamma",
        "0.4905": "0.4905",
        "-2": "-2",
    }
    assert {text: latex_of(parse(text)) for text in written} == written


def test_values_of_letters_are_what_was_typed():
    rng = np.random.default_rng(3)
    for _ in range(50):
        k, m = rng.normal(size=2).tolist()
        system = read_system(f"A = [0 1; k/m -3.5*k]; B = [0; 1/m]; k = {k!r}; m = {m!r}").system
        assert system.A[1].tolist() == [k / m, -3.5 * k]
        assert system.B[1, 0] == 1 / m
