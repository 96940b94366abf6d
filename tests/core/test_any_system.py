"""Any system, held to outsiders: the books' own gains, python-control, SciPy, SLICOT."""

from __future__ import annotations

from math import pi

import control as ct
import numpy as np
import pytest
import sympy as sp
from scipy.linalg import eigvals
from slycot import ab08nd

from heli2dof_core.errors import InvalidInputError, MethodUnavailableError, UncontrollableError
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.systems.analysis import analyse
from heli2dof_core.systems.courses import courses
from heli2dof_core.systems.formulas import closed_forms
from heli2dof_core.systems.frequency import bode, gain_and_phase
from heli2dof_core.systems.loop import Wish, close_loop
from heli2dof_core.systems.model import System
from heli2dof_core.systems.pasted import read_system
from heli2dof_core.systems.textbook import EXAMPLES
from heli2dof_core.systems.zeros import invariant_zeros

PRINTED = {
    "ogata-third-order": [199, 55, 8],
    "ogata-observer": [29.6, 3.6],
    "chen-second-order": [4, 17 / 3],
    "chen-pendulum": [-5 / 3, -11 / 3, -103 / 12, -13 / 3],
    "nise-phase-variable": [413.1, 132.08, 10.9],
    "franklin-pendulum": [3, 4],
    "kwakernaak-sivan-positioning": [223.6, 18.69],
}
"""K as these books print it, where it is the only one: with one input, or by LQR; Kwakernaak's to four digits."""
DERIVED = ("ogata-pendulum", "astrom-murray-steering", "dorf-bishop-pendulum")
"""One input too, but K is python-control's own here."""


def placed(name: str):
    example = EXAMPLES[name]
    pasted = read_system(example.text)
    wish = Wish(pasted.poles, example.method, pasted.observer_poles, example.weights)
    return pasted, close_loop(pasted.system, wish)


@pytest.mark.parametrize("name", PRINTED)
def test_the_gain_is_the_books(name):
    _, loop = placed(name)
    rtol = 6e-4 if name.startswith("kwakernaak") else 1e-12
    assert np.allclose(loop.K, [PRINTED[name]], rtol=rtol, atol=1e-12)


@pytest.mark.parametrize("name", [*PRINTED, *DERIVED])
def test_one_input_has_one_gain(name):
    pasted, loop = placed(name)
    own = pasted.system
    if EXAMPLES[name].method == "lqr":
        wanted = ct.lqr(own.A, own.B, np.diag([1.0, 0.0]), [[2e-5]])[0]
    else:
        wanted = ct.acker(own.A, own.B, pasted.poles)
    assert np.allclose(loop.K, wanted, rtol=1e-8)
    if loop.L is not None:
        wanted = np.reshape(ct.acker(own.A.T, own.C.T, pasted.observer_poles), (-1, 1))
        assert np.allclose(loop.L, wanted, rtol=1e-9)


def test_the_observers_gain_is_ogatas():
    """K_e = [16, 84.6]ᵀ for observer poles −8, −8."""
    assert np.allclose(placed("ogata-observer")[1].L, [[16], [84.6]], rtol=1e-14)


@pytest.mark.parametrize("name", EXAMPLES)
def test_all_methods_place_the_books_poles(name):
    pasted, _ = placed(name)
    own, done = pasted.system, 0
    for method in METHODS.values():
        if not method.places_poles:
            continue
        try:
            loop = close_loop(own, Wish(pasted.poles, method.name))
        except MethodUnavailableError:
            continue
        found, wanted = np.poly(own.A - own.B @ loop.K), np.poly(pasted.poles)
        assert np.allclose(found, wanted, rtol=1e-6, atol=1e-6 * np.max(np.abs(wanted)))
        done += 1
    assert done >= 2


def test_satellite_and_distillation_have_the_books_relative_gains():
    """Skogestad and Postlethwaite: 35.1 and −34.1 of the distillation."""
    assert np.allclose(
        analyse(read_system(EXAMPLES["skogestad-distillation"].text).system).rga,
        [[35.1, -34.1], [-34.1, 35.1]],
        atol=0.05,
    )
    satellite = analyse(read_system(EXAMPLES["skogestad-satellite"].text).system)
    assert len(satellite.zeros) == 0
    assert np.allclose(satellite.rga, satellite.dc_gain * np.linalg.inv(satellite.dc_gain).T)


