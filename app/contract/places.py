"""Where the quantities stand that are no part of a design, as `heli2dof_core.request` says of those that are."""

from __future__ import annotations

from heli2dof_core.recordings.recording import Columns
from heli2dof_core.request import Place
from heli2dof_core.robustness import Uncertainty

COLUMNS = Place("columns", "columns", Columns)
UNCERTAINTY = Place("", "", Uncertainty)
