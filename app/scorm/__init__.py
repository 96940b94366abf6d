"""A lab as a SCORM 1.2 package: the page itself, in a learning management system, without a server."""

from .content import LeftOut, lab_content, steps_left_out
from .package import Package, scorm_package

__all__ = ["LeftOut", "Package", "lab_content", "scorm_package", "steps_left_out"]
