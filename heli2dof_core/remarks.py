"""What can be said of the poles that were asked for and of the gain that places them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import pi, sqrt

from .findings import Finding
from .kernels.layout import ROUNDING
from .kernels.update_layout import NEARLY_PARALLEL
from .plant import Plant
from .signals import AXES, Floats
from .tables import conjugates

COINCIDENT = 1e-6
"""Poles closer than this share of their size count as one."""
ACCURATE = 1e-6
"""Share of the largest pole by which poles may miss those asked for without a word."""
FAR_OUT = 1e3
"""Poles beyond this, rad/s, are remarked on: a lab rig's motors and sensors end far below."""


def design_remarks(
    plant: Plant,
    K: Sequence[Sequence[float]] | Floats,
    poles: Sequence[complex],
    error: float | None,
    *,
    stable: bool,
    steady: bool,
) -> tuple[Finding, ...]:
    """Findings on a design.

    Args:
        plant: the rig.
        K: rows of its state feedback.
        poles: those asked for, or the method's own where it chooses them (error None), rad/s.
        error: distance of the poles as computed from those asked for, rad/s.
        stable: see `Design.stable`.
        steady: whether there is a steady state.
    """
    found: list[Finding] = [] if error is not None else [_OWN_POLES]
    if not (stable and steady):
        found += _on_stability(poles, stable=stable, steady=steady, placed=error is not None)
    if error is not None:
        found += _on_choice(plant, poles, K)
    if plant.independence < NEARLY_PARALLEL:
        found.append(_nearly_uncontrollable(plant.independence))
    if error is not None and error > ACCURATE * max(1.0, *map(abs, poles)):
        found.append(_inaccurate(error))
    return tuple(found)


_OWN_POLES = Finding(
    "own_poles",
    "info",
    "LQR computes its poles from Q and R. Your placed poles are ignored.",
)


def _on_stability(poles: Sequence[complex], *, stable: bool, steady: bool, placed: bool) -> Iterator[Finding]:
    if not stable and any(p.real > 0 for p in poles):
        yield Finding(
            "right_half_plane",
            "error",
            "A pole lies in the right half plane: without an outer loop the helicopter is unstable. "
            + ("Move it left of the imaginary axis." if placed else "Change the weights."),
        )
    elif not stable:
        yield Finding(
            "imaginary_axis",
            "warning",
            "A pole lies on the imaginary axis: its motion neither grows nor decays. Move it to the left.",
        )
    if not steady:
        yield Finding(
            "no_steady_state",
            "warning",
            "A pole lies at 0: the inner loop has no steady state, so Ĝ(0) and the RGA do not exist.",
        )


def _on_choice(
    plant: Plant, poles: Sequence[complex], K: Sequence[Sequence[float]] | Floats
) -> Iterator[Finding]:
    largest = max(map(abs, poles))
    near = COINCIDENT * max(largest, 1.0)
    repeated = [p for p, q in combinations(poles, 2) if abs(p - q) <= near]
    if repeated:
        yield Finding(
            "repeated_poles",
            "info",
            f"Two poles coincide at {conjugates(repeated[0])} rad/s. This works, but is sensitive: a model error ε "
            "moves a double pole by about √ε.",
        )
    at_open: list[complex] = []
    if min([abs(p - q) for p in poles for q in plant.own_poles]) <= near:  # hardly ever
        at_open = [
            p
            for p in poles
            if p != 0 and min(abs(p - q) for q in plant.own_poles) <= COINCIDENT * max(abs(p), 1.0)
        ]
    if at_open:
        yield Finding(
            "open_loop_pole",
            "info",
            f"The pole at {conjugates(at_open[0])} rad/s is a pole of the open loop: feedback leaves it where it is.",
        )
    if largest > FAR_OUT:
        volts = max(abs(gain) for row in K for gain in row[:2]) * pi / 180
        left_out = "Noise and dead time" if len(K[0]) > 4 else "Noise, dead time and motor lag"
        yield Finding(
            "far_out",
            "warning",
            f"A pole lies {largest:.3g} rad/s out: one degree of error asks for {volts:.3g} V. {left_out}, "
            "which the model leaves out, dominate there. Place slower poles.",
        )


def _nearly_uncontrollable(share: float) -> Finding:
    return Finding(
        "nearly_uncontrollable",
        "warning",
        f"Both motors act nearly alike: K_pp K_yy and K_py K_yp differ by only {100 * share:.2g} % of their sum. "
        "Expect high gains.",
    )


