"""Tracks: any one number swept, the loop's poles and figures along it, and where poles cross to the other side."""

from .numbers import Number, known_paths, number_at, swept_paths
from .track import FEWEST, MOST, MOST_MEASURES, Crossing, Scale, Track, figure_of, track, words

__all__ = [
    "FEWEST",
    "MOST",
    "MOST_MEASURES",
    "Crossing",
    "Number",
    "Scale",
    "Track",
    "figure_of",
    "known_paths",
    "number_at",
    "swept_paths",
    "track",
    "words",
]
