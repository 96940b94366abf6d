"""The design as a script for MATLAB and GNU Octave, in plain matrices: no toolbox is needed."""

from __future__ import annotations

from ..evaluate import loop_of
from ..loop import Loop
from ..parameters import PARAMETER_INFO
from ..spec import Spec
from .dialect import MATLAB
from .format import Format
from .nonlinear_script import nonlinear_lines
from .origin import origin
from .script_loop import estimator_lines, gain_comment, loop_lines, machine_lines, model_names, start_of


def render(spec: Spec, link: str = "") -> str:
    """A script that defines rig, K and loops, checks them, and plots the linear model's and the rig's responses."""
    loop = loop_of(spec)
    design, scenario, matrix = loop.design, spec.scenario, MATLAB.matrix
    theta, psi, *_ = scenario.resolved(spec.theta_0)
    wanted = design.wanted.tolist() if design.aims else design.closed_loop_poles.tolist()
    what = "asked for" if design.aims else "chosen by the method"
    numbers = []
    for name, value in spec.parameters.as_dict().items():
        unit = PARAMETER_INFO[name].unit.replace("·", "*").replace("²", "^2")
        numbers.append(f"{name} = {value!r};  % {PARAMETER_INFO[name].meaning}, {unit}")
    A, B = model_names(loop)
    return "\n".join(
        [
            *(f"% {line}" for line in origin(spec, FORMAT.name, link)),
            "% Set no_plots = true beforehand to compute only.",
            "",
            *numbers,
            f"theta_0 = {spec.theta_0!r};  % operating point, rad",
            _PLANT,
            *machine_lines(loop, MATLAB),
            *estimator_lines(loop, MATLAB),
            *_observer_check(loop),
            "\n% State feedback",
            f"poles = [{_numbers(wanted)}];  % {what}, rad/s",
            matrix("K", design.K, gain_comment(loop)),
            matrix("P", loop.proportional, "volts of each motor per error of pitch and yaw, V/rad"),
            *([] if loop.integral is None else [matrix("I_z", loop.integral, "per integral, V/(rad s)")]),
            matrix("F", loop.feedforward, "volts per reference, V/rad"),
            _check("placed", f"{A} - {B} * K", "pole_error", "poles", len(wanted)),
            "fprintf('The placed poles are off by %.3g rad/s.\\n', pole_error);\n",
            *loop_lines(loop, MATLAB),
            "loop_poles = eig(A_loop);\n",
            f"t = linspace(0, {scenario.duration!r}, {scenario.samples})';  % s",
            f"reference = [{theta!r} - theta_0; {psi!r}];  % deviations, rad",
            f"x = [{'; '.join(map(repr, start_of(loop, scenario)))}];",
            _RESPONSE,
            *nonlinear_lines(spec, loop),
            _PLOTS,
        ]
    )


def _numbers(poles: list[complex]) -> str:
    return "; ".join(f"complex({p.real!r}, {p.imag!r})" for p in poles)


def _observer_check(loop: Loop) -> list[str]:
    """The observer's poles, and how far they are from those that were asked for."""
    if loop.estimator is None or loop.estimator.L is None:
        return []
    wanted = loop.estimator.wanted
    if wanted is None:
        return ["observed = eig(A - L * C);"]
    return [
        f"observer_poles = [{_numbers(wanted.tolist())}];  % asked for, rad/s",
        _check("observed", "A - L * C", "observer_error", "observer_poles", len(wanted)),
        "fprintf('The poles of A - LC are off by %.3g rad/s.\\n', observer_error);",
    ]


def _check(found: str, matrix: str, error: str, wanted: str, n: int) -> str:
    """The eigenvalues of a matrix beside those that it should have."""
    return _CHECK.format(found=found, matrix=matrix, error=error, wanted=wanted, n=n)


_PLANT = """
% The rig linearized at rest (theta_0, 0): x = [theta; psi; theta_dot; psi_dot], u = [V_p; V_y], deviations
alpha = J_p + m * l^2;
beta_0 = J_y + m * l^2 * cos(theta_0)^2;
thrust = [K_pp, K_py; K_yp, K_yy];
A = [zeros(2), eye(2); ...
    (m * g * l * sin(theta_0) - K_s) / alpha, 0, -B_p / alpha, 0; ...
    0, 0, 0, -B_y / beta_0];
B = [zeros(2); diag([alpha, beta_0]) \\ thrust];
C = [eye(2), zeros(2)];
trim = thrust \\ [m * g * l * cos(theta_0) + K_s * theta_0; 0];  % V"""

_CHECK = """{found} = eig({matrix});
{error} = 0;  % largest distance between these and the poles, matched one to one, rad/s
left = {found};
for k = 1:{n}
    [distance, nearest] = min(abs(left - {wanted}(k)));
    {error} = max({error}, distance);
    left(nearest) = [];
end"""

_RESPONSE = """
% Linear step response, exact at every sample: no limits; voltages are deviations from the trim
n = size(A_loop, 1);
step_matrix = expm([A_loop, B_loop * reference; zeros(1, n + 1)] * (t(2) - t(1)));
theta = zeros(size(t)); psi = theta; V_p = theta; V_y = theta;
for k = 1:numel(t)
    theta(k) = x(1) + theta_0;
    psi(k) = x(2);
    u = law * x + law_of_reference * reference;
    V_p(k) = u(1);
    V_y(k) = u(2);
    x = step_matrix(1:n, :) * [x; 1];
end"""

_PLOTS = """
if ~exist('no_plots', 'var') || ~no_plots
    figure;
    subplot(2, 1, 1); plot(t, [theta_rig, psi_rig] * 180 / pi, t, [theta, psi] * 180 / pi, '--'); grid on;
    ylabel('angle, deg'); legend('theta', 'psi', 'theta, linear', 'psi, linear');
    subplot(2, 1, 2); plot(t, [V_p_rig, V_y_rig], t, [V_p + trim(1), V_y + trim(2)], '--'); grid on;
    ylabel('voltage, V'); xlabel('t, s'); legend('V_p', 'V_y', 'V_p, linear', 'V_y, linear');
end
% With the Control System Toolbox: loop = ss(A_loop, B_loop, [eye(2, n); law], [zeros(2); law_of_reference]);
% In Octave keep it an ss: bode draws a tf with poles at 0 lower by 360 degrees, isstable of a 2x2 tf cancels poles.
"""

FORMAT = Format("matlab", "Script for MATLAB and Octave", ".m", "text/x-matlab; charset=utf-8", render)
