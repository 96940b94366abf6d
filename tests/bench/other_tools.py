"""The same six loops in python-control, SciPy, slycot, GNU Octave's control package and ours: docs/other_tools.md.

`python -m tests.bench.other_tools` prints the tables; with ``--write`` they replace those of the document. What is
right comes from `other_loops`: roots, modes and eigenvalues at 30 to 60 digits. Without Octave and its control
package (Debian: octave-control) these columns say so.
"""

from __future__ import annotations

import argparse
import datetime
import platform
import shutil
import subprocess
import tempfile
import warnings
from collections.abc import Callable, Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import control
import mpmath as mp
import numpy as np
from scipy import signal
from scipy.io import savemat
from scipy.linalg import solve_continuous_are

from heli2dof_core import interaction, place_poles
from heli2dof_core.margins import loop_margins
from heli2dof_core.metrics import step_metrics
from heli2dof_core.placement.method import Weights
from heli2dof_core.simulation.linear import simulate_linear

from . import other_cases
from .other_loops import DURATION, SAMPLES, Case, cases, exact_margins, exact_step, pole_error, polynomials

DOCUMENT = Path(__file__).parents[2] / "docs" / "other_tools.md"
BEGIN, END = "<!-- tables: python -m tests.bench.other_tools --write -->", "<!-- end of the tables -->"
FREQUENCIES = [0.1, 1.0, 10.0]
Answers = dict[str, str]


def main() -> None:
    """Prints or writes the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true", help="into docs/other_tools.md")
    write = parser.parse_args().write
    warnings.simplefilter("ignore")
    loops = cases()
    octave = ask_octave(loops)
    parts = [
        versions(octave),
        described(loops),
        margins(loops, octave),
        phases(loops, octave),
        steps(loops, octave),
    ]
    parts += [placement(loops, octave), regulators(loops, octave), interactions(loops[-1], octave)]
    text = "\n\n".join([*parts, other_cases.table(octave)])
    if write:
        before, rest = DOCUMENT.read_text("utf-8").split(BEGIN)
        DOCUMENT.write_text(f"{before}{BEGIN}\n\n{text}\n\n{END}{rest.split(END)[1]}", "utf-8")
    else:
        print(text)


def ask_octave(loops: list[Case]) -> Answers:
    """What `other_tools.m` prints, by name; empty without Octave or its control package."""
    program = shutil.which("octave-cli")
    if program is None:
        return {}
    data: dict[str, Any] = {"count": len(loops)}
    for k, case in enumerate(loops, 1):
        plant = case.loop.design.plant
        named = dict(zip(("A", "b", "c"), case.opened, strict=True))
        named |= dict(zip(("Ac", "bc", "cc"), case.closed, strict=True))
        named |= dict(zip(("Aa", "Ba", "pa"), case.axis, strict=True))
        named |= {"Ap": plant.A, "Bp": plant.B, "poles": np.array(case.spec.poles.values)}
        named |= dict(zip(("num", "den"), transfer_function(case), strict=True))
        data |= {f"{name}{k}": value for name, value in named.items()}
    design = loops[-1].loop.design
    data |= {"A0": design.plant.A - design.plant.B @ design.K, "B0": design.plant.B, "C0": np.eye(2, 4)}
    script = Path(__file__).with_suffix(".m")
    with tempfile.TemporaryDirectory() as folder:
        savemat(Path(folder) / "loops.mat", data)
        command = [program, "--no-gui", "--eval", f"loops = 'loops.mat'; source {script}"]
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    lines = (line.partition("|") for line in done.stdout.splitlines() if "|" in line)
    return {name: value for name, _, value in lines}


def transfer_function(case: Case) -> tuple[list[float], list[float]]:
    """L(s)'s coefficients, highest power first, as one would type them."""
    with mp.workdps(60):
        n, d = polynomials(*case.opened)
        while n[-1] == 0:
            n.pop()
        return [float(v) for v in n[::-1]], [float(v) for v in d[::-1]]


