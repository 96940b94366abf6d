"""The design as a script for MATLAB and GNU Octave, in plain matrices: no toolbox is needed."""

from __future__ import annotations

from ..evaluate import loop_of
from ..parameters import PARAMETER_INFO
from ..signals import Floats
from ..spec import Spec
from .format import Format
from .origin import origin


def render(spec: Spec, link: str = "") -> str:
    """A script that defines rig, K, loops and the linear step response, checks them and plots."""
    loop = loop_of(spec)
    design, scenario = loop.design, spec.scenario
    theta, psi, *start = scenario.resolved(spec.theta_0)
    initial = [start[0] - spec.theta_0, *start[1:], *[0.0] * (len(loop.A) - 4)]
    wanted = design.poles.values if design.aims else design.closed_loop_poles.tolist()
    poles = "; ".join(f"complex({p.real!r}, {p.imag!r})" for p in wanted)
    what = "asked for" if design.aims else "chosen by the method"
    numbers = []
    for name, value in spec.parameters.as_dict().items():
        unit = PARAMETER_INFO[name].unit.replace("·", "*").replace("²", "^2")
        numbers.append(f"{name} = {value!r};  % {PARAMETER_INFO[name].meaning}, {unit}")
    return "\n".join(
        [
            *(f"% {line}" for line in origin(spec, FORMAT.name, link)),
            "% Set no_plots = true beforehand to compute only.",
            "",
            *numbers,
            f"theta_0 = {spec.theta_0!r};  % operating point, rad",
            _PLANT,
            f"poles = [{poles}];  % {what}, rad/s",
            _matrix("K", design.K, "u = -K x + v, V/rad and V s/rad"),
            _matrix("P", loop.proportional, "volts of each motor per error of pitch and yaw, V/rad"),
            *([] if loop.integral is None else [_matrix("I_z", loop.integral, "per integral, V/(rad s)")]),
            _matrix("F", loop.feedforward, "volts per reference, V/rad"),
            _CHECK,
            _INTEGRATING if loop.integral is not None else _STATIC,
            f"t = linspace(0, {scenario.duration!r}, {scenario.samples})';  % s",
            f"reference = [{theta!r} - theta_0; {psi!r}];  % deviations, rad",
            f"x = [{'; '.join(map(repr, initial))}];",
            _RESPONSE,
        ]
    )


def _matrix(name: str, rows: Floats, comment: str) -> str:
    inner = "; ...\n".join(f"    {', '.join(map(repr, row))}" for row in rows.tolist())
    return f"% {comment}\n{name} = [ ...\n{inner} ...\n];"


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
trim = thrust \\ [m * g * l * cos(theta_0) + K_s * theta_0; 0];  % V

% State feedback"""

_CHECK = """placed = eig(A - B * K);
pole_error = 0;  % largest distance between these and the poles, matched one to one, rad/s
left = placed;
for k = 1:4
    [distance, nearest] = min(abs(left - poles(k)));
    pole_error = max(pole_error, distance);
    left(nearest) = [];
end
fprintf('The placed poles are off by %.3g rad/s.\\n', pole_error);
"""

_INTEGRATING = """% The whole loop: u = -K x + P e + I z + F r with e = r - C x and z' = e
law = [-K - P * C, I_z];
law_of_reference = P + F;
A_loop = [A, zeros(4, 2); -C, zeros(2)] + [B; zeros(2)] * law;
B_loop = [B * law_of_reference; eye(2)];
loop_poles = eig(A_loop);
"""

_STATIC = """% The whole loop: u = -K x + P e + F r with e = r - C x
law = -K - P * C;
law_of_reference = P + F;
A_loop = A + B * law;
B_loop = B * law_of_reference;
loop_poles = eig(A_loop);
"""

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
end

if ~exist('no_plots', 'var') || ~no_plots
    figure;
    subplot(2, 1, 1); plot(t, [theta, psi] * 180 / pi); grid on;
    ylabel('angle, deg'); legend('theta', 'psi');
    subplot(2, 1, 2); plot(t, [V_p, V_y]); grid on;
    ylabel('voltage from trim, V'); xlabel('t, s'); legend('V_p', 'V_y');
end
% With the Control System Toolbox: loop = ss(A_loop, B_loop, [eye(2, n); law], [zeros(2); law_of_reference]);
% In Octave keep it an ss: bode draws a tf with poles at 0 lower by 360 degrees, isstable of a 2x2 tf cancels poles.
"""

FORMAT = Format("matlab", "Script for MATLAB and Octave", ".m", "text/x-matlab; charset=utf-8", render)
