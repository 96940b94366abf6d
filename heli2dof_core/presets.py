"""The rigs that ship, each with its source, poles, PI values and scenario."""

from __future__ import annotations

from dataclasses import dataclass
from math import radians
from typing import Literal

from .checks import by_name, require_known, require_one_of
from .components import Components
from .couplings import Structure
from .parameters import PARAMETER_INFO, Parameters
from .poles import PoleSet
from .rotors import AxisFriction, Rotor, Rotors
from .scenario import Limits, OuterLoop, PIGains, Scenario
from .tables import Shown, Table, number

RigName = Literal["helicopter", "aero"]


@dataclass(frozen=True, repr=False)
class Preset(Shown):
    """One rig, ready to be used; its scenario keeps its motors within their limits.

    Attributes:
        name, title: for programs and for people.
        source: where the numbers come from.
        rig: which machine the scene shows.
        encoders: counts per revolution of pitch and yaw.
        components: the parts that the parameters are computed from, where the source gives them.
        rotors, friction: as its source or recordings tell of them; where none does, the paper's.
        place_rotors, rotor_poles: whether the rotors are placed, too, and where, rad/s.
    """

    name: str
    title: str
    source: str
    rig: RigName
    parameters: Parameters
    limits: Limits
    poles: PoleSet
    outer: OuterLoop
    scenario: Scenario
    structure: Structure = Structure()
    theta_0: float = 0.0
    components: Components | None = None
    encoders: tuple[int, int] = (4096, 8192)
    rotors: Rotors = Rotors()
    friction: AxisFriction = AxisFriction()
    place_rotors: bool = False
    rotor_poles: tuple[float, float] = (-15.0, -16.0)

    def __post_init__(self) -> None:
        require_one_of(self.rig, RigName, "rig")

    def summary(self) -> str:
        """Name and title."""
        return f"{self.name}; {self.title}"

    def tables(self) -> tuple[Table, ...]:
        """Its parameters."""
        values = self.parameters.as_dict()
        rows = ((n, number(values[n], 6), i.unit, i.meaning) for n, i in PARAMETER_INFO.items())
        return (Table.of(self.source, ("parameter", "value", "unit", "meaning"), rows),)


_TRAVEL = radians(40.5)
_HELICOPTER_LIMITS = Limits(V_p=24.0, V_y=15.0, theta=_TRAVEL)
_PAPER_POLES = PoleSet([-12.0, -10.0, -9.25, -8.76])
_PAPER_PI = OuterLoop(pitch=PIGains(30.0, 0.1), yaw=PIGains(30.0, 0.1))
_AERO_POLES = PoleSet([complex(-1.8, 1.0), complex(-1.8, -1.0), -2.0, -2.4])
_AERO_2_POLES = PoleSet([complex(-1.5, 0.5), complex(-1.5, -0.5), -1.2, -2.1])
"""With their PI values chosen under the rotors' lag: the placed poles are slow, so that margins and settling are
better there than with `_AERO_POLES`, which bear the quicker rotors of the first generation."""
_AERO_LAG, _AERO_2_LAG = Rotor(tau=0.156), Rotor(tau=0.165)
_GENTLE = Scenario(theta=radians(10), psi=radians(20), duration=3.0)

_MANUAL = Parameters(
    K_pp=0.204,
    K_py=0.0068,
    K_yp=0.0219,
    K_yy=0.072,
    J_p=0.0384,
    J_y=0.0432,
    m=1.3872,
    l=0.186,
    B_p=0.8,
    B_y=0.318,
)


_COMPONENTS = Components(
    R_p=0.83,
    R_y=1.60,
    K_tp=0.0182,
    K_ty=0.0109,
    K_fp=1.037,
    K_fy=0.4278,
    r_p=0.19685,
    r_y=0.168275,
    m_p=0.292,
    m_y=0.128,
    m_shield=0.167,
)


