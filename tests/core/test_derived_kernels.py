"""The kernels made of the derivation: current, and near to what it gives where nothing is rounded."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cache
from importlib import import_module
from typing import Any

import mpmath as mp
import numpy as np
import pytest
import sympy as sp

from heli2dof_core.couplings import STRUCTURES, Structure
from heli2dof_core.plant import NEARLY_PARALLEL
from heli2dof_core.presets import PRESETS, preset
from heli2dof_core.symbolic.full_rank import full_rank, steady_state_inverse
from heli2dof_core.symbolic.full_rank import plant as symbolic_plant
from heli2dof_core.symbolic.linearization import linear_model
from heli2dof_core.symbolic.names import PARAMETERS, c, cos_0, sin_0, tau_p, tau_y, theta_0
from heli2dof_core.symbolic.observer import observer
from heli2dof_core.symbolic.rotors import COEFFICIENTS, base, full_rank_with_rotors
from tests import kernel_formulas

EPS = 2.0**-52
FOUR, SIX = [d for triple in COEFFICIENTS for d in triple[:2]], [d for triple in COEFFICIENTS for d in triple]
MEMBERS = [
    (s, shifted) for s in STRUCTURES for shifted in (False, True) if not (shifted and s.coupling[0] == "a")
]
KINDS = ("kernels", "interpreted")


def test_they_are_current_and_small():
    """`make contract` writes them anew."""
    for name, text in kernel_formulas.files().items():
        assert (kernel_formulas.FOLDER / name).read_text("utf-8") == text
        assert len(text.encode()) < 15_000


def kernel(kind: str, name: str) -> Callable[..., Any]:
    module = "derived_rotors" if name.endswith("rotors") else "derived"
    return getattr(import_module(f"heli2dof_core.{kind}.{module}"), name)


class Case:
    """A random rig, desired polynomials, lags and shift."""

    def __init__(self, rng: np.random.Generator, *, wild: bool) -> None:
        spread = 1.5 if wild else 0.2
        while True:
            own = preset(str(rng.choice(list(PRESETS)))).parameters.as_dict().values()
            self.p = np.array(list(own)) * 10 ** rng.uniform(-spread, spread, len(own))
            self.p[:4] *= rng.choice([-1, 1, 1], 4)
            own_way, other_way = self.p[0] * self.p[3], self.p[1] * self.p[2]
            share = abs(own_way - other_way) / (abs(own_way) + abs(other_way))
            if share > (NEARLY_PARALLEL if wild else 0.2):
                break
        self.theta_0 = float(rng.uniform(-1.3, 1.3))
        pairs = [self._pair(rng) for _ in range(2)]
        if rng.random() < 0.1:
            pairs[1] = pairs[0]
        thirds = -(10 ** rng.uniform(-1, 1.5, 2))
        self.four = np.concatenate([np.poly(pair).real[:0:-1] for pair in pairs])
        triples = [[*pair, third] for pair, third in zip(pairs, thirds, strict=True)]
        self.six = np.concatenate([np.poly(triple).real[:0:-1] for triple in triples])
        self.tau = 10 ** rng.uniform(-2.5, 0, 2)
        self.c = float(rng.normal() * 10 ** (rng.uniform(-1, 6) if wild else 0.0))

    @staticmethod
    def _pair(rng: np.random.Generator) -> list[complex]:
        re, im = -(10 ** rng.uniform(-1, 1.3, 2))
        kinds = ([complex(re, im), complex(re, -im)], [re, im], [re, re])
        return kinds[rng.choice(3, p=(0.4, 0.5, 0.1))]

    def numbers(self, rotors: bool, shifted: bool) -> list[float]:
        lags, own = (self.tau.tolist() if rotors else []), ([self.c] if shifted else [])
        return [*(self.six if rotors else self.four).tolist(), *self.p.tolist(), self.theta_0, *lags, *own]

    def gain(self, kind: str, structure: Structure, rotors: bool, shifted: bool) -> tuple[Any, Any]:
        K, inverse = np.full((2, 6 if rotors else 4), np.nan), np.full((2, 2), np.nan)
        name, lags = ("full_rank_gain_with_rotors", (self.tau,)) if rotors else ("full_rank_gain", ())
        first = (
            STRUCTURES.index(structure),
            shifted,
            self.six if rotors else self.four,
            self.p,
            self.theta_0,
        )
        kernel(kind, name)(*first, *lags, self.c, K, inverse)
        return K, inverse


def cases(count: int, seed: int, *, wild: bool) -> Iterator[Case]:
    rng = np.random.default_rng(seed)
    return (Case(rng, wild=wild) for _ in range(count))


@cache
def derived(structure: Structure, rotors: bool, shifted: bool, modules: str) -> Callable[..., Any]:
    """K and Ĝ(0)⁻¹ as the derivation has them in physical parameters, not as `reading` writes them."""
    placed = (full_rank_with_rotors if rotors else full_rank)(structure, shifted=shifted)
    inverse = steady_state_inverse(placed.K, *(base() if rotors else symbolic_plant()))
    arguments = [*(SIX if rotors else FOUR), *PARAMETERS.values(), theta_0]
    arguments += [*((tau_p, tau_y) if rotors else ()), *((c,) if shifted else ())]
    return written(arguments, (placed.K.to_Matrix(), inverse.to_Matrix()), modules)


def written(arguments: list[sp.Symbol], matrices: tuple[Any, ...], modules: str) -> Callable[..., Any]:
    angles = {sin_0: sp.sin(theta_0), cos_0: sp.cos(theta_0)}
    physical = [matrix.subs(linear_model().definitions).subs(angles).tolist() for matrix in matrices]
    return sp.lambdify(arguments, physical, modules=modules)


def away(found: Any, exact: Any) -> float:
    """Largest error of a matrix in roundings of its largest entry."""
    largest = max(abs(x) for row in exact for x in row)
    errors = (
        abs(x - mp.mpf(float(y)))
        for row, own in zip(exact, found, strict=True)
        for x, y in zip(row, own, strict=True)
    )
    return float(max(errors) / largest) / EPS


@pytest.mark.parametrize("rotors", [False, True])
@pytest.mark.parametrize(("structure", "shifted"), MEMBERS)
def test_gains_are_those_of_the_derivation(structure: Structure, shifted: bool, rotors: bool):
    """To a few roundings on tame rigs; on wild ones no worse than the formulas in physical letters, and zeros are."""
    tame, wild, expanded = [], [], []
    with mp.workprec(400):
        for case in (*cases(30, 1, wild=False), *(wild_ones := list(cases(60, 2, wild=True)))):
            numbers = case.numbers(rotors, shifted)
            exact = derived(structure, rotors, shifted, "mpmath")(*map(mp.mpf, numbers))
            found = case.gain("interpreted", structure, rotors, shifted)
            errors = max(map(away, found, exact))
            for own, true in zip(found, exact, strict=True):
                assert not np.any(own[np.array([[x == 0 for x in row] for row in true])])
            if case not in wild_ones:
                tame.append(errors)
            else:
                wild.append(errors)
                expanded.append(max(map(away, derived(structure, rotors, shifted, "math")(*numbers), exact)))
    print(f"tame {max(tame):.3g}, wild {max(wild):.3g}, in physical letters {max(expanded):.3g}")
    assert max(tame) < 20
    assert max(wild) < max(2 * max(expanded), 60)
    assert np.median(wild) < np.median(expanded) + 0.5


def test_the_observers_gain_is_that_of_the_derivation():
    arguments = [*FOUR, *PARAMETERS.values(), theta_0]
    functions = [written(arguments, (observer(s).L.to_Matrix(),), "mpmath") for s in STRUCTURES]
    with mp.workprec(400):
        for case in cases(60, 3, wild=True):
            L = np.full((4, 2), np.nan)
            kernel("interpreted", "full_rank_observer")(case.four, case.p, case.theta_0, L)
            for function in functions:
                (exact,) = function(*map(mp.mpf, case.numbers(False, False)))
                assert away(L, exact) < 4


def test_the_rigs_model_is_that_of_the_derivation():
    model = linear_model()
    function = written([*PARAMETERS.values(), theta_0], (model.A, model.B, model.trim), "math")
    for case in cases(2000, 4, wild=True):
        A, B, trim = np.full((4, 4), np.nan), np.full((4, 2), np.nan), np.full(2, np.nan)
        kernel("interpreted", "rig_model")(case.p, case.theta_0, A, B, trim)
        for own, exact in zip((A, B, trim[:, None]), function(*case.p.tolist(), case.theta_0), strict=True):
            np.testing.assert_allclose(own, exact, rtol=1e-14)  # C's sine and powers round otherwise


def test_compiled_and_interpreted_give_the_same_digits():
    for case in cases(500, 5, wild=True):
        for structure, shifted in MEMBERS:
            for rotors in (False, True):
                both = (case.gain(kind, structure, rotors, shifted) for kind in KINDS)
                for found, twin in zip(*both, strict=True):
                    np.testing.assert_array_equal(found, twin)
        models = [(np.empty((4, 4)), np.empty((4, 2)), np.empty(2), np.empty((4, 2))) for _ in KINDS]
        for kind, (A, B, trim, L) in zip(KINDS, models, strict=True):
            kernel(kind, "rig_model")(case.p, case.theta_0, A, B, trim)
            kernel(kind, "full_rank_observer")(case.four, case.p, case.theta_0, L)
        for found, twin in zip(*models, strict=True):
            np.testing.assert_array_equal(found, twin)


@pytest.mark.parametrize("rotors", [False, True])
def test_a_structure_that_does_not_exist_gives_no_finite_gain(rotors: bool):
    case = next(cases(1, 6, wild=False))
    for structure, name in ((STRUCTURES[0], "K_pp"), (STRUCTURES[1], "K_yy")):
        case.p[list(PARAMETERS).index(name)] = 0.0
        K, inverse = case.gain("kernels", structure, rotors, False)
        assert not np.isfinite(K.sum() + inverse.sum())
        assert np.all(np.isfinite(case.gain("kernels", STRUCTURES[2], rotors, True)[0]))
        case = next(cases(1, 6, wild=False))
