"""Single calls whose result surprises who compares: what is right, and what each tool says."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from typing import Any

import control
import numpy as np
from scipy.linalg import solve_continuous_are

from heli2dof_core import Heli2DofError, OuterLoop, Spec, close_loop, place, place_poles
from heli2dof_core.placement.method import Weights

CHAIN = np.diag(np.ones(3), 1), np.eye(4)[:, 3:]
TRIPLE = np.diag(np.ones(2), 1), np.eye(3)[:, 2:]
DOUBLE = np.diag(np.ones(2), 2), np.eye(4)[:, 2:]
SPLIT = np.diag([1.0, 2.0]), np.array([[1.0], [0.0]])
INTEGRATOR = np.array([[0.0, 1.0], [0.0, 0.0]]), np.array([[0.0], [1.0]])
OSCILLATOR = np.array([[0.0, 1.0], [-1.0, 0.0]]), INTEGRATOR[1]
INTERLEAVED = [-1 + 1j, -2 + 1j, -1 - 1j, -2 - 1j]
PAIRS = [-1 + 1j, -1 - 1j, -2 + 1j, -2 - 1j]
s = control.tf("s")
NOT_RUN, NONE = "not run", "–"
Answers = dict[str, str]
Place = Callable[[Any, Any, Any], Any]


def table(octave: Answers) -> str:
    """All of them in Markdown; Octave's answers come from `other_tools.m`."""
    rows = [
        *(
            row(octave)
            for row in (_textbook_phase, _negative_margin, _two_limits, _margin_at_zero, _integrators_as_ss)
        ),
        *(row(octave) for row in (_slow_mode, _never_risen, _zero_steady_state, _cross_step)),
        *(
            row(octave)
            for row in (_interleaved, _double_integrators, _uncontrollable, _triple, _fewer, _shape)
        ),
        *(row(octave) for row in (_lqr_unseen, _lqr_oscillator)),
        *(row(octave) for row in (_dcgain, _impulse, _sample_time, _order, _hidden, _matched, _sampled_pid)),
        _derivative(octave),
    ]
    head = ["call", "right", "python-control (slycot where named), SciPy", "Octave", "ours"]
    lines = [head, ["---"] * 5, *rows]
    body = "\n".join("| " + " | ".join(cell.replace("|", "\\|") for cell in line) + " |" for line in lines)
    return f"### Single calls\n\n{body}"


def _textbook_phase(octave: Answers) -> list[str]:
    phase = np.degrees(control.bode((s + 1) / s**2, [0.1, 1, 10], plot=False)[1])
    right = "−174.3, −135, −95.7"
    return ["phase of (s + 1)/s² at 0.1, 1, 10", right, _list(phase), octave.get("textbook", NOT_RUN), NONE]


def _negative_margin(octave: Answers) -> list[str]:
    _, phase, *_ = control.margin(100 / ((s + 1) * (s + 2) * (s + 3)))
    theirs = octave.get("unstable_margin", NOT_RUN).split(", ")
    right = "−14.68 (unstable loop)"
    return ["phase margin of 100/((s+1)(s+2)(s+3)), °", right, f"{phase:.4g}", theirs[2 % len(theirs)], NONE]


def _two_limits(octave: Answers) -> list[str]:
    system = (s + 1) ** 2 / (s**3 * (s / 20 + 1) ** 2)
    gains = control.stability_margins(system, returnall=True)[0]
    told = f"margin {control.margin(system)[0]:.4g}; returnall {_list(gains)}"
    theirs = octave.get("two_limits", NOT_RUN).split(", ")[0]
    return [
        "gain margin of (s+1)²/(s³(s/20+1)²)",
        "0.6235 and 32.08",
        told,
        theirs,
        "see the margins above",
    ]


def _margin_at_zero(octave: Answers) -> list[str]:
    gain, _, at, _ = control.margin(2 / (s - 1))
    theirs = octave.get("margin_at_zero", NOT_RUN).split(", ")[0]
    return [
        "gain margin of 2/(s − 1)",
        "0.5 at ω = 0: pole 1 − 2k",
        f"{gain:.4g} at {at:.4g}",
        theirs,
        "see static, light",
    ]


