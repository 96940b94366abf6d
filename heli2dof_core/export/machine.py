"""The rig as it is and what the feedback acts on, in words: nothing where all is as in the paper's model."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from ..design import Design
from ..estimators import Estimator, Observer
from ..kernels.layout import FILTER_DAMPING, FILTER_FREQUENCY
from ..signals import AXES, Floats
from ..spec import Spec
from ..tables import number


def machine_lines(spec: Spec) -> list[str]:
    """Lines in ASCII on rotors, friction, and what the feedback acts on; none on what is as in the paper."""
    parts = (
        ("Rotors", rotors_in_words(spec)),
        ("Friction", friction_in_words(spec)),
        ("The feedback acts on", estimator_in_words(spec)),
    )
    return [f"{head}: {words}" for head, words in parts if words]


def rotors_in_words(spec: Spec) -> str:
    """Lag and thrust curve of both motors' rotors; empty where thrust follows the voltages."""
    actuators = spec.actuators
    if actuators is None:
        return ""
    words = []
    for axis, tau, dead, square, slope in zip(
        AXES, actuators.tau, actuators.dead_zone, actuators.square, actuators.slope, strict=True
    ):
        parts = [f"lags by {in_ascii(tau)} s"] if tau else []
        if square:
            zone = f"(|v| - {in_ascii(dead)})^2" if dead else "v^2"
            parts.append(f"thrust {in_ascii(square)} {zone}, {in_ascii(slope)} times as steep at the trim")
        if parts:
            words.append(f"{axis} {', '.join(parts)}")
    return "; ".join(words)


def friction_in_words(spec: Spec) -> str:
    """Of both axes; empty where there is none."""
    actuators = spec.actuators
    if actuators is None:
        return ""
    both = zip(AXES, actuators.coulomb, actuators.breakaway, strict=True)
    return "; ".join(
        f"{axis} {in_ascii(moving)} N m against the motion, {in_ascii(rest)} N m at rest"
        for axis, moving, rest in both
        if rest
    )


def estimator_in_words(spec: Spec) -> str:
    """What the feedback acts on; empty where it has the states."""
    measured, observer = spec.scenario.measured, spec.observer or Observer()
    if measured == "states":
        return ""
    if measured == "filtered":
        words = f"2nd order, {FILTER_FREQUENCY:.6g} rad/s, damping {FILTER_DAMPING:g}"
        return f"the angles and their filtered rates, {words}"
    if observer.method == "kalman":
        voltages, angles = in_ascii(observer.voltage_noise), in_ascii(observer.angle_noise)
        return (
            f"the estimate of a Kalman filter for white noise of {voltages} V/sqrt(Hz) on the voltages and "
            f"{angles} rad/sqrt(Hz) on the angles"
        )
    poles = poles_in_words(observer.poles.values)
    return f"the estimate of an observer, {observer.structure.title}, with poles {poles} rad/s"


def estimated_in_words(design: Design, estimator: Estimator) -> str:
    """What the states of an estimator are, in ASCII."""
    names = [f"w_{i}" for i in range(1, estimator.order + 1)]
    if estimator.L is None:
        what = ["theta filtered", "its rate / omega", "psi filtered", "its rate / omega"]
    else:
        what = [signal.name for signal in design.states[: estimator.order]]
    return ", ".join(f"{name}: {own}" for name, own in zip(names, what, strict=True))


def with_lag(design: Design) -> tuple[Floats, Floats]:
    """A and B of the rig with the speeds of the rotors that lag behind its four states, n×n and n×2."""
    plant, actuators = design.plant, design.actuators
    if actuators is None:
        return plant.A, plant.B
    lagging, thrust = actuators.tau > 0.0, plant.B * actuators.slope
    late, lag = np.eye(2)[:, lagging], np.diag(1.0 / actuators.tau[lagging])
    A = np.block([[plant.A, thrust @ late], [np.zeros((len(lag), 4)), -lag]])
    return A, np.vstack((thrust * ~lagging, lag @ late.T))


def poles_in_words(poles: Iterable[complex]) -> str:
    """Poles as text, in ASCII."""
    return ", ".join(map(in_ascii, poles))


def in_ascii(value: complex) -> str:
    """A number or pole as the tables write it, in ASCII."""
    return number(value, 6, minus="-", gap="")
