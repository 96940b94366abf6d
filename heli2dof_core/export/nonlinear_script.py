"""The nonlinear rig under the loop, in MATLAB's and Octave's language: what `simulate_nonlinear` solves.

Anonymous functions alone: in a script MATLAB wants named ones at its end, and Octave before their use.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..kernels.layout import (
    ANTI_WINDUP,
    BACK,
    BACK_CALCULATION,
    BOUND,
    CLAMPING,
    FED,
    START,
    STOP,
    VOLTS,
)
from ..loop import Loop
from ..signals import Floats
from ..simulation.augmented import inner_start
from ..simulation.experiment import experiment
from ..spec import Spec
from .dialect import MATLAB

BAND = 1e-2
"""Volts beyond the limit within which clamping fades the integrals out: an abrupt stop would make solvers creep."""
CREEP = 1e-3
"""rad/s, below which an axis creeps where friction would hold it."""


def nonlinear_lines(spec: Spec, loop: Loop) -> Iterator[str]:
    """Lines that follow those of the linear loop, whose names they use."""
    x = experiment(loop, spec.limits, spec.scenario)
    integrals = 0 if loop.integral is None else 2
    lagging = 0 if loop.actuators is None else int((loop.actuators.tau > 0.0).sum())
    order = 0 if loop.estimator is None else loop.estimator.order
    yield "\n% The nonlinear rig under this loop: y = [theta; psi; theta_dot; psi_dot; z; v; w], absolute"
    if spec.scenario.controller is not None:
        yield "% The controller is continuous here: sampling, encoders and noise are left out."
    yield f"limit = {MATLAB.vector(x[BOUND:STOP].tolist())};  % of the voltages, V"
    yield f"travel = {float(x[STOP])!r};  % of pitch, to either side, rad"
    yield f"fed = {int(x[FED])};  % 1: the trim voltages are added"
    d = spec.scenario.disturbance
    yield f"push = {MATLAB.vector(x[VOLTS : VOLTS + 2].tolist())};  % V on the motors besides the controller's,"
    yield f"push_from = {np.inf if d is None else d.time!r};  % from this time on, s"
    held = f"zeros({integrals}, 1); " if integrals else ""
    rotors = "trim(tau > 0); " if lagging else ""
    yield f"held = [theta_0; 0; 0; 0; {held}{rotors}zeros({order}, 1)];  % deviations are from there"
    yield "asked = @(y) fed * trim + law * (y - held) + law_of_reference * reference;"
    yield "given = @(u) max(min(u, limit), -limit);"
    yield from _motors(loop, integrals, lagging)
    yield from _friction(loop)
    rubs = loop.actuators is not None and bool(loop.actuators.breakaway.any())
    yield _MECHANICS.format(friction=" + friction(y(3:4))" if rubs else "")
    parts = ["y(3:4)", "accelerations(y, u, d)"]
    if integrals:
        yield from _windup(loop, x)
        parts.append("integrated(asked(y), u, wanted - y(1:2))")
    if lagging:
        parts.append(f"lag * (late' * (u + d) - {_places(4 + integrals, lagging)})")
    if order:
        place = _places(4 + integrals + lagging, order)
        parts.append(f"F_w * {place} + G_w * (y(1:2) - [theta_0; 0]) + H_w * (u - trim)")
    yield f"rates = @(y, u, d) [{'; '.join(parts)}];"
    yield f"y = [{'; '.join(map(repr, _start(loop, x)))}];"
    yield _SOLVED


def _places(first: int, count: int) -> str:
    return f"y({first + 1}:{first + count})"


def _start(loop: Loop, x: Floats) -> list[float]:
    """The rig's states at t = 0; one that begins beyond a stop begins on it."""
    theta, *others = x[START:BOUND].tolist()
    angle = min(max(theta, -x[STOP]), x[STOP])
    rows = [float(angle), *others, 0.0, 0.0, *inner_start(loop, x)[1].tolist()]
    return [rows[place] for place in loop.places]


def _motors(loop: Loop, integrals: int, lagging: int) -> Iterator[str]:
    actuators = loop.actuators
    if actuators is not None and actuators.square.any():
        yield f"square = {MATLAB.vector(actuators.square.tolist())};  % of the thrust curves, 1/V; 0: linear"
        yield f"dead = {MATLAB.vector(actuators.dead_zone.tolist())};  % V"
        yield "acting = @(v) (square == 0) .* v + square .* sign(v) .* max(abs(v) - dead, 0) .^ 2;"
    else:
        yield "acting = @(v) v;"
    if lagging:
        yield f"speed = @(y, u, d) at_once * (u + d) + late * {_places(4 + integrals, lagging)};"
    else:
        yield "speed = @(y, u, d) u + d;"