def _integrators_as_ss(octave: Answers) -> list[str]:
    system = (s + 0.1) / s**2
    told = [control.margin(form)[0] for form in (system, control.ss(system))]
    theirs = octave.get("margin_of_ss", NOT_RUN).split(", ")[0]
    return [
        "gain margin of (s + 0.1)/s²",
        "none",
        f"tf {told[0]:.2g}; ss {told[1]:.2g}",
        f"ss {theirs}",
        "none",
    ]


def _slow_mode(octave: Answers) -> list[str]:
    system = 0.97 / (s / 10 + 1) + 0.03 / (s / 0.04 + 1)
    default, long = (control.step_info(system, **more)["SettlingTime"] for more in ({}, {"T": 500}))
    right = f"{np.log(1.5) / 0.04:.5g} = ln(1.5)/0.04"
    call = "settling time of 0.97/(s/10+1) + 0.03/(s/0.04+1), s"
    return [
        call,
        right,
        f"{default:.5g}; T=500: {long:.5g}",
        "no stepinfo",
        "within the scenario's duration",
    ]


def _never_risen(octave: Answers) -> list[str]:
    told = _tried(lambda: control.step_info([0, 0.1, 0.2, 0.3], T=[0, 1, 2, 3], final_output=1)["RiseTime"])
    return ["rise time of samples that stay below 90 %", "none", told, "no stepinfo", "none"]


def _zero_steady_state(octave: Answers) -> list[str]:
    info = control.step_info(s / (s + 1))
    told = f"overshoot {info['Overshoot']:.3g} %, rise {info['RiseTime']:.3g} s, settling {info['SettlingTime']:.3g}"
    return [
        "step_info of s/(s + 1): ends at 0",
        "no shares of 0",
        told,
        "no stepinfo",
        "coupling_peak instead",
    ]


def _cross_step(octave: Answers) -> list[str]:
    loops = [close_loop(place(Spec.from_preset()), OuterLoop(outer)).to_control() for outer in ("pi", "none")]
    share = _tried(lambda: f"overshoot {control.step_info(loops[0])[1][0]['Overshoot']:.0e} %")
    told = f"{share}; inner loop alone: {_tried(lambda: control.step_info(loops[1])[1][0]['Overshoot'])}"
    call = "step_info of the rig's loop, yaw from the pitch reference: ends at 0"
    return [call, "no shares of 0", told, "no stepinfo", "coupling_peak instead"]


def _interleaved(octave: Answers) -> list[str]:
    found = [_eig(find, CHAIN, INTERLEAVED) for find in (control.place, control.place_varga)]
    told = f"place {found[0]}; place_varga {found[1]}"
    call = "4 integrators, poles −1+j, −2+j, −1−j, −2−j in this order"
    return [call, "those", told, octave.get("interleaved", NOT_RUN), _eig(_own, CHAIN, INTERLEAVED)]


def _double_integrators(octave: Answers) -> list[str]:
    told = "; ".join(
        f"{find.__name__} {_fastest(find, DOUBLE, PAIRS)}" for find in (control.place, control.place_varga)
    )
    call = "two double integrators, −1 ± j, −2 ± j: largest Re of the result"
    return [call, "−1", told, octave.get("double", NOT_RUN), _fastest(_own, DOUBLE, PAIRS)]


def _uncontrollable(octave: Answers) -> list[str]:
    told = "; ".join(
        f"{find.__name__} {_eig(find, SPLIT, [-1, -2])}"
        for find in (control.place, control.place_acker, control.place_varga)
    )
    call = "A = diag(1, 2), b = (1, 0): 2 cannot be moved; poles −1, −2"
    return [call, "refused", told, octave.get("uncontrollable", NOT_RUN), _eig(_own, SPLIT, [-1, -2])]


