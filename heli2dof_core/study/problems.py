"""What can be wrong with a study beside its numbers."""

from __future__ import annotations

from ..errors import Heli2DofError


class StudyError(Heli2DofError):
    """A study's file or folder is unusable, or its workers are lost."""

    code = "unusable_study"
