"""Pole placement for a two-degree-of-freedom laboratory helicopter: the mathematics.

    import heli2dof_core as heli

    spec = heli.Spec.from_preset(heli.preset())
    report = heli.evaluate(spec)
    report.design.K, report.loop.poles, report.interaction.rga

Knows no web, no 3D and no plot. SymPy is imported on the first derivation only.
"""

from .comparison import compare, compare_splits
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
from .evaluate import Report, Spec, evaluate, place, simulate
from .findings import Finding
from .interaction import Interaction, interaction, rga_over_frequency
from .loop import Loop, close_loop
from .parameters import Parameters
from .placement.assess import Assessment, place_poles
from .placement.full_rank import full_rank
from .placement.method import Weights
from .placement.registry import METHODS
from .plant import Plant, plant
from .poles import PoleSet, match_poles, pole_error
from .presets import PRESETS, Preset, preset
from .relative_gains import best_pairing, diagonal_dominance, niederlinski_index, relative_gain_array
from .robustness import Cloud, Uncertainty, cloud
from .simulation.response import Response
from .spec import Limits, OuterLoop, PIGains, Scenario
from .tuning import suggest_pi

__all__ = [
    "METHODS",
    "PRESETS",
    "Assessment",
    "Cloud",
    "Components",
    "Design",
    "Finding",
    "Heli2DofError",
    "Interaction",
    "InvalidInputError",
    "Limits",
    "Loop",
    "MethodUnavailableError",
    "OuterLoop",
    "PIGains",
    "Parameters",
    "Plant",
    "PoleSet",
    "Preset",
    "Report",
    "Response",
    "Scenario",
    "Spec",
    "Structure",
    "StructureUnavailableError",
    "Uncertainty",
    "UncontrollableError",
    "UnpairedPolesError",
    "Weights",
    "best_pairing",
    "close_loop",
    "cloud",
    "compare",
    "compare_splits",
    "design",
    "diagonal_dominance",
    "evaluate",
    "full_rank",
    "interaction",
    "match_poles",
    "niederlinski_index",
    "place",
    "place_poles",
    "plant",
    "pole_error",
    "preset",
    "relative_gain_array",
    "rga_over_frequency",
    "simulate",
    "suggest_pi",
    "warm_up",
]
