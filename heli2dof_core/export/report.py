"""A laboratory report: one HTML page to print, with formulas, plots, figures of merit and findings, and no script."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from math import degrees
from typing import TYPE_CHECKING

import numpy as np

from ..design import Design
from ..evaluate import Report, evaluate
from ..parameters import PARAMETER_INFO
from ..placement.registry import METHODS
from ..scenario import Model
from ..signals import AXES, INPUTS, OUTPUTS, ROTORS, Floats
from ..simulation.response import Response
from ..spec import Spec
from ..templates import templates_beside
from .format import NOTHING, Beside, Format
from .origin import origin, preset_of
from .report_figures import margins, merit
from .report_formulas import formulas
from .report_machine import words
from .report_pins import pinned
from .report_required import required
from .report_style import STYLE
from .svg import Curve, Marks, chart, number, pole_map

if TYPE_CHECKING:  # would be imported before the first page
    from jinja2 import Environment

_NAMES = ("p₁", "p₂", "p₃", "p₄", "p₅", "p₆")


def render(spec: Spec, link: str = "", beside: Beside = NOTHING) -> str:
    """The page; figures and words are those of `evaluate`."""
    report, preset = evaluate(spec, each_axis=True), preset_of(spec)
    rig = words(spec, report)
    # what makes it long: rows of pins, a machine's tables and words, six states' formulas
    load = (
        bool(beside.pins) + bool(rig["machine"] or rig["feedback"]) + (report.design.rotor_poles is not None)
    )
    return (
        _templates()
        .get_template("report.html.jinja")
        .render(
            title=f"Pole placement: {preset.title}",
            source=preset.source,
            link=link,
            style=STYLE,
            spec=spec,
            report=report,
            method=METHODS[spec.method],
            parameters=_parameters(spec),
            trim=_trim(report),
            placed=_placed(report.design),
            outer=_outer(spec, report),
            pole_map=_pole_map(report),
            loop_poles=[(str(i), pole(p)) for i, p in enumerate(report.loop.poles.tolist(), 1)],
            formulas=formulas(report.design),
            experiment=_experiment(spec, report),
            responses=_responses(spec, report),
            merit=merit(report),
            margins=margins(report),
            origin=origin(spec, FORMAT.name, link),
            rig=rig,
            load=load,
            pins=pinned(beside.pins),
            required=required(report, beside.required),
            remarks=beside.remarks,
        )
    )


@cache
def _templates() -> Environment:
    return templates_beside(__file__, number=number, degrees=degrees, inner=_inner, displayed=_displayed)


def pole(p: complex) -> str:
    """A pole for people."""
    if not p.imag:
        return number(p.real, 6)
    return f"{number(p.real, 6)} {'−' if p.imag < 0 else '+'} {number(abs(p.imag), 6)}j"


def _parameters(spec: Spec) -> list[tuple[str, ...]]:
    values = spec.parameters.as_dict().items()
    return [
        (name, info.meaning, number(value, 6), info.unit)
        for (name, value), info in zip(values, PARAMETER_INFO.values(), strict=True)
    ]


def _trim(report: Report) -> str:
    volts = zip(INPUTS, report.design.trim.tolist(), strict=True)
    return ", ".join(f"{signal.symbol} = {number(value, 5)} V" for signal, value in volts)


def _placed(design: Design) -> list[tuple[str, ...]]:
    """The placed poles, after those that were asked for and with the distance from them where there were any."""
    found = design.closed_loop_poles.tolist()
    if not design.aims:
        return [(name, pole(p)) for name, p in zip(_NAMES, found, strict=False)]
    return [
        (name, pole(p), pole(q), number(abs(p - q), 2))
        for name, p, q in zip(_NAMES, design.wanted.tolist(), found, strict=False)
    ]


def _pole_map(report: Report) -> str:
    groups = [
        Marks(report.design.closed_loop_poles.tolist(), "cross", _NAMES),
        Marks(report.loop.poles.tolist(), "plus"),
        Marks(report.design.plant.poles.tolist(), "circle"),
    ]
    return pole_map("Poles in the s-plane", groups)


def _outer(spec: Spec, report: Report) -> str:
    outer = spec.outer
    if report.design.integral is not None:
        return "The method brings its own integral action; there are no PI loops."
    if outer.outer == "none":
        return "No outer loop: v = Ĝ(0)⁻¹ r."
    gains = "; ".join(
        f"{axis} {number(pi.kp, 5)} V/rad · (1 + 1/({number(pi.ti, 5)} s · s))"
        for axis, pi in zip(AXES, (outer.pitch, outer.yaw), strict=True)
    )
    return f"PI loops, {outer.pairing} pairing{', with the static decoupler' if outer.decoupler else ''}: {gains}."


def _inner(mathml: str) -> str:
    """What a whole math element holds."""
    return mathml[mathml.index(">") + 1 : mathml.rindex("</math>")]


def _displayed(mathml: str) -> str:
    """The math element with fractions of full size."""
    return mathml.replace("<math ", '<math displaystyle="true" ', 1)


def _responses(spec: Spec, report: Report) -> list[tuple[str, str]]:
    """Drawings and their captions."""
    trim, reference = report.design.trim, report.step["nonlinear"].response.reference
    bounds, pictures = (spec.limits.V_p, spec.limits.V_y), []
    for i, signal in enumerate(OUTPUTS):
        curves = [Curve(t, np.degrees(response.angles[i]), kind) for t, response, kind in _traces(report)]
        curves.append(Curve(curves[0].x, np.full(len(curves[0].x), degrees(reference[i])), "mark"))
        pictures.append((chart(signal.meaning, "t, s", f"{signal.symbol}, °", curves), signal.meaning))
    for i, signal in enumerate(INPUTS):
        curves = [
            Curve(t, r.voltages[i] + (trim[i] if r.model == "linear" else 0.0), kind)
            for t, r, kind in _traces(report)
        ]
        if spec.scenario.saturation:
            solid = [c.y for c in curves if c.kind in AXES]
            near = [b for b in (-bounds[i], bounds[i]) if max(float(np.max(y / b)) for y in solid) > 0.8]
            curves += [Curve(curves[0].x, np.full(len(curves[0].x), bound), "mark") for bound in near]
        pictures.append((chart(signal.meaning, "t, s", f"{signal.symbol}, V", curves), signal.meaning))
    return [*pictures, *_speeds(report)]


def _speeds(report: Report) -> Iterator[tuple[str, str]]:
    """Drawings of the speeds of the rotors that lag, and their captions."""
    actuators, trim = report.design.actuators, report.design.trim
    for i, signal in enumerate(ROTORS):
        if actuators is None or not actuators.tau[i]:
            continue
        curves = [
            Curve(t, r.rotors[i] + (trim[i] if r.model == "linear" else 0.0), kind)
            for t, r, kind in _traces(report)
            if r.rotors is not None
        ]
        yield chart(signal.meaning, "t, s", f"{signal.symbol}, V", curves), signal.meaning


def _traces(report: Report) -> Iterator[tuple[Floats, Response, str]]:
    """The page's curves, those of the linear model below; without any step the rig at rest."""
    steps = report.axis_steps
    models: tuple[tuple[Model, str], ...] = (("linear", "-linear"), ("nonlinear", ""))
    for model, suffix in models:
        for axis, signal in zip(AXES, OUTPUTS, strict=True):
            if signal.name in steps:
                response = steps[signal.name][model].response
                yield response.t, response, axis + suffix
    if not steps:
        rest = report.step["nonlinear"].response
        yield rest.t, rest, "pitch"


