"""Pole placement for a two-degree-of-freedom laboratory helicopter: the mathematics.

    import heli2dof_core as heli

    spec = heli.Spec.from_preset(heli.preset())
    report = heli.evaluate(spec)
    report.design.K, report.loop.poles, report.interaction.rga

Knows no web, no 3D and no plot. SymPy is imported on the first derivation only.
"""

from .couplings import Structure
from .design import Design, design
from .errors import (
    Heli2DofError,
    InvalidInputError,
    StructureUnavailableError,
    UncontrollableError,
    UnpairedPolesError,
)
from .evaluate import Report, Spec, evaluate, place, simulate
from .findings import Finding
from .interaction import Interaction, interaction, rga_over_frequency
from .loop import Loop, close_loop
from .parameters import Parameters
from .plant import Plant, plant
from .poles import PoleSet, match_poles, pole_error
from .presets import PRESETS, Preset, preset
from .simulation.response import Response
from .spec import Limits, OuterLoop, PIGains, Scenario
from .tuning import suggest_pi

__all__ = [
    "PRESETS",
    "Design",
    "Finding",
    "Heli2DofError",
    "Interaction",
    "InvalidInputError",
    "Limits",
    "Loop",
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
    "UncontrollableError",
    "UnpairedPolesError",
    "close_loop",
    "design",
    "evaluate",
    "interaction",
    "match_poles",
    "place",
    "plant",
    "pole_error",
    "preset",
    "rga_over_frequency",
    "simulate",
    "suggest_pi",
]
