"""Pole placement for a two-degree-of-freedom laboratory helicopter: the mathematics.

>>> import heli2dof_core as heli
>>> spec = heli.Spec.from_preset("quanser-2dof-manual", poles=[-12, -10, -3 + 4j, -3 - 4j])
>>> report = heli.evaluate(spec)
>>> report.design
<Design: full-rank, triangular; poles −12, −10, −3 ± 4j rad/s; ‖K‖ = 60.57>
>>> report.step["nonlinear"].response.theta.shape
(501,)

`read_recording(path)` reads what a rig did; `driven_in_segments` lays the model over it and `identify` finds
the rig's parameters. `Rig(spec)` is the rig in hand: it flies in steps, is pushed, and takes another design in the
air. `design_map(spec, "yaw-pair", "overshoot")` tells what each place of a pair would give. `formulas()` gives the
derivation as SymPy objects, `to_control()` of a plant, a design or a loop a
`control.StateSpace`. Results are frozen; a notebook shows them as small tables.

Knows no web, no 3D and no plot. SymPy and python-control are imported when they are first needed.
"""

from typing import TYPE_CHECKING, Any

from .body import body_of
from .comparison import Comparison, compare, compare_splits
from .components import Components
from .couplings import Structure
from .design import Design, design
from .engine import warm_up
from .errors import (
    Heli2DofError,
    InvalidInputError,
    MethodUnavailableError,
    StructureUnavailableError,
    UncontrollableError,
    UnpairedPolesError,
)
from .estimators import Estimator, Observer
from .evaluate import Report, Step, evaluate, loop_of, place, simulate
from .findings import Finding
from .formulas import formulas, observer_formulas, rotor_formulas
from .interaction import Interaction, interaction, rga_over_frequency
from .loop import Loop, close_loop
from .metrics import StepMetrics
from .nearest import Move, Nearest, nearest
from .parameters import Parameters
from .placement.assess import Assessment, place_poles
from .placement.full_rank import full_rank
from .placement.method import Weights
from .placement.registry import METHODS
from .plant import Plant, plant
from .poles import PoleSet, match_poles, pole_error
from .presets import PRESETS, Preset, preset
from .relative_gains import best_pairing, diagonal_dominance, niederlinski_index, relative_gain_array
from .request import spec_of
from .requirements import Requirement, requirements_of
from .robustness import Cloud, Uncertainty, cloud
from .rotors import Actuators, AxisFriction, Friction, Rotor, Rotors
from .scenario import Digital, Disturbance, Limits, OuterLoop, PIGains, Scenario
from .simulation.response import Response
from .spec import Spec
from .tuning import Suggestion, suggest_pi

if TYPE_CHECKING:
    from . import paper as paper
    from . import symbolic as symbolic
    from .finder import Bounds, Designs, Find, find
    from .flight import FlightCourse, FlightLog, Rig, fly_script, read_script, simulate_flight
    from .many import Measure
    from .maps import DesignMap, design_map
    from .placement.symbols import SymbolicPlacement, symbolic_place
    from .recordings.files.opened import read_recording
    from .recordings.identification import Identification, identify
    from .recordings.overlay import Overlay, driven_by_references, driven_by_voltages, driven_in_segments
    from .recordings.recording import Columns, Recording
    from .tracks import Track, track

__all__ = [
    "METHODS",
    "PRESETS",
    "Actuators",
    "Assessment",
    "AxisFriction",
    "Bounds",
    "Cloud",
    "Columns",
    "Comparison",
    "Components",
    "Design",
    "DesignMap",
    "Designs",
    "Digital",
    "Disturbance",
    "Estimator",
    "Find",
    "Finding",
    "FlightCourse",
    "FlightLog",
    "Friction",
    "Heli2DofError",
    "Identification",
    "Interaction",
    "InvalidInputError",
    "Limits",
    "Loop",
    "Measure",
    "MethodUnavailableError",
    "Move",
    "Nearest",
    "Observer",
    "OuterLoop",
    "Overlay",
    "PIGains",
    "Parameters",
    "Plant",
    "PoleSet",
    "Preset",
    "Recording",
    "Report",
    "Requirement",
    "Response",
    "Rig",
    "Rotor",
    "Rotors",
    "Scenario",
    "Spec",
    "Step",
    "StepMetrics",
    "Structure",
    "StructureUnavailableError",
    "Suggestion",
    "SymbolicPlacement",
    "Track",
    "Uncertainty",
    "UncontrollableError",
    "UnpairedPolesError",
    "Weights",
    "best_pairing",
    "body_of",
    "close_loop",
    "cloud",
    "compare",
    "compare_splits",
    "design",
    "design_map",
    "diagonal_dominance",
    "driven_by_references",
    "driven_by_voltages",
    "driven_in_segments",
    "evaluate",
    "find",
    "fly_script",
    "formulas",
    "full_rank",
    "identify",
    "interaction",
    "loop_of",
    "match_poles",
    "nearest",
    "niederlinski_index",
    "observer_formulas",
    "place",
    "place_poles",
    "plant",
    "pole_error",
    "preset",
    "read_recording",
    "read_script",
    "relative_gain_array",
    "requirements_of",
    "rga_over_frequency",
    "rotor_formulas",
    "simulate",
    "simulate_flight",
    "spec_of",
    "suggest_pi",
    "symbolic_place",
    "track",
    "warm_up",
]


_LATE = {
    **dict.fromkeys(("DesignMap", "design_map"), ".maps"),
    "Measure": ".many",
    **dict.fromkeys(("Identification", "identify"), ".recordings.identification"),
    **dict.fromkeys(
        ("Overlay", "driven_by_references", "driven_by_voltages", "driven_in_segments"), ".recordings.overlay"
    ),
    **dict.fromkeys(("Columns", "Recording"), ".recordings.recording"),
    "read_recording": ".recordings.files.opened",
    **dict.fromkeys(("Bounds", "Designs", "Find", "find"), ".finder"),
    **dict.fromkeys(
        ("FlightCourse", "FlightLog", "Rig", "fly_script", "read_script", "simulate_flight"), ".flight"
    ),
    **dict.fromkeys(("Track", "track"), ".tracks"),
    **dict.fromkeys(("SymbolicPlacement", "symbolic_place"), ".placement.symbols"),
}
"""Modules of what is not imported before it is asked for."""


def __dir__() -> list[str]:
    """What completion offers: what comes late among it."""
    return sorted({*globals(), *__all__})


def __getattr__(name: str) -> Any:
    """What is imported when it is asked for: recordings; `symbolic` and `paper`, with which SymPy comes."""
    from importlib import import_module

    if name in _LATE:
        return getattr(import_module(_LATE[name], __name__), name)
    if name in ("paper", "symbolic"):
        return import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
