"""The derivation's steps: every equation and figure of the paper, and the steps that it leaves out."""

from __future__ import annotations

from .control_equations import FEEDBACK, INTERACTION, LOOPS
from .model_equations import LINEAR, MACHINE, MECHANICS

EQUATIONS = (*MACHINE, *MECHANICS, *LINEAR, *FEEDBACK, *INTERACTION, *LOOPS)
"""In the order in which one follows from the other, which is nearly the paper's."""