def versions(octave: Answers) -> str:
    """What was run, and when."""
    packages = ("control", "slycot", "scipy", "numpy", "mpmath")
    found = ", ".join(f"{name} {version(name)}" for name in packages)
    run = f"{octave.get('version', 'Octave not run')}; Python {platform.python_version()}"
    return f"Run on {datetime.date.today()}: {found}; {run}."


def described(loops: list[Case]) -> str:
    """The loops."""
    rows = [[case.name, case.words, listed(case.spec.poles.values)] for case in loops]
    return markdown("The six loops", ["loop", "L(s)", "placed poles"], rows)


def margins(loops: list[Case], octave: Answers) -> str:
    """Which crossings each tool reports."""
    rows = []
    for k, case in enumerate(loops, 1):
        gains, angles = exact_margins(*case.opened)
        gain, angle, w_gain, w_angle = control.margin(control.ss(*case.opened, 0))
        own = loop_margins(case.loop)
        told = (
            f"{_of(own[0].gain_margin)} / {_of(own[0].gain_reduction_margin)}; "
            f"{_of(own[0].phase_margin and np.degrees(own[0].phase_margin))}°"
            if own
            else "none: unstable"
        )
        theirs = f"{_of(gain)} at {_of(w_gain)}; {_of(angle)}° at {_of(w_angle)}"
        rows.append(
            [case.name, _pairs(gains), _pairs(angles, "°"), theirs, _margin(octave, f"margin_ss{k}"), told]
        )
    head = ["loop", "all gain margins, at ω", "all phase margins, at ω", "control.margin", "Octave margin"]
    return markdown("Margins at the pitch motor", [*head, "ours: gain up / down; phase"], rows)


def phases(loops: list[Case], octave: Answers) -> str:
    """Bode phases in degrees."""
    rows = []
    for k, case in enumerate(loops[:5], 1):
        system, fraction = control.ss(*case.opened, 0), transfer_function(case)
        with mp.workdps(30):
            n, d = fraction
            exact = [
                float(mp.degrees(mp.arg(mp.polyval(n, 1j * w) / mp.polyval(d, 1j * w)))) for w in FREQUENCIES
            ]
        drawn = np.degrees(control.bode(system, FREQUENCIES, plot=False)[1])
        response = np.degrees(control.frequency_response(system, FREQUENCIES).phase)
        of_tf = np.degrees(control.frequency_response(control.tf(*fraction), FREQUENCIES).phase)
        scipys = signal.bode(fraction, FREQUENCIES)[2]
        octaves = [octave.get(f"phase_{form}{k}", "not run") for form in ("ss", "tf")]
        numbers = [listed(values) for values in (exact, drawn, response, of_tf, scipys)]
        rows.append([case.name, *numbers, *(_shorter(text) for text in octaves)])
    head = [
        "loop",
        "arg L(jω)",
        "control.bode",
        ".phase, ss",
        ".phase, tf",
        "SciPy bode",
        "Octave, ss",
        "Octave, tf",
    ]
    return markdown("Phase at ω = 0.1, 1, 10 rad/s, degrees", head, rows)


def steps(loops: list[Case], octave: Answers) -> str:
    """Rise time, settling time, overshoot of the closed loop, pitch from its reference."""
    t = np.linspace(0, DURATION, SAMPLES)
    rows = []
    for k, case in enumerate(loops, 1):
        exact, system = exact_step(*case.closed), control.ss(*case.closed, 0)
        default, gridded = control.step_info(system), control.step_info(system, T=t)
        window = float(control.step_response(system).time[-1])
        theirs = [(i["RiseTime"], i["SettlingTime"], i["Overshoot"]) for i in (default, gridded)]
        scenario = case.spec.scenario
        own = step_metrics(simulate_linear(case.loop, scenario)).axes["theta"]
        ours = [v if v is not None else np.nan for v in (own.rise_time, own.settling_time, own.overshoot)]
        end = octave.get(f"window{k}", "not run").split(", ")
        rows.append(
            [
                case.name,
                listed([exact[name] for name in ("rise", "settling", "overshoot")]),
                f"{listed(theirs[0])} (to {_of(window)} s)",
                listed(theirs[1]),
                f"to {end[0]} s" if len(end) == 3 else end[0],
                listed(ours),
            ]
        )
    head = [
        "loop",
        "exact",
        "control.step_info(sys)",
        "… on 501 samples of 10 s",
        "Octave's step",
        "ours, same samples",
    ]
    return markdown("Rise time (s), settling time (s), overshoot (%)", head, rows)


