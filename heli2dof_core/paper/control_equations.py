"""From state feedback to the loops: Figs. 2–5, Eqs. 16–23, in the order of the derivation."""

# pyright: reportArgumentType=false, reportCallIssue=false, reportOperatorIssue=false, reportAttributeAccessIssue=false
# (SymPy annotates its functions with classes that are wider than what they return.)

from __future__ import annotations

from ..couplings import Structure
from ..symbolic.full_rank import full_rank, indices, plant
from ..symbolic.grouping import grouped
from ..symbolic.luenberger import controllability_matrix
from ..symbolic.names import latex
from ..symbolic.rga import relative_gain_array, steady_state, transfer_matrix
from . import as_printed
from .equation import Equation, named


def _form(name: str) -> str:
    """A matrix of the canonical form of the paper's structure."""
    return latex(grouped(getattr(full_rank(Structure()).form, name)))


FEEDBACK = (
    Equation(
        number="Fig. 2",
        title="State feedback",
        plain="Each motor gets a command, less a weighted sum of all four states; the weights are $K$.",
        note="Redrawn, with the sign that is right.",
    ),
    Equation(
        number="Eq. 16",
        title="Closed loop",
        plain="Feedback replaces $A$ by $A − BK$, and with it the rig's own poles by chosen ones.",
        printed=r"\dot x = (A + BK)x + Bv,\quad y = Cx",
        derived=lambda: r"\dot x = (A - BK)x + Bv,\quad y = Cx",
        status="corrected",
        errata=("sign-of-feedback",),
    ),
    Equation(
        number="controllability",
        title="Controllability matrix and indices",
        plain="Can the motors move every state? Reading the columns from left to right, the first four that are "
        "independent tell how many states each motor takes care of: here two and two.",
        derived=lambda: (
            r"\left[B\ \ AB\ \ A^2B\ \ A^3B\right] = "
            + latex(controllability_matrix(*plant()).to_Matrix())
            + r",\quad (\sigma_1, \sigma_2) = "
            + latex(indices())
        ),
        status="explained",
        note="“A simple test” is all that the paper says. The indices are (2, 2) exactly where γ ≠ 0.",
        errata=("lower-gain",),
    ),
    Equation(
        number="transformation",
        title="Transformation T",
        plain="New coordinates $z = Tx$, chosen so that each motor drives a chain of two integrators of its own.",
        derived=lambda: f"T = {_form('T')},\\quad Q = {_form('Q')}",
        status="explained",
        note="The paper gives neither T nor Q. These, Luenberger's with the basis shifted by K_py/K_pp, lead to "
        "its K; Q holds the nonzero rows of B̄ = TB.",
        formulas=("T", "Q"),
    ),
    Equation(
        number="canonical form",
        title="Canonical form",
        plain="In these coordinates the plant is two chains; only the last row of each carries numbers, and only "
        "there do the motors act.",
        derived=lambda: r"\bar A = TAT^{-1} = " + _form("A_bar") + r",\quad \bar B = TB = " + _form("B_bar"),
        status="explained",
        note="Luenberger's controllable canonical form (1967).",
        formulas=("A_bar", "B_bar"),
    ),
    Equation(
        number="Eq. 18",
        title="Desired poles",
        plain="The four eigenvalues of the closed loop shall be the four poles that were chosen.",
        printed=r"\sigma(A + BK) = \{p_1, p_2, p_3, p_4\}",
        derived=lambda: r"\sigma(A - BK) = \{p_1, p_2, p_3, p_4\}",
        status="corrected",
        errata=("sign-of-feedback",),
    ),
    Equation(
        number="desired polynomials",
        title="Desired polynomials",
        plain="Each chain gets a pair of poles; multiplied out, a pair is two coefficients.",
        derived=lambda: (
            r"d_1(s) = (s - p_1)(s - p_2) = s^2 + d_{11} s + d_{10},\quad "
            r"d_2(s) = (s - p_3)(s - p_4) = s^2 + d_{21} s + d_{20}"
        ),
        status="explained",
    ),
    Equation(
        number="gain in z",
        title="Gain in the new coordinates",
        plain="What stands in the chains' last rows, less what shall stand there, is what the feedback must take "
        "away.",
        derived=lambda: r"\bar K = QKT^{-1} = " + latex(grouped(full_rank(Structure()).K_bar)),
        status="explained",
        note="What drives the second chain by the first is left as the plant has it: there $K̄$ is 0, and the closed "
        "loop becomes triangular.",
        formulas=("K_bar",),
    ),
    Equation(
        number="Eq. 19",
        title="Back to the rig's coordinates",
        plain="$Q$ undoes how the motors mix, $T$ brings the angles and rates into the new coordinates.",
        printed=r"K = Q^{-1}\bar K T",
    ),
    Equation(
        number="Eq. 20",
        title="Shape of K",
        plain="Two rows, one per motor; four columns, one per state.",
        printed=r"K = \begin{bmatrix} k_{11} & k_{12} & k_{13} & k_{14} \\ k_{21} & k_{22} & k_{23} & k_{24} \end{bmatrix}",
    ),
    Equation(
        number="Eqs. 21, 22",
        title="Gain in terms of the poles",
        plain="The product of a pair of poles sets the stiffness, their sum the damping; γ sorts out which motor "
        "pays for it.",
        printed=r"K = " + latex(as_printed.gain()),
        derived=named("K", lambda: grouped(full_rank(Structure()).K)),
        status="corrected",
        errata=("yaw-damping-in-K", "yaw-inertia-in-K"),
        formulas=("K",),
    ),
    Equation(
        number="closed loop",
        title="The closed loop, checked",
        plain="In the new coordinates the last row of each chain now holds the desired coefficients.",
        derived=lambda: r"T(A - BK)T^{-1} = " + latex(grouped(full_rank(Structure()).canonical_closed_loop)),
        status="explained",
        formulas=("canonical_closed_loop",),
    ),
)