def _friction(loop: Loop) -> Iterator[str]:
    actuators = loop.actuators
    if actuators is None or not actuators.breakaway.any():
        return
    yield f"moving = {MATLAB.vector(actuators.coulomb.tolist())};  % N m"
    yield f"at_rest = {MATLAB.vector(actuators.breakaway.tolist())};  % N m"
    yield f"creep = {CREEP!r};  % rad/s: slower than this an axis counts as held"
    yield (
        "friction = @(rate) -(moving + (at_rest - moving) .* exp(-(rate / creep) .^ 2)) .* tanh(10 * rate / creep);"
    )


def _windup(loop: Loop, x: Floats) -> Iterator[str]:
    """Rates of the integrals by what is asked, what is given, and the errors."""
    theta, psi = (repr(float(angle)) for angle in x[:2])
    yield f"wanted = [{theta}; {psi}];  % rad"
    kind, integral = int(x[ANTI_WINDUP]), loop.integral
    if kind == BACK_CALCULATION:
        yield MATLAB.matrix("back", x[BACK : BACK + 4].reshape(2, 2), "back-calculation, rad/(V s)")
        yield "integrated = @(u, u_given, e) e + back * (u_given - u);"
    elif kind == CLAMPING and integral is not None:
        drives = [int(abs(integral[1, i]) > abs(integral[0, i])) for i in range(2)]
        if len(loop.places) == 4:
            drives = [0, 1]
        yield f"of = [{drives[0] + 1}; {drives[1] + 1}];  % the motor that each integral drives in the main"
        yield f"gain = {MATLAB.vector([float(integral[drives[i], i]) for i in range(2)])};  % V/(rad s)"
        yield f"band = {BAND!r};  % V beyond the limit, within which clamping fades an integral out"
        yield "late_by = @(u) min(max((abs(u) - limit) / band, 0), 1);"
        yield "chosen = @(v) v(of);"
        yield (
            "integrated = @(u, u_given, e) e .* (1 - (gain .* e .* sign(chosen(u)) > 0) .* chosen(late_by(u)));"
        )
    else:
        yield "integrated = @(u, u_given, e) e;"


_MECHANICS = """inertia = @(y) [alpha; J_y + m * l^2 * cos(y(1))^2];
sway = @(y) m * l^2 * sin(y(1)) * cos(y(1));
others = @(y) [-B_p * y(3) - K_s * y(1) - sway(y) * y(4)^2 - m * g * l * cos(y(1)); ...
    -B_y * y(4) + 2 * sway(y) * y(3) * y(4)];
accelerations = @(y, u, d) (thrust * acting(speed(y, u, d)) + others(y){friction}) ./ inertia(y);"""

_SOLVED = """
% From stop to stop: pitch meets its stop without rebound and rests there while the torque presses
solver = @ode45;  % or another one that finds events
warning('off', 'integrate_adaptive:unexpected_termination');  % which Octave says at every stop
first = @(v) v(1);
on_rig = @(y, d) rates(y, given(asked(y)), d);
stopped = @(rate) [0; rate(2); 0; rate(4:end)];
pressing = @(y, d) first(accelerations([y(1); y(2); 0; y(4:end)], given(asked(y)), d));
side = sign(y(1)) * (abs(y(1)) >= travel);
found_t = t(1); found_y = y'; now = t(1);
while now < t(end)
    d = push * (now >= push_from);
    upto = t(end);
    if now < push_from && push_from < upto, upto = push_from; end
    if side ~= 0
        y(3) = 0;
        if side * pressing(y, d) < 0, side = 0; y(1) = y(1) * (1 - 1e-12); end
    end
    options = odeset('RelTol', 1e-7, 'AbsTol', 1e-9, 'MaxStep', 0.05);
    if side ~= 0
        way = @(s, y) stopped(on_rig(y, d));
        options = odeset(options, 'Events', @(s, y) deal(side * pressing(y, d), 1, -1));
    else
        way = @(s, y) on_rig(y, d);
        if isfinite(travel), options = odeset(options, 'Events', @(s, y) deal(travel - abs(y(1)), 1, -1)); end
    end
    [times, states] = solver(way, [now; t(t > now & t < upto); upto], y, options);
    found_t = [found_t; times(2:end)]; found_y = [found_y; states(2:end, :)];
    y = states(end, :)'; now = times(end);
    if side ~= 0
        if now < upto, side = 0; y(1) = y(1) * (1 - 1e-12); end
    elseif now < upto
        side = sign(y(1)); y(1) = side * travel;
    end
end
[found_t, at] = unique(found_t);
found_y = interp1(found_t, found_y(at, :), t);
theta_rig = found_y(:, 1); psi_rig = found_y(:, 2);
V_rig = zeros(numel(t), 2);
for k = 1:numel(t), V_rig(k, :) = given(asked(found_y(k, :)'))'; end
V_p_rig = V_rig(:, 1); V_y_rig = V_rig(:, 2);"""
