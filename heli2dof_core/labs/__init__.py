"""Labs: text files with steps, goals and questions, each student's own rig, and marks by the core's own numbers.

>>> from heli2dof_core.labs import mark, read_lab, shipped_labs, student_rig, start_body
"""

from .lab import Hint, Lab, Step
from .library import labs_in, read_file, shipped_labs, shipped_text
from .locks import LOCKS
from .marking import Marked, Told, mark, right_answers
from .problems import LabError, LabProblem
from .reading import problems_of, read_lab
from .recordings import recording_csv
from .rigs import start_body, student_rig, true_rig
from .views import hint_view, instructor_view, student_view

__all__ = [
    "LOCKS",
    "Hint",
    "Lab",
    "LabError",
    "LabProblem",
    "Marked",
    "Step",
    "Told",
    "hint_view",
    "instructor_view",
    "labs_in",
    "mark",
    "problems_of",
    "read_file",
    "read_lab",
    "recording_csv",
    "right_answers",
    "shipped_labs",
    "shipped_text",
    "start_body",
    "student_rig",
    "student_view",
    "true_rig",
]
