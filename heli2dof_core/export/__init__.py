"""Designs to take away: one file per format, one registry.

    from heli2dof_core.export import FORMATS
    FORMATS["csv"].render(spec)  # str, or bytes where the format is binary

Every file says which rig, poles and version it is of, and the call that makes it again.
"""

from __future__ import annotations

from ..checks import by_name
from . import c_controller, matlab_data, matlab_script, python_script, report, responses_csv
from .format import Beside, Format

_ALL = (
    python_script.FORMAT,
    matlab_script.FORMAT,
    matlab_data.FORMAT,
    c_controller.HEADER,
    c_controller.SOURCE,
    responses_csv.FORMAT,
    report.FORMAT,
)

FORMATS = by_name(_ALL)
"""Formats by name."""

__all__ = ["FORMATS", "Beside", "Format"]
