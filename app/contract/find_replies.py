"""What the finder replies: how far it is, and what it has found."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import isfinite

from pydantic import Field

from heli2dof_core.estimators import Observer
from heli2dof_core.figures.figure import Better
from heli2dof_core.finder import Candidate, Designs, Free, Give, Progress
from heli2dof_core.finder.result import consequence, gives_text, why_text
from heli2dof_core.many import Measure
from heli2dof_core.measured import Axis, Motor, Steps
from heli2dof_core.placement.method import Weights
from heli2dof_core.request import WEIGHTED
from heli2dof_core.requirements import Requirement, told_measure
from heli2dof_core.scenario import Model as RigModel
from heli2dof_core.signals import AXES
from heli2dof_core.spec import Spec

from .model import Complex, Model, Reply, poles_reply


class FindProgress(Model):
    """How far a search is."""

    done: bool = Field(description="false: more comes")
    tried: int = Field(description="of the designs")
    designs: int = Field(description="the budget")
    seconds: float
    met: int = Field(description="how many of those tried meet everything")
    points: list[list[float]] = Field(
        description="the front so far: the minimized figures of its designs, a row each, at most 100 that are spread "
        "along it; those alone that have a value of each"
    )


class ToldFigure(Model):
    """A figure that is told of every design."""

    measure: str
    axis: Axis | None = None
    motor: Motor | None = None
    model: RigModel | None = None
    steps: Steps | None = None
    title: str
    unit: str = Field(description="empty of ratios and shares, 0 to 1")
    better: Better
    minimized: bool


class ToldRequirement(Model):
    """A requirement."""

    figure: int = Field(description="its place among the figures")
    max: float | None = Field(None, description="at most, in the figure's unit")
    min: float | None = Field(None, description="at least, in the figure's unit")
    share: float | None = Field(None, description="least share of the uncertain rigs, 0 to 1")
    words: str
    limit: str


class FoundFigure(Model):
    """A figure of one design."""

    value: float | None = Field(None, description="left out where there is none, or no limit")
    text: str


class FoundRequirement(Model):
    """A requirement of one design."""

    met: bool
    share: float | None = Field(None, description="of the uncertain rigs that meet it")


class PresentDesign(Model):
    """The design that was sent."""

    figures: list[FoundFigure]
    required: list[FoundRequirement]
    stable: bool
    met: bool


class FoundLoop(Model):
    """An axis' PI loop."""

    kp: float = Field(description="V/rad")
    ti: float = Field(description="s")


class FoundLoops(Model):
    """Both PI loops."""

    pitch: FoundLoop
    yaw: FoundLoop


class FoundObserver(Model):
    """The observer: its poles, and what was not free of it."""

    poles: list[Complex]
    coupling: str
    lead: str


class FoundChanges(Model):
    """What was free, to be put in the request's place."""

    poles: list[Complex] | None = None
    rotor_poles: list[Complex] | None = None
    loops: FoundLoops | None = None
    coupling: str | None = None
    lead: str | None = None
    shift: float | None = Field(None, description="shift c of Luenberger's basis")
    pairing: str | None = None
    decoupler: bool | None = None
    observer: FoundObserver | None = None
    weights: dict[str, dict[str, float]] | None = Field(
        None, description="of states, inputs and integrals by name"
    )


class FoundDesign(PresentDesign):
    """One design."""

    design: FoundChanges


class FoundGive(Model):
    """What one requirement would have to become."""

    requirement: int = Field(description="its place among the requirements")
    value: float | None = Field(None, description="left out where nothing was found")
    text: str
    by: float | None = Field(None, description="by how much it would have to give")
    others: bool = Field(description="whether all other requirements are met then")
    message: str


class FoundWhy(Model):
    """Why nothing meets everything, as far as was seen."""

    alone: list[int] = Field(description="requirements that no design tried meets, whatever else is asked")
    requirements: list[int] = Field(
        description="of the others the smallest set that no design tried meets together; empty where there is none"
    )
    excluding: list[list[int]] | None = Field(
        None,
        description="pairs of requirements whose limits exclude one another, before any design is tried; left out "
        "where there are none",
    )
    message: str
    gives: list[FoundGive]


class FindReply(Model):
    """The designs found."""

    done: bool
    met: bool = Field(description="whether they meet everything; else these are the nearest misses")
    figures: list[ToldFigure]
    requirements: list[ToldRequirement]
    designs: list[FoundDesign]
    present: PresentDesign | None = Field(None, description="left out where it does not exist")
    tried: int = Field(description="designs, those on uncertain rigs counted by rig")
    seconds: float = Field(description="that it took")
    stopped: bool = Field(description="whether the time had run out before all designs were tried")
    seed: int = Field(description="of the request")
    why: FoundWhy | None = None