def test_letters_have_the_books_formulas():
    """Franklin: K = [3ω₀², 4ω₀] for poles −2ω₀; Åström and Murray: K = [ω², 2ζω − γω²], L = [2ζω, ω²]ᵀ."""
    p, q = sp.symbols("p_1:3"), sp.symbols("q_1:3")
    w, z, gamma = sp.symbols("omega zeta gamma_", positive=True)
    own = read_system(EXAMPLES["franklin-pendulum"].text)
    K = closed_forms(own.rows["A"], own.rows["B"]).control.K
    w_0 = sp.Symbol("w_0")
    assert sp.expand(K.subs(dict.fromkeys(p, -2 * w_0)) - sp.Matrix([[3 * w_0**2, 4 * w_0]])).is_zero_matrix
    own = read_system(EXAMPLES["astrom-murray-steering"].text)
    found = closed_forms(own.rows["A"], own.rows["B"], own.rows["C"])
    root = w * sp.sqrt(1 - z**2) * sp.I
    pair = [-z * w + root, -z * w - root]
    K = found.control.K.subs(sp.Symbol("gamma_"), gamma).subs(dict(zip(p, pair, strict=True)))
    assert sp.simplify(K - sp.Matrix([[w**2, 2 * z * w - gamma * w**2]])).is_zero_matrix
    L = found.observer.K.T.subs(dict(zip(q, pair, strict=True)))
    assert sp.simplify(L - sp.Matrix([2 * z * w, w**2])).is_zero_matrix


def test_formulas_are_the_numbers():
    for name in ("dorf-bishop-pendulum", "skogestad-satellite", "kwakernaak-sivan-positioning"):
        pasted, _ = placed(name)
        q = tuple(2 * p for p in pasted.poles)
        loop = close_loop(pasted.system, Wish(pasted.poles, observer_poles=q))
        found = closed_forms(pasted.rows["A"], pasted.rows["B"], pasted.rows["C"])
        letters = {symbol: pasted.letters[name] for name, symbol in found.control.letters.items()}
        for gain, poles, letter, wanted in (
            (found.control.K, pasted.poles, "p", loop.K),
            (found.observer.K.T, q, "q", loop.L),
        ):
            values = {sp.Symbol(f"{letter}_{i + 1}"): pole for i, pole in enumerate(poles)}
            numbers = np.array(gain.subs(letters).subs(values).evalf(), dtype=complex)
            if name != "skogestad-satellite":  # where the groups of poles decide, and both have the same
                assert np.allclose(numbers, wanted, rtol=1e-9, atol=1e-9)
    with pytest.raises(InvalidInputError):
        closed_forms([["a"] * 7] * 7, [["1"]] * 7)


def random_systems(count: int, seed: int):
    rng = np.random.default_rng(seed)
    while count:
        n, p, q = int(rng.integers(1, 8)), int(rng.integers(1, 4)), int(rng.integers(1, 4))
        A, B, C = (rng.integers(-2, 3, size=size).astype(float) for size in ((n, n), (n, p), (q, n)))
        D = rng.integers(-1, 2, size=(q, p)) * float(rng.random() < 0.3)
        try:
            yield System.of(A, B, C, D)
        except InvalidInputError:
            continue
        count -= 1


def same_set(found: np.ndarray, wanted: np.ndarray, tolerance: float) -> bool:
    return (
        len(found) == len(wanted)
        and all(min(abs(found - w)) <= tolerance * max(1, abs(w)) for w in wanted)
        and all(min(abs(wanted - f)) <= tolerance * max(1, abs(f)) for f in found)
    )


def test_zeros_are_slicots():
    many = 0
    for system in random_systems(300, 1):
        n, p, q = system.sizes
        found = ab08nd(n, p, q, system.A, system.B, system.C, system.D, tol=1e-9)
        nu, left, right = found[0], found[-2], found[-1]
        wanted = eigvals(left[:nu, :nu], right[:nu, :nu]) if nu else np.zeros(0)
        assert same_set(invariant_zeros(system), wanted, 1e-3), system
        many += nu > 0
    assert many > 60


def test_zeros_do_not_depend_on_units():
    rng = np.random.default_rng(2)
    for system in random_systems(60, 3):
        n, p, q = system.sizes
        states, inputs, outputs = (10.0 ** rng.uniform(-6, 6, size=size) for size in (n, p, q))
        scaled = System.of(
            system.A * states / states[:, None],
            system.B * inputs / states[:, None],
            system.C * states * outputs[:, None],
            system.D * inputs * outputs[:, None],
        )
        assert same_set(invariant_zeros(scaled), invariant_zeros(system), 1e-3)


