"""Robust placement after Tits and Yang, by SciPy."""

from __future__ import annotations

from .method import Method, Placement, Task
from .robust import place_with_scipy


class TitsYang(Method):
    """Maximizes |det| of the eigenvector matrix over pairs of eigenvectors; complex poles allowed."""

    name = "tits-yang"
    title = "Tits–Yang robust eigenvector assignment (SciPy)"
    short = "Tits–Yang"
    source = (
        "A. L. Tits and Y. Yang, IEEE Trans. Autom. Control 41 (1996) 1432–1452; scipy.signal.place_poles"
    )

    def place(self, task: Task) -> Placement:
        """K with well-conditioned closed-loop eigenvectors."""
        return Placement(place_with_scipy(task, "YT"))