def _inaccurate(error: float) -> Finding:
    return Finding(
        "pole_error",
        "warning",
        f"The computed poles miss the requested ones by up to {error:.2g} rad/s: repeated or very fast poles are "
        "sensitive to rounding.",
    )


def flat_thrust(axes: Sequence[str], *, stable: bool) -> Finding:
    """The motors that do nothing on small changes, as their thrust curves have no slope at the trim."""
    both = len(axes) == 2
    motors = "Both motors'" if both else f"The {axes[0]} motor's"
    open_loop = "the linear loop is open there" + ("" if stable else ", and not stable")
    return Finding(
        "flat_thrust",
        "warning" if stable else "error",
        f"{motors} thrust does not change with the voltage at the trim, where {'they rest' if both else 'it rests'}: "
        f"{open_loop}. Choose an operating point at which {'both motors turn' if both else 'the motor turns'}, or "
        "a linear thrust curve.",
    )


def observer_instability(pole: complex) -> Finding:
    """The observer that the feedback acts on has this pole, rad/s, which does not decay."""
    return Finding(
        "observer_unstable",
        "error",
        f"The estimate's errors do not decay: a pole of the observer lies at {conjugates(pole, 3)} rad/s, and "
        "so does one of the whole loop. Move the observer's poles left of the imaginary axis.",
    )


def lag_instability(lag: float, limit: float) -> Finding:
    """What the rotors' lag has done, s, of which the design bears less than `limit`."""
    digits = 3 if f"{lag:.3g}" != f"{limit:.3g}" else 6
    return Finding(
        "rotors_unstable",
        "error",
        f"The rotors' lag of {lag:.{digits}g} s makes the helicopter unstable: with this design both may need less "
        f"than {limit:.{digits}g} s. Place slower poles or lower the gains, or place the rotors, too.",
    )


def loop_remarks(
    kp: Sequence[float], integral: Sequence[Sequence[float]], *, no_decoupler: bool
) -> Iterator[Finding]:
    """Which PI loops are open, and whether there is a static decoupler.

    Args:
        kp: of pitch's and yaw's loop, V/rad.
        integral: what each axis' integral drives, 2×2, V/(rad·s), rows are the axes of the errors.
        no_decoupler: whether one is asked for that does not exist, as there is no steady state.
    """
    for name, gain, driven in zip(AXES, kp, integral, strict=True):
        if gain == 0:
            words = (
                f"The {name} loop is open: its gain is 0. Its integrator drives nothing and does not count."
            )
            yield Finding(f"{name}_loop_open", "warning", words)
        elif not any(driven):
            words = f"The {name} loop does not integrate: its controller's integral reaches no motor."
            yield Finding(f"{name}_loop_open", "warning", words)
    if no_decoupler:
        yield Finding(
            "no_decoupler",
            "warning",
            "A placed pole lies at 0: without steady state there is no static decoupler, and the PI loops act "
            "without one. Move the pole.",
        )


def loop_instability(poles: Sequence[complex], closed: Sequence[str], *, aims: bool, placed: bool) -> Finding:
    """What the connected loops have done.

    Args:
        poles: of the whole loop, slowest first, rad/s.
        closed: the axes whose PI loops have done it; empty where the state feedback itself has.
        aims: whether the method aims at poles.
        placed: whether the placed poles are stable.
    """
    slowest, reach = poles[0], sqrt(ROUNDING) * max(map(abs, poles))
    crosses = slowest.real > reach
    where = f"lies at {conjugates(slowest, 3)} rad/s"
    if not crosses:
        height = "0" if abs(slowest) <= reach else f"±{abs(slowest.imag):.3g}j rad/s"
        where = f"lies on the imaginary axis, at {height}"
    if not closed:
        how = "unstable" if crosses else "not stable"
        if not aims:
            advice = "Change the weights."
        else:
            advice = "Place faster poles." if placed else "Place all poles in the left half plane."
        return Finding("loop_unstable", "error", f"The whole loop is {how}: a pole of it {where}. {advice}")
    if len(closed) == 2:
        loops, advice = (
            "The PI loops make",
            "Lower the gains, raise the integral times, or place faster poles.",
        )
    else:
        loops = f"The PI loop of {closed[0]} makes"
        advice = "Lower its gain, raise its integral time, or place faster poles."
    return Finding(
        "pi_unstable",
        "error",
        f"{loops} the helicopter unstable: a pole of the whole loop {where}, although the placed poles are stable. "
        + advice,
    )
