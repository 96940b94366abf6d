"""A system with its state feedback, and an observer where one is wanted: gains, poles, and what they cost."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..controllability import in_own_units, reach
from ..design import FULL_RANK
from ..errors import Heli2DofError, InvalidInputError, MethodUnavailableError, UncontrollableError
from ..findings import Finding, merged
from ..frozen import Frozen
from ..placement.assess import Assessment, assess
from ..placement.groups import conjugate_units
from ..placement.method import Method, Placement, Task, Weights
from ..placement.registry import method as method_named
from ..rank import numeric_rank
from ..signals import Complexes, Floats
from ..tables import Shown, Table
from ..tables import poles as pole_words
from .analysis import analyse_pair
from .model import System

HIGH = 1e3
"""Gains are said to be high where BK, in the system's own units, is so many times as large as the poles."""


@dataclass(frozen=True)
class Wish:
    """What is wanted of a system.

    Attributes:
        poles: n, rad/s; quadratic methods choose their own.
        method: name in `placement.registry.METHODS`.
        observer_poles: n, rad/s; None without an observer.
        weights: of the quadratic methods; ones if not given.
        exactly: whether the closed loop's poles are told exactly where floats do not tell them.
    """

    poles: tuple[complex, ...]
    method: str = FULL_RANK
    observer_poles: tuple[complex, ...] | None = None
    weights: Weights | None = None
    exactly: bool = True


@dataclass(frozen=True, repr=False)
class ClosedLoop(Frozen, Shown):
    """u = −Kx + F r, or u = −Kx + K_z ∫(r − y) dt with integral action; with an observer x̂ stands in x's place.

    Attributes:
        system: the system.
        control: K and what it does.
        observer: Lᵀ and what it does to (Aᵀ, Cᵀ); None without an observer.
        F: p×m, how the m references enter.
        scaling: ``static``: F = Ĝ(0)⁻¹ of the closed loop, so that outputs end at their references, m = q;
            ``pseudo-inverse``: likewise with more inputs than outputs; ``integral``: m = q, and F = 0;
            ``inputs``: none of these exists, and each reference is added to an input, F = 1.
        reason: why, in a sentence.
        findings: remarks.
    """

    system: System
    control: Assessment
    observer: Assessment | None
    F: Floats
    scaling: str
    reason: str
    findings: tuple[Finding, ...]

    @property
    def K(self) -> Floats:
        """State feedback, p×n."""
        return self.control.placement.K

    @property
    def K_z(self) -> Floats:
        """Of the integrated errors, p×q; p×0 without integral action."""
        own = self.control.placement.integral
        return np.zeros((len(self.K), 0)) if own is None else own

    @property
    def L(self) -> Floats | None:
        """The observer's gain, n×q."""
        return None if self.observer is None else self.observer.placement.K.T

    @property
    def poles(self) -> Complexes:
        """Of the loop without its observer: n, and with integral action q more."""
        if not self.K_z.size:
            return self.control.closed_loop_poles
        return np.linalg.eigvals(self.matrices()[0]).astype(np.complex128)

    def matrices(self) -> tuple[Floats, Floats, Floats, Floats]:
        """From r to [y, u], the observer at rest: states [x, z]."""
        A, B, C, D = self.system.A, self.system.B, self.system.C, self.system.D
        n, q, k = len(A), len(C), self.K_z.shape[1]
        gain = np.hstack([-self.K, self.K_z])
        inner = np.block([[A, np.zeros((n, k))], [-C[:k], np.zeros((k, k))]])
        enter = np.vstack([B, np.zeros((k, B.shape[1]))])
        drive = enter @ self.F
        if k:
            drive = drive + np.vstack([np.zeros((n, k)), np.eye(k)])
        y = np.hstack([C, np.zeros((q, k))]) + D @ gain
        return inner + enter @ gain, drive, np.vstack([y, gain]), np.vstack([D @ self.F, self.F])

    def summary(self) -> str:
        """Poles and gains."""
        own = f"K {self.K.shape[0]}×{self.K.shape[1]}, poles {pole_words(self.poles.tolist())}"
        return (
            own
            if self.observer is None
            else f"{own}; observer poles {pole_words(self.observer.closed_loop_poles.tolist())}"
        )

    def tables(self) -> tuple[Table, ...]:
        """K and L."""
        n, p, q = self.system.sizes
        states, inputs = [f"x{i + 1}" for i in range(n)], [f"u{i + 1}" for i in range(p)]
        found = [Table.matrix("K, u = −Kx", self.K, inputs, states)]
        if self.L is not None:
            found.append(Table.matrix("L", self.L, states, [f"y{i + 1}" for i in range(q)]))
        return tuple(found)