def test_modes_that_the_inputs_do_not_reach():
    """Kalman's decomposition, hidden by a change of basis: the lost modes are those of its last block."""
    rng = np.random.default_rng(4)
    for _ in range(40):
        r, lost, p = int(rng.integers(1, 5)), int(rng.integers(1, 4)), int(rng.integers(1, 3))
        n = r + lost
        A, B = rng.normal(size=(n, n)), rng.normal(size=(n, min(p, r)))
        A[r:, :r] = B[r:] = 0
        basis = np.linalg.qr(rng.normal(size=(n, n)))[0]
        system = System.of(basis @ A @ basis.T, basis @ B)
        found = analyse(system)
        assert found.inputs.reached == r
        assert same_set(found.inputs.lost, np.linalg.eigvals(A[r:, r:]), 1e-6)
        assert found.inputs.distance < 1e-8
        assert found.findings[0].code == "uncontrollable"
        with pytest.raises(UncontrollableError, match="not the modes s ="):
            close_loop(system, Wish(tuple(-1.0 - i for i in range(n))))
        dual = analyse(System.of(system.A.T, np.eye(n), system.B.T))
        assert dual.outputs is not None
        assert same_set(dual.outputs.lost, found.inputs.lost, 1e-9)


def test_repeated_modes_that_are_lost_are_told():
    """A double eigenvalue, which floats scatter by 1e-8: the test of Hautus alone would not find it."""
    found = analyse(
        System.of([[-1, 0, 0, 0], [1, -1, 0, 0], [0, 0, -2, 1], [0, 0, 0, -2]], [[1], [0], [1], [0]])
    )
    assert found.inputs.reached == 3
    assert np.allclose(found.inputs.lost, [-2])


def test_canonical_form():
    for name in EXAMPLES:
        system = read_system(EXAMPLES[name].text).system
        found = analyse(system)
        A_bar = found.T @ system.A @ np.linalg.inv(found.T)
        B_bar = found.T @ system.B
        ends = np.cumsum(found.inputs.indices) - 1
        assert np.allclose(B_bar[ends], found.Q, atol=1e-9)
        assert np.allclose(np.delete(B_bar, ends, axis=0), 0, atol=1e-9)
        rows = np.delete(A_bar, ends, axis=0)
        assert np.allclose(rows[rows > 0.5], 1) and np.allclose(np.abs(rows).sum(), len(rows), atol=1e-6)
        columns, k = [], 0
        for b, index in zip(system.B.T, found.inputs.indices, strict=True):
            columns += [np.linalg.matrix_power(system.A, i) @ b for i in range(index)]
        assert np.allclose(found.M, np.column_stack(columns)), k


A3 = np.array([[0, 1, 0], [0, 0, 1], [-1, -5, -6.0]])
B3 = np.array([[0, 0], [1, 0], [0.3, 1.0]])
C3 = np.array([[1, 0, 0], [0, 1, 1.0]])
D3 = np.array([[0, 0], [0.2, 0]])


@pytest.mark.parametrize("observed", [False, True])
@pytest.mark.parametrize(
    ("method", "D"), [("full-rank", D3), ("tits-yang", D3), ("lqr", D3), ("lqr-integral", 0 * D3)]
)
def test_responses_are_python_controls(method, D, observed):
    """The loop built of plant and controller by `control.interconnect`, with the observer's states."""
    system = System.of(A3, B3, C3, D)
    q = (-20, -21, -22) if observed else None
    loop = close_loop(system, Wish((-2 + 4j, -2 - 4j, -10), method, q))
    x0 = [1.0, -0.5, 2.0]
    found = courses(loop, x0)
    K, K_z, n, k = loop.K, loop.K_z, 3, loop.K_z.shape[1]
    states, outputs, u = [f"x{i}" for i in range(3)], ["y0", "y1"], ["u0", "u1"]
    plant = ct.ss(A3, B3, np.eye(3), 0, inputs=u, outputs=states)
    told = ct.ss([], [], [], np.hstack([C3, D]), inputs=[*states, *u], outputs=outputs)
    L = loop.L if observed else np.zeros((3, 2))
    seen = states if not observed else [f"e{i}" for i in range(3)]
    law = ct.ss(
        np.zeros((k, k)),
        np.hstack([np.zeros((k, 3)), np.eye(k, 2), -np.eye(k, 2)]),
        K_z,
        np.hstack([-K, loop.F, np.zeros((2, 2))]),
        inputs=[*seen, "r0", "r1", *outputs],
        outputs=u,
    )
    parts = [plant, told, law]
    if observed:
        parts.append(
            ct.ss(
                A3 - L @ C3,
                np.hstack([B3 - L @ D, L]),
                np.eye(3),
                np.zeros((3, 4)),
                inputs=[*u, *outputs],
                outputs=seen,
            )
        )
    whole = ct.interconnect(parts, inputs=["r0", "r1"], outputs=[*outputs, *u])
    stepped = ct.step_response(whole, found.t, squeeze=False).outputs.transpose(1, 0, 2)
    assert np.allclose(found.step_y, stepped[:, :2], atol=1e-7) and np.allclose(
        found.step_u, stepped[:, 2:], atol=1e-6
    )
    free = ct.initial_response(whole, found.t, [*x0, *np.zeros(whole.nstates - 3)])
    assert np.allclose(np.vstack([found.initial_y, found.initial_u]), free.outputs, atol=1e-7)
    assert np.allclose(found.initial_x, free.states[:n], atol=1e-7)
    if observed:
        assert np.allclose(found.estimate, free.states[n + k :], atol=1e-7)
    over = bode(analyse(system), loop)
    closed = whole(1j * over.frequencies)[:2].transpose(2, 0, 1)
    assert np.allclose(over.closed, closed, atol=1e-8)
    assert np.allclose(over.plant, ct.ss(A3, B3, C3, D)(1j * over.frequencies).transpose(2, 0, 1), rtol=1e-9)
    for i in range(2):  # opened at input i: the plant's input comes from outside there
        names = [f"w{j}" if j == i else name for j, name in enumerate(u)]
        opened = ct.ss(A3, B3, np.eye(3), 0, inputs=names, outputs=states)
        seen_there = ct.ss([], [], [], np.hstack([C3, D]), inputs=[*states, *names], outputs=outputs)
        cut = ct.interconnect(
            [opened, seen_there, *parts[2:]], inputs=[f"w{i}", "r0", "r1"], outputs=[u[i]], check_unused=False
        )
        response = -cut(1j * over.frequencies)[0, 0]
        assert np.allclose(over.loops[:, i], response, rtol=1e-6, atol=1e-9)
    if loop.scaling in ("static", "integral"):
        long = courses(loop, duration=200.0).step_y[:, :, -1]
        assert np.allclose(long, np.eye(2), atol=1e-3)


