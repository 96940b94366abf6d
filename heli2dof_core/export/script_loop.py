"""The loop of an exported script, block by block: rotors, estimator, and the whole, as the core composes them."""

from __future__ import annotations

from collections.abc import Iterator

from ..kernels.layout import FILTER_DAMPING, FILTER_FREQUENCY
from ..loop import Loop
from ..scenario import Scenario
from ..signals import AXES
from ..simulation.augmented import inner_start
from ..simulation.experiment import experiment
from .dialect import Dialect


def start_of(loop: Loop, scenario: Scenario) -> list[float]:
    """The loop's states at t = 0, in deviations, as the linear simulation takes them."""
    theta_0, x = loop.design.plant.theta_0, experiment(loop, None, scenario)
    theta, *others = scenario.resolved(theta_0)[2:]
    inner = inner_start(loop, x)[0].tolist()
    known = [theta - theta_0, *others, 0.0, 0.0, *inner]
    return [known[place] for place in loop.places]


def model_names(loop: Loop) -> tuple[str, str]:
    """A and B of the model that K is designed for, by their names in the script."""
    return ("A", "B") if loop.design.rotor_poles is None else ("A_plus", "B_plus")


def gain_comment(loop: Loop) -> str:
    """Of the script's K."""
    if loop.design.rotor_poles is None:
        return "u = -K x + v, V/rad and V s/rad"
    return "u = -K x + v, V/rad, V s/rad, and V/V on the rotors' speeds"


def machine_lines(loop: Loop, d: Dialect) -> Iterator[str]:
    """Thrust curves and rotors; nothing where all is as in the paper's model."""
    actuators = loop.actuators
    if actuators is None:
        return
    if actuators.breakaway.any():
        yield f"\n{d.comment} Friction is no part of the linear model."
    effect, ones = _effect(loop), "ones(2, 1)" if d.matlab else "np.ones(2)"
    if actuators.square.any():
        yield f"\n{d.comment} Thrust curves s sign(v) max(|v| - v_d, 0)^2: slope at rest, and voltages there"
        yield d.line("slope", ones)
        both = zip(AXES, actuators.square.tolist(), actuators.dead_zone.tolist(), strict=True)
        for i, (axis, square, dead) in enumerate(both):
            if square:
                yield from _curve(d, i, f"the {axis} motor's", square, dead)
        diagonal = d.function("diag")
        yield d.line(effect, f"B @ {diagonal}(slope)", "small voltages at the trim act by the slopes")
    if not actuators.lags:
        return
    lagging = "tau(tau > 0)" if d.matlab else "tau[tau > 0]"
    late = "both_motors(:, tau > 0)" if d.matlab else "both_motors[:, tau > 0]"
    yield f"\n{d.comment} Rotors that lag, tau dv/dt = V - v: thrust follows v, and v is a state where tau is not 0"
    yield d.line("tau", d.vector(actuators.tau.tolist()), "s")
    yield d.line("both_motors", d.eye(2, 2))
    yield d.line("late", late, "the motors whose rotors lag")
    yield d.line("at_once", f"{d.function('diag')}({'double(tau == 0)' if d.matlab else '1.0 * (tau == 0)'})")
    yield d.line("lag", f"{d.function('diag')}(1 {'./' if d.matlab else '/'} {lagging})")
    k = _lagging(loop)
    yield d.line("A_plus", d.block([["A", f"{effect} @ late"], [d.zeros(k, 4), "-lag"]]))
    yield d.line("B_plus", d.stacked([f"{effect} @ at_once", "lag @ late.T"]))


def _curve(d: Dialect, i: int, whose: str, square: float, dead: float) -> Iterator[str]:
    root, absolute, sign = (d.function(name) for name in ("sqrt", "abs", "sign"))
    trim = d.entry("trim", i)
    yield d.line("s", repr(square), f"{whose}, 1/V")
    yield d.line("v_d", repr(dead), "V")
    yield d.line(d.entry("slope", i), f"2 * {root}(s * {absolute}({trim}))")
    yield d.line(trim, f"{sign}({trim}) * (v_d + {root}({absolute}({trim}) / s))", "V")