def placement(loops: list[Case], octave: Answers) -> str:
    """‖K‖ and pole error of every tool's placement, both motors."""
    rows = []
    for k, case in enumerate(loops, 1):
        plant, poles = case.loop.design.plant, list(case.spec.poles.values)
        A, B = plant.A, plant.B

        def judged(find: Callable[[], Any], A: Any = A, B: Any = B, poles: Any = poles) -> str:
            try:
                K = np.atleast_2d(find())
                return f"{_of(np.linalg.norm(K))}, {pole_error(A, B, K, poles):.0e}"
            except ValueError as error:
                return f"{type(error).__name__}"

        answer = octave.get(f"place{k}")
        a, b, pair = case.axis
        acker = [
            np.atleast_2d(control.place_acker(a, b, pair)),
            place_poles(a, b, pair, "ackermann").placement.K,
        ]
        text = octave.get(f"acker{k}", "")
        acker += [np.array([[float(v) for v in text.split(",")]])] if text and "error" not in text else []
        rows.append(
            [
                case.name,
                judged(lambda A=A, B=B, poles=poles: control.place(A, B, poles)),
                judged(lambda A=A, B=B, poles=poles: control.place_varga(A, B, poles)),
                judged(lambda A=A, B=B, poles=poles: signal.place_poles(A, B, poles, "KNV0").gain_matrix)
                if not np.iscomplex(poles).any()
                else "real poles only",
                judged(lambda text=answer: np.array(text.split(","), float).reshape(2, 4))
                if answer
                else "not run",
                judged(lambda case=case: case.loop.design.K),
                listed(acker[0][0]) + (f"; spread {max(np.ptp(np.vstack(acker), axis=0)):.0e}"),
            ]
        )
    head = ["loop", "control.place = SciPy YT", "place_varga (slycot)", "SciPy KNV0", "Octave place", "ours"]
    return markdown("Placement: ‖K‖, pole error (rad/s)", [*head, "acker, pitch alone: K of all three"], rows)


def regulators(loops: list[Case], octave: Answers) -> str:
    """Relative distance of every LQR gain from the one at 40 digits, Q = I, R = I."""
    rows = []
    for k, case in enumerate(loops, 1):
        A, B = case.loop.design.plant.A, case.loop.design.plant.B
        scipys = B.T @ solve_continuous_are(A, B, np.eye(4), np.eye(2))
        exact = exact_regulator(A, B, scipys)
        ones = Weights((1.0,) * 4, (1.0,) * 2)
        found = [control.lqr(A, B, np.eye(4), np.eye(2), method=name)[0] for name in ("scipy", "slycot")]
        found += [scipys, place_poles(A, B, case.spec.poles.values, "lqr", weights=ones).placement.K]
        errors = [f"{np.linalg.norm(K - exact) / np.linalg.norm(exact):.0e}" for K in found]
        text = octave.get(f"lqr{k}")
        theirs = np.array(text.split(","), float).reshape(2, 4) if text else None
        same = (
            "not run" if theirs is None else f"{np.linalg.norm(theirs - exact) / np.linalg.norm(exact):.0e}"
        )
        rows.append([case.name, _of(np.linalg.norm(exact)), *errors, f"{same}"])
    head = ["loop", "‖K‖", "control, scipy", "control, slycot", "SciPy", "ours", "Octave"]
    return markdown("LQR with Q = I, R = I: relative error of K", head, rows)


