"""Random loops whose rotors take time and whose controllers estimate, each as a state-space model of its own."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import control
import numpy as np
from scipy.signal import place_poles

from heli2dof_core.engine import engine
from heli2dof_core.loop_polynomials import controller_numbers, whole_polynomials
from heli2dof_core.scratch import scratch
from tests.core.random_loops import random_stable_loops

KINDS = ("states", "filtered", "observer", "speeds", "observer of speeds")


@dataclass(frozen=True)
class WholeLoop:
    """What margins and sensitivity read of a loop, and the state-space model that nobody of them knows.

    Attributes:
        A, B: of the rig, the slopes of the thrust curves within B.
        tau: of the rotors.
        K, K_v, proportional, integral: the law.
        filters, observer: as `controller_numbers` takes them.
    """

    A: np.ndarray
    B: np.ndarray
    tau: np.ndarray
    K: np.ndarray
    K_v: np.ndarray
    proportional: np.ndarray
    integral: np.ndarray | None
    filters: tuple | None = None
    observer: tuple | None = None

    @cached_property
    def controller(self):
        return controller_numbers(
            np.hstack((self.K, self.K_v)), self.proportional, self.integral, self.filters, self.observer
        )

    @cached_property
    def polynomials(self):
        return whole_polynomials(self.A, self.B, self.tau, self.controller)

    @cached_property
    def stable(self) -> bool:
        return bool(engine().is_stable(self.polynomials, scratch.stability))

    @cached_property
    def connected_poles(self):
        return np.linalg.eigvals(self.closed()[0]).astype(complex)

    def with_lags(self, tau) -> WholeLoop:
        """The same controller before other rotors."""
        return WholeLoop(**{**self.arguments, "tau": np.array(tau, dtype=float)})

    @property
    def arguments(self) -> dict:
        return {name: getattr(self, name) for name in self.__dataclass_fields__}

    def closed(self, factors=(1.0, 1.0)):  # noqa: C901, PLR0912 # every kind at once, each line as it is defined
        """A, B, C, D of the loop from what disturbs both motors' voltages to u; `factors` on what the motors get."""
        x = slice(0, 4)
        integrates = [] if self.integral is None else [j for j in range(2) if self.integral[:, j].any()]
        n = 4
        z = {j: n + k for k, j in enumerate(integrates)}
        n += len(z)
        v = {}
        for j in range(2):
            if self.tau[j] > 0:
                v[j], n = n, n + 1
        w = n
        n += 4 if self.filters or self.observer else 0
        knows = self.observer is not None and np.any(self.observer[3])
        n += 2 if knows else 0
        u = np.zeros((2, n))
        u[:, :2] -= self.proportional
        for j, k in z.items():
            u[:, k] += self.integral[:, j]
        A = np.zeros((n, n))
        if self.filters:
            omega, zeta = self.filters
            u[:, :2] -= self.K[:, :2]
            for j in range(2):
                one, two = w + 2 * j, w + 2 * j + 1
                A[one, two], A[two, one], A[two, two], A[two, j] = 1, -(omega**2), -2 * zeta * omega, 1
                u[:, two] -= self.K[:, 2 + j] * omega**2
        elif self.observer:
            u[:, w : w + 4] -= self.K
            if knows:
                u[:, w + 4 : w + 6] -= self.K_v
        else:
            u[:, x] -= self.K
        if not self.observer:
            for j, k in v.items():
                u[:, k] -= self.K_v[:, j]
        if self.observer:
            own_A, own_B, L, own_tau = self.observer
            A[w : w + 4, w : w + 4] = own_A - L @ np.eye(2, 4)
            A[w : w + 4, :2] = L
            if knows:
                A[w : w + 4, w + 4 : w + 6] = own_B
                A[w + 4 : w + 6] += (u - np.eye(2, n, w + 4)) / own_tau[:, None]
            else:
                A[w : w + 4] += own_B @ u
        A[x, x] += self.A
        for j, k in z.items():
            A[k, j] = -1
        B = np.zeros((n, 2))
        for j in range(2):
            if j in v:
                k = v[j]
                A[x, k] += self.B[:, j]
                A[k] += factors[j] * u[j] / self.tau[j]
                A[k, k] -= 1 / self.tau[j]
                B[k, j] = 1 / self.tau[j]
            else:
                A[x] += factors[j] * np.outer(self.B[:, j], u[j])
                B[x, j] = self.B[:, j]
        return A, B, u, np.zeros((2, 2))

    def opened(self, motor=None) -> control.StateSpace:
        """L(s) with both motors opened, or with one, the other closed."""
        factors = [0.0, 0.0] if motor is None else [float(j != motor) for j in range(2)]
        A, B, C, D = self.closed(factors)
        if motor is None:
            return control.ss(A, B, -C, D)
        return control.ss(A, B[:, [motor]], -C[[motor]], 0)


def random_whole_loops(count: int, seed: int, kinds=KINDS, *, stable=True) -> Iterator[WholeLoop]:
    """Loops of these kinds in turn, on random rigs with random laws."""
    rng = np.random.default_rng(seed)
    loops = random_stable_loops(10**6, seed)
    while count:
        kind = kinds[count % len(kinds)]
        loop = random_whole_loop(rng, next(loops), kind)
        if loop.stable or not stable:
            count -= 1
            yield loop


def random_whole_loop(rng, loop, kind) -> WholeLoop:
    """One of a kind around a design's own K and outer loop."""
    plant, fast = loop.design.plant, max(abs(loop.connected_poles))
    slope = rng.uniform(0.6, 1.8, 2) if rng.random() < 0.5 else np.ones(2)
    B = plant.B * slope
    tau = 10 ** rng.uniform(-2.5, 0.3, 2) / fast
    if rng.random() < 0.3:
        tau[1] = tau[0]
    elif rng.random() < 0.3 and "speeds" not in kind:
        tau[rng.integers(2)] = 0.0
    K_v, filters, observer = np.zeros((2, 2)), None, None
    if "speeds" in kind:
        K_v = rng.uniform(-0.2, 1.0, (2, 2))
    if kind == "filtered":
        filters = fast * 10 ** rng.uniform(0.5, 2), rng.uniform(0.5, 1.0)
    if "observer" in kind:
        knows = "speeds" in kind
        L = _observer_gain(rng, plant.A, fast)
        observer = plant.A, B if knows else plant.B, L, tau if knows else np.zeros(2)
    return WholeLoop(plant.A, B, tau, loop.design.K, K_v, loop.proportional, loop.integral, filters, observer)


def _observer_gain(rng, A, fast):
    """Poles of A − LC by SciPy, which need not find the most robust L."""
    poles = -fast * rng.uniform(1.5, 5) * (1 + 0.2 * np.arange(4))
    return place_poles(A.T, np.eye(4)[:, :2], poles, rtol=-1, maxiter=5).gain_matrix.T
