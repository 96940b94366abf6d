"""Schur placement after Varga, by SLICOT's SB01BD."""

from __future__ import annotations

import warnings

import numpy as np

from ..controllability import scan
from ..errors import MethodUnavailableError, UncontrollableError
from ..poles import pole_error
from ..signals import Complexes, Floats
from ..tables import poles as pole_words
from .groups import conjugate_units
from .method import Method, Placement, Task

MISSED = 1e-3
"""Share of the largest pole by which a gain may miss the poles and still count as one that places them."""


class Varga(Method):
    """Moves the poles one or two at a time up the real Schur form of A."""

    name = "varga"
    title = "Varga's Schur method (SLICOT SB01BD)"
    short = "Varga’s Schur method"
    source = "A. Varga, IEEE Trans. Autom. Control 26 (1981) 517–519; slycot.sb01bd"
    needs = "slycot"

    def place(self, task: Task) -> Placement:
        """K from poles placed one after the other, without inverting a controllability matrix.

        Raises:
            MethodUnavailableError: slycot is not installed, SLICOT refuses the task, or its gain misses the poles.
            UnpairedPolesError: the poles are not closed under conjugation.
        """
        try:
            from slycot import sb01bd
            from slycot.exceptions import SlycotError, SlycotResultWarning
        except ImportError as error:
            raise MethodUnavailableError(
                "Varga's method needs the package slycot, which is not installed",
                field="method",
                value=self.name,
                hint="pip install 'heli2dof[slycot]'",
            ) from error
        n, p = task.B.shape
        fastest = float(np.max(np.abs(np.linalg.eigvals(task.A)), initial=1.0))
        # conjugates must be neighbours: others' are taken for the one's own, and placed in their stead
        wanted = task.poles[[i for unit in conjugate_units(task.poles) for i in unit]]
        try:
            with warnings.catch_warnings():  # of large gains, which the norm of K tells anyway
                warnings.simplefilter("ignore", SlycotResultWarning)
                schur, _, _, _, fixed, F, _ = sb01bd(n, p, n, -10.0 * fastest, task.A, task.B, wanted, "C")
        except SlycotError as error:
            raise MethodUnavailableError(
                f"SLICOT cannot place these poles: {str(error).strip()}", field="poles"
            ) from error
        K = -np.asarray(F, dtype=float)
        missed = pole_error(wanted, np.linalg.eigvals(task.A - task.B @ K).astype(np.complex128))
        if not missed <= MISSED * max(float(np.max(np.abs(wanted))), 1.0):
            unmoved = np.linalg.eigvals(schur[n - fixed :, n - fixed :]).astype(np.complex128)
            raise _refusal(task, K, missed, unmoved)
        return Placement(K)


def _refusal(task: Task, K: Floats, missed: float, unmoved: Complexes) -> MethodUnavailableError:
    """Why a gain that misses the poles does; `unmoved` are the eigenvalues that SLICOT took for uncontrollable."""
    try:
        scan(task.A, task.B)
    except UncontrollableError as error:
        return MethodUnavailableError(f"no gain places these poles: {error}", field="B", hint=error.hint)
    if len(unmoved):
        them, reach = ("it", "hardly reach it") if len(unmoved) == 1 else ("them", "hardly reach them")
        return MethodUnavailableError(
            f"SLICOT leaves {pole_words(unmoved.tolist())} where the plant has {them}: the inputs {reach}, and it "
            "takes what is below its tolerance for uncontrollable",
            field="B",
            hint="Take another method, and expect large gains.",
        )
    size = f"SLICOT's gain, of norm {np.linalg.norm(K):.1e}, misses these poles by {missed:.1e}"
    if np.all(task.poles.imag == 0):
        return MethodUnavailableError(
            f"{size}: the steps by which it places one after the other lose too many digits",
            field="poles",
            hint="Take another method.",
        )
    return MethodUnavailableError(
        f"{size}: it moves complex poles two at a time, and meets two of the plant's that the inputs hardly reach "
        "together",
        field="poles",
        hint="Take real poles, or another method.",
    )
