"""Models of the replies about methods, comparisons and other systems than the rig."""

from __future__ import annotations

from .models import Complex, Finding, LoopMargins, Metrics, Model, Sensitivity


class Method(Model):
    """A placement method; `needs` names the package that it takes, `couplings` are full-rank's alone."""

    name: str
    title: str
    source: str
    places_poles: bool
    available: bool
    couplings: list[str]
    leads: list[str]
    needs: str | None = None


class Group(Model):
    """A block of the closed loop: its inputs and its poles, by position from 0."""

    inputs: list[int]
    poles: list[int]


class Placement(Model):
    """K of u = −Kx + v for any system; T, Q, indices and groups with full-rank placement."""

    K: list[list[float]]
    integral: list[list[float]] | None = None
    T: list[list[float]] | None = None
    Q: list[list[float]] | None = None
    controllability_indices: list[int] | None = None
    groups: list[Group] | None = None
    closed_loop_poles: list[Complex]
    pole_error: float | None = None
    norm: float
    spectral_norm: float
    eigenvector_condition: float | None = None
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
    K: list[list[float]] | None = None
    integral: list[list[float]] | None = None
    poles: list[Complex] | None = None
    closed_loop_poles: list[Complex] | None = None
    pole_error: float | None = None
    norm: float | None = None
    spectral_norm: float | None = None
    eigenvector_condition: float | None = None
    rga: list[list[float]] | None = None
    pairing: list[list[str]] | None = None
    reason: str | None = None
    niederlinski: float | None = None
    niederlinski_cross: float | None = None
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

    split: list[list[int]]
    poles: list[Complex]
    K: list[list[float]]
    norm: float
    pole_error: float
    rga: list[list[float]] | None = None
