"""Designs to take away: one file per format, one registry.

    from heli2dof_core.export import FORMATS
    FORMATS["csv"].render(spec)  # str, or bytes where the format is binary

Every file says which rig, poles and version it is of, and the call that makes it again.
"""

from __future__ import annotations

from types import MappingProxyType

from . import responses_csv
from .format import Format

_ALL = (responses_csv.FORMAT,)

FORMATS = MappingProxyType({each.name: each for each in _ALL})
"""Formats by name."""

__all__ = ["FORMATS", "Format"]
