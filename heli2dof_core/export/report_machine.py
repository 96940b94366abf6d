"""What the report says of the rig as it is: rotors, thrust curves, friction, and what the feedback acts on."""

from __future__ import annotations

from typing import Any

from ..evaluate import Report
from ..figures import LOOP
from ..figures.written import told
from ..loop import UNLIMITED
from ..rotors import Actuators
from ..signals import AXES
from ..spec import Spec
from ..tables import number, poles

_ROWS = (
    ("τ", "time constant of the rotor's speed v: τ v̇ = V − v", "tau", "s"),
    ("s", "thrust curve φ(v) = s·sign(v)·max(|v| − v_d, 0)²", "square", "1/V"),
    ("v_d", "its dead zone", "dead_zone", "V"),
    ("φ′", "slope of the thrust curve at the trim", "slope", ""),
    ("F_c", "Coulomb friction against the motion", "coulomb", "N·m"),
    ("F_s", "torque that friction withstands at rest", "breakaway", "N·m"),
)


def machine(actuators: Actuators | None) -> list[tuple[str, ...]]:
    """Rows of symbol, meaning, pitch's and yaw's value, unit; none where all is as in the paper's model."""
    if actuators is None:
        return []
    plain = {"slope": 1.0}
    return [
        (symbol, meaning, *(number(value, 6) for value in getattr(actuators, name).tolist()), unit)
        for symbol, meaning, name, unit in _ROWS
        if (getattr(actuators, name) != plain.get(name, 0.0)).any()
    ]


def model_in_words(report: Report) -> str:
    """The linear model with rotors; empty where thrust follows the voltages as the model says."""
    actuators = report.design.actuators
    if actuators is None or not (actuators.lags or actuators.square.any()):
        return ""
    parts = []
    if actuators.square.any():
        parts.append("the motors act on small changes by B diag(φ′)")
    if actuators.lags:
        lagging = " and ".join(f"{axis}'s" for axis, tau in zip(AXES, actuators.tau, strict=True) if tau)
        thrust = "B diag(φ′)" if actuators.square.any() else "B"
        parts.append(f"the speed v of {lagging} rotor is a state: ẋ = Ax + {thrust} v, v̇ = (V − v)/τ")
    known = report.design.rotor_poles is not None
    return f"On the rig {'; '.join(parts)}. The design {'knows this' if known else 'does not know of it'}."


def feedback_in_words(spec: Spec, report: Report) -> str:
    """What the feedback acts on; empty where it has the states."""
    estimator, n = report.loop.estimator, len(report.design.states)
    if estimator is None:
        return ""
    speeds = " The rotors' speeds are measured." if n == 6 and len(estimator.from_state) == 4 else ""
    if estimator.L is None:
        return f"The feedback acts on the measured angles and on rates filtered from them.{speeds}"
    kind = (
        "a Kalman filter's"
        if spec.observer is not None and spec.observer.method == "kalman"
        else "an observer's"
    )
    follow = " Its rotors' speeds follow the voltages uncorrected." if estimator.order == 6 else ""
    return (
        f"The feedback acts on {kind} estimate x̂, x̂' = Ax̂ + Bu + L(y − Cx̂), with the poles of A − LC at "
        f"{poles(estimator.poles.tolist())} rad/s.{follow}"
    )


def lag_margin(report: Report) -> str:
    """In words, where the loop is stable."""
    figure, value = LOOP["lag_margin"], report.loop.lag_margin
    if value is None:
        return f"{figure.title}: {UNLIMITED}." if report.loop.stable else ""
    return f"{figure.title}: {told(figure, value)}, the {figure.meaning}."


def words(spec: Spec, report: Report) -> dict[str, Any]:
    """All of it, for the template."""
    return {
        "machine": machine(report.design.actuators),
        "model": model_in_words(report),
        "feedback": feedback_in_words(spec, report),
        "lag_margin": lag_margin(report),
    }