def test_references_are_scaled_where_they_can_be():
    square = close_loop(System.of(A3, B3, C3), Wish((-1, -2, -3)))
    wide = close_loop(System.of(A3, B3, C3[:1]), Wish((-1, -2, -3)))
    tall = close_loop(System.of(A3, B3[:, 1:], C3), Wish((-1, -2, -3)))
    derivative = close_loop(System.of(A3, B3[:, 1:], [[0, 1, 0]]), Wish((-1, -2, -3)))
    assert [loop.scaling for loop in (square, wide, tall, derivative)] == [
        "static",
        "pseudo-inverse",
        "inputs",
        "inputs",
    ]
    assert courses(wide, duration=30.0).step_y[:, :, -1] == pytest.approx(1, abs=1e-6)
    assert "zero at 0" in derivative.reason and "more outputs" in tall.reason


def test_findings():
    near = System.of([[-1, 0], [0, -1.0000001]], [[1], [1]], [[1, 0]])
    assert "nearly_uncontrollable" in [f.code for f in analyse(near).findings]
    assert "high_gains" in [f.code for f in close_loop(near, Wish((-3, -4))).findings]
    assert "unobservable" in [f.code for f in analyse(near).findings]
    with pytest.raises(UncontrollableError, match="not observable") as refused:
        close_loop(near, Wish((-3, -4), observer_poles=(-5, -6)))
    assert refused.value.field == "C"
    away = System.of([[0, 1], [0, -1]], [[0], [1]], [[-1, 1]])
    assert analyse(away).zeros == pytest.approx([1])  # (s − 1)/(s (s + 1))
    assert "zeros_right" in [f.code for f in analyse(away).findings]
    assert "unstable" in [f.code for f in close_loop(away, Wish((1, -4))).findings]


def test_what_does_not_fit_is_refused():
    system = System.of(A3, B3, C3)
    with pytest.raises(InvalidInputError) as refused:
        close_loop(system, Wish((-1, -2, -3), observer_poles=(-1, -2)))
    assert refused.value.field == "observer_poles"
    with pytest.raises(ValueError, match="conjugate") as refused:
        close_loop(system, Wish((-1, -2, -3), observer_poles=(-1, -2, -3 + 1j)))
    assert refused.value.field == "observer_poles.2"
    with pytest.raises(InvalidInputError) as refused:
        close_loop(System.of(A3, B3), Wish((-1, -2, -3), observer_poles=(-1, -2, -3)))
    assert refused.value.field == "observer_poles"
    with pytest.raises(MethodUnavailableError):
        close_loop(System.of(A3, B3, C3, D3), Wish((-1, -2, -3), "lqr-integral"))


def test_phases_begin_between_minus_one_turn_and_zero():
    w = np.logspace(-2, 2, 50)
    gain, phase = gain_and_phase((1 / (1j * w) ** 2 / (1 + 1j * w))[:, None])
    assert phase[0, 0] == pytest.approx(-pi, abs=0.02) and phase[-1, 0] == pytest.approx(-1.5 * pi, abs=0.02)
    assert np.allclose(gain[:, 0], 1 / w**2 / np.abs(1 + 1j * w))
