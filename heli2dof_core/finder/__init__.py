"""A search for designs that meet what is required, along the front of what is to be small.

>>> import heli2dof_core as heli
>>> ask = Find(free=("poles",), require=heli.requirements_of({"overshoot": {"max": 2}}), designs=500)
>>> find(heli.Spec.from_preset(), ask).met
True
"""

from .ask import FREE, Bounds, Find, Free
from .finding import Progress, find, find_in_parts
from .result import Candidate, Designs, Give, Judged, Why

__all__ = [
    "FREE",
    "Bounds",
    "Candidate",
    "Designs",
    "Find",
    "Free",
    "Give",
    "Judged",
    "Progress",
    "Why",
    "find",
    "find_in_parts",
]
