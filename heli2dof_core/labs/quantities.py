"""Quantities that questions ask for, evaluated on the student's own rig: figures, parameters, entries of matrices."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any

from ..evaluate import Report
from ..measured import MEASURED, Where, worse
from ..parameters import PARAMETER_INFO
from .bodies import PATHS
from .context import Context, Evaluated, Which
from .edges import largest_gain, largest_step

Read = Callable[[Evaluated, Sequence[int]], float | None]
NAME = re.compile(r"([A-Za-z][A-Za-z0-9_.]*)(?:\[([1-9])(?:\s*,\s*([1-9]))?\])?")


@dataclass(frozen=True)
class Quantity:
    """Something with a value on a rig.

    Attributes:
        name: in files, without its indices.
        meaning: in a few words.
        unit: SI.
        read: the value of a design; None where there is none.
        shape: the largest index of each kind; empty without any.
        shown: the unit in which it is asked for, unless a question says otherwise; its own where empty.
    """

    name: str
    meaning: str
    unit: str
    read: Read
    shape: tuple[int, ...] = ()
    shown: str = ""

    @property
    def form(self) -> str:
        """As it is written."""
        return self.name + ("[i]" if len(self.shape) == 1 else "[i,j]" if self.shape else "")


_ANYWHERE = Where()


@dataclass(frozen=True)
class Asked:
    """A quantity as a question asks for it.

    Attributes:
        quantity, indices: which.
        of: of which design.
        where: of which response, where it is a figure.
    """

    quantity: Quantity
    indices: tuple[int, ...] = ()
    of: Which = "own"
    where: Where = _ANYWHERE

    def value(self, context: Context) -> float | None:
        """On the student's rig, SI; None where it does not exist."""
        design = context.of(self.of)
        if design is None or design.failure is not None:
            return None
        measured = MEASURED.get(self.quantity.name)
        if measured is None:
            return self.quantity.read(design, self.indices)
        if not design.stable:
            return None
        values = measured.read(design.report, self.where)
        return worse(measured, values)


def _real_poles(report: Report) -> list[complex]:
    return sorted(map(complex, report.judged.connected), key=lambda p: (-p.real, abs(p.imag)))


def _matrix(read: Callable[[Evaluated], Any]) -> Read:
    def entry(design: Evaluated, indices: Sequence[int]) -> float | None:
        matrix = read(design)
        if matrix is None:
            return None
        i, j = indices
        return float(matrix[i - 1][j - 1]) if i <= len(matrix) and j <= len(matrix[0]) else None

    return entry


def _plain(read: Callable[[Evaluated], float | None]) -> Read:
    return lambda design, _: read(design)


def _trim(i: int) -> Read:
    return _plain(lambda design: design.report.judged.trim[i])


def _flat(path: str) -> Read:
    def read(design: Evaluated, _: Sequence[int]) -> float | None:
        value = design.flat.get(path)
        return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else None

    return read


def _pole(part: Callable[[complex], float]) -> Read:
    def read(design: Evaluated, indices: Sequence[int]) -> float | None:
        poles = _real_poles(design.report)
        return part(poles[indices[0] - 1]) if indices[0] <= len(poles) else None

    return read


def _damping(design: Evaluated) -> float | None:
    found = [-p.real / abs(p) for p in design.report.judged.connected if p]
    return min(found, default=None)


