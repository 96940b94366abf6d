"""`heli2dof lab …`: labs written, checked, tried and marked, as files of one's own or those that ship."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .lab_files import LabFile, opened
from .lab_scorm import scorm
from .output import load_kernels, print_json, refusals, show

if TYPE_CHECKING:
    from heli2dof_core.labs import Lab, Marked, Step, Told
    from heli2dof_core.tables import Table

_JSON = click.option("--json", "as_json", is_flag=True, help="Print JSON.")
_SEED = click.option(
    "--seed", type=click.IntRange(0, 2**63 - 1), default=0, show_default=True, help="The student's."
)


_LAB = click.argument("lab", type=LabFile())


@click.group()
def lab() -> None:
    """Labs: steps with goals and questions, each student's rig their own.

    A lab is a text file, YAML with Markdown (docs/labs.md). Where LAB is asked for, give a file, or the name of a lab
    that ships.
    """


lab.add_command(scorm)


@lab.command()
@click.argument("file", type=click.Path(dir_okay=False, path_type=Path))
def new(file: Path) -> None:
    """Write a lab to begin with to FILE, with a word on each field.

    It passes `check` as it is. An existing file is left alone.
    """
    from heli2dof_core.labs.template import new_lab

    if not file.suffix:
        file = file.with_suffix(".yaml")
    name = _name(file.stem)
    if name != file.stem:
        raise click.BadParameter(
            f"{file.stem!r} is no name of a lab; use lower-case letters, digits and hyphens: {name or 'my-lab'}",
            param_hint="FILE",
        )
    try:
        with file.open("x", encoding="utf-8") as target:
            target.write(new_lab(name))
    except FileExistsError:
        raise click.BadParameter(f"{file} exists already; choose another name", param_hint="FILE") from None
    except OSError as error:
        raise click.ClickException(f"{file} cannot be written: {error.strerror}") from None
    click.echo(f"{file} is written. `heli2dof lab check {file}` says what is wrong with it, `try` shows it.")


def _name(text: str) -> str:
    words = "".join(c if c.isascii() and c.isalnum() else "-" for c in text.lower())
    return "-".join(filter(None, words.split("-")))[:40]


@lab.command()
@click.argument("labs", nargs=-1, required=True, type=LabFile())
@click.option("--strict", is_flag=True, help="Warnings count as errors.")
@_JSON
def check(labs: tuple[Path, ...], strict: bool, as_json: bool) -> None:
    """Tell all that is wrong with LABS, each with line and column.

    Solutions are tried on the rig as it is printed and on a few students'. The exit status is 0, or 2 where there are
    errors.
    """
    from heli2dof_core.labs import LabError, problems_of
    from heli2dof_core.labs.library import named_as, text_of

    found = []
    for path in labs:
        try:
            text = text_of(path)
            if _is_read(
                text
            ):  # nothing of a broken file is tried, so that it is told before kernels are compiled
                load_kernels()
            problems = (*problems_of(text), *named_as(text, path.stem))
        except LabError as error:
            problems = error.problems
        except OSError as error:
            raise click.ClickException(f"{path} cannot be read: {error.strerror}") from None
        found += [(path, problem) for problem in sorted(problems)]
    if as_json:
        print_json([{"file": str(path), **vars(problem)} for path, problem in found])
    else:
        for path, problem in found:
            click.echo(f"{path}:{problem}")
        errors = sum(problem.severity == "error" for _, problem in found)
        click.echo(
            f"{_count(len(labs), 'file')}, {_count(errors, 'error')}, {_count(len(found) - errors, 'warning')}"
        )
    if any(strict or problem.severity == "error" for _, problem in found):
        raise click.exceptions.Exit(2)


def _is_read(text: str) -> bool:
    from heli2dof_core.labs import LabError, read_lab

    try:
        read_lab(text)
    except LabError:
        return False
    return True


def _count(n: float, what: str) -> str:
    return f"{n:g} {what}{'' if n == 1 else 's'}"


@lab.command("try")
@_LAB
@_SEED
@click.option("--step", "only", help="This step alone.")
@click.option(
    "--design", type=click.File(encoding="utf-8"), help="A design's JSON, in place of the solution."
)
@click.option(
    "--answer", "answers", multiple=True, metavar="NAME=TEXT", help="To a question; may be repeated."
)
@_JSON
def try_(
    lab: Path, *, seed: int, only: str | None, design: Any, answers: tuple[str, ...], as_json: bool
) -> None:
    """Show LAB as the student of a seed has it: their rig, the steps' texts, what start and solution reach."""
    from heli2dof_core.labs import mark, right_answers, student_rig
    from heli2dof_core.labs.bodies import body_of_flat
    from heli2dof_core.labs.flights import tried_flight
    from heli2dof_core.labs.rigs import handed_in, solution_flat, start_flat

    with refusals(as_json):
        known = opened(lab)
        given = None if design is None else _design(_json_of(design, "--design"))
        answered = dict(_assignment(answer) for answer in answers)
        steps = known.steps if only is None else (known.step(only),)
        load_kernels()
        rig = student_rig(known, seed)
        found: list[tuple[Step, Marked, Marked | None, dict[str, Any]]] = []
        for step in steps:
            begun = body_of_flat(start_flat(known, step, rig))
            start = mark(known, step.name, rig, begun, {}, seed=seed, flight=tried_flight(step, begun))
            flat = solution_flat(known, step, rig, seed) if given is None else None
            body = given if flat is None else body_of_flat(flat)
            own = None
            if body is not None:
                judged = body_of_flat(handed_in(known, step, rig, body)[0])
                flight = tried_flight(step, judged)
                own = mark(known, step.name, rig, body, answered, seed=seed, flight=flight)
            key = right_answers(known, step.name, rig, start.body if body is None else body, seed=seed)
            found.append((step, start, own, key))
        if as_json:
            return print_json(
                {
                    "rig": rig,
                    "steps": [
                        {
                            "step": s.name,
                            "start": a.as_dict(),
                            "right": right,
                            **({"design": b.as_dict()} if b else {}),
                        }
                        for s, a, b, right in found
                    ],
                }
            )
        show([_rig_table(known, rig, seed)], _heading(known))
        for step, start, own, key in found:
            click.echo(f"── {step.name}: {step.title}\n\n{step.text}\n")
            show(_tried(start, own, "design" if given is not None else "solution", key))
            for note in _notes(step, own):
                click.echo(note)
    return None