def close_loop(system: System, wish: Wish) -> ClosedLoop:
    """Places the poles of a system, and of its observer.

    Raises:
        InvalidInputError: poles or weights do not fit, or the method's name is wrong.
        UnpairedPolesError: a complex pole lacks its conjugate.
        UncontrollableError: not all modes are reached by the inputs; with those that are not.
        MethodUnavailableError: the method cannot solve this task.
    """
    chosen = method_named(wish.method)
    n, p, q = system.sizes
    wanted = system.require_poles(wish.poles)
    conjugate_units(wanted)
    if chosen.places_poles and not chosen.structured:  # which judges that itself
        _require_reached(system.A, system.B, "B")
    if chosen.integrates and not system.measured:
        raise MethodUnavailableError(
            "integral action needs the outputs that it shall regulate", field="C", hint="Give C of y = Cx."
        )
    if chosen.integrates and np.any(system.D):
        raise MethodUnavailableError(
            "integral action is designed for systems without D",
            field="method",
            hint="Leave D out, or choose another method.",
        )
    weights = wish.weights or Weights((1.0,) * n, (1.0,) * p, (1.0,) * q)
    try:
        control = _placed(chosen, Task(system.A, system.B, wanted, system.C, weights), exactly=wish.exactly)
    except UncontrollableError:
        _require_reached(system.A, system.B, "B")
        raise
    observer = (
        None if wish.observer_poles is None else _observer(system, chosen, wish.observer_poles, wish.exactly)
    )
    F, scaling, reason = _reference(system, control.placement)
    own = tuple(_remarks(system, control, chosen, wanted))
    seen = () if observer is None else _of_observer(observer.findings)
    return ClosedLoop(system, control, observer, F, scaling, reason, merged(control.findings, own, seen))


def _placed(method: Method, task: Task, *, exactly: bool) -> Assessment:
    placement = method.place(task)
    return assess(task.A, task.B, task.poles, placement, aimed=method.places_poles, exactly=exactly)


def _observer(system: System, method: Method, poles: tuple[complex, ...], exactly: bool) -> Assessment:
    """Lᵀ by duality, by the method itself where it places poles, else through the canonical form."""
    if not system.measured:
        raise InvalidInputError("an observer needs C", field="observer_poles", hint="Give C of y = Cx.")
    wanted = system.require_poles(poles, "observer_poles")
    own = method if method.places_poles else method_named(FULL_RANK)
    A, C = system.dual
    try:
        conjugate_units(wanted)
        if not own.structured:
            _require_reached(A, C, "C")
        return _placed(own, Task(A, C, wanted), exactly=exactly)
    except UncontrollableError:
        _require_reached(A, C, "C")
        raise
    except Heli2DofError as error:
        if error.field.startswith("poles"):
            error.name_field("observer_" + error.field)
        elif error.field == "B":
            error.name_field("C")
        raise


def _require_reached(A: Floats, B: Floats, field: str) -> None:
    found = reach(A, B)
    n, r = len(A), found.basis.shape[1]
    if r == n:
        return
    lost = pole_words(analyse_pair(A, B).lost.tolist())
    if field == "B":
        raise UncontrollableError(
            f"(A, B) is not controllable: the inputs reach {r} of the {n} states, and not the modes s = {lost}",
            field="B",
            hint="Add an input, or take these modes out of the model.",
        )
    raise UncontrollableError(
        f"(A, C) is not observable: the outputs show {r} of the {n} states, and not the modes s = {lost}",
        field="C",
        hint="Add an output, or leave the observer out.",
    )


def _reference(system: System, placement: Placement) -> tuple[Floats, str, str]:
    """F, its kind, and why."""
    n, p, q = system.sizes
    if placement.integral is not None:
        return np.zeros((p, q)), "integral", "Integral action takes each output to its reference."
    if not system.measured:
        return (
            np.eye(p),
            "inputs",
            "Without C nothing says what is to be regulated: each step is added to an input.",
        )
    closed = system.A - system.B @ placement.K
    if int(numeric_rank(closed)) == n and q <= p:
        gain = system.D - (system.C - system.D @ placement.K) @ np.linalg.solve(closed, system.B)
        if int(numeric_rank(gain)) == q:
            if q == p:
                return (
                    np.asarray(np.linalg.inv(gain), dtype=np.float64),
                    "static",
                    "F is the inverse of the closed loop’s gain at ω = 0: outputs end at their references.",
                )
            return (
                np.asarray(np.linalg.pinv(gain), dtype=np.float64),
                "pseudo-inverse",
                "F is the pseudo-inverse of the closed loop’s gain at ω = 0: outputs end at their references by the "
                "smallest inputs.",
            )
    reason = (
        "There are more outputs than inputs"
        if q > p
        else "The closed loop’s gain at ω = 0 has no inverse (a zero at 0)"
    )
    return np.eye(p), "inputs", f"{reason}: each step is added to an input."


def _remarks(system: System, control: Assessment, method: Method, wanted: Complexes) -> Iterator[Finding]:
    poles = control.closed_loop_poles
    size = float(np.max(np.abs(poles), initial=0.0))
    right = poles[poles.real >= -1e-9 * size]
    if len(right):
        yield Finding(
            "unstable",
            "error",
            f"The closed loop is not stable: s = {pole_words(right.tolist())}. Place it further left.",
        )
    _, inputs, units, speed = in_own_units(system.A, system.B)
    moved = float(np.linalg.norm(inputs @ (control.placement.K * units), 2))
    if moved > HIGH * max(1.0, size / speed):
        yield Finding(
            "high_gains",
            "warning",
            f"High gains: BK is {moved * speed / max(size, speed):.1g} times the size of the poles, in the "
            "states’ own units. Small errors of the model and noise weigh as much. Move the poles "
            "less, or see which mode is hard to reach.",
        )


def _of_observer(findings: tuple[Finding, ...]) -> tuple[Finding, ...]:
    """The same remarks, said of L."""
    told: dict[str, Any] = {
        "nearly_uncontrollable": "The system is nearly unobservable from these outputs: L is large.",
        "pole_error": "L misses the observer’s poles: where these coincide, or lie far out, rounding L moves them.",
    }
    names = {"nearly_uncontrollable": "nearly_unobservable", "pole_error": "observer_pole_error"}
    return tuple(Finding(names[f.code], f.severity, told[f.code]) for f in findings if f.code in names)
