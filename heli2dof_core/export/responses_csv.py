"""Both models' responses as numbers, one row per sample."""

from __future__ import annotations

from collections.abc import Iterator

from ..evaluate import evaluate
from ..loop import Loop
from ..signals import INPUTS, OUTPUTS, ROTORS, Signal
from ..spec import Spec
from .format import Format
from .machine import estimated_in_words
from .origin import origin


def render(spec: Spec, link: str = "") -> str:
    """Comma-separated values behind lines that begin with #; units in the header."""
    report = evaluate(spec)
    columns = [("t [s]", report.step["linear"].response.t)]
    references = report.step["linear"].response.reference
    columns += [
        (f"{signal.name}_reference [{signal.unit}]", columns[0][1] * 0 + value)
        for signal, value in zip(OUTPUTS, references, strict=True)
    ]
    for model, step in report.step.items():
        columns += [
            (f"{signal.name}_{model}{_unit(signal)}", values) for signal, values in step.response.by_signal()
        ]
    trim = ", ".join(f"{s.name} = {v!r} V" for s, v in zip(INPUTS, report.design.trim.tolist(), strict=True))
    lines = [
        *(f"# {line}" for line in origin(spec, FORMAT.name, link)),
        f"# Linear voltages are deviations from the trim, {trim}; those of the nonlinear rig hold it.",
        *(f"# {line}" for line in _more_states(report.loop)),
        ",".join(name for name, _ in columns),
        *(",".join(map(repr, row)) for row in zip(*(values.tolist() for _, values in columns), strict=True)),
    ]
    return "\n".join(lines) + "\n"


def _unit(signal: Signal) -> str:
    return f" [{signal.unit.replace('·', '*')}]" if signal.unit else ""


def _more_states(loop: Loop) -> Iterator[str]:
    """What the states are that the paper's rig does not have."""
    names = {signal.name for signal in loop.states}
    rotors = [signal.name for signal in ROTORS if signal.name in names]
    if rotors:
        yield f"Rotors' speeds {', '.join(rotors)} are told by the voltages that would hold them, and count alike."
    if loop.estimator is not None:
        yield f"Estimate in deviations from the trim. {estimated_in_words(loop.design, loop.estimator)}"


FORMAT = Format(
    "csv", "Responses as numbers", ".csv", "text/csv; charset=utf-8", render, "heli2dof_responses"
)
