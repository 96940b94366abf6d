"""Optimizers on the finder's problems, each with so many designs: docs/decisions/0007-finder.md has the figures.

    pip install pymoo optuna
    python -m tests.bench.optimizers --designs 12000 [--problem "Aero with lag"] [--seeds 2]

All get the same function of the same points, one number for how much is missed, and remember what meets everything;
those for one figure go from one weighting of the figures to the next. Told are hypervolumes, as shares of that of all
together, and the time per design beside the function's own.
"""

from __future__ import annotations

import argparse
import importlib
import warnings
from collections.abc import Callable
from dataclasses import replace
from time import perf_counter
from typing import Any

import numpy as np

from heli2dof_core import warm_up
from heli2dof_core.finder.problem import Problem
from heli2dof_core.finder.search import Exhausted, Search
from tests.bench.finder import reference
from tests.finder.problems import SOLVABLE, Case
from tests.finder.volume import front, volume


class Watched:
    """The function, its budget and what it has found."""

    def __init__(self, case: Case, designs: int, seed: int) -> None:
        self.problem = Problem(case.spec(), replace(case.find, seed=seed))
        self.search = Search(self.problem, designs)
        self.inside, self.seed = 0.0, seed
        self.rng = np.random.default_rng(seed)

    @property
    def size(self) -> int:
        """Of a point."""
        return self.problem.space.size

    @property
    def goals(self) -> int:
        """How many figures are minimized."""
        return len(self.problem.ask.minimize)

    def __call__(self, points: Any) -> tuple[np.ndarray, np.ndarray]:
        """What is minimized, (n, k), and by how much each design misses what is required, (n,)."""
        begin = perf_counter()
        own = self.search.look(np.atleast_2d(points))
        self.inside += perf_counter() - begin
        return own.goals, own.missed

    def first(self, count: int) -> np.ndarray:
        """Random points, and the design that is there."""
        points = self.rng.random((count, self.size))
        points[0] = self.problem.space.point_of(self.problem.space.spec)
        return points


def of_pymoo(module: str, name: str) -> Callable[[Watched], None]:
    """One of pymoo's, with 100 designs a generation."""

    def run(own: Watched) -> None:
        base = importlib.import_module("pymoo.core.problem").Problem
        minimize = importlib.import_module("pymoo.optimize").minimize

        class Task(base):
            def _evaluate(self, x: Any, out: Any, *_: Any, **__: Any) -> None:
                goals, missed = own(x)
                out["F"], out["G"] = goals, missed[:, None]

        task = Task(n_var=own.size, n_obj=own.goals, n_ieq_constr=1, xl=0.0, xu=1.0)
        kind = getattr(importlib.import_module(f"pymoo.algorithms.moo.{module}"), name)
        minimize(task, kind(pop_size=100, sampling=own.first(100)), ("n_gen", 10**6), seed=own.seed)

    return run


def _weightings(own: Watched, count: int) -> list[np.ndarray]:
    if own.goals == 1:
        return [np.ones(1)]
    return [np.array([x, 1 - x]) for x in np.linspace(0.02, 0.98, count)]


def _fitness(own: Watched, weight: np.ndarray) -> Callable[[np.ndarray, np.ndarray], np.ndarray]:
    known = own.search.front if own.search.front is not None else own.search.kept
    assert known is not None
    low, scale = known.goals.min(axis=0), np.maximum(np.ptp(known.goals, axis=0), 1e-9)

    def fitness(goals: np.ndarray, missed: np.ndarray) -> np.ndarray:
        parts = weight * (goals - low) / scale
        value = np.clip(parts.max(axis=1) + 0.05 * parts.sum(axis=1), -1e3, 1e3)
        return np.where(missed > 0, 1e4 + missed, value)

    return fitness


def cma(own: Watched) -> None:
    """CMA-ES, from eight weightings by turns."""
    from cma import CMAEvolutionStrategy

    own(own.first(200))
    share = own.search.designs // 8
    for turn, weight in enumerate(100 * _weightings(own, 8)):
        fitness, end = _fitness(own, weight), own.search.used + share
        known = own.search.kept
        assert known is not None
        start = known.points[np.argmin(fitness(known.goals, known.missed))]
        how = {"bounds": [0, 1], "verbose": -9, "popsize": 24, "seed": 1000 * own.seed + turn + 1}
        strategy = CMAEvolutionStrategy(start, 0.15, how)
        while own.search.used < end and not strategy.stop():
            points = strategy.ask()
            strategy.tell(points, fitness(*own(points)).tolist())


