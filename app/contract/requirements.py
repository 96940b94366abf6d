"""What is required of a design: limits of figures, as every search takes them."""

from __future__ import annotations

from pydantic import Field

from heli2dof_core.measured import Axis, Motor, Steps
from heli2dof_core.scenario import Model as RigModel

from .fields import Strict


class OfResponse(Strict):
    """Of which response a figure is meant; what the figure does not have is refused."""

    axis: Axis | None = Field(
        default=None, description="the axis that is stepped; both, the worse one, where left out"
    )
    motor: Motor | None = Field(default=None, description="the motor; both, the worse one, where left out")
    model: RigModel | None = Field(default=None, description="of the response; nonlinear where left out")
    steps: Steps | None = Field(
        default=None,
        description="alone, each axis by itself, where left out; together, the scenario as it is set",
    )


class LimitedFigure(OfResponse):
    """Limits of one figure, in SI units but for %; one of them at least."""

    max: float | None = Field(default=None, description="at most, in the figure's unit")
    min: float | None = Field(default=None, description="at least, in the figure's unit")
