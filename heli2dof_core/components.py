"""The parts that a 2-DOF helicopter is built of, and the constants that follow from them (Eqs. 1, 8)."""

from __future__ import annotations

from dataclasses import asdict, dataclass, field, fields
from typing import Any

from .checks import require_within


def _part(meaning: str, unit: str, printed: str) -> Any:
    return field(metadata={"meaning": meaning, "unit": unit, "printed": printed})


@dataclass(frozen=True, kw_only=True)
class Components:
    """Motors, propellers and shields, SI units; the paper's symbols in brackets.

    Raises:
        InvalidInputError: a value is not a positive finite number.
    """

    R_p: float = _part("armature resistance of the pitch motor", "Ω", "R_m,p")
    R_y: float = _part("armature resistance of the yaw motor", "Ω", "R_m,y")
    K_tp: float = _part("torque constant of the pitch motor", "N·m/A", "K_t,p")
    K_ty: float = _part("torque constant of the yaw motor", "N·m/A", "K_t,y")
    K_fp: float = _part("thrust per volt of the pitch propeller", "N/V", "K_f,p")
    K_fy: float = _part("thrust per volt of the yaw propeller", "N/V", "K_f,y")
    r_p: float = _part("distance of the pitch propeller from the pivot", "m", "r_p")
    r_y: float = _part("distance of the yaw propeller from the pivot", "m", "r_y")
    m_p: float = _part("mass of the pitch motor", "kg", "m_m,p")
    m_y: float = _part("mass of the yaw motor", "kg", "m_m,y")
    m_shield: float = _part("mass of one propeller's shield", "kg", "m_shield")

    def __post_init__(self) -> None:
        for f in fields(self):
            require_within(getattr(self, f.name), f"components.{f.name}", f.metadata["unit"], 1e-9, 1e6)

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


COMPONENT_INFO: dict[str, dict[str, Any]] = {f.name: dict(f.metadata) for f in fields(Components)}
"""Per component: meaning, unit and the paper's symbol."""
