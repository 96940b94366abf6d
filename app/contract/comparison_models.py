"""Models of the replies about methods, comparisons and other systems than the rig."""

from __future__ import annotations

from pydantic import Field

from heli2dof_core.figures import DESIGN

from .models import Complex, Finding, LoopMargins, Metrics, Model, Sensitivity


class Method(Model):
    """A placement method; `needs` names the package that it takes, `couplings` are full-rank's alone."""

    name: str
    title: str
    source: str
    places_poles: bool = Field(description="whether it takes the poles given, rather than choose its own")
    integrates: bool = Field(description="whether it brings integral action, in place of the PI loops")
    available: bool
    couplings: list[str]
    leads: list[str]
    needs: str | None = None


class Group(Model):
    """A block of the closed loop: its inputs and its poles, by position from 0."""

    inputs: list[int] = Field(description="positions from 0")
    poles: list[int] = Field(description="positions from 0")


class Placement(Model):
    """K of u = −Kx + v for any system; T, Q, indices and groups with full-rank placement."""

    K: list[list[float]] = Field(description="p×n, rows are inputs")
    integral: list[list[float]] | None = Field(None, description="p×q, the method's own integral action")
    T: list[list[float]] | None = Field(None, description="n×n, x̄ = Tx")
    Q: list[list[float]] | None = Field(None, description="p×p")
    controllability_indices: list[int] | None = Field(None, description="one per input")
    groups: list[Group] | None = None
    closed_loop_poles: list[Complex]
    pole_error: float | None = Field(None, description=DESIGN["pole_error"].described)
    pole_error_bound: float | None = Field(None, description=DESIGN["pole_error_bound"].described)
    norm: float = Field(description=DESIGN["norm"].described)
    spectral_norm: float = Field(description=DESIGN["spectral_norm"].described)
    eigenvector_condition: float | None = Field(None, description=DESIGN["eigenvector_condition"].described)
    findings: list[Finding]


class Unavailable(Model):
    """Why a method has no result here."""

    code: str
    detail: str
    hint: str | None = None


class AxisMetricsAlone(Model):
    """Metrics of each axis stepped alone."""

    theta: Metrics | None = None
    psi: Metrics | None = None


class ComparisonRow(Model):
    """One method's result, or why there is none; structures are full-rank's alone."""

    method: str
    title: str
    coupling: str | None = None
    lead: str | None = None
    unavailable: Unavailable | None = None
    K: list[list[float]] | None = Field(
        None, description="V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y"
    )
    integral: list[list[float]] | None = Field(
        None, description="the method's own integral action, V/(rad·s)"
    )
    poles: list[Complex] | None = None
    closed_loop_poles: list[Complex] | None = None
    pole_error: float | None = Field(None, description=DESIGN["pole_error"].described)
    pole_error_bound: float | None = Field(None, description=DESIGN["pole_error_bound"].described)
    norm: float | None = Field(None, description=DESIGN["norm"].described)
    spectral_norm: float | None = Field(None, description=DESIGN["spectral_norm"].described)
    eigenvector_condition: float | None = Field(None, description=DESIGN["eigenvector_condition"].described)
    rga: list[list[float]] | None = Field(None, description="RGA at s = 0; rows θ, ψ, columns V_p, V_y")
    pairing: list[list[str]] | None = None
    reason: str | None = None
    niederlinski: float | None = Field(None, description="index of the diagonal pairing")
    niederlinski_cross: float | None = Field(None, description="index of the cross pairing")
    metrics: Metrics | None = None
    axis_metrics: AxisMetricsAlone | None = None
    margins: LoopMargins | None = None
    sensitivity: Sensitivity | None = None
    loop_poles: list[Complex] | None = None
    stable: bool | None = None
    findings: list[Finding] | None = None


class Comparison(Model):
    """All methods side by side, and what becomes of the paper's claim of lower gains."""

    rows: list[ComparisonRow]
    claim: str


class Split(Model):
    """One way to deal the poles: positions of pitch's pair and of yaw's, and what it gives."""

    split: list[list[int]] = Field(description="positions from 0 of pitch's pair and of yaw's")
    poles: list[Complex]
    K: list[list[float]] = Field(description="V/rad and V·s/rad, columns θ, ψ, θ̇, ψ̇; rows V_p, V_y")
    norm: float = Field(description=DESIGN["norm"].described)
    pole_error: float = Field(description=DESIGN["pole_error"].measured)
    rga: list[list[float]] | None = Field(None, description="RGA at s = 0; rows θ, ψ, columns V_p, V_y")