INTERACTION = (
    Equation(
        number="Eq. 17",
        title="Closed-loop transfer matrix",
        plain="How each angle answers each command at every frequency, with the state feedback closed.",
        printed=r"\hat G(s) = C(sI - A - BK)^{-1}B",
        derived=lambda: r"\hat G(s) = C(sI - A + BK)^{-1}B = " + latex(grouped(transfer_matrix(Structure()))),
        status="corrected",
        errata=("sign-of-feedback",),
        formulas=("G",),
    ),
    Equation(
        number="steady state",
        title="Steady-state gain",
        plain="After a constant command has acted for long, this is where the angles have come to rest.",
        derived=lambda: r"\hat G(0) = " + latex(grouped(steady_state(Structure()))),
        status="explained",
        note="The paper goes from Ĝ(s) to the array without writing it.",
        formulas=("G_0",),
    ),
    Equation(
        number="Eq. 23",
        title="Relative gain array",
        plain="Each entry is a channel's gain with the other loop open, over its gain with the other loop closed "
        "tightly: 1 is no interaction.",
        printed=r"\text{RGA} = \begin{bmatrix} 1 + \frac{73 p_3p_4}{7127 p_1p_2} & -\frac{73 p_3p_4}{7127 p_1p_2} \\ "
        r"-\frac{73 p_3p_4}{7127 p_1p_2} & 1 + \frac{73 p_3p_4}{7127 p_1p_2} \end{bmatrix}",
        derived=lambda: r"\text{RGA} = " + latex(grouped(relative_gain_array(Structure()))),
        note="“No interaction at zero frequency” is not quite what it says.",
        errata=("no-interaction",),
        formulas=("RGA",),
    ),
)

LOOPS = (
    Equation(
        number="Fig. 3",
        title="PI control of the overall system",
        plain="Two PI controllers turn the errors of the angles into the commands of the inner loop, until no error "
        "is left.",
        printed=r"\text{PI}(s) = 30\left(1 + \frac{1}{0.1\, s}\right)",
        derived=lambda: r"\text{PI}(s) = k_p\left(1 + \frac{1}{T_i\, s}\right)",
        note="The zero at −10 cancels the placed pole p₂ = −10; the loop's other poles are not those placed.",
    ),
    Equation(
        number="Fig. 4",
        title="Step of the pitch reference",
        plain="The nose is asked to rise by one radian at once.",
        status="explained",
        note="Our copy has no curve: redrawn from the model.",
        errata=("unit-step",),
    ),
    Equation(
        number="Fig. 5",
        title="Step of the yaw reference",
        plain="The rig is asked to turn by one radian at once.",
        status="explained",
        note="Our copy has no curve: redrawn from the model.",
        errata=("unit-step",),
    ),
)
"""Each tuple in the order in which the derivation needs it."""