def _triple(octave: Answers) -> list[str]:
    told = "; ".join(
        f"{find.__name__} {_tried(lambda find=find: _list(np.ravel(find(*TRIPLE, [-1, -1, -1]))))}"
        for find in (control.place, control.place_acker, control.place_varga)
    )
    own = _list(_own(*TRIPLE, [-1, -1, -1])[0])
    return ["3 integrators, −1 three times", "K = 1, 3, 3", told, octave.get("triple", NOT_RUN), own]


def _fewer(octave: Answers) -> list[str]:
    A, B = np.diag([-5.0, -1.0]), np.ones((2, 1))
    told = _tried(lambda: f"place_varga K = {_list(control.place_varga(A, B, [-3])[0])}")
    theirs = f"{octave.get('fewer', NOT_RUN)}; with alpha −2: {octave.get('fewer_alpha', NOT_RUN)}"
    return [
        "A = diag(−5, −1), b = (1, 1), pole −3 alone",
        "not unique",
        told,
        theirs,
        _eig(_own, (A, B), [-3]),
    ]


def _shape(octave: Answers) -> list[str]:
    poles = [-1, -2, -3, -4]
    told = ", ".join(
        f"{find.__name__} {np.shape(find(*CHAIN, poles))}"
        for find in (control.place, control.place_acker, control.place_varga)
    )
    return ["shape of K, one input, 4 states", "(1, 4)", told, "1×4", str(_own(*CHAIN, poles).shape)]


def _lqr_unseen(octave: Answers) -> list[str]:
    told = _lqr(INTEGRATOR, np.diag([0.0, 1.0]))
    call = "lqr, double integrator, Q = diag(0, 1), R = 1"
    own = _tried(lambda: _list(_quadratic(INTEGRATOR, (0.0, 1.0))))
    return [call, "none stabilizes: the pole at 0 stays", told, octave.get("lqr_unseen", NOT_RUN), own]


def _lqr_oscillator(octave: Answers) -> list[str]:
    told = _lqr(OSCILLATOR, np.zeros((2, 2)))
    own = _tried(lambda: _list(_quadratic(OSCILLATOR, (0.0, 0.0))))
    right = "none stabilizes: ±j stay"
    return [
        "lqr, oscillator 1/(s² + 1), Q = 0, R = 1",
        right,
        told,
        octave.get("lqr_oscillator", NOT_RUN),
        own,
    ]


def _dcgain(octave: Answers) -> list[str]:
    system = control.ss(np.diag([0.0, -1.0]), np.eye(2), np.eye(2), np.zeros((2, 2)))
    told = (
        f"ss {_list(control.dcgain(system).ravel())}; tf {_list(control.dcgain(control.tf(system)).ravel())}"
    )
    theirs = (
        f"of 1/s + 1/(s+1) in two bases: {octave.get('dcgain_integrating', NOT_RUN)}, "
        f"{octave.get('dcgain_other_basis', NOT_RUN)}"
    )
    return ["dcgain of diag(1/s, 1/(s+1))", "∞, 0, 0, 1", told, theirs, "no RGA, with a finding"]


def _impulse(octave: Answers) -> list[str]:
    t = np.linspace(0, 1, 2001)
    last = control.impulse_response(control.ss((s + 1.2) / ((s + 1) * (s + 2))), t).outputs[-1]
    theirs = (
        f"dt 1e-3: {octave.get('impulse_coarse', NOT_RUN)}; dt 5e-4: {octave.get('impulse_fine', NOT_RUN)}; "
        f"2×2: {octave.get('impulse_mimo', NOT_RUN)}"
    )
    return ["impulse of (s+1.2)/((s+1)(s+2)) at t = 1", "0.18184", f"{last:.5g}", theirs, NONE]


SAMPLED = [[0.5, 0.1], [0.0, 0.2]], [[1.0], [1.0]], [[1.0, 1.0]], 0


def _sample_time(octave: Answers) -> list[str]:
    reduced = control.model_reduction(control.ss(*SAMPLED, 0.1), [1], method="truncate")
    told = f"model_reduction: dt = {reduced.dt}"
    theirs = f"ss2ss: continuous, stable before and after: {octave.get('ss2ss', NOT_RUN)}"
    return ["sample time after a change of the model", "0.1", told, theirs, NONE]


