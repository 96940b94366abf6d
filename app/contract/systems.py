"""Any system that is pasted: as it is read, what can be said of it, its state feedback and observer, its courses."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from heli2dof_core.design import FULL_RANK
from heli2dof_core.placement.method import MOST_STATES, Weights
from heli2dof_core.placement.registry import METHODS
from heli2dof_core.systems.loop import ClosedLoop, Wish, close_loop
from heli2dof_core.systems.model import System

from .derivation import Formula
from .fields import Pole, Strict
from .model import Complex, Finding, Model
from .placement import Matrix, SystemWeights, array_of, sized
from .symbols import Matrix as Entries

Numbers = list[list[float]]
Cube = list[list[list[float]]]


class SystemText(Strict):
    """A system as it is pasted from MATLAB, Python or a page of text; nothing in it is ever run as code."""

    text: str = Field(
        description="A = …, B = …, and C, D, letters' values, desired poles where they are given"
    )


class SystemRequest(Strict):
    """Any system ẋ = Ax + Bu, y = Cx + Du, row by row."""

    A: Matrix = Field(description="n×n, row by row")
    B: Matrix = Field(description="n×p, row by row")
    C: Matrix | None = Field(default=None, description="q×n; all states are outputs where it is left out")
    D: Matrix | None = Field(default=None, description="q×p; 0 where it is left out")

    def system(self) -> System:
        """The system.

        Raises:
            InvalidInputError: a shape does not fit.
        """
        given = {
            name: None if (rows := getattr(self, name)) is None else array_of(rows, name) for name in "ABCD"
        }
        return System.of(**given)  # pyright: ignore[reportArgumentType]


PoleList = Annotated[list[Pole], Field(min_length=1, max_length=MOST_STATES)]


class SystemDesignRequest(SystemRequest):
    """A system, the poles it shall have, and the experiment on it."""

    poles: PoleList = Field(description="n, in the unit of A; complex ones with their conjugates")
    method: str = Field(default=FULL_RANK, json_schema_extra={"enum": [*METHODS]})
    observer_poles: PoleList | None = Field(default=None, description="n; no observer where left out")
    weights: SystemWeights = Field(default=SystemWeights(), description="of the quadratic methods")
    x0: Annotated[list[float], Field(max_length=MOST_STATES)] | None = Field(
        default=None, description="initial state, n; 1 for the first state where left out"
    )
    duration: float | None = Field(
        default=None, json_schema_extra={"minimum": 1e-6, "maximum": 1e6}, description="of the responses, s"
    )
    exactly: bool = Field(
        default=True,
        description="whether poles are told exactly where floats do not tell them, which takes longer",
    )

    def loop(self) -> ClosedLoop:
        """The closed loop.

        Raises:
            Heli2DofError: a shape or number does not fit, or the method cannot solve the task.
        """
        system = self.system()
        n, p, q = system.sizes
        weights = Weights(
            sized(self.weights.states, n, "weights.states"),
            sized(self.weights.inputs, p, "weights.inputs"),
            sized(self.weights.integrals, q, "weights.integrals"),
        )
        observer = None if self.observer_poles is None else tuple(self.observer_poles)
        return close_loop(system, Wish(tuple(self.poles), self.method, observer, weights, self.exactly))


class SystemFormulasRequest(Strict):
    """Any system of up to six states, in expressions; nothing in it is ever run as code."""

    A: Entries = Field(description="n×n, row by row")
    B: Entries = Field(description="n×p, row by row")
    C: Entries | None = Field(default=None, description="q×n, for the observer's gain")


class SystemMatrix(Model):
    """A matrix as it was typed, as a formula, and in numbers."""

    rows: list[list[str]]
    latex: str
    mathml: str
    values: Numbers = Field(description="row by row")


class Reached(Model):
    """How far the inputs reach, or what the outputs tell."""

    indices: list[int] = Field(
        description="per input the controllability index, per output the observability index"
    )
    reached: int = Field(description="dimension of what is reached")
    lost: list[Complex] = Field(description="modes that are not, rad/s")
    nearest: Complex = Field(description="the mode that is hardest to reach, rad/s")
    distance: float = Field(
        description="there the smallest singular value of [sI − A, B], in units of its own"
    )


class SystemAnalysis(Model):
    """What can be said of a system before anything is designed."""

    poles: list[Complex] = Field(description="eigenvalues of A, rad/s")
    zeros: list[Complex] = Field(description="invariant zeros, rad/s; none are told without C")
    stable: bool
    inputs: Reached
    outputs: Reached | None = Field(None, description="left out without C")
    T: Numbers | None = Field(None, description="n×n, x̄ = Tx")
    Q: Numbers | None = Field(None, description="p×p, the nonzero rows of TB")
    M: Numbers | None = Field(
        None, description="n×n, columns of the controllability matrix, [b₁ … A^(σ₁−1)b₁ | b₂ …]"
    )
    dc_gain: Numbers | None = Field(None, description="Ĝ(0), q×p")
    rga: Numbers | None = Field(None, description="at ω = 0, q×p")
    niederlinski: float | None = Field(None, description="index of the diagonal pairing")


class SystemRead(Model):
    """A system as it was read, and what can be said of it."""

    matrices: dict[str, SystemMatrix] = Field(description="A, B, and C and D where they are given")
    letters: dict[str, float] = Field(description="value of each letter; 1 where it has none")
    missing: list[str] = Field(description="letters without a value")
    poles: list[Complex] | None = Field(None, description="desired ones, where the text has some")
    observer_poles: list[Complex] | None = None
    analysis: SystemAnalysis
    findings: list[Finding]


class SystemCourses(Model):
    """Responses over time, s; exact at every sample."""

    t: list[float] = Field(description="s")
    step_y: Cube = Field(description="per reference every output; each reference steps by 1")
    step_u: Cube = Field(description="per reference every input")
    initial_x: Numbers = Field(description="every state from x(0), the references 0")
    initial_y: Numbers = Field(description="the outputs meanwhile")
    initial_u: Numbers = Field(description="the inputs meanwhile")
    estimate: Numbers | None = Field(None, description="with an observer, which begins at 0, every estimate")
    x0: list[float] = Field(description="where the states begin")


class SystemBode(Model):
    """Frequency responses as gain and phase, rad; per output (or loop), per input (or reference)."""

    frequencies: list[float] = Field(description="rad/s")
    plant: dict[str, Cube] = Field(description="gain and phase of Ĝ(jω)")
    loops: dict[str, Numbers] = Field(
        description="of each input's loop opened there, the others closed; −1 is critical"
    )
    closed: dict[str, Cube] = Field(description="from references to outputs")
    rga: Cube | None = Field(None, description="|RGA(jω)| of the plant, per output, per input")


class SystemObserver(Model):
    """x̂' = Ax̂ + Bu + L (y − Cx̂ − Du)."""

    L: Numbers = Field(description="n×q")
    poles: list[Complex] = Field(description="of A − LC, rad/s")
    pole_error: float = Field(description="largest distance to those asked for, rad/s")
    norm: float = Field(description="Frobenius norm of L")


