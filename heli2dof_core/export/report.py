"""A laboratory report: one HTML page to print, with formulas, plots, figures of merit and findings, and no script."""

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from math import degrees
from typing import TYPE_CHECKING, Any

import numpy as np

from ..couplings import Structure
from ..evaluate import Report, evaluate
from ..parameters import PARAMETER_INFO
from ..placement.registry import METHODS
from ..scenario import Model
from ..signals import AXES, INPUTS, OUTPUTS, Floats
from ..simulation.response import Response
from ..spec import Spec
from .format import Format
from .markup import figure, formula, indexed, matrix, paragraph, pole, section, table
from .origin import origin, preset_of
from .report_figures import merit
from .report_style import STYLE
from .svg import Curve, Marks, chart, number, pole_map

if TYPE_CHECKING:  # it would import SymPy before the first page
    from ..symbolic.render import Formula


def render(spec: Spec, link: str = "") -> str:
    """The page; figures and words are those of `evaluate`."""
    report, preset = evaluate(spec, each_axis=True), preset_of(spec)
    title = f"Pole placement: {preset.title}"
    opened = (
        f'<p class="about">This design, live: <a href="{escape(link)}">{escape(link)}</a></p>' if link else ""
    )
    return "".join(
        [
            '<!doctype html><html lang="en"><head><meta charset="utf-8">',
            f"<title>{escape(title)}</title>",
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            f"<style>{STYLE}</style></head><body>",
            f"<header><h1>{escape(title)}</h1>",
            paragraph(preset.source, "about"),
            opened,
            '<p class="fields"><span>Name</span><span>Date</span></p></header><main>',
            section("Rig", *_rig(spec, report)),
            section("Design", *_design(spec, report)),
            section("Formulas", *_formulas(spec)),
            section("Responses", *_responses(spec, report)),
            section("Figures of merit", *merit(report)),
            section("Findings", *_findings(report)),
            section("Origin", f"<pre>{escape(chr(10).join(origin(spec, FORMAT.name, link)))}</pre>"),
            "</main></body></html>\n",
        ]
    )


def _rig(spec: Spec, report: Report) -> Iterator[str]:
    rows = [
        (name, info.meaning, number(value, 6), info.unit)
        for (name, value), info in zip(
            spec.parameters.as_dict().items(), PARAMETER_INFO.values(), strict=True
        )
    ]
    yield table(("", "meaning", "value", "unit"), rows)
    trim = ", ".join(
        f"{s.symbol} = {number(v, 5)} V"
        for s, v in zip(INPUTS, report.design.plant.trim.tolist(), strict=True)
    )
    travel = spec.limits.theta
    free = "free" if travel is None else f"±{number(degrees(travel))}°"
    yield paragraph(
        f"Operating point θ₀ = {number(degrees(spec.theta_0))}°, held by {trim}. Limits: |V_p| ≤ "
        f"{number(spec.limits.V_p)} V, |V_y| ≤ {number(spec.limits.V_y)} V; pitch travel {free}."
    )


def _design(spec: Spec, report: Report) -> Iterator[str]:
    design, method = report.design, METHODS[spec.method]
    structure = ""
    if design.structure is not None:
        lead = f", {design.structure.lead} leads" if design.structure.coupling == "triangular" else ""
        structure = f"; {design.structure.coupling}{lead}"
    yield paragraph(f"Method: {method.title}{structure}. Source: {method.source}")
    names = [f"p{chr(0x2081 + i)}" for i in range(4)]
    found = design.closed_loop_poles.tolist()
    if design.aims:
        rows = [
            (name, pole(p), pole(q), number(abs(p - q), 2))
            for name, p, q in zip(names, design.poles.values, found, strict=True)
        ]
        yield table(("", "requested, rad/s", "placed, rad/s", "distance, rad/s"), rows)
    else:
        yield table(("", "chosen by the method, rad/s"), list(zip(names, map(pole, found), strict=True)))
    yield matrix("<mi>K</mi>", design.K)
    yield paragraph(
        "u = −Kx + v with x = [θ, ψ, θ̇, ψ̇], in V/rad and V·s/rad. "
        f"Frobenius norm {number(design.norm, 5)}, mixed units."
    )
    rga = report.interaction.rga
    if rga is not None:
        yield matrix("<mi mathvariant='normal'>RGA</mi>", rga, 5)
    yield paragraph(report.interaction.reason)
    yield paragraph(_outer(spec, report))
    groups = [
        Marks(found, "cross", names),
        Marks(report.loop.poles.tolist(), "plus"),
        Marks(design.plant.poles.tolist(), "circle"),
    ]
    words = "× placed poles, + poles of the whole loop, ○ poles of the rig alone"
    parts = figure(pole_map("Poles in the s-plane", groups), words)
    whole = table(
        ("", "rad/s"),
        [(str(i + 1), pole(p)) for i, p in enumerate(report.loop.poles.tolist())],
        "Poles of the whole loop",
    )
    yield f'<div class="plots">{parts}<div>{whole}</div></div>'


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


