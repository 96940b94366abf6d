"""A design of any system as a script of MATLAB or Octave, and of Python with python-control."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..systems.loop import ClosedLoop
from ..version import package_version
from .dialect import MATLAB, PYTHON, Dialect

STEM = "heli2dof_system"
_HEAD = {"static": "outputs end at their references", "pseudo-inverse": "outputs end at their references"}


def system_script(
    loop: ClosedLoop, dialect: Dialect, duration: float, x0: Sequence[float], link: str = ""
) -> str:
    """The whole file.

    Args:
        loop: the design.
        dialect: `dialect.MATLAB` or `dialect.PYTHON`.
        duration: of its responses, s.
        x0: initial state, n.
        link: address that opens the design.
    """
    lines = [*_head(loop, dialect, link), *_matrices(loop, dialect, duration, x0)]
    lines += _closed(loop, dialect)
    lines += _MATLAB_END if dialect.matlab else _PYTHON_END
    return "\n".join(lines) + "\n"


def _head(loop: ClosedLoop, dialect: Dialect, link: str) -> Iterator[str]:
    n, p, q = loop.system.sizes
    yield f"{dialect.comment} heli2dof {package_version()}: {n} states, {p} inputs, {q} outputs"
    if link:
        yield f"{dialect.comment} {link}"
    if dialect.matlab:
        yield "% Needs the Control System Toolbox, or in Octave: pkg load control"
        yield "if exist('OCTAVE_VERSION', 'builtin'), pkg('load', 'control'); end"
    else:
        yield "import control as ct"
        yield "import numpy as np"
    yield ""


def _matrices(loop: ClosedLoop, dialect: Dialect, duration: float, x0: Sequence[float]) -> Iterator[str]:
    own = loop.system
    for name, matrix, comment in (
        ("A", own.A, "dx/dt = A x + B u"),
        ("B", own.B, "inputs"),
        ("C", own.C, "y = C x + D u" if own.measured else "all states are outputs"),
        ("D", own.D, "y = C x + D u"),
        ("K", loop.K, "u = -K x + F r" if not loop.K_z.size else "u = -K x + K_z z, dz/dt = r - y"),
        ("F", loop.F, _HEAD.get(loop.scaling, "each reference is added to an input")),
    ):
        yield dialect.matrix(name, matrix, comment)
    if loop.K_z.size:
        yield dialect.matrix("K_z", loop.K_z, "of the integrated errors")
    if loop.L is not None:
        yield dialect.matrix("L", loop.L, "observer: dxh/dt = A xh + B u + L (y - C xh - D u)")
    yield dialect.line("x0", dialect.vector([float(x) for x in x0]), "initial state")
    yield dialect.line("duration", repr(float(duration)), "s")
    yield ""


def _closed(loop: ClosedLoop, dialect: Dialect) -> Iterator[str]:
    """The closed loop from r to [y; u], as blocks of the matrices above."""
    n, _, q = loop.system.sizes
    k = loop.K_z.shape[1]
    yield f"{dialect.comment} closed loop from r to [y; u]" + (
        ", the observer at rest" if loop.L is not None else ""
    )
    if k:
        yield dialect.line("gain", dialect.beside(["-K", "K_z"]))
        zero = dialect.zeros(n, k)
        inner = dialect.block([["A", zero], ["-C", dialect.zeros(k, k)]])
        yield dialect.line("enter", dialect.stacked(["B", dialect.zeros(k, loop.K.shape[0])]))
        yield dialect.line("Acl", f"{inner} + enter @ gain")
        yield dialect.line("Bcl", f"enter @ F + {dialect.stacked([zero, dialect.eye(k, k)])}")
        y = f"{dialect.beside(['C', dialect.zeros(q, k)])} + D @ gain"
    else:
        yield dialect.line("gain", "-K")
        yield dialect.line("Acl", "A - B @ K")
        yield dialect.line("Bcl", "B @ F")
        y = "C - D @ K"
    yield dialect.line("Ccl", dialect.stacked([y, "gain"]))
    yield dialect.line("Dcl", dialect.stacked(["D @ F", "F"]))
    ss = "ss" if dialect.matlab else "ct.ss"
    yield dialect.line("closed", f"{ss}(Acl, Bcl, Ccl, Dcl)")
    eig = "eig" if dialect.matlab else "np.linalg.eigvals"
    yield dialect.line("poles", f"{eig}(Acl)", "of the closed loop")
    if loop.L is not None:
        yield dialect.line("observer_poles", f"{eig}(A - L @ C)")
    yield dialect.line("t", f"{'linspace' if dialect.matlab else 'np.linspace'}(0, duration, 241)")
    if k:
        yield dialect.line("start", _under("x0", k, dialect))
    else:
        yield dialect.line("start", "x0")


def _under(name: str, k: int, dialect: Dialect) -> str:
    zeros = ", ".join(["0.0"] * k)
    return f"[{name}; zeros({k}, 1)]" if dialect.matlab else f"np.concatenate([{name}, [{zeros}]])"


_MATLAB_END = (
    "y = step(closed, t);       % samples, outputs and inputs, references",
    "free = initial(closed, start, t);",
    "disp('K ='), disp(K)",
    "disp('poles ='), disp(poles)",
    "if ~exist('quiet', 'var'), figure, step(closed, duration), figure, bode(ss(A, B, C, D)), end",
)
_PYTHON_END = (
    "y = ct.step_response(closed, t, squeeze=False).outputs  # outputs and inputs, references, samples",
    "free = ct.initial_response(closed, t, start, squeeze=False).outputs",
    'print("K =", K, "poles =", poles, sep="\\n")',
)


def matlab_script(loop: ClosedLoop, duration: float, x0: Sequence[float], link: str = "") -> str:
    """For MATLAB and Octave."""
    return system_script(loop, MATLAB, duration, x0, link)


def python_script(loop: ClosedLoop, duration: float, x0: Sequence[float], link: str = "") -> str:
    """For Python with python-control."""
    return system_script(loop, PYTHON, duration, x0, link)


__all__ = ["STEM", "matlab_script", "python_script", "system_script"]
