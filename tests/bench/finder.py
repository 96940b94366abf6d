"""The finder on twenty problems beside a brute force of a million designs, and beside CMA-ES around python-control.

    python -m tests.bench.finder brute --designs 1000000   (hours; goes on where it was, kept in build/finder)
    python -m tests.bench.finder finder                    (some three minutes: the same problems, 5 s each)
    python -m tests.bench.finder finder --shared           (the same beside other work: 5 s of the cores' own time)
    python -m tests.bench.finder control                   (a minute: two of them around python-control)

Hypervolumes are of the same figures up to the same point, a tenth beyond the worst of both fronts, as a share of that
of both together. What others find is judged by `evaluate`, too.
"""

from __future__ import annotations

import argparse
import json
import warnings
from collections.abc import Callable, Iterator
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from time import perf_counter, process_time, thread_time
from typing import Any

import numpy as np

from heli2dof_core import Spec, plant, warm_up
from heli2dof_core.finder import Designs, find
from heli2dof_core.finder import search as search_module
from heli2dof_core.finder.problem import Problem, Tried
from heli2dof_core.finder.proof import proved
from heli2dof_core.finder.search import Search, nondominated
from heli2dof_core.measured import MEASURED
from tests.finder.problems import SOLVABLE, UNSOLVABLE, Case
from tests.finder.volume import volume

KEPT = Path("build/finder")
CHUNK = 20_000
"""Designs of one turn of the brute force."""
SECONDS = 5.0
UNEVEN = 0.6
"""Of two threads' time, what passes on two cores: a generation waits for the later half of it."""
MOST = 1_000_000
Judge = Callable[[dict[str, Any]], tuple[list[float], float]]
"""From figures to what is minimized, and by how much limits are missed."""


def reference(*fronts: np.ndarray) -> np.ndarray:
    """A point a tenth beyond the worst of what is on the fronts."""
    every = np.vstack([own for own in fronts if len(own)])
    high, low = every.max(axis=0), every.min(axis=0)
    return high + 0.1 * np.maximum(high - low, 1e-6 * np.abs(high) + 1e-9)


def goals_of(found: Designs) -> np.ndarray:
    """What was minimized, smaller is better, of designs that meet everything, (n, k)."""
    better = [MEASURED[own.name].figure.better for own in found.ask.minimize]
    signs = np.array([-1.0 if own == "higher" else 1.0 for own in better])
    rows = [own.values[: len(signs)] for own in found.candidates if own.met]
    return signs * np.array(rows).reshape(-1, len(signs))


def shares(first: np.ndarray, second: np.ndarray) -> tuple[float, float]:
    """Of two sets of designs the hypervolumes, as shares of that of both together."""
    point = reference(first, second)
    both = volume(np.vstack((first, second)), point)
    return volume(first, point) / both, volume(second, point) / both


class Brute:
    """Random designs, all of them; kept on disk after every turn."""

    def __init__(self, case: Case) -> None:
        self.case, self.path = case, KEPT / f"{case.name.replace(' ', '_').replace(',', '')}.json"
        known = json.loads(self.path.read_text()) if self.path.exists() else {}
        self.tried, self.met, self.seconds = (known.get(name, 0) for name in ("tried", "met", "seconds"))
        self.goals = np.array(known.get("goals", [])).reshape(-1, max(1, len(case.find.minimize)))

    def turn(self) -> None:
        """Some more."""
        problem = Problem(self.case.spec(), self.case.find)
        begin = perf_counter()
        own = problem.tried(np.random.default_rng([7, self.tried]).random((CHUNK, problem.space.size)))
        known = self.goals
        waiting = np.flatnonzero(own.waiting)
        if own.goals.shape[1]:
            waiting = waiting[np.argsort(own.goals[waiting, 0])]
        for i in waiting:
            if not len(known) or not np.any(np.all(known <= own.goals[i], axis=1)):  # else it adds nothing
                own = problem.put_on_rigs(own, np.array([i]))
                known = np.vstack((known, own.goals[i : i + 1])) if own.missed[i] == 0.0 else known
        good: Tried = own.taken(own.missed == 0.0)
        if own.goals.shape[1]:
            goals = np.vstack((self.goals, good.goals))
            self.goals = goals[nondominated(goals)] if len(goals) else goals
        self.tried, self.met = self.tried + CHUNK, self.met + int(np.count_nonzero(own.nominal))
        self.seconds += perf_counter() - begin
        KEPT.mkdir(parents=True, exist_ok=True)
        told = {"tried": self.tried, "met": self.met, "seconds": self.seconds, "goals": self.goals.tolist()}
        self.path.write_text(json.dumps(told))