def _heading(lab: Lab) -> str:
    minutes = f", {lab.minutes} minutes" if lab.minutes else ""
    return f"{lab.title}: {_count(len(lab.steps), 'step')}, {lab.points:g} points{minutes}.\n\n{lab.text}\n"


def _rig_table(lab: Lab, rig: Mapping[str, Any], seed: int) -> Table:
    from heli2dof_core.labs.bodies import PATHS, flat_body
    from heli2dof_core.labs.rigs import lab_rig, path_of_varied
    from heli2dof_core.tables import Table, number

    printed, own = flat_body(lab_rig(lab)), flat_body(rig)
    rows = [
        (name, number(printed[path]), number(own[path]), PATHS[path][1].quantity.unit, f"± {100 * share:g} %")
        for name, share in lab.vary.items()
        for path in [path_of_varied(name)]
    ]
    return Table.of(f"rig of seed {seed}", ("value", "as printed", "here", "unit", "varies"), rows)


def _tried(start: Marked, own: Marked | None, called: str, key: Mapping[str, Any]) -> Iterator[Table]:
    from heli2dof_core.tables import Table

    heads = ("goal", "required", "start", "", *((called, "") if own else ()), "points")
    rows = []
    for i, told in enumerate(start.goals):
        more = () if own is None else (own.goals[i].value_text, _sign(own.goals[i]))
        rows.append((told.label, told.required_text, told.value_text, _sign(told), *more, f"{told.of:g}"))
    if rows:
        yield Table.of("goals", heads, rows)
    asked = [
        (q.name, q.label, _right(key[q.name]), q.value_text, _sign(q), f"{q.of:g}")
        for q in (own or start).questions
    ]
    if asked:
        yield Table.of("questions", ("name", "question", "right", "answer", "", "points"), asked)


def _right(answer: Mapping[str, Any]) -> str:
    """A question's right answer in words."""
    from heli2dof_core.tables import number

    if "unit" in answer:
        return f"{number(answer.get('value'))} {answer['unit']}".rstrip()
    return ", ".join(map(str, answer["answer"])) if "answer" in answer else answer["sample"] or "—"


def _sign(told: Told) -> str:
    return {True: "✓", False: "✕", None: "?"}[told.met]


def _notes(step: Step, own: Marked | None) -> Iterator[str]:
    yield from (
        f"hint {i} ({_count(hint.cost, 'point')}): {hint.text}" for i, hint in enumerate(step.hints, 1)
    )
    if own is None:
        yield "There is no solution to try."
        return
    if own.ignored:
        yield f"Locked, and taken from the start: {', '.join(own.ignored)}."
    for told in (*own.goals, *own.questions):
        if told.message and told.met is False and told.message != "No answer.":
            yield f"{told.name}: {told.message}"
    yield f"{own.points:g} of {own.of:g} points" + (
        f", {own.by_hand:g} of them by hand." if own.by_hand else "."
    )
    yield ""


@lab.command("mark")
@_LAB
@click.argument("attempts", type=click.File(encoding="utf-8"))
@_SEED
@click.option("--step", help="Of the attempt, where it does not say so itself.")
@_JSON
def mark_(lab: Path, attempts: Any, seed: int, step: str | None, as_json: bool) -> None:
    """Mark ATTEMPTS at LAB, a JSON file: one attempt or a list of them.

    An attempt is {"step", "seed", "design", "answers", "hints", "flight", "name"}; a design alone will do where
    --step and --seed say the rest. `-` reads from standard input.
    """
    from heli2dof_core.labs import mark, student_rig

    with refusals(as_json):
        known, given = opened(lab), _json_of(attempts, "ATTEMPTS")
        load_kernels()
        rows = []
        for i, each in enumerate(given if isinstance(given, list) else [given], 1):
            attempt = _attempt(each, i, seed, step)
            own = attempt["seed"]
            rig = student_rig(known, own)
            told = mark(
                known,
                attempt["step"],
                rig,
                attempt["design"],
                attempt["answers"],
                hints=attempt["hints"],
                seed=own,
                flight=attempt["flight"],
            )
            rows.append((attempt["name"], own, told))
        if as_json:
            return print_json([{"name": name, "seed": own, **told.as_dict()} for name, own, told in rows])
        show([_marks_table(rows)])
    return None


