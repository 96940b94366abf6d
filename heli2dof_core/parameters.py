"""The rig's physical parameters: frozen, validated, with units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, fields, replace
from typing import Any

from .checks import require_within
from .components import Components
from .errors import InvalidInputError

_LARGEST = 1e6


def _parameter(meaning: str, unit: str, low: float, *, default: float | None = None) -> Any:
    metadata = {"meaning": meaning, "unit": unit, "low": low, "high": _LARGEST}
    return field(metadata=metadata) if default is None else field(default=default, metadata=metadata)


@dataclass(frozen=True, kw_only=True)
class Parameters:
    """Physical parameters of a 2-DOF helicopter, SI units, symbols as in the paper's Table I.

    The paper writes J_eq,p, J_eq,y, m_heli and l_CM for J_p, J_y, m and l. K_s is 0 for the 2-DOF
    Helicopter and the pitch stiffness of the Aero rigs. m = l = 0 says that the inertias and K_s
    hold everything.

    Raises:
        InvalidInputError: a value is not a finite number or out of its range.
    """

    K_pp: float = _parameter("thrust torque about pitch per volt of the pitch motor", "N·m/V", -_LARGEST)
    K_py: float = _parameter("thrust torque about pitch per volt of the yaw motor", "N·m/V", -_LARGEST)
    K_yp: float = _parameter("thrust torque about yaw per volt of the pitch motor", "N·m/V", -_LARGEST)
    K_yy: float = _parameter("thrust torque about yaw per volt of the yaw motor", "N·m/V", -_LARGEST)
    J_p: float = _parameter("moment of inertia about the pitch axis", "kg·m²", 1e-9)
    J_y: float = _parameter("moment of inertia about the yaw axis", "kg·m²", 1e-9)
    m: float = _parameter("moving mass", "kg", 0.0)
    l: float = _parameter("distance of the centre of mass from the pivot", "m", 0.0)  # noqa: E741
    B_p: float = _parameter("viscous damping about pitch", "N·m·s/rad", 0.0)
    B_y: float = _parameter("viscous damping about yaw", "N·m·s/rad", 0.0)
    K_s: float = _parameter("pitch stiffness", "N·m/rad", 0.0, default=0.0)
    g: float = _parameter("gravitational acceleration", "m/s²", 0.0, default=9.81)

    def __post_init__(self) -> None:
        for info in fields(self):
            value, about = getattr(self, info.name), info.metadata
            number = require_within(
                value, f"parameters.{info.name}", about["unit"], about["low"], about["high"]
            )
            object.__setattr__(self, info.name, number)

    @property
    def alpha(self) -> float:
        """α = J_p + m l², effective inertia about pitch, kg·m² (Eq. 15)."""
        return self.J_p + self.m * self.l**2

    @property
    def beta(self) -> float:
        """β = J_y + m l², effective inertia about yaw at θ = 0, kg·m² (Eq. 15)."""
        return self.J_y + self.m * self.l**2

    @property
    def gamma(self) -> float:
        """γ = K_py K_yp − K_pp K_yy, minus the determinant of the thrust matrix, (N·m/V)² (Eq. 15)."""
        return self.K_py * self.K_yp - self.K_pp * self.K_yy

    @property
    def independence(self) -> float:
        """|γ| as a share of the products that it is made of, 0 to 1: 0 where both motors push alike."""
        products = abs(self.K_pp * self.K_yy) + abs(self.K_py * self.K_yp)
        return abs(self.gamma) / products if products else 0.0

    @classmethod
    def from_components(cls, components: Components, **others: float) -> Parameters:
        """Thrust constants and l from the rig's parts (Eqs. 1, 8); `others` are the remaining values."""
        return cls(**components.thrust, l=components.centre_of_mass, **others)

    def replaced(self, changes: Mapping[str, float]) -> Parameters:
        """A copy with single values changed; unknown names raise InvalidInputError."""
        for name in changes:
            if name not in PARAMETER_INFO:
                raise InvalidInputError(
                    f"there is no parameter {name!r}",
                    field=f"parameters.{name}",
                    value=changes[name],
                    hint="Known are " + ", ".join(PARAMETER_INFO) + ".",
                )
        return replace(self, **dict(changes)) if changes else self

    def as_dict(self) -> dict[str, float]:
        """Name → value in SI units."""
        return dict(vars(self))


PARAMETER_INFO: dict[str, dict[str, Any]] = {f.name: dict(f.metadata) for f in fields(Parameters)}
"""Per parameter: meaning, unit, the lowest and the highest value allowed."""