def _formulas(spec: Spec) -> Iterator[str]:
    from ..symbolic.render import symbolic_report  # SymPy: on first use

    symbols = symbolic_report(spec.structure.family)
    yield paragraph("Linear model ẋ = Ax + Bu about rest at θ₀:", "before")
    for name in ("A", "B"):
        yield formula(f"<mi>{name}</mi>", symbols.formulas[name].mathml)
    if spec.method == "full-rank":
        shift = spec.structure.shift
        gains, relative = symbols.entries["K"], symbols.entries["RGA"]["lambda_11"]
        if shift is not None:
            gains, relative = _shifted(spec.structure.family)
            yield paragraph(
                f"Gain of the state feedback, with the basis' shift c = {number(shift, 6)}:", "before"
            )
        else:
            yield paragraph("Gain of the state feedback:", "before")
        for name, entry in gains.items():
            yield formula(indexed("k", name.removeprefix("k_")), entry.mathml)
        yield paragraph("Relative gain at s = 0:", "before")
        yield formula(indexed("λ", "11"), relative.mathml)
    else:
        yield paragraph(f"K is computed in numbers by the method {METHODS[spec.method].title}.")
    yield paragraph("With the abbreviations", "before")
    for name, definition in symbols.definitions.items():
        if name in symbols.notation:
            yield formula(_inner(symbols.notation[name].mathml), definition.mathml)


def _shifted(structure: Structure) -> tuple[dict[str, Formula], Formula]:
    """K's entries and λ₁₁ with the shift as a symbol, and no more: all else with it takes SymPy a minute."""
    from ..symbolic.full_rank import full_rank
    from ..symbolic.grouping import group
    from ..symbolic.render import formula
    from ..symbolic.rga import relative_gain_array

    K: Any = full_rank(structure, shifted=True).K.to_Matrix()  # SymPy's entries are dynamic
    relative: Any = relative_gain_array(structure, shifted=True).to_Matrix()
    entries = {f"k_{i + 1}{j + 1}": formula(group(K[i, j])) for i in range(2) for j in range(4)}
    return entries, formula(group(relative[0, 0]))


def _inner(mathml: str) -> str:
    """What a whole math element holds."""
    return mathml[mathml.index(">") + 1 : mathml.rindex("</math>")]


def _responses(spec: Spec, report: Report) -> Iterator[str]:
    yield paragraph(_experiment(spec, report))
    trim, reference = report.design.plant.trim, report.step["nonlinear"].response.reference
    bounds, pictures = (spec.limits.V_p, spec.limits.V_y), []
    for i, signal in enumerate(OUTPUTS):
        curves = [Curve(t, np.degrees(response.angles[i]), kind) for t, response, kind in _traces(report)]
        curves.append(Curve(curves[0].x, np.full(len(curves[0].x), degrees(reference[i])), "mark"))
        pictures.append(figure(chart(signal.meaning, "t, s", f"{signal.symbol}, °", curves), signal.meaning))
    for i, signal in enumerate(INPUTS):
        curves = [
            Curve(t, r.voltages[i] + (trim[i] if r.model == "linear" else 0.0), kind)
            for t, r, kind in _traces(report)
        ]
        if spec.scenario.saturation:
            solid = [c.y for c in curves if c.kind in AXES]
            near = [b for b in (-bounds[i], bounds[i]) if max(float(np.max(y / b)) for y in solid) > 0.8]
            curves += [Curve(curves[0].x, np.full(len(curves[0].x), bound), "mark") for bound in near]
        pictures.append(figure(chart(signal.meaning, "t, s", f"{signal.symbol}, V", curves), signal.meaning))
    yield f'<div class="plots">{"".join(pictures)}</div>'
    yield paragraph(
        "Thick: pitch step; thin: yaw step, each alone on the nonlinear rig. Dashed and dotted: the same by the "
        "linear model, without limits, the trim added to its voltages, where it fits in the picture. Grey: "
        "references and voltage limits.",
        "about",
    )


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
    if scenario.digital is not None:
        parts.append(f"digital controller, {number(1e3 * scenario.digital.sample_time)} ms")
    if scenario.disturbance is not None:
        d = scenario.disturbance
        parts.append(f"disturbed by {number(d.V_p)} V and {number(d.V_y)} V from {number(d.time)} s on")
    return "; ".join(parts) + "."


def _findings(report: Report) -> Iterator[str]:
    if not report.findings:
        yield paragraph("No warnings.")
        return
    items = "".join(f"<li><b>{escape(f.severity)}:</b> {escape(f.message)}</li>" for f in report.findings)
    yield f"<ul>{items}</ul>"


FORMAT = Format(
    "report", "Laboratory report, to print", ".html", "text/html; charset=utf-8", render, "heli2dof_report"
)