def _experiment(spec: Spec, report: Report) -> str:
    scenario = spec.scenario
    rig = report.step["nonlinear"].response
    steps = ", ".join(
        f"{axis} step from {number(degrees(a))}° to {number(degrees(b))}°"
        for axis, signal, a, b in zip(AXES, OUTPUTS, rig.start, rig.reference, strict=True)
        if signal.name in report.axis_steps
    )
    parts = [f"Each axis stepped alone at t = 0: {steps}" if steps else "No step: the rig rests"]
    parts.append("voltages limited" if scenario.saturation else "voltages unlimited")
    if scenario.saturation and report.loop.has_integrators:
        parts.append(f"anti-windup: {scenario.anti_windup}")
    if not scenario.trim_feedforward:
        parts.append("without the trim voltages")
    if scenario.controller is not None:
        parts.append(f"digital controller, {number(1e3 * scenario.controller.sample_time)} ms")
    if any(scenario.noises):
        theta, psi = (number(degrees(deviation)) for deviation in scenario.noises)
        parts.append(f"white noise on the measured angles, standard deviations {theta}° and {psi}°")
    if scenario.disturbance is not None:
        d = scenario.disturbance
        parts.append(f"disturbed by {number(d.V_p)} V and {number(d.V_y)} V from {number(d.time)} s on")
    return "; ".join(parts) + "."


FORMAT = Format(
    "report",
    "Laboratory report, to print",
    ".html",
    "text/html; charset=utf-8",
    render,
    "heli2dof_report",
    render,
)
