"""Twenty searches that have an answer, and five that have none: what the finder is measured by.

They were written down before any optimizer was tried on them; limits are such that among random designs between none
and one in three meets them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import radians
from typing import Any

from heli2dof_core import Observer, Spec, Uncertainty
from heli2dof_core.finder.ask import Bounds, Find
from heli2dof_core.requirements import measure_of, requirements_of


@dataclass(frozen=True)
class Case:
    """A search.

    Attributes:
        name: what it is about.
        spec: the design that is there, made when it is asked for.
        find: what is asked of it.
        contradict: of one that has no answer the figures of each smallest set of requirements that contradict.
    """

    name: str
    spec: Callable[[], Spec]
    find: Find
    contradict: tuple[frozenset[str], ...] = field(default=())


def _find(free: str, require: dict[str, Any], minimize: tuple[Any, ...], **more: Any) -> Find:
    needs, goals = requirements_of(require), tuple(measure_of(own) for own in minimize)
    return Find(tuple(free.split()), needs, goals, **more)  # pyright: ignore[reportArgumentType]


def helicopter(**changes: Any) -> Callable[[], Spec]:
    """The Quanser 2-DOF Helicopter, 10° and 20° in 3 s."""
    return lambda: Spec.from_preset("quanser-2dof-manual", **changes)


def aero_2(**changes: Any) -> Callable[[], Spec]:
    """The Aero 2, whose rotors lag by 0.165 s: 10° and 15° in 10 s."""
    return lambda: Spec.from_preset("quanser-aero-2", **changes)


def aero(**changes: Any) -> Callable[[], Spec]:
    """The first Aero, whose motors drive both axes nearly alike: 10° and 15° in 15 s."""
    return lambda: Spec.from_preset("quanser-aero", **changes)


LINEAR = {"model": "linear"}
SETTLING, VOLTAGE = "settling_time", "V_peak"
FAR = (radians(30), radians(60))
TENTH = Uncertainty({"K_pp": 0.1, "K_yy": 0.1, "m": 0.1, "J_p": 0.1, "J_y": 0.1}, samples=16)
FIFTH = Uncertainty({"K_pp": 0.2, "K_py": 0.2, "K_yp": 0.2, "K_yy": 0.2, "B_p": 0.2, "B_y": 0.2}, samples=40)

SOLVABLE = (
    Case(
        "easy",
        helicopter(),
        _find("poles loops", {SETTLING: {"max": 1.5}, "overshoot": {"max": 10}}, (SETTLING, VOLTAGE)),
    ),
    Case(
        "easy, linear",
        helicopter(),
        _find(
            "poles loops",
            {SETTLING: {"max": 1.5, **LINEAR}, "disk_margin": {"min": 0.5}},
            ({"measure": SETTLING, "axis": "both", **LINEAR}, "norm"),
        ),
    ),
    Case(
        "one figure",
        helicopter(),
        _find("poles loops", {"overshoot": {"max": 5}, VOLTAGE: {"max": 20}}, (SETTLING,)),
    ),
    Case("poles alone", helicopter(), _find("poles", {"overshoot": {"max": 10}}, (SETTLING, "disk_margin"))),
    Case("loops alone", helicopter(), _find("loops", {"overshoot": {"max": 10}}, (SETTLING, VOLTAGE))),
    Case(
        "narrow",
        helicopter(),
        _find(
            "poles loops",
            {
                SETTLING: {"max": 0.9},
                "overshoot": {"max": 2},
                VOLTAGE: {"max": 19},
                "disk_margin": {"min": 0.9},
            },
            (SETTLING, "coupling_peak"),
        ),
    ),
    Case(
        "narrow, each axis its own",
        helicopter(),
        _find(
            "poles loops",
            {
                SETTLING: [{"max": 1.0, "axis": "theta"}, {"max": 0.6, "axis": "psi"}],
                "overshoot": [{"max": 1, "axis": "theta"}, {"max": 3, "axis": "psi"}],
                "gain_margin": {"min": 2.0},
                "phase_margin": {"min": radians(50)},
            },
            ("effort", "coupling_peak"),
        ),
    ),
    Case(
        "far steps that saturate",
        helicopter(reference=FAR, duration=4.0),
        _find("poles loops", {SETTLING: {"max": 3}, "overshoot": {"max": 20}}, (SETTLING, "saturated")),
    ),
    Case(
        "far steps that must not saturate",
        helicopter(reference=FAR, duration=4.0),
        _find("poles loops", {"saturated": {"max": 0.0}, SETTLING: {"max": 3.5}}, (SETTLING, "overshoot")),
    ),
    Case(
        "coupling",
        helicopter(),
        _find(
            "poles loops structure",
            {"coupling_peak": {"max": radians(0.5)}, "overshoot": {"max": 10}},
            ("coupling_peak", SETTLING),
        ),
    ),
    Case(
        "structure and shift without loops",
        helicopter(outer="none"),
        _find(
            "poles structure shift",
            {"overshoot": {"max": 5, **LINEAR}, SETTLING: {"max": 2, **LINEAR}},
            ({"measure": "coupling_peak", "axis": "both", **LINEAR}, "norm"),
        ),
    ),
    Case(
        "pairing and decoupler",
        aero_2(),
        _find(
            "poles loops pairing decoupler",
            {"overshoot": {"max": 25}, "disk_margin": {"min": 0.3}},
            ("coupling_peak", SETTLING),
        ),
    ),
    Case(
        "pitch alone, by its error",
        helicopter(reference=(radians(20), None)),
        _find(
            "poles loops",
            {"overshoot": {"max": 3, "axis": "theta"}, VOLTAGE: {"max": 22}},
            ({"measure": "itae", "axis": "theta"}, {"measure": "effort", "axis": "theta"}),
        ),
    ),
    Case(
        "uncertain, stable",
        helicopter(),
        _find(
            "poles loops",
            {"share_stable": {"min": 1.0}, "overshoot": {"max": 15}, "lag_margin": {"min": 0.05}},
            (SETTLING, VOLTAGE),
            uncertainty=FIFTH,
        ),
    ),
    Case(
        "uncertain, settled",
        helicopter(),
        _find(
            "poles loops",
            {SETTLING: {"max": 1.5, "share": 0.9}, "overshoot": {"max": 10, "share": 0.9}},
            (SETTLING, VOLTAGE),
            uncertainty=TENTH,
        ),
    ),
    Case(
        "Aero 2 with lag",
        aero_2(),
        _find(
            "poles loops",
            {SETTLING: {"max": 8}, "overshoot": {"max": 20}, "disk_margin": {"min": 0.3}},
            (SETTLING, VOLTAGE),
        ),
    ),
    Case(
        "Aero 2 with rotors placed",
        aero_2(place_rotors=True, poles=[-1.5 + 0.5j, -1.5 - 0.5j, -1.2, -2.1], rotor_poles=(-6.0, -6.5)),
        _find(
            "poles rotor_poles loops",
            {SETTLING: {"max": 6}, "overshoot": {"max": 20}, "disk_margin": {"min": 0.4}},
            (SETTLING, VOLTAGE),
        ),
    ),
    Case(
        "Aero with lag",
        aero(),
        _find(
            "poles loops",
            {SETTLING: {"max": 12, **LINEAR}, "overshoot": {"max": 30, **LINEAR}},
            ({"measure": SETTLING, "axis": "both", **LINEAR}, "lag_margin"),
        ),
    ),
    Case(
        "observer",
        helicopter(measured="observer", observer=Observer()),
        _find(
            "poles loops observer",
            {"overshoot": {"max": 15}, VOLTAGE: {"max": 22}},
            (SETTLING, "disk_margin"),
        ),
    ),
    Case(
        "weights",
        helicopter(method="lqr"),
        _find(
            "weights loops",
            {"overshoot": {"max": 10}},
            (SETTLING, VOLTAGE),
            bounds=Bounds(kp=(1.0, 100.0), ti=(0.03, 3.0)),
        ),
    ),
)

UNSOLVABLE = (
    Case(
        "quicker than its rise",
        helicopter(),
        _find(
            "poles loops",
            {
                SETTLING: {"max": 0.5, "axis": "theta"},
                "rise_time": {"min": 0.8, "axis": "theta"},
                "overshoot": {"max": 20},
                "disk_margin": {"min": 0.3},
            },
            (VOLTAGE,),
        ),
        (frozenset((SETTLING, "rise_time")),),
    ),
    Case(
        "less than holds it still",
        helicopter(),
        _find(
            "poles loops",
            {VOLTAGE: {"max": 9.0}, SETTLING: {"max": 2.0}, "disk_margin": {"min": 0.3}},
            (SETTLING,),
        ),
        (frozenset((VOLTAGE,)),),
    ),
    Case(
        "quick with few volts",
        helicopter(reference=(radians(25), radians(45))),
        _find(
            "poles loops",
            {
                "rise_time": {"max": 0.28},
                VOLTAGE: {"max": 15.0},
                "disk_margin": {"min": 0.3},
                "norm": {"max": 500},
            },
            (),
        ),
        (frozenset(("rise_time", VOLTAGE)),),
    ),
    Case(
        "more margin than there is",
        aero_2(),
        _find(
            "poles loops",
            {"disk_margin": {"min": 2.5}, "overshoot": {"max": 30}, VOLTAGE: {"max": 18}},
            (SETTLING,),
        ),
        (frozenset(("disk_margin",)),),
    ),
    Case(
        "a peak without overshoot",
        helicopter(),
        _find(
            "poles loops",
            {
                "peak": {"min": radians(12), "axis": "theta"},
                "overshoot": {"max": 10, "axis": "theta"},
                SETTLING: {"max": 2.0},
                "lag_margin": {"min": 0.01},
            },
            (VOLTAGE,),
        ),
        (frozenset(("peak", "overshoot")),),
    ),
)


def quick(case: Case, designs: int) -> Case:
    """The same with fewer designs."""
    return replace(case, find=replace(case.find, designs=designs))
