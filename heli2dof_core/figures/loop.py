"""Figures of the loop and of its state feedback: margins, what both motors bear, size and quality of K."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

from .figure import Figure, documented, figures_of

_OGATA = "Ogata, Modern Control Engineering, 2010, section 7.7"
_PEAK = "Skogestad and Postlethwaite, Multivariable Feedback Control, 2005, section 2.4.3"
_SEILER = "Seiler, Packard and Gahinet, IEEE Control Systems 40 (2020) 78"


@documented
@dataclass(frozen=True)
class Margins:
    """Margins of the loop opened at one motor's input, the rest closed; None where unlimited.

    Every crossing counts, those at ω = 0 too: there a factor on the gain puts a pole at 0. None is at infinity, where
    L = 0.
    """

    gain_margin: Annotated[
        float | None,
        Figure(
            "gain margin",
            "smallest factor above 1 on the motor’s gain that makes the loop unstable",
            better="higher",
            source=_OGATA,
            absent="where unlimited",
            notation="decibel",
            title="Gain margin",
            short="Gain margin",
            hint="the smaller of both motors’, everything else closed",
            key="gain",
        ),
    ]
    gain_reduction_margin: Annotated[
        float | None,
        Figure(
            "gain reduction margin",
            "largest factor below 1 on the motor’s gain that makes the loop unstable",
            better="lower",
            absent="where unlimited",
            notation="decibel",
        ),
    ]
    phase_margin: Annotated[
        float | None,
        Figure(
            "phase margin",
            "smallest phase lag or lead at a gain crossover that makes the loop unstable",
            "rad",
            "higher",
            source=_OGATA,
            absent="where unlimited",
            digits=0,
            shown="°",
            title="Phase margin",
            short="Phase margin",
            hint="the smaller of both motors’, everything else closed",
            key="phase",
        ),
    ]
    delay_margin: Annotated[
        float | None,
        Figure(
            "delay margin",
            "smallest dead time at this axis’ own motor that makes the loop unstable: phase margin over crossover "
            "frequency",
            "s",
            "higher",
            absent="where unlimited",
            notation="seconds",
            title="Delay margin",
            key="delay",
        ),
    ]


SENSITIVITY: Mapping[str, Figure] = {
    "peak": Figure(
        "sensitivity peak",
        "largest singular value of S(jω) over all frequencies, at the motors: its inverse is the distance to "
        "instability under an additive change of the loop",
        source=_PEAK,
        title="Sensitivity peak",
        symbol="M_S",
        key="sensitivity",
        detail=True,
    ),
    "peak_frequency": Figure(
        "its frequency",
        "where the sensitivity peaks",
        "rad/s",
        "none",
        absent="where it is approached at infinity alone",
        notation="significant",
        digits=3,
    ),
    "disk_margin": Figure(
        "disk margin",
        "size α of the disks of gain and phase changes, at both motors at once and independent of each other, that "
        "the loop tolerates",
        better="higher",
        source=_SEILER,
        title="Disk margin",
        short="Disk margin",
        hint="both motors at once",
        symbol="α",
        key="disk",
        detail=True,
    ),
    "disk_frequency": Figure(
        "its frequency",
        "where the disk margin is reached",
        "rad/s",
        "none",
        absent="where it is approached at infinity alone",
    ),
    "gain_low": Figure("lowest factor", "lowest factor on both gains that is borne"),
    "gain_high": Figure(
        "highest factor",
        "highest factor on both gains that is borne",
        better="higher",
        absent="where unlimited",
    ),
    "phase": Figure(
        "phase", "change of phase at both motors that is borne, ±", "rad", "higher", digits=0, shown="°"
    ),
}
"""What the whole loop bears at both motors at once."""

LOOP: Mapping[str, Figure] = {
    "lag_margin": Figure(
        "lag margin",
        "least time constant of both rotors alike at which the loop is no longer stable; where the rotors are "
        "placed, above their own",
        "s",
        "higher",
        absent="where unlimited, and where the loop is not stable",
        notation="seconds",
        title="Lag margin",
        short="Lag margin",
        hint="how slow both rotors may be; an Aero’s need 0.16 s",
        key="lag",
    ),
}
"""What the whole loop bears of its rotors."""

DESIGN: Mapping[str, Figure] = {
    "norm": Figure(
        "norm of K",
        "Frobenius norm of K: the size of all its gains",
        notation="significant",
        digits=4,
        short="norm",
        symbol="‖K‖_F",
    ),
    "spectral_norm": Figure(
        "spectral norm of K",
        "spectral norm of K: the most it can amplify a state",
        notation="significant",
        digits=4,
        short="spectral norm",
        symbol="‖K‖_2",
        key="spectral",
    ),
    "pole_error": Figure(
        "pole error",
        "farthest distance of a computed pole from the placed one",
        "rad/s",
        absent="where the method chose its own poles",
        notation="exponent",
        digits=0,
        short="Pole error",
        key="error",
    ),
    "pole_error_bound": Figure(
        "bound of the pole error",
        "how far rounding may have moved the poles told, and so their error",
        "rad/s",
        absent="where the method chose its own poles",
    ),
    "eigenvector_condition": Figure(
        "condition of the eigenvectors",
        "condition number of the eigenvectors of A − BK: how sensitive the poles are, at best 1",
        absent="where there are too few eigenvectors",
        notation="significant",
        digits=3,
        short="condition",
        symbol="κ_2(X)",
        key="kappa",
    ),
    "relative_gain": Figure(
        "relative gain",
        "relative gain at s = 0, dimensionless: at 1 the diagonal loops do not feel each other",
        better="none",
        digits=3,
        short="relative gain",
        symbol="λ_11",
        key="lambda",
    ),
}
"""What a state feedback says of itself."""


MARGINS: Mapping[str, Figure] = figures_of(Margins)
