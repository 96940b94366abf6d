"""Figures of a response: of an axis, of its step, of a motor."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isnan
from typing import Annotated, Any

from .figure import Figure, documented, figures_of

_OGATA = "Ogata, Modern Control Engineering, 2010, section 5.3"
_GRAHAM = "Graham and Lathrop, Trans. AIEE 72 (1953) 273"
_UNDERSHOOT = "Skogestad and Postlethwaite, Multivariable Feedback Control, 2005, section 5.6"


@documented
@dataclass(frozen=True)
class AxisMetrics:
    """How one stepped axis follows its reference; what does not happen within the window is None.

    An axis has settled if it is within the band at the end of the window and stays there. A crossing shortly before
    the end does not count: the course is followed beyond it, for ten periods or six time constants of every pole
    where it is linear, for one period of the slowest pole, at most the window's length, where it is not.
    """

    rise_time: Annotated[
        float | None,
        Figure(
            "rise time",
            "time from 10 % to 90 % of the step",
            "s",
            source=_OGATA,
            absent="where 90 % are not reached",
            notation="seconds",
            title="Rise time",
            short="Rise",
            hint="10 to 90 % of this axis’ step",
            symbol="t_r",
            key="rise",
            least=0.01,
        ),
    ]
    settling_time: Annotated[
        float | None,
        Figure(
            "settling time",
            "time after which the angle stays within 2 % of the step around its reference",
            "s",
            source=_OGATA,
            absent="where not `settled`",
            notation="seconds",
            title="Settling time",
            short="Settling",
            hint="to within 2 % of this axis’ step",
            symbol="t_s",
            key="settling",
            least=0.01,
        ),
    ]
    overshoot: Annotated[
        float,
        Figure(
            "overshoot",
            "largest excess beyond the reference, in percent of the step",
            "%",
            source=_OGATA,
            digits=1,
            title="Overshoot",
            short="Over\u00adshoot",
            hint="beyond the reference of this axis’ step",
            symbol="M_p",
            least=1,
        ),
    ]
    undershoot: Annotated[
        float,
        Figure(
            "undershoot",
            "largest excursion from the start away from the reference, in percent of the step",
            "%",
            source=_UNDERSHOOT,
            digits=1,
            title="Undershoot",
            short="Under\u00adshoot",
            hint="from the start away from the reference of this axis’ step",
            detail=True,
            least=1,
        ),
    ]
    peak: Annotated[
        float,
        Figure("peak", "angle of the largest deviation from the start", "rad", "none", shown="°"),
    ]
    peak_time: Annotated[
        float | None,
        Figure(
            "peak time",
            "when the peak is reached",
            "s",
            "none",
            source=_OGATA,
            absent="where nothing overshoots, or the window ends on the peak",
            notation="seconds",
            symbol="t_p",
        ),
    ]
    steady_state_error: Annotated[
        float,
        Figure(
            "steady-state error",
            "reference minus the last angle shown",
            "rad",
            shown="°",
            title="Error at the end",
            short="Error",
            hint="size of the error at the end",
            key="error",
            signed=True,
            least=1e-3,
        ),
    ]
    iae: Annotated[
        float,
        Figure(
            "IAE",
            "∫ |e| dt, integral of the absolute error over the time shown",
            "rad·s",
            source=_GRAHAM,
            notation="significant",
            digits=3,
            shown="°s",
            in_head=True,
            title="IAE",
            detail=True,
            least=1e-4,
        ),
    ]
    itae: Annotated[
        float,
        Figure(
            "ITAE",
            "∫ t |e| dt, the absolute error weighted with time, over the time shown",
            "rad·s²",
            source=_GRAHAM,
            notation="significant",
            digits=3,
            shown="°s²",
            in_head=True,
            title="ITAE",
            detail=True,
            least=1e-4,
        ),
    ]
    settled: Annotated[
        bool,
        Figure(
            "settled",
            "whether it is within 2 % of the step when the window ends, for good",
            "",
            "none",
            notation="flag",
        ),
    ]


def axis_figures(row: Sequence[float]) -> dict[str, Any]:
    """A kernel's row by the names of `AxisMetrics`, whose attributes are its columns.

    What did not happen, NaN there, is left out.
    """
    rise, settling, overshoot, undershoot, peak, peak_time, error, iae, itae, settled = row
    found = {  # a display of constant names: by zip it takes thrice as long, and a drag makes eight
        "rise_time": rise,
        "settling_time": settling,
        "overshoot": overshoot,
        "undershoot": undershoot,
        "peak": peak,
        "peak_time": peak_time,
        "steady_state_error": error,
        "iae": iae,
        "itae": itae,
        "settled": settled == 1.0,
    }
    if isnan(rise):
        del found["rise_time"]
    if isnan(settling):
        del found["settling_time"]
    if isnan(peak_time):
        del found["peak_time"]
    return found


@documented
@dataclass(frozen=True)
class MotorMetrics:
    """What one motor has to do."""

    peak: Annotated[
        float,
        Figure(
            "largest |voltage|",
            "largest voltage of the motor, trim included",
            "V",
            digits=1,
            title="peak",
            short="peak",
            hint="motor over both steps, trim included",
            symbol="V",
            least=0.5,
        ),
    ]
    saturated: Annotated[
        float, Figure("share of time at the limit", "share of time at its limit, 0 to 1", digits=0, shown="%")
    ]
    effort: Annotated[
        float,
        Figure(
            "effort",
            "∫ (V − V_trim)² dt over the time shown: what control costs beyond holding still; the inputs’ part of "
            "the quadratic cost",
            "V²·s",
            source="Anderson and Moore, Optimal Control, 1990",
            notation="significant",
            digits=3,
            shown="V²s",
            in_head=True,
            title="effort",
            detail=True,
            least=0.05,
        ),
    ]


STEP: Mapping[str, Figure] = {
    "coupling_peak": Figure(
        "peak of the other axis",
        "largest deviation of the axis that is not stepped",
        "rad",
        absent="where both are stepped",
        shown="°",
        title="Other axis moves",
        short="Other axis",
        key="coupling",
        least=1e-3,
    )
}
"""What a step of one axis alone says of the other."""

AXIS: Mapping[str, Figure] = figures_of(AxisMetrics)
MOTOR: Mapping[str, Figure] = figures_of(MotorMetrics)

AXIS_METRICS = len(AXIS)
"""Columns of the kernels' row of an axis."""
NO_AXIS_METRICS: Mapping[str, None] = dict.fromkeys(AXIS)
"""Where nothing has happened."""
_MARK = "steady_state_error"

RESPONSE = tuple(
    name for own in AXIS for name in (own, *(STEP if own == _MARK else ())) if {**AXIS, **STEP}[name].title
)
"""Rows of an axis' step on the page and in the report; what it does to the other axis follows its error."""
