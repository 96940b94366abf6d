"""The structures that the closed loop can have, by name.

They exist because full-rank placement is a family: the basis and one triangle of the closed loop
are free (theory: Patel & Munro 1982), and the RGA tells the members apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Literal

from .errors import InvalidInputError, StructureUnavailableError, UncontrollableError
from .parameters import Parameters
from .quantities import Quantity, documented, require_valid

Coupling = Literal["triangular", "input-diagonal", "axis-decoupled"]
Lead = Literal["pitch", "yaw"]
Modelled = Literal["paper", "rotors"]
"""What a gain is derived for: the paper's four states, or six with both rotors' speeds."""
Sought = Literal["K", "L"]
"""The gain of the state feedback, or of the observer."""

_MEANINGS = {
    "triangular, pitch leads": "pitch has exactly its own pair and drives yaw: the paper’s",
    "triangular, yaw leads": "yaw has exactly its own pair and drives pitch",
    "input-diagonal": "standard Luenberger: diagonal in B₂⁻¹[θ, ψ]",
    "axis-decoupled": "pitch and yaw do not feel each other",
}
NEGLIGIBLE = 1e-9
"""γ or a thrust constant counts as 0 below this share of the terms it is made of."""


@documented
@dataclass(frozen=True)
class Structure:
    """Coupling of the closed loop, and for the triangular one the axis that leads.

    ``triangular``: the leading axis has exactly its own pair and drives the other (the paper's,
    with pitch leading). ``input-diagonal``: diagonal in z = B₂⁻¹[θ, ψ] (standard Luenberger).
    ``axis-decoupled``: θ and ψ do not feel each other.

    Without a shift the basis has the one that gives the structure its name: K_py/K_pp, K_yp/K_yy, or 0 where it is
    input-diagonal.
    """

    coupling: Annotated[Coupling, Quantity("structure of the closed loop")] = "triangular"
    lead: Annotated[Lead, Quantity("axis that leads where the coupling is triangular")] = "pitch"
    shift: Annotated[
        float | None,
        Quantity(
            "shift c of Luenberger's basis, q₁ → q₁ + c q₂ (yaw leading: q₂ → q₂ + c q₁)",
            "",
            -1e6,
            1e6,
            absent="the structure's own where left out",
            symbol="c",
        ),
    ] = None

    @property
    def family(self) -> Structure:
        """The structure without a shift of its own: what the derivation is made for."""
        return Structure(self.coupling, self.lead)

    @property
    def title(self) -> str:
        """The family, for people: coupling, and where it matters who leads."""
        return f"{self.coupling}, {self.lead} leads" if self.coupling == "triangular" else self.coupling

    @property
    def meaning(self) -> str:
        """What the family makes of the closed loop, in a few words."""
        return _MEANINGS[self.title]

    def __post_init__(self) -> None:
        require_valid(self)
        if self.coupling != "triangular":  # the lead says nothing there; one value keeps caches small
            object.__setattr__(self, "lead", "pitch")
        if self.shift is not None and self.coupling == "axis-decoupled":
            raise InvalidInputError(
                "the axis-decoupled structure is not in Luenberger's basis, so it has no shift",
                field="shift",
                value=self.shift,
                hint="Leave the shift out, or choose triangular or input-diagonal.",
            )


STRUCTURES = (
    Structure("triangular", "pitch"),
    Structure("triangular", "yaw"),
    Structure("input-diagonal"),
    Structure("axis-decoupled"),
)
"""The named members of the full-rank family."""


def require_controllable(parameters: Parameters) -> None:
    """Raises UncontrollableError if γ = 0: the motors' torques are parallel."""
    if parameters.independence <= NEGLIGIBLE:
        raise UncontrollableError(
            "the rig is not controllable: K_pp K_yy = K_py K_yp, so both motors act alike",
            field="parameters",
            value=parameters.gamma,
            hint="Change one thrust constant so that K_pp K_yy and K_py K_yp differ.",
        )


def require_structure(parameters: Parameters, structure: Structure) -> None:
    """Raises StructureUnavailableError if the leading axis' own motor has no thrust on it."""
    p = parameters
    if structure.coupling != "triangular" or structure.shift is not None:
        return
    own, name = (p.K_pp, "K_pp") if structure.lead == "pitch" else (p.K_yy, "K_yy")
    if abs(own) <= NEGLIGIBLE * max(abs(p.K_pp), abs(p.K_py), abs(p.K_yp), abs(p.K_yy)):
        raise StructureUnavailableError(
            f"triangular with {structure.lead} leading needs {name} ≠ 0: the basis' shift divides by it",
            field="structure.lead",
            value=structure.lead,
            hint="Let the other axis lead, choose another coupling, or give the shift.",
        )