def _helicopter(
    name: str, title: str, source: str, parameters: Parameters, components: Components | None = None
) -> Preset:
    return Preset(
        name,
        title,
        source,
        "helicopter",
        parameters,
        _HELICOPTER_LIMITS,
        _PAPER_POLES,
        _PAPER_PI,
        _GENTLE,
        components=components,
    )


_ALL = (
    _helicopter(
        "quanser-2dof-manual",
        "Quanser 2-DOF Helicopter (manual)",
        "Quanser 2-DOF Helicopter, user manual: parameters as rounded there",
        _MANUAL,
    ),
    _helicopter(
        "quanser-2dof-design-file",
        "Quanser 2-DOF Helicopter (design file)",
        "Quanser 2-DOF Helicopter, design file: constants from the components (Eqs. 1, 8)",
        Parameters.from_components(
            _COMPONENTS, J_p=0.038430987, J_y=0.043151726, m=1.3872, B_p=0.8, B_y=0.318
        ),
        _COMPONENTS,
    ),
    _helicopter(
        "paper-table-1",
        "Paper, Table I as printed",
        "Mumcu, Çandır, Üstoğlu: Symbolic Pole Assignment of 2DoF Conventional Helicopter, Table I",
        _MANUAL.replaced({"K_pp": 0.2041, "J_y": 0.0431, "l": 0.1855}),
    ),
    _helicopter(
        "paper-as-computed",
        "Paper, as computed",
        "The values from which the paper's printed K, poles and RGA follow (they differ from its Table I)",
        _MANUAL.replaced({"m": 1.39, "B_y": 0.8}),
    ),
    Preset(
        "quanser-aero-2",
        "Quanser Aero 2",
        "Quanser Aero 2, half-quadrotor/2-DOF helicopter workbook; thrust in N/V times D_t = 0.16743 m. Rotors' lag: the "
        "middle of fits to recordings of such rigs, 0.162 to 0.169 s",
        "aero",
        Parameters(
            K_pp=0.00321 * 0.16743,
            K_py=0.00137 * 0.16743,
            K_yp=-0.00319 * 0.16743,
            K_yy=0.00610 * 0.16743,
            J_p=0.02318850045,
            J_y=0.02381041595,
            m=0.0,
            l=0.0,
            B_p=0.00199,
            B_y=0.00192,
            K_s=0.00744,
        ),
        Limits(V_p=18.0, V_y=18.0),
        _AERO_2_POLES,
        OuterLoop(pitch=PIGains(60.0, 1.2), yaw=PIGains(42.0, 1.05)),
        Scenario(theta=radians(10), psi=radians(15), duration=10.0),
        encoders=(2880, 4096),
        rotors=Rotors(_AERO_2_LAG, _AERO_2_LAG),
    ),
    Preset(
        "quanser-aero",
        "Quanser Aero (first generation)",
        "Quanser Aero, 2-DOF helicopter workbook. Rotors' lag: a recording of such a rig, 63 % of the final speed 0.156 s "
        "after a step from 0 to 10 V",
        "aero",
        Parameters(
            K_pp=0.0011,
            K_py=0.0021,
            K_yp=-0.0027,
            K_yy=0.0022,
            J_p=0.0218868648,
            J_y=0.0219920648,
            m=0.0,
            l=0.0,
            B_p=0.0071116,
            B_y=0.0220,
            K_s=0.037463,
        ),
        Limits(V_p=24.0, V_y=24.0),
        _AERO_POLES,
        OuterLoop(pitch=PIGains(7.6, 0.85), yaw=PIGains(19.0, 0.5)),
        Scenario(theta=radians(10), psi=radians(15), duration=15.0),
        Structure("axis-decoupled"),
        encoders=(2880, 4096),
        rotors=Rotors(_AERO_LAG, _AERO_LAG),
    ),
)

PRESETS = by_name(_ALL)
"""All presets by name; the first is the default."""
DEFAULT = _ALL[0].name


def preset(name: str = DEFAULT) -> Preset:
    """The preset of that name, or InvalidInputError with the names that exist."""
    return require_known(name, PRESETS, "preset")