def part_reply(part: Progress | Designs) -> Reply:
    """Progress, or the answer."""
    return progress_reply(part) if isinstance(part, Progress) else find_reply(part)


def progress_reply(part: Progress) -> Reply:
    """How far it is."""
    points = [row for row in part.points.tolist() if all(map(isfinite, row))]
    return {
        "done": False,
        "tried": part.tried,
        "designs": part.designs,
        "seconds": part.seconds,
        "met": part.met,
        "points": points,
    }


def find_reply(found: Designs) -> Reply:
    """The answer."""
    ask, measures = found.ask, found.measures
    reply: Reply = {
        "done": True,
        "met": found.met,
        "figures": [_figure(own, minimized=own in ask.minimize) for own in measures],
        "requirements": [_requirement(own, measures.index(own.measure)) for own in ask.require],
        "designs": [
            {"design": changes_of(own.spec, ask.free), **_candidate(own, measures)}
            for own in found.candidates
        ],
        "tried": found.tried,
        "seconds": found.seconds,
        "stopped": found.stopped,
        "seed": ask.seed,
    }
    if found.present is not None:
        reply["present"] = _candidate(found.present, measures)
    if found.why is not None:
        reply["why"] = {
            "alone": list(found.why.alone),
            "requirements": list(found.why.requirements),
            "message": why_text(found),
            "gives": [_give(found, own) for own in found.why.gives],
        }
        if found.why.excluding:
            reply["why"]["excluding"] = [[*pair] for pair in found.why.excluding]
    return reply


def _figure(measure: Measure, *, minimized: bool) -> Reply:
    figure = measure.figure
    about = {"title": measure.words, "unit": figure.unit, "better": figure.better}
    return {**told_measure(measure), **about, "minimized": minimized}


def _requirement(need: Requirement, figure: int) -> Reply:
    limits = {name: value for name in ("max", "min", "share") if (value := getattr(need, name)) is not None}
    return {"figure": figure, **limits, "words": need.words, "limit": need.limit_text}


def _candidate(own: Candidate, measures: tuple[Measure, ...]) -> Reply:
    figures = [
        {**({"value": value} if isfinite(value) else {}), "text": measure.written(value)}
        for measure, value in zip(measures, own.values, strict=True)
    ]
    required = [
        {"met": one.met, **({} if one.share is None else {"share": one.share})} for one in own.required
    ]
    return {"figures": figures, "required": required, "stable": own.stable, "met": own.met}


def _give(found: Designs, give: Give) -> Reply:
    need = found.ask.require[give.requirement]
    text = gives_text(need, give)
    reply: Reply = {"requirement": give.requirement, "text": text, "others": give.others_met}
    if give.value is not None:
        limit = need.share if need.share is not None else need.nearest_limit(give.value)
        reply |= {"value": give.value, "by": abs(give.value - limit)}
        return reply | {
            "message": f"{need.words}: {text} in place of {need.limit_text}; {consequence(found, give)}."
        }
    return reply | {"message": f"{need.words}: nothing was found that meets the others."}


def changes_of(spec: Spec, free: tuple[Free, ...]) -> Reply:
    """What was free of a design, as a request says it."""
    structure, outer = spec.structure, spec.outer
    every: Mapping[str, Callable[[], Reply]] = {
        "poles": lambda: {"poles": poles_reply(spec.poles.values)},
        "rotor_poles": lambda: {"rotor_poles": poles_reply(complex(p) for p in spec.rotor_poles)},
        "loops": lambda: {"loops": {axis: vars(getattr(outer, axis)) for axis in AXES}},
        "structure": lambda: {"coupling": structure.coupling, "lead": structure.lead},
        "shift": lambda: {} if structure.shift is None else {"shift": structure.shift},
        "pairing": lambda: {"pairing": outer.pairing},
        "decoupler": lambda: {"decoupler": outer.decoupler},
        "observer": lambda: {} if spec.observer is None else {"observer": _observer(spec.observer)},
        "weights": lambda: {} if spec.weights is None else {"weights": _weights(spec.weights)},
    }
    return {name: value for own in free for name, value in every[own]().items()}


def _observer(own: Observer) -> Reply:
    return {"poles": poles_reply(own.poles.values), "coupling": own.coupling, "lead": own.lead}


def _weights(own: Weights) -> Reply:
    return {
        kind: {signal.name: value for signal, value in zip(signals, values, strict=True)}
        for kind, signals in WEIGHTED.items()
        if (values := getattr(own, kind))
    }
