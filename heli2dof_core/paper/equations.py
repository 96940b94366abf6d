"""The derivation's steps: every equation and figure of the paper, and the steps that it leaves out."""

from __future__ import annotations

from dataclasses import replace

from .control_equations import FEEDBACK, INTERACTION, LOOPS
from .equation import Chapter, Equation
from .model_equations import LINEAR, MACHINE, MECHANICS

_CHAPTERS: dict[Chapter, tuple[Equation, ...]] = {
    "machine": MACHINE,
    "mechanics": MECHANICS,
    "linear": LINEAR,
    "feedback": FEEDBACK,
    "interaction": INTERACTION,
    "loops": LOOPS,
}
EQUATIONS = tuple(replace(step, chapter=name) for name, steps in _CHAPTERS.items() for step in steps)
"""In the order in which one follows from the other, which is nearly the paper's."""