def _design(body: Any) -> dict[str, Any]:
    """A design that the REST API would take."""
    from ..contract.experiment import StepRequest

    StepRequest.model_validate(body)
    return body


def _attempt(given: Any, place: int, seed: int, step: str | None) -> dict[str, Any]:
    from heli2dof_core import InvalidInputError

    if not isinstance(given, dict):
        raise InvalidInputError(
            f"attempt {place} is no JSON object", field="ATTEMPTS", hint='Give {"step", "design"}.'
        )
    own = given if "design" in given or "answers" in given else {"design": given}
    found = {
        "name": str(own.get("name", place)),
        "seed": own.get("seed", seed),
        "step": own.get("step", step),
    }
    found |= {
        "design": _design(own.get("design") or {}),
        "answers": own.get("answers") or {},
        "hints": own.get("hints") or [],
        "flight": own.get("flight"),
    }
    if found["step"] is None:
        raise InvalidInputError(
            f"attempt {place} names no step", field="step", hint="Give --step, or its field step."
        )
    kinds = {"seed": int, "step": str, "design": dict, "answers": dict, "hints": list}
    kinds |= {} if found["flight"] is None else {"flight": dict}
    for name, kind in kinds.items():
        if not isinstance(found[name], kind) or isinstance(found[name], bool):
            raise InvalidInputError(
                f"{name} of attempt {place} is {found[name]!r}", field=name, hint="See --help."
            )
    return found


def _marks_table(rows: Sequence[tuple[str, int, Marked]]) -> Table:
    from heli2dof_core.tables import Table

    cells = [
        (
            name,
            str(seed),
            told.step,
            " ".join(f"{_sign(each)} {each.name} {each.value_text}".rstrip() for each in told.goals) or "—",
            " ".join(f"{_sign(each)} {each.name}" for each in told.questions) or "—",
            f"{told.points:g} of {told.of:g}",
        )
        for name, seed, told in rows
    ]
    return Table.of("marks", ("attempt", "seed", "step", "goals", "questions", "points"), cells)


@lab.command()
def schema() -> None:
    """Print the format's JSON schema, for an editor's completion.

    Beside a lab write it to schema.json and begin the lab with `# yaml-language-server: $schema=schema.json`.
    """
    from heli2dof_core.labs.schema import schema_text

    click.echo(schema_text(), nl=False)


@lab.command()
@_JSON
def figures(as_json: bool) -> None:
    """List what goals may require and questions may ask for, what can be locked, and the labs that ship."""
    from heli2dof_core.labs import LOCKS, shipped_labs
    from heli2dof_core.labs.quantities import QUANTITIES
    from heli2dof_core.measured import MEASURED
    from heli2dof_core.tables import Table

    if as_json:
        return print_json(
            {
                "figures": [
                    {"name": name, "of": own.of, "unit": own.figure.unit, "meaning": own.figure.meaning}
                    for name, own in MEASURED.items()
                ],
                "quantities": [
                    {"name": own.form, "unit": own.unit, "meaning": own.meaning}
                    for own in QUANTITIES.values()
                ],
                "locks": {name: [*paths] for name, paths in LOCKS.items()},
            }
        )
    of = [
        (name, own.of, own.figure.shown or own.figure.unit, own.figure.meaning)
        for name, own in MEASURED.items()
    ]
    asked = [(own.form, own.unit, own.meaning) for name, own in QUANTITIES.items() if name not in MEASURED]
    locks = [(name, ", ".join(paths) or "of the page alone") for name, paths in LOCKS.items()]
    labs = [(name, own.title, f"{own.points:g}") for name, own in shipped_labs().items()]
    show(
        (
            Table.of("figures, for goals and questions", ("figure", "of", "unit", "what it is"), of),
            Table.of("further quantities, for questions", ("quantity", "unit", "what it is"), asked),
            Table.of("locks", ("lock", "what of a design it holds"), locks),
            *((Table.of("labs that ship", ("lab", "title", "points"), labs),) if labs else ()),
        )
    )
    return None


def _json_of(file: Any, what: str) -> Any:
    from heli2dof_core import InvalidInputError

    try:
        return json.load(file)
    except ValueError as error:
        raise InvalidInputError(f"{what} is no JSON: {error}", field=what, hint="Give a JSON file.") from None


def _assignment(text: str) -> tuple[str, str]:
    name, mark_of, answer = text.partition("=")
    if not mark_of:
        raise click.BadParameter(f"{text!r} gives no answer; write slowest=-3,2", param_hint="--answer")
    return name, answer
