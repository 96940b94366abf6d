"""The parts that a 2-DOF helicopter is built of, and the constants that follow from them (Eqs. 1, 8)."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Annotated

from .quantities import Quantity, quantities_of, require_valid


@dataclass(frozen=True, kw_only=True)
class Components:
    """Motors, propellers and shields, SI units; the paper's symbols in brackets.

    Raises:
        InvalidInputError: a value is not a positive finite number.
    """

    R_p: Annotated[float, Quantity("armature resistance of the pitch motor", "Ω", 1e-9, 1e6, symbol="R_m,p")]
    R_y: Annotated[float, Quantity("armature resistance of the yaw motor", "Ω", 1e-9, 1e6, symbol="R_m,y")]
    K_tp: Annotated[float, Quantity("torque constant of the pitch motor", "N·m/A", 1e-9, 1e6, symbol="K_t,p")]
    K_ty: Annotated[float, Quantity("torque constant of the yaw motor", "N·m/A", 1e-9, 1e6, symbol="K_t,y")]
    K_fp: Annotated[
        float, Quantity("thrust per volt of the pitch propeller", "N/V", 1e-9, 1e6, symbol="K_f,p")
    ]
    K_fy: Annotated[float, Quantity("thrust per volt of the yaw propeller", "N/V", 1e-9, 1e6, symbol="K_f,y")]
    r_p: Annotated[
        float, Quantity("distance of the pitch propeller from the pivot", "m", 1e-9, 1e6, symbol="r_p")
    ]
    r_y: Annotated[
        float, Quantity("distance of the yaw propeller from the pivot", "m", 1e-9, 1e6, symbol="r_y")
    ]
    m_p: Annotated[float, Quantity("mass of the pitch motor", "kg", 1e-9, 1e6, symbol="m_m,p")]
    m_y: Annotated[float, Quantity("mass of the yaw motor", "kg", 1e-9, 1e6, symbol="m_m,y")]
    m_shield: Annotated[float, Quantity("mass of one propeller's shield", "kg", 1e-9, 1e6, symbol="m_shield")]

    def __post_init__(self) -> None:
        require_valid(self)

    @property
    def thrust(self) -> dict[str, float]:
        """K_pp = K_f,p r_p, K_yy = K_f,y r_y, K_py = K_t,y/R_m,y, K_yp = K_t,p/R_m,p, N·m/V (Eq. 8)."""
        return {
            "K_pp": self.K_fp * self.r_p,
            "K_py": self.K_ty / self.R_y,
            "K_yp": self.K_tp / self.R_p,
            "K_yy": self.K_fy * self.r_y,
        }

    @property
    def centre_of_mass(self) -> float:
        """l, the weighted mean of both arms, m (Eq. 1).

        Caution: the arms lie on opposite sides of the pivot, so their difference would be the centre
        of mass; the paper and Quanser's own files add them.
        """
        front, back = self.m_p + self.m_shield, self.m_y + self.m_shield
        return (front * self.r_p + back * self.r_y) / (front + back)

    def as_dict(self) -> dict[str, float]:
        """Name → value in SI units."""
        return asdict(self)


COMPONENT_INFO: dict[str, Quantity] = {name: f.quantity for name, f in quantities_of(Components).items()}
"""Per component what it is: meaning, unit, range, the paper's symbol."""