def estimator_lines(loop: Loop, d: Dialect) -> Iterator[str]:
    """What estimates the states, w' = F_w w + G_w y + H_w u; nothing where they are measured."""
    estimator, comment = loop.estimator, d.comment
    if estimator is None:
        return
    if estimator.L is None:
        kron, two = d.function("kron"), d.eye(2, 2)
        yield f"\n{comment} Rate filters, w' = F_w w + G_w y: per axis the filtered angle and its rate / omega"
        yield d.line("omega", repr(FILTER_FREQUENCY), "rad/s")
        yield d.line("zeta", repr(FILTER_DAMPING))
        yield d.line("F_w", f"omega * {kron}({two}, {d.rows('0, 1', '-1, -2 * zeta')})")
        yield d.line("G_w", f"omega * {kron}({two}, {d.rows('0', '1')})")
        yield d.line("H_w", d.zeros(4, 2))
        rates = f"omega * {kron}({two}, {d.rows('0, 1')})"
        yield d.line("x_from_w", d.stacked([d.zeros(2, 4), rates]), "x = x_from_y y + x_from_w w")
        yield d.line("x_from_y", d.eye(4, 2))
        return
    yield f"\n{comment} Observer, x' = A x + B u + L (y - C x), in deviations from the trim"
    yield d.matrix(
        "L",
        estimator.L,
        "1/s and 1/s^2; poles of A - LC"
        + (" asked for below" if estimator.wanted is not None else " by the Kalman filter"),
    )
    if estimator.order == 4:
        yield d.line("F_w", "A - L @ C")
        yield d.line("G_w", "L")
        yield d.line("H_w", "B")
        return
    yield d.line("G_w", d.stacked(["L", d.zeros(2, 2)]), "the rotors' speeds follow the voltages uncorrected")
    yield d.line("F_w", f"A_plus - G_w @ {d.eye(2, 6)}")
    yield d.line("H_w", "B_plus")


def loop_lines(loop: Loop, d: Dialect) -> Iterator[str]:
    """The law and the whole loop, x first, then the integrals, the rotors and the estimator."""
    sizes = {"x": 4, "z": 2 * (loop.integral is not None), "v": _lagging(loop)}
    sizes["w"] = 0 if loop.estimator is None else loop.estimator.order
    parts = [part for part, size in sizes.items() if size]
    x, integral = "x" if loop.estimator is None else "x_hat", " + I z" if "z" in parts else ""
    words = f"u = -K {x} + P e{integral} + F r with e = r - C x" + (" and z' = e" if "z" in parts else "")
    yield f"{d.comment} The whole loop: {words}"
    if {"v", "w"} & set(parts):
        yield f"{d.comment} Its states: {', '.join(_MEANT[part] for part in parts)}"
    law, effect = _law(loop, d), _effect(loop)
    yield d.line("law", d.beside([law.get(part, d.zeros(2, sizes[part])) for part in parts]))
    yield d.line("law_of_reference", "P + F")
    blocks = {("x", "x"): "A", ("z", "x"): "-C", ("x", "v"): f"{effect} @ late", ("v", "v"): "-lag"}
    blocks |= {("w", "x"): "G_w @ C", ("w", "w"): "F_w"}
    motors = {"x": effect if "v" not in parts else f"{effect} @ at_once", "v": "lag @ late.T", "w": "H_w"}
    rows = [[blocks.get((a, b), d.zeros(sizes[a], sizes[b])) for b in parts] for a in parts]
    voltages = d.stacked([motors.get(part, d.zeros(2, 2)) for part in parts])
    yield d.line("A_loop", f"{d.block(rows)} + {voltages} @ law")
    by_reference = [d.eye(2, 2) if part == "z" else f"{motors[part]} @ law_of_reference" for part in parts]
    yield d.line("B_loop", d.stacked(by_reference))


_MEANT = {"x": "x", "z": "z", "v": "v of the rotors that lag", "w": "w of the estimator"}


def _law(loop: Loop, d: Dialect) -> dict[str, str]:
    """∂u/∂ states by part; what is left out is 0."""
    six, estimator = loop.design.K.shape[1] == 6, loop.estimator
    K, on_rotors = ("K", "") if not six else (d.columns("K", 0, 4), d.columns("K", 4, 6))
    law = {"z": d.integral} | ({"v": f"-{on_rotors}"} if six else {})
    if estimator is None:
        return law | {"x": f"-{K} - P @ C"}
    if estimator.L is None:
        return law | {"x": f"-({K} @ x_from_y + P) @ C", "w": f"-{K} @ x_from_w"}
    return {"z": d.integral, "x": "-P @ C", "w": "-K"}


def _lagging(loop: Loop) -> int:
    return 0 if loop.actuators is None else int((loop.actuators.tau > 0.0).sum())


def _effect(loop: Loop) -> str:
    """Name of B with the thrust curves' slopes."""
    return "B" if loop.actuators is None or not loop.actuators.square.any() else "B_thrust"
