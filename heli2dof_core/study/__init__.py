"""Studies: designs times uncertain rigs by the million, kept as they are computed, the same digits wherever."""

from .folder import Folder
from .part import Part, compute
from .problems import StudyError
from .processes import processes, usable_cores
from .reading import read_study, study_of
from .running import Alone, Pool, Progress, Workers, run
from .study import Study, Task
from .summary import Summary, summarize

__all__ = [
    "Alone",
    "Folder",
    "Part",
    "Pool",
    "Progress",
    "Study",
    "StudyError",
    "Summary",
    "Task",
    "Workers",
    "compute",
    "processes",
    "read_study",
    "run",
    "study_of",
    "summarize",
    "usable_cores",
]
