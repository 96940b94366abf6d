"""Many designs at once: the same figures as those of `evaluate`, by one call of a kernel for all.

What is asked for decides what is computed: a map of settling times takes no margins, and one of margins no response.
"""

from .designs import MOST_STEPS, Found, Many, evaluate_many
from .measure import ANYWHERE, SHARE_FIGURES, SHARES, Measure

__all__ = [
    "ANYWHERE",
    "MOST_STEPS",
    "SHARES",
    "SHARE_FIGURES",
    "Found",
    "Many",
    "Measure",
    "evaluate_many",
]
