"""The rig as it is and what the feedback acts on, in words: nothing where all is as in the paper's model."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..design import Design
from ..estimators import FILTER_DAMPING, FILTER_FREQUENCY, Estimator, Observer
from ..rotors import Actuators
from ..signals import AXES, Floats
from ..spec import Spec
from ..tables import number


def rotors_in_words(actuators: Actuators | None) -> str:
    """Lag and thrust curve of both motors' rotors; empty where thrust follows the voltages."""
    if actuators is None:
        return ""
    return "; ".join(_rotor(actuators, j, axis) for j, axis in enumerate(AXES) if _own(actuators, j))


def friction_in_words(actuators: Actuators | None) -> str:
    """Of both axes; empty where there is none."""
    if actuators is None:
        return ""
    both = zip(AXES, actuators.coulomb.tolist(), actuators.breakaway.tolist(), strict=True)
    return "; ".join(
        f"{axis} {ascii_number(moving)} N m against the motion, {ascii_number(rest)} N m at rest"
        for axis, moving, rest in both
        if rest
    )


def estimator_in_words(spec: Spec) -> str:
    """What the feedback acts on; empty where it has the states."""
    measured = spec.scenario.measured
    if measured == "states":
        return ""
    if measured == "filtered":
        return f"angles and rates filtered from them, 2nd order, {FILTER_FREQUENCY:.6g} rad/s, damping {FILTER_DAMPING:g}"
    observer = spec.observer or Observer()
    if observer.method == "kalman":
        return (
            f"the estimate of a Kalman filter for white noise of {ascii_number(observer.voltage_noise)} V/sqrt(Hz) on "
            f"the voltages and {ascii_number(observer.angle_noise)} rad/sqrt(Hz) on the angles"
        )
    poles = ", ".join(map(ascii_number, observer.poles.values))
    return f"an observer's estimate, poles of A - LC {poles} rad/s, {observer.structure.title}"


def machine_lines(spec: Spec) -> Iterator[str]:
    """Lines for the head of a file, in ASCII."""
    parts = (
        ("Rotors", rotors_in_words(spec.actuators)),
        ("Friction", friction_in_words(spec.actuators)),
        ("The feedback acts on", estimator_in_words(spec)),
    )
    return (f"{head}: {words}" for head, words in parts if words)


def ascii_number(value: complex) -> str:
    """As the tables write it, in ASCII."""
    return number(value, 6, minus="-", gap="")


def estimated_names(design: Design, estimator: Estimator) -> tuple[str, ...]:
    """What the states of an estimator are, by their names."""
    if estimator.measured == "filtered":
        return "theta: x_1", "theta: x_2", "psi: x_1", "psi: x_2"
    return tuple(signal.name for signal in design.states[: estimator.order])


def with_lag(design: Design) -> tuple[Floats, Floats] | None:
    """A and B of the rig with the rotors that lag, x = [θ, ψ, θ̇, ψ̇, v …]; None where none lags.

    Their order is 5 where one of them follows at once.
    """
    actuators = design.actuators
    if actuators is None or not actuators.lags:
        return None
    thrust, lags = design.plant.B * actuators.slope, actuators.tau > 0.0
    late, rates = np.eye(2)[:, lags], np.diag(1.0 / actuators.tau[lags])
    below = np.zeros((len(rates), 4))
    A = np.block([[design.plant.A, thrust @ late], [below, -rates]])
    return A, np.vstack((thrust * ~lags, rates @ late.T))


def _own(actuators: Actuators, j: int) -> bool:
    return bool(actuators.tau[j] or actuators.square[j])


def _rotor(actuators: Actuators, j: int, axis: str) -> str:
    tau, dead, square = (float(x[j]) for x in (actuators.tau, actuators.dead_zone, actuators.square))
    parts = [f"lags, time constant {ascii_number(tau)} s"] if tau else []
    if square:
        zone = f" beyond {ascii_number(dead)} V" if dead else ""
        slope = ascii_number(float(actuators.slope[j]))
        parts.append(
            f"thrust grows with the square of its speed{zone}, {slope} times the linear slope at the trim"
        )
    return f"{axis} {', '.join(parts)}"