class SystemDesign(Model):
    """The state feedback of a system, and what it does."""

    K: Numbers = Field(description="p×n, u = −Kx + F r")
    K_z: Numbers | None = Field(None, description="p×q, of the integrated errors")
    F: Numbers = Field(description="p×m, how the references enter")
    scaling: str = Field(description="static, pseudo-inverse, integral or inputs: what F is")
    reason: str = Field(description="the same in a sentence")
    poles: list[Complex] = Field(description="of the closed loop without the observer, rad/s")
    pole_error: float | None = Field(None, description="largest distance to those asked for, rad/s")
    norm: float = Field(description="Frobenius norm of K")
    eigenvector_condition: float | None = Field(None, description="κ₂ of the eigenvectors of A − BK")
    observer: SystemObserver | None = None
    courses: SystemCourses
    bode: SystemBode
    findings: list[Finding]


class SystemFormulas(Model):
    """K and L in closed form."""

    K: Formula
    K_entries: dict[str, Formula] = Field(description="as k_11, row by row")
    T: Formula
    Q: Formula
    closed_loop: Formula = Field(description="A − BK")
    controllability_indices: list[int] = Field(description="one per input")
    holds_unless: list[Formula] = Field(description="what must not be 0")
    L: Formula | None = Field(None, description="in the observer's poles q_1 … q_n")
    L_entries: dict[str, Formula] | None = None
    observability_indices: list[int] | None = Field(None, description="one per output")
    observer_holds_unless: list[Formula] | None = None
    reason: str | None = Field(None, description="why there is no L, though C is given")


class SystemExample(Model):
    """A system of a textbook, to be pasted."""

    name: str
    title: str
    source: str
    text: str
    method: str
    weights: dict[str, list[float]] | None = Field(None, description="of a quadratic method")