def brute(designs: int, only: str | None) -> None:
    """All problems by turns, until each has had so many designs."""
    every = [Brute(case) for case in (*SOLVABLE, *UNSOLVABLE) if only in (None, case.name)]
    while waiting := [own for own in every if own.tried < designs]:
        for own in waiting:
            own.turn()
            print(
                f"{own.case.name}: {own.tried} tried, {own.met} meet everything, {own.seconds:.0f} s",
                flush=True,
            )


def own_time() -> float:
    """Seconds that would have passed since the process began, had nothing else run on two cores."""
    alone = thread_time()
    return alone + UNEVEN * (process_time() - alone)


def finder(designs: int, seconds: float, only: str | None, clock: Callable[[], float]) -> None:
    """The finder on two threads, beside what the brute force has found so far."""
    heads = ("finder", "brute", "ratio", "tried", "seconds", "brute tried", "met")
    print(f"{'problem':36}" + "".join(f"{head:>12}" for head in heads))
    for case in SOLVABLE:
        if only not in (None, case.name):
            continue
        rough, begin = Brute(case), clock()
        search = Search(Problem(case.spec(), case.find, 2), designs, begin + seconds)
        for _ in search.run():
            pass
        took = clock() - begin
        front = np.zeros((0, len(case.find.minimize))) if search.front is None else search.front.goals
        mine, theirs = shares(front, rough.goals)
        ratio = mine / theirs if theirs else np.inf
        print(
            f"{case.name:36}{mine:12.3f}{theirs:12.3f}{ratio:12.2f}{search.used:12}{took:12.1f}"
            f"{rough.tried:12}{rough.met:12}",
            flush=True,
        )
    for case in UNSOLVABLE:
        if only not in (None, case.name):
            continue
        found = find(case.spec(), replace(case.find, designs=20_000, seconds=60.0))
        which = () if found.why is None else (*found.why.alone, *found.why.requirements)
        named = [case.find.require[i].measure.name for i in which]
        right = "right" if frozenset(named) in case.contradict else "WRONG"
        print(f"{case.name:36}{' '.join(named)}: {right}, {found.seconds:.1f} s", flush=True)


def by_control(spec: Spec) -> dict[str, Any]:
    """Figures of the linear loop as python-control tells them."""
    import control

    model = plant(spec.parameters, spec.theta_0)
    A, B = np.array(model.A), np.array(model.B)
    poles = spec.poles.array
    K = np.array(control.place(A, B, poles + np.where(poles.imag == 0, 1e-6 * np.arange(4), 0)))  # none twice
    pi = (spec.outer.pitch, spec.outer.yaw)
    P, P_i = np.diag([own.kp for own in pi]), np.diag([own.kp / own.ti for own in pi])
    F = np.hstack((-K - P @ np.eye(2, 4), P_i))
    whole = np.zeros((6, 6))
    whole[:4] = B @ F
    whole[:4, :4] += A
    whole[4:, :2] = -np.eye(2)
    if np.max(np.linalg.eigvals(whole).real) >= 0:
        return {}
    loop = control.ss(
        whole, np.vstack((B @ P, np.eye(2))), np.vstack((np.eye(2, 6), F)), np.vstack((np.zeros((2, 2)), P))
    )
    times = np.linspace(0.0, spec.scenario.duration, 501)
    steps = (spec.scenario.theta or 0.0, spec.scenario.psi or 0.0)
    axes: Any = loop[:2, :]
    response: Any = control.step_response(loop, times)
    info: Any = _info(axes, times)
    settling = [info[i][i]["SettlingTime"] for i in range(2)]
    opened = control.ss(
        np.block([[A, np.zeros((4, 2))], [-np.eye(2, 4), np.zeros((2, 2))]]),
        np.vstack((B, np.zeros((2, 2)))),
        -F,
        0,
    )
    disk = control.disk_margins(opened, np.geomspace(0.01, 1000, 200))
    volts = [np.abs(model.trim[:, None] + response.outputs[2:, i] * steps[i]).max() for i in range(2)]
    return {
        "settling": max(settling),
        "overshoot": max(info[i][i]["Overshoot"] for i in range(2)),
        "norm": float(np.linalg.norm(K)),
        "disk": float(np.atleast_1d(disk[0])[0]),
        "volts": max(volts),
    }