def _order(octave: Answers) -> list[str]:
    reduced = control.balred(control.ss(*SAMPLED, 0.1), 1)
    return [
        "balred of a sampled model, poles 0.5, 0.2, to order 1",
        "1",
        f"{reduced.nstates}, dt {reduced.dt}",
        "–",
        NONE,
    ]


def _hidden(octave: Answers) -> list[str]:
    system = (s - 1) / ((s - 1) * (s + 1))
    told = (
        f"tf {_list(control.poles(system))}; ss(tf), with slycot: {_list(control.poles(control.ss(system)))}"
    )
    theirs = f"isstable SISO, within a 2×2: {octave.get('hidden', NOT_RUN)}"
    return ["poles of (s−1)/((s−1)(s+1))", "−1, 1", told, theirs, "exports give ss"]


def _matched(octave: Answers) -> list[str]:
    told = _tried(lambda: control.c2d(1 / (s * (s + 1)), 0.1, "matched"))
    return [
        "c2d 'matched' of 1/(s(s+1)): gain at 0.01",
        "1.000 times",
        told,
        octave.get("matched", NOT_RUN),
        NONE,
    ]


def _sampled_pid(octave: Answers) -> list[str]:
    return ["pole of pid(1, 2, 0, 0, Ts)", "z = 1", "–", octave.get("sampled_pid", NOT_RUN), NONE]


def _derivative(octave: Answers) -> list[str]:
    def poles(within: bool) -> str:
        found = control.rootlocus_pid_designer(
            1 / s**2, "P", Kp0=1, Kd0=1, tau=0.01, derivative_in_feedback_path=within, plot=False
        ).poles()
        return _list(np.sort_complex(found))

    told = f"error {poles(False)}; feedback path {poles(True)}"
    return ["rootlocus_pid_designer, 1/s², Kp = Kd = 1: poles", "−0.5 ± 0.9j and filter", told, "–", NONE]


def _own(A: Any, B: Any, poles: Any) -> Any:
    return place_poles(A, B, poles).placement.K


def _quadratic(system: Any, states: tuple[float, ...]) -> Any:
    return np.ravel(place_poles(*system, [-1, -2], "lqr", weights=Weights(states, (1.0,))).placement.K)


def _lqr(system: Any, Q: Any) -> str:
    def gain(method: str) -> str:
        return _tried(lambda: _list(np.ravel(control.lqr(*system, Q, 1, method=method)[0])))

    riccati = _tried(lambda: _list(np.ravel(system[1].T @ solve_continuous_are(*system, Q, np.eye(1)))))
    return f"method scipy {gain('scipy')}; slycot {gain('slycot')}; SciPy {riccati}"


def _eig(find: Place, system: Any, poles: Any) -> str:
    A, B = system
    return _tried(lambda: _list(np.sort_complex(np.linalg.eigvals(A - B @ np.atleast_2d(find(A, B, poles))))))


def _fastest(find: Place, system: Any, poles: Any) -> str:
    A, B = system
    return _tried(lambda: f"{np.max(np.linalg.eigvals(A - B @ find(A, B, poles)).real):.4g}")


def _tried(call: Callable[[], Any]) -> str:
    """Its result, or the error's kind and beginning; warnings are counted."""
    with warnings.catch_warnings(record=True) as told:
        warnings.simplefilter("always")
        try:
            result = str(call())
        except (ArithmeticError, IndexError, NameError, ValueError, Heli2DofError) as error:
            return f"{type(error).__name__}: {' '.join(str(error).split())[:60]}"
    return result + (" (warned)" if told else "")


def _list(values: Any) -> str:
    def one(v: complex) -> str:
        real = f"{v.real:.4g}"
        return real if abs(v.imag) < 1e-9 else f"{real} {'+' if v.imag > 0 else '−'} {abs(v.imag):.4g}j"

    return ", ".join(one(complex(v)) for v in values)