def exact_regulator(A: np.ndarray, B: np.ndarray, K: np.ndarray) -> np.ndarray:
    """The LQR gain for Q = I, R = I from a near one, by Kleinman's iteration (IEEE TAC 13 (1968) 114)."""
    with mp.workdps(40):
        n, a, b, k = len(A), mp.matrix(A.tolist()), mp.matrix(B.tolist()), mp.matrix(K.tolist())
        for _ in range(3):
            closed, weight = a - b * k, mp.eye(n) + k.T * k
            system = mp.zeros(n * n)
            for i in range(n):
                for j in range(n):
                    for m in range(n):
                        system[i * n + j, m * n + j] += closed[m, i]
                        system[i * n + j, i * n + m] += closed[m, j]
            flat = mp.lu_solve(system, mp.matrix([-weight[i, j] for i in range(n) for j in range(n)]))
            k = b.T * mp.matrix([[flat[i * n + j] for j in range(n)] for i in range(n)])
        return np.array([[float(v) for v in row] for row in k.tolist()])


def interactions(case: Case, octave: Answers) -> str:
    """Gains at s = 0 and what becomes of the relative gain, of inner loop and plant."""
    design = case.loop.design
    A, B, C = design.plant.A - design.plant.B @ design.K, design.plant.B, np.eye(2, 4)
    with mp.workdps(40):
        inverse = mp.lu_solve(mp.matrix(A.tolist()), mp.matrix(B[:, :1].tolist()))
        other = mp.lu_solve(mp.matrix(A.tolist()), mp.matrix(B[:, 1:].tolist()))
        a, b, c, d = -inverse[0], -other[0], -inverse[1], -other[1]
        exact, relative = [float(v) for v in (a, b, c, d)], float(a * d / (a * d - b * c))
    gain = control.dcgain(control.ss(A, B, C, np.zeros((2, 2))))
    rga = (gain * np.linalg.inv(gain).T)[0, 0]
    own = interaction(design).rga
    at_zero = control.dcgain(control.ss(design.plant.A, B, C, np.zeros((2, 2))))
    rows = [
        [
            "inner loop, Ĝ(0) by rows",
            listed(exact),
            listed(gain.ravel()),
            _shorter(octave.get("dcgain", "not run")),
            "",
        ],
        ["λ₁₁", f"{relative:.8f}", f"{rga:.8f} (NumPy)", "by hand", f"{own[0, 0]:.8f}"],
        [
            "plant, G(0): integrators",
            "none: poles at 0",
            listed(at_zero.ravel()),
            octave.get("dcgain_plant", "not run"),
            "",
        ],
    ]
    return markdown("Gains at s = 0 and RGA", ["", "exact", "control.dcgain", "Octave dcgain", "ours"], rows)


def markdown(title: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """A table below its title."""
    lines = [head, ["---"] * len(head), *rows]
    body = "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)
    return f"### {title}\n\n{body}"


def listed(values: Any) -> str:
    """Numbers to four digits."""
    return ", ".join(_of(v) for v in values)


def _of(value: Any) -> str:
    if value is None:
        return "–"
    if np.iscomplexobj(value) and value.imag:
        return f"{_of(value.real)} {'+' if value.imag > 0 else '−'} {_of(abs(value.imag))}j"
    return f"{np.real(value) + 0.0:.5g}".replace("-", "−")


def _pairs(pairs: list[tuple[float, float]], unit: str = "") -> str:
    return "; ".join(f"{_of(value)}{unit} at {_of(w)}" for value, w in pairs) or "none"


def _shorter(text: str) -> str:
    try:
        return listed([float(v) for v in text.split(",")])
    except ValueError:
        return text


def _margin(octave: Answers, name: str) -> str:
    if name not in octave:
        return "not run"
    gain, w_gain, angle, w_angle = (float(v) for v in octave[name].split(","))
    return f"{_of(gain)} at {_of(w_gain)}; {_of(angle)}° at {_of(w_angle)}"


if __name__ == "__main__":
    main()
