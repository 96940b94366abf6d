"""Tracks: any one number swept, the loop's poles and figures along it, and where poles cross to the other side."""

from .numbers import Number, known_paths, number_at, swept_paths
from .track import FEWEST, MOST, MOST_MEASURES, Crossing, Scale, Track, track

__all__ = [
    "FEWEST",
    "MOST",
    "MOST_MEASURES",
    "Crossing",
    "Number",
    "Scale",
    "Track",
    "known_paths",
    "number_at",
    "swept_paths",
    "track",
]