def scipy(own: Watched) -> None:
    """SciPy's differential evolution, from five weightings one after the other."""
    from scipy.optimize import differential_evolution

    own(own.first(60))
    for weight in 100 * _weightings(own, 5):
        fitness, known = _fitness(own, weight), own.search.kept
        assert known is not None
        first = known.points[np.argsort(known.missed, kind="stable")[:60]]
        most = max(2, own.search.designs // 5 // 60)
        how: dict[str, Any] = {"vectorized": True, "updating": "deferred", "init": first, "polish": False}
        differential_evolution(
            lambda x, f=fitness: f(*own(x.T)), [(0, 1)] * own.size, maxiter=most, tol=0, rng=own.seed, **how
        )


def optuna(own: Watched) -> None:
    """Optuna's NSGA-II, a hundred trials at a time."""
    kit = importlib.import_module("optuna")
    kit.logging.set_verbosity(kit.logging.ERROR)
    sampler = kit.samplers.NSGAIISampler(
        seed=own.seed, population_size=100, constraints_func=lambda trial: trial.user_attrs["missed"]
    )
    study = kit.create_study(directions=["minimize"] * own.goals, sampler=sampler)
    names = [f"x{i}" for i in range(own.size)]
    space = {name: kit.distributions.FloatDistribution(0, 1) for name in names}
    while True:
        trials = [study.ask(space) for _ in range(100)]
        goals, missed = own([[trial.params[name] for name in names] for trial in trials])
        for trial, row, miss in zip(trials, goals.tolist(), missed.tolist(), strict=True):
            trial.set_user_attr("missed", (miss,))
            study.tell(trial, row)


def ours(own: Watched) -> None:
    """The finder's: SciPy's differential evolution and CMA-ES by turns, along the front."""
    look = own.search.look

    def timed(points: np.ndarray) -> Any:
        begin = perf_counter()
        try:
            return look(points)
        finally:
            own.inside += perf_counter() - begin

    own.search.look = timed
    for _ in own.search.run():
        pass


METHODS: dict[str, Callable[[Watched], None]] = {
    "finder": ours,
    "pymoo NSGA-II": of_pymoo("nsga2", "NSGA2"),
    "pymoo AGE-MOEA": of_pymoo("age", "AGEMOEA"),
    "pymoo SMS-EMOA": of_pymoo("sms", "SMSEMOA"),
    "cma": cma,
    "SciPy DE": scipy,
    "optuna NSGA-II": optuna,
}


def compare(case: Case, designs: int, seeds: int) -> None:
    """All of them on one problem."""
    found: dict[str, list[np.ndarray]] = {}
    times: dict[str, float] = {}
    for name, run in METHODS.items():
        for seed in range(seeds):
            own, begin = Watched(case, designs, seed), perf_counter()
            try:
                run(own)
            except Exhausted:
                pass
            except ValueError as error:  # SMS-EMOA takes no single figure
                print(f"  {name}: {error}")
                continue
            beside = (perf_counter() - begin - own.inside) / max(1, own.search.used)
            times[name] = min(times.get(name, np.inf), beside)
            known = own.search.front
            found.setdefault(name, []).append(np.zeros((0, own.goals)) if known is None else known.goals)
    every = np.vstack([goals for several in found.values() for goals in several])
    point = reference(every[front(every)])
    best = volume(every, point)
    print(case.name)
    for name, several in found.items():
        share = np.mean([volume(goals, point) / best for goals in several])
        print(f"  {name:18}{share:8.3f}{1e6 * times[name]:8.0f} µs", flush=True)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--designs", type=int, default=12_000)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--problem", help="one alone, by its name")
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    warm_up()
    for own in SOLVABLE:
        if asked.problem in (None, own.name):
            compare(own, asked.designs, asked.seeds)
