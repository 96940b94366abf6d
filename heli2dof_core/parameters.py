"""The rig's physical parameters: frozen, validated, with units."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated

from .components import Components
from .errors import InvalidInputError
from .quantities import Quantity, quantities_of, require_valid

_LARGEST = 1e6


@dataclass(frozen=True, kw_only=True)
class Parameters:
    """Physical parameters of a 2-DOF helicopter, SI units, symbols as in the paper's Table I.

    The paper writes J_eq,p, J_eq,y, m_heli and l_CM for J_p, J_y, m and l. K_s is 0 for the 2-DOF
    Helicopter and the pitch stiffness of the Aero rigs. m = l = 0 says that the inertias and K_s
    hold everything.

    Raises:
        InvalidInputError: a value is not a finite number or out of its range.
    """

    K_pp: Annotated[
        float, Quantity("thrust torque about pitch per volt of the pitch motor", "N·m/V", -_LARGEST, _LARGEST)
    ]
    K_py: Annotated[
        float, Quantity("thrust torque about pitch per volt of the yaw motor", "N·m/V", -_LARGEST, _LARGEST)
    ]
    K_yp: Annotated[
        float, Quantity("thrust torque about yaw per volt of the pitch motor", "N·m/V", -_LARGEST, _LARGEST)
    ]
    K_yy: Annotated[
        float, Quantity("thrust torque about yaw per volt of the yaw motor", "N·m/V", -_LARGEST, _LARGEST)
    ]
    J_p: Annotated[float, Quantity("moment of inertia about the pitch axis", "kg·m²", 1e-9, _LARGEST)]
    J_y: Annotated[float, Quantity("moment of inertia about the yaw axis", "kg·m²", 1e-9, _LARGEST)]
    m: Annotated[float, Quantity("moving mass", "kg", 0.0, _LARGEST)]
    l: Annotated[float, Quantity("distance of the centre of mass from the pivot", "m", 0.0, _LARGEST)]  # noqa: E741
    B_p: Annotated[float, Quantity("viscous damping about pitch", "N·m·s/rad", 0.0, _LARGEST)]
    B_y: Annotated[float, Quantity("viscous damping about yaw", "N·m·s/rad", 0.0, _LARGEST)]
    K_s: Annotated[float, Quantity("pitch stiffness", "N·m/rad", 0.0, _LARGEST)] = 0.0
    g: Annotated[float, Quantity("gravitational acceleration", "m/s²", 0.0, _LARGEST)] = 9.81

    def __post_init__(self) -> None:
        require_valid(self)

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
                    field=name,
                    value=changes[name],
                    hint="Known are " + ", ".join(PARAMETER_INFO) + ".",
                )
        return replace(self, **dict(changes)) if changes else self

    def as_dict(self) -> dict[str, float]:
        """Name → value in SI units."""
        return dict(vars(self))


PARAMETER_INFO: dict[str, Quantity] = {name: f.quantity for name, f in quantities_of(Parameters).items()}
"""Per parameter what it is: meaning, unit, range."""
