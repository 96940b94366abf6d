"""All placement methods by name, the paper's own first."""

from __future__ import annotations

from ..checks import by_name, require_known
from .ackermann import Ackermann
from .bass_gura import BassGura
from .full_rank import FullRank
from .knv0 import KNV0
from .lqr import LQR
from .lqr_integral import LQRIntegral
from .method import Method
from .tits_yang import TitsYang
from .varga import Varga

_ALL: tuple[Method, ...] = (
    FullRank(),
    TitsYang(),
    KNV0(),
    Varga(),
    Ackermann(),
    BassGura(),
    LQR(),
    LQRIntegral(),
)

METHODS = by_name(_ALL)
"""Placement methods by name."""


def method(name: str) -> Method:
    """The method of that name, or InvalidInputError with the names that exist."""
    return require_known(name, METHODS, "method")
