"""Systems of textbooks, typed as these print them, with the poles that they ask for."""

from __future__ import annotations

from dataclasses import dataclass

from ..checks import by_name
from ..design import FULL_RANK
from ..placement.method import Weights


@dataclass(frozen=True)
class Example:
    """A system of a book.

    Attributes:
        name: for programs.
        title: for people.
        source: author and book.
        text: to be pasted; its desired poles are `p`, the observer's `q`.
        method: of placement.
        weights: of a quadratic method.
    """

    name: str
    title: str
    source: str
    text: str
    method: str = FULL_RANK
    weights: Weights | None = None


_ALL = (
    Example(
        "ogata-third-order",
        "Third-order regulator",
        "K. Ogata, Modern Control Engineering, 5th ed., Example 10–1",
        """A = [0 1 0; 0 0 1; -1 -5 -6];
B = [0; 0; 1];
C = [1 0 0];
p = [-2+j*4 -2-j*4 -10];""",
    ),
    Example(
        "ogata-observer",
        "Regulator with an observer",
        "K. Ogata, Modern Control Engineering, chapter 10",
        """A = [0 1; 20.6 0];
B = [0; 1];
C = [1 0];
p = [-1.8+j*2.4 -1.8-j*2.4];
q = [-8 -8];""",
    ),
    Example(
        "ogata-pendulum",
        "Inverted pendulum on a cart",
        "K. Ogata, Modern Control Engineering, chapters 3 and 10; M = 2 kg, m = 0.1 kg, l = 0.5 m",
        """A = [0 1 0 0
     20.601 0 0 0
     0 0 0 1
     -0.4905 0 0 0];
B = [0; -1; 0; 0.5];
C = [0 0 1 0];
p = [-2+j*2*sqrt(3) -2-j*2*sqrt(3) -10 -10];""",
    ),
    Example(
        "chen-second-order",
        "Second-order system",
        "C.-T. Chen, Linear System Theory and Design, chapter 8",
        """A = [1 3; 3 1];
B = [1; 0];
p = [-1+2j -1-2j];""",
    ),
    Example(
        "chen-pendulum",
        "Cart with inverted pendulum",
        "C.-T. Chen, Linear System Theory and Design, chapters 6 and 8",
        """A = [0 1 0 0; 0 0 -1 0; 0 0 0 1; 0 0 5 0];
B = [0; 1; 0; -2];
C = [1 0 0 0];
p = [-1.5+0.5j -1.5-0.5j -1+1j -1-1j];""",
    ),
    Example(
        "nise-phase-variable",
        "Phase-variable form",
        "N. S. Nise, Control Systems Engineering, Example 12.1",
        """A = [0 1 0; 0 0 1; 0 -4 -5];
B = [0; 0; 1];
C = [100 20 0];
p = [-5.4+7.2j -5.4-7.2j -5.1];""",
    ),
    Example(
        "franklin-pendulum",
        "Undamped oscillator, in letters",
        "G. F. Franklin, J. D. Powell, A. Emami-Naeini, Feedback Control of Dynamic Systems, chapter 7",
        """F = [0 1; -w_0^2 0];
G = [0; 1];
H = [1 0];
w_0 = 1
p = [-2 -2];""",
    ),
    Example(
        "astrom-murray-steering",
        "Vehicle steering, in a letter",
        "K. J. Åström and R. M. Murray, Feedback Systems, chapters on state and output feedback",
        """A = [0 1; 0 0];
B = [gamma; 1];
C = [1 0];
gamma = 0.5
p = [-0.49+0.5j -0.49-0.5j];
q = [-1.4+1.43j -1.4-1.43j];""",
    ),
    Example(
        "dorf-bishop-pendulum",
        "Inverted pendulum, in letters",
        "R. C. Dorf and R. H. Bishop, Modern Control Systems, inverted pendulum control",
        """A = [0 1 0 0
     0 0 -m*g/M 0
     0 0 0 1
     0 0 g/l 0];
B = [0; 1/M; 0; -1/(M*l)];
C = [1 0 0 0];
m = 0.1, M = 1, l = 0.5, g = 9.81
p = [-2+1j -2-1j -3+3j -3-3j];""",
    ),
    Example(
        "kautsky-reactor",
        "Chemical reactor, two inputs",
        "J. Kautsky, N. K. Nichols, P. Van Dooren, Int. J. Control 41 (1985) 1129; after N. Munro (1972)",
        """A = [ 1.38   -0.2077  6.715  -5.676
     -0.5814 -4.29    0       0.675
      1.067   4.273  -6.654   5.893
      0.048   4.273   1.343  -2.104];
B = [0 0; 5.679 0; 1.136 -3.146; 1.136 0];
C = [1 0 1 -1; 0 1 0 0];
p = [-0.2 -0.5 -5.0566 -8.6659];""",
    ),
    Example(
        "skogestad-satellite",
        "Spinning satellite",
        "S. Skogestad and I. Postlethwaite, Multivariable Feedback Control, section 3.7",
        """A = [0 a; -a 0];
B = [1 0; 0 1];
C = [1 a; -a 1];
D = [0 0; 0 0];
a = 10
p = [-1 -1];""",
    ),
    Example(
        "skogestad-distillation",
        "Distillation, LV configuration",
        "S. Skogestad and I. Postlethwaite, Multivariable Feedback Control, section 3.7; a realization of its Ĝ(s)",
        """A = [-1/75 0; 0 -1/75];
B = [1/75 0; 0 1/75];
C = [87.8 -86.4; 108.2 -109.6];
p = [-0.7 -0.7];""",
    ),
    Example(
        "kwakernaak-sivan-positioning",
        "Positioning system, by LQR",
        "H. Kwakernaak and R. Sivan, Linear Optimal Control Systems, chapter 3",
        """A = [0 1; 0 -alpha];
B = [0; kappa];
C = [1 0];
kappa = 0.787, alpha = 4.6
p = [-9.5+9.5j -9.5-9.5j];""",
        "lqr",
        Weights((1.0, 0.0), (2e-5,), (1.0,)),
    ),
)

EXAMPLES = by_name(_ALL)
"""Textbook systems by name."""
