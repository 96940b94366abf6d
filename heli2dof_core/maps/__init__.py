"""The field of designs around one: what each place would give for a pair of poles, or for an axis' PI gains."""

from .design_map import MOST_PLACES, MOST_RIGS, DesignMap, design_map
from .planes import LARGEST_SIDE, Move, Plane, Scale

__all__ = ["LARGEST_SIDE", "MOST_PLACES", "MOST_RIGS", "DesignMap", "Move", "Plane", "Scale", "design_map"]
