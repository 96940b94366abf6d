"""Linear systems as python-control's objects; `control` is imported on the first call only."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from .signals import Floats, Signal

if TYPE_CHECKING:
    import control


def state_space(
    name: str,
    matrices: tuple[Floats, Floats, Floats, Floats],
    states: Iterable[str | Signal],
    inputs: Iterable[str | Signal],
    outputs: Iterable[str | Signal],
) -> control.StateSpace:
    """A `control.StateSpace` whose signals have this project's names.

    Args:
        name: of the system.
        matrices: A (n×n), B (n×p), C (q×n), D (q×p).
        states: n signals, or their names.
        inputs: p of them.
        outputs: q of them.
    """
    import control

    A, B, C, D = matrices
    return control.StateSpace(
        *(A, B, C, D),
        name=name,
        states=list(map(_name, states)),
        inputs=list(map(_name, inputs)),
        outputs=list(map(_name, outputs)),
    )


def _name(signal: str | Signal) -> str:
    return signal if isinstance(signal, str) else signal.name