def _info(axes: Any, times: np.ndarray) -> Any:
    """Its step_info, which fails where 90 % are not reached."""
    import control

    try:
        return control.step_info(axes, T=times)
    except IndexError:
        return [[{"SettlingTime": np.nan, "Overshoot": np.nan}] * 2] * 2


def around_control(
    case: Case, judge: Callable[[dict[str, Any]], tuple[list[float], float]]
) -> tuple[list[np.ndarray], int]:
    """Designs that CMA-ES finds around python-control in the same seconds, and how many it has tried."""
    from cma import CMAEvolutionStrategy

    problem = Problem(case.spec(), case.find)
    begin, tried, good = perf_counter(), 0, []
    known: list[tuple[list[float], np.ndarray]] = []
    turn = 0
    while perf_counter() - begin < SECONDS:
        weight = np.array([0.02 + 0.96 * (turn % 5) / 4, 0.98 - 0.96 * (turn % 5) / 4])
        turn += 1
        start = known[int(np.argmin([float(weight @ own) for own, _ in known]))][1] if known else None
        first = problem.space.point_of(problem.space.spec) if start is None else start
        strategy = CMAEvolutionStrategy(
            first, 0.1, {"bounds": [0, 1], "verbose": -9, "seed": turn, "maxfevals": 150}
        )
        while not strategy.stop() and perf_counter() - begin < SECONDS:
            points, fitness = strategy.ask(), []
            for point in points:
                tried += 1
                goals, missed = judge(by_control(problem.space.design(np.array(point))))
                fitness.append(1e4 + missed if missed > 0 else float(weight @ goals))
                if missed == 0.0:
                    good.append(np.array(point))
                    known.append((goals, np.array(point)))
            strategy.tell(points, fitness)
    return good, tried


def _judges() -> Iterator[tuple[Case, Judge]]:
    def linear(own: dict[str, Any]) -> tuple[list[float], float]:
        if not own or np.isnan(own["settling"]):
            return [0.0, 0.0], 100.0
        missed = max(own["settling"] / 1.505 - 1, 0.0) + max(1 - own["disk"] / 0.495, 0.0)
        return [own["settling"], own["norm"] / 100], missed

    def easy(own: dict[str, Any]) -> tuple[list[float], float]:
        if not own or np.isnan(own["settling"]):
            return [0.0, 0.0], 100.0
        missed = max(own["settling"] / 1.505 - 1, 0.0) + max(own["overshoot"] / 10.05 - 1, 0.0)
        return [own["settling"], own["volts"] / 10], missed

    known = {case.name: case for case in SOLVABLE}
    yield known["easy, linear"], linear
    yield (
        known["easy"],
        easy,
    )  # its figures are nonlinear; the linear ones are what python-control has in this time


def beside_control() -> None:
    """Both in the same seconds: hypervolumes, judged by `evaluate`, and designs tried."""
    for case, judge in _judges():
        problem = Problem(case.spec(), case.find)
        points, theirs = around_control(case, judge)
        rows = [problem.tried(point[np.newaxis]) for point in points]
        goals = np.array([own.goals[0] for own in rows if own.missed[0] == 0.0]).reshape(-1, 2)
        found = find(case.spec(), replace(case.find, designs=MOST, seconds=SECONDS))
        mine, other = shares(goals_of(found), goals)
        print(
            f"{case.name}: finder {mine:.3f}, {found.tried} tried; "
            f"CMA-ES around python-control {other:.3f}, {theirs} tried"
        )
        assert all(own.met for own in proved(problem, [own.spec for own in found.candidates[:3]]))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", choices=("brute", "finder", "control"))
    parser.add_argument(
        "--designs", type=int, default=MOST, help="the most, of the brute force or the finder"
    )
    parser.add_argument("--seconds", type=float, default=SECONDS, help="the most, of the finder")
    parser.add_argument(
        "--shared", action="store_true", help="the finder's seconds are of the cores' own time"
    )
    parser.add_argument("--problem", help="one alone, by its name")
    asked = parser.parse_args()
    warnings.simplefilter("ignore")
    warm_up()
    for library in ("cma", "control", "scipy.optimize"):  # as in a worker that has searched before
        import_module(library)
    clock = own_time if asked.shared else perf_counter
    search_module.perf_counter = clock  # pyright: ignore[reportPrivateImportUsage]
    {
        "brute": lambda: brute(asked.designs, asked.problem),
        "finder": lambda: finder(asked.designs, asked.seconds, asked.problem, clock),
        "control": beside_control,
    }[asked.what]()