OF_DESIGNS = (
    Quantity(
        "K", "entry of the state feedback u = −Kx + v", "", _matrix(lambda d: d.report.placed.K), (2, 6)
    ),
    Quantity("A", "entry of the linear model's A", "", _matrix(lambda d: d.report.design.plant.A), (4, 4)),
    Quantity("B", "entry of the linear model's B", "", _matrix(lambda d: d.report.design.plant.B), (4, 2)),
    Quantity("L", "entry of the observer's gain", "", _matrix(lambda d: d.report.judged.L), (4, 2)),
    Quantity(
        "rga",
        "entry of the relative gain array at s = 0",
        "",
        _matrix(lambda d: d.report.interaction.rga),
        (2, 2),
    ),
    Quantity(
        "niederlinski",
        "Niederlinski index of the diagonal pairing",
        "",
        _plain(lambda d: d.report.interaction.niederlinski),
    ),
    Quantity(
        "niederlinski_cross",
        "Niederlinski index of the cross pairing",
        "",
        _plain(lambda d: d.report.interaction.niederlinski_cross),
    ),
    Quantity(
        "slowest_pole",
        "real part of the whole loop's rightmost pole",
        "rad/s",
        _plain(lambda d: _real_poles(d.report)[0].real),
    ),
    Quantity(
        "fastest_pole",
        "real part of the whole loop's leftmost pole",
        "rad/s",
        _plain(lambda d: _real_poles(d.report)[-1].real),
    ),
    Quantity(
        "loop_pole_re",
        "real part of the whole loop's i-th pole, from the right",
        "rad/s",
        _pole(lambda p: p.real),
        (9,),
    ),
    Quantity(
        "loop_pole_im", "size of that pole's imaginary part", "rad/s", _pole(lambda p: abs(p.imag)), (9,)
    ),
    Quantity(
        "order",
        "number of the whole loop's poles",
        "",
        _plain(lambda d: float(len(d.report.judged.connected))),
    ),
    Quantity("damping", "least damping ratio of the whole loop's poles", "", _plain(_damping)),
    Quantity("trim_V_p", "voltage of the pitch motor that holds the rig", "V", _trim(0)),
    Quantity("trim_V_y", "voltage of the yaw motor that holds the rig", "V", _trim(1)),
    Quantity(
        "alpha", "α = J_p + m l², inertia about pitch", "kg·m²", _plain(lambda d: d.spec.parameters.alpha)
    ),
    Quantity(
        "beta",
        "β = J_y + m l², inertia about yaw at θ = 0",
        "kg·m²",
        _plain(lambda d: d.spec.parameters.beta),
    ),
    Quantity(
        "largest_step_theta",
        "largest pitch step whose first voltage, trim + kp · step, is within the limit",
        "rad",
        _plain(lambda d: largest_step(d.spec, d.report.judged.trim[0], "pitch")),
        shown="°",
    ),
    Quantity(
        "largest_step_psi",
        "largest yaw step whose first voltage, trim + kp · step, is within the limit",
        "rad",
        _plain(lambda d: largest_step(d.spec, d.report.judged.trim[1], "yaw")),
        shown="°",
    ),
    Quantity(
        "largest_kp_pitch",
        "largest kp of the pitch loop up to which the whole loop is stable",
        "V/rad",
        _plain(lambda d: largest_gain(d.spec, "pitch")),
    ),
    Quantity(
        "largest_kp_yaw",
        "largest kp of the yaw loop up to which the whole loop is stable",
        "V/rad",
        _plain(lambda d: largest_gain(d.spec, "yaw")),
    ),
    Quantity("gamma", "γ = K_py K_yp − K_pp K_yy", "", _plain(lambda d: d.spec.parameters.gamma)),
)


def _registry() -> dict[str, Quantity]:
    found = {own.name: own for own in OF_DESIGNS}
    for name, measured in MEASURED.items():
        figure = measured.figure
        shown = {"seconds": "s", "decibel": "dB"}.get(figure.notation, figure.shown or figure.unit)
        found[name] = Quantity(name, figure.meaning, figure.unit, _plain(lambda _: None), (), shown)
    for name, info in PARAMETER_INFO.items():
        found[name] = Quantity(name, info.meaning, info.unit, _flat(f"parameters.{name}"))
    for path, (_, field) in PATHS.items():
        if path.startswith("parameters.") or field.choices or field.kind is bool:
            continue
        found.setdefault(path, Quantity(path, field.quantity.meaning, field.quantity.unit, _flat(path)))
    return found


QUANTITIES = MappingProxyType(_registry())
"""All that can be asked for, by name."""


def quantity_named(text: str) -> tuple[Quantity, tuple[int, ...]] | None:
    """A quantity and its indices as they are written, such as ``K[1,2]``; None where there is none."""
    match = NAME.fullmatch(text.strip())
    own = QUANTITIES.get(match[1]) if match else None
    if own is None or match is None:
        return None
    indices = tuple(int(i) for i in match.groups()[1:] if i)
    within = len(indices) == len(own.shape) and all(
        i <= most for i, most in zip(indices, own.shape, strict=True)
    )
    return (own, indices) if within else None
