"""The page's module of the kernel's layout: `python -m tests.page_kernel` makes it of the core's.

As Prettier has it, so that it is checked like any other module; a test holds it to the core.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any, get_args

from heli2dof_core.couplings import STRUCTURES
from heli2dof_core.figures import AXIS, MARGINS
from heli2dof_core.flight import events, log, rig
from heli2dof_core.kernels import flight_layout, layout
from heli2dof_core.kernels import update_layout as update
from heli2dof_core.parameters import PARAMETER_INFO
from heli2dof_core.poles import ZERO
from heli2dof_core.quantities import Field
from heli2dof_core.request import Place, quantities
from heli2dof_core.robustness import GRID, PERCENTILES, RTOL, SMALLEST
from heli2dof_core.rotors import AT_ONCE
from heli2dof_core.scenario import MOST_SAMPLE_TIMES, SAMPLED, AntiWindup, Measured
from heli2dof_core.simulation.nonlinear import ABSOLUTE_TOLERANCE
from tests.children import ROOT
from tests.page_source import WIDTH, key, literal, quoted

PAGE = ROOT / "static" / "kernel" / "layout.js"
SHAPES = PAGE.with_name("shapes.js")
FLIGHT = PAGE.with_name("flight_layout.js")
HEAD = """/**
 * What stands where in the numbers that the kernel `update` takes and in the block that it fills, and what a request
 * may be. Made of heli2dof_core/kernels/update_layout.py and the core's dataclasses by `python -m tests.page_kernel`;
 * not to be changed by hand.
 */
"""
NUMBERS = (
    *("PARAMETERS", "ANGLE", "LIMITS", "POLES", "ROTOR_POLES", "ROTORS_PLACED", "FAMILY", "SHIFTED", "SHIFT"),
    *(
        "PI_LOOPS",
        "PI_GAINS",
        "CROSSWISE",
        "DECOUPLED",
        "LAGS",
        "QUADRATIC",
        "DEAD_ZONES",
        "MATCHED",
        "FRICTION",
    ),
    *("MEASURED", "OBSERVER_POLES", "OBSERVER_FAMILY", "ASKED", "BEGINNING", "DURATION", "SATURATION"),
    *(
        "WINDUP_KIND",
        "TRACKING_TIME",
        "STOPS",
        "FEEDFORWARD",
        "RTOL",
        "DIGITAL",
        "SAMPLE_TIME",
        "LATE",
        "COUNTS",
    ),
    *(
        "RATES_FILTERED",
        "DISTURBED",
        "DISTURBANCE_VOLTS",
        "DISTURBED_FROM",
        "EACH_AXIS",
        "MOST_STEPS",
        "AIMS",
    ),
    *(
        "WITHOUT_MARGINS",
        "WITHOUT_LAG_MARGIN",
        "WITHOUT_LINEAR",
        "WITHOUT_RIG",
        "WITHOUT_SCENARIO",
        "WITHOUT_UNSTABLE",
    ),
    "NUMBERS",
)
GIVEN = ("K_GIVEN", "GIVEN_K", "GIVEN_INVERSE", "OWN_INTEGRAL", "GIVEN_INTEGRAL", "L_GIVEN", "GIVEN_L")
"""Numbers that the page leaves 0: what other methods have found."""
OUTCOMES = ("DONE", "EXACT", "UNCONTROLLABLE", "NO_STRUCTURE", "NO_CURVE", "NO_SLOPE", "NO_EIGENVALUES")
FIGURES = (
    *("DETERMINANT", "PLACED_STABLE", "NORM", "SPECTRAL_NORM", "CONDITION", "POLE_ERROR", "POLE_ERROR_BOUND"),
    *("DOUBTFUL", "RELATIVE_GAIN", "STABLE", "LAG_MARGIN", "CONNECTED"),
)
COURSE = ("DEVIATION", "SHARE", "HELD", "OUTCOME", "IMPACTS", "REACHED")
SENSITIVITY = ("SENSITIVITY_PEAK", "PEAK_FREQUENCY", "DISK_MARGIN", "DISK_FREQUENCY")
MOTOR = ("PEAK_VOLTAGE", "EFFORT")
ENDS = ("ENDED", "OUT_OF_STEPS", "OUT_OF_SWITCHES", "OUT_OF_BOUNDS")
FOUND = (
    *("FOUND_OUTCOME", "FOUND_RUNS", "SHARE_STABLE", "SHARE_WITHIN", "FOUND_FIGURES", "FOUND_SENSITIVITY"),
    *("FOUND_MARGINS", "FOUND_COURSES", "FOUND_MOTORS", "FOUND_AXES", "FOUND_K", "FOUND_INVERSE", "FOUND"),
)
EXPERIMENT = ("REFERENCE", "START", "BOUND", "STOP")


def module() -> str:
    """The whole module."""
    known = {path: (place, known) for path, place, known in quantities()}
    parts = (
        HEAD,
        _places("Offsets within the numbers.", "AT", update, NUMBERS),
        _list("Parameters, in the numbers' order.", "PARAMETERS", PARAMETER_INFO),
        _list(
            "Coupling and leading axis of each family of structures, by its number.",
            "FAMILIES",
            (f"{own.coupling}/{own.lead}" for own in STRUCTURES),
        ),
        _list("What is measured, by its number.", "MEASURED", get_args(Measured)),
        _list("Kinds of anti-windup, by their numbers.", "WINDUPS", get_args(AntiWindup)),
        _places("How an update ended.", "OUTCOMES", update, OUTCOMES),
        _places("Columns of the figures.", "FIGURES", update, FIGURES),
        _places("Columns of an experiment.", "EXPERIMENT", layout, EXPERIMENT),
        _list("Columns of an axis' metrics.", "AXIS", AXIS),
        _places("Columns of a motor's metrics.", "MOTOR", layout, MOTOR),
        _places("Columns of a course.", "COURSE", layout, COURSE),
        _places("How a course ended.", "ENDS", layout, ENDS),
        _list("Columns of a motor's margins.", "MARGINS", MARGINS),
        _places("Columns of what both motors bear.", "SENSITIVITY", layout, SENSITIVITY),
        _places("Columns of a design among many.", "FOUND", update, FOUND),
        _numbers(),
        _object(
            "Of clouds: times of their responses, tolerance, least share of a parameter, percentiles of bands.",
            "RIGS",
            {
                "TIMES": GRID,
                "RTOL": RTOL,
                "LEAST": SMALLEST,
                "PERCENTILES": [int(percent) for percent in PERCENTILES],
            },
        ),
        _set(
            "Paths in a request whose values may be null.",
            "MAY_LACK",
            known,
            lambda q: bool(q.quantity.absent),
        ),
        _set("Those whose numbers are whole.", "WHOLE", known, lambda q: q.kind is int),
    )
    return "\n".join(parts)


def _numbers() -> str:
    own = {
        "RUNS": ("Experiments in a block, filled or not.", update.RUNS),
        "PLAIN": ("States of the paper's rig, with rotors or friction, with an estimator.", layout.PLAIN),
        "LAGGED": ("", layout.LAGGED),
        "FULL": ("", layout.FULL),
        "ROTORS": ("Where the rotors' speeds stand among the states.", layout.PLAIN),
        "FACTORS": (
            "What rigs differ in: their parameters, and both rotors' time constants.",
            update.FACTORS,
        ),
        "ZERO": ("Parts of poles below this are 0, rad/s.", ZERO),
        "AT_ONCE": ("Rotors below this follow at once, s.", AT_ONCE),
    }
    return "".join(
        f"{f'/** {words} */' + chr(10) if words else ''}export const {name} = {literal(value)};\n"
        for name, (words, value) in own.items()
    )


def _places(about: str, name: str, where: object, names: Iterable[str]) -> str:
    return _object(about, name, {own: getattr(where, own) for own in names})


def _object(about: str, name: str, values: Mapping[str, Any]) -> str:
    entries = [f"{own}: {literal(value)}" for own, value in values.items()]
    one = f"export const {name} = {{ {', '.join(entries)} }};"
    if len(one) > WIDTH:
        one = "\n".join((f"export const {name} = {{", *(f"  {entry}," for entry in entries), "};"))
    return f"/** {about} */\n{one}\n"


def _list(about: str, name: str, words: Iterable[str]) -> str:
    entries = [quoted(word) for word in words]
    return f"/** {about} */\n{_array(f'export const {name} = ', entries, ';')}\n"


def _array(before: str, entries: list[str], after: str) -> str:
    one = f"{before}[{', '.join(entries)}]{after}"
    return (
        one
        if len(one) <= WIDTH
        else "\n".join((f"{before}[", *(f"  {entry}," for entry in entries), f"]{after}"))
    )


def _set(
    about: str, name: str, known: Mapping[str, tuple[Place, Field]], which: Callable[[Field], bool]
) -> str:
    entries = [quoted(path) for path, (_, own) in known.items() if which(own)]
    return f"/** {about} */\n{_array(f'export const {name} = new Set(', entries, ');')}\n"


SHAPES_HEAD = """/**
 * The arrays of the kernels `update`, `run_rigs` and `run_designs` for a loop of n states: kinds and shapes.
 * Made of heli2dof_core/kernels/update_layout.py by `python -m tests.page_kernel`; not to be changed by hand.
 *
 * @typedef {['f64' | 'i64' | 'c128', ...number[]]} Kind  c128: two f64
 */
"""
KINDS = {"float64": "f64", "int64": "i64", "complex128": "c128"}


def shapes() -> str:
    """The module of the arrays' shapes."""
    parts = (
        _shapes("What it fills.", "block", update.block_shapes, ("samples",)),
        _shapes("What it writes into besides.", "scratch", update.scratch_shapes, ("samples",)),
        _shapes("What `run_rigs` takes behind these.", "many", update.rigs_shapes, ("rigs", "times")),
        _shapes("What `run_designs` takes behind these.", "designs", update.designs_shapes, ("designs",)),
    )
    return "\n".join((SHAPES_HEAD, *parts))


def _shapes(
    about: str,
    name: str,
    shapes_of: Callable[..., dict[str, tuple[update.Shape, str]]],
    counts: tuple[str, ...],
) -> str:
    """A function of the number of states and of these counts."""
    sizes = (layout.PLAIN, layout.LAGGED, layout.FULL)
    few = [shapes_of(n, *(100 for _ in counts)) for n in sizes]
    more = {
        count: [shapes_of(n, *(300 if other == count else 100 for other in counts)) for n in sizes]
        for count in counts
    }
    lines = []
    for own, (shape, kind) in few[0].items():
        dims = [
            _dimension(
                [at[own][0][i] for at in few],
                {count: [at[own][0][i] for at in many] for count, many in more.items()},
            )
            for i in range(len(shape))
        ]
        lines.append(f"  {key(own)}: [{', '.join((quoted(KINDS[kind]), *dims))}],")
    taken = ("n", *counts)
    told = (*(f"@param {{number}} {one}" for one in taken), "@returns {Record<string, Kind>}")
    one = f"/** {about} {' '.join(told)} */"
    head = one if len(one) <= WIDTH else "\n".join(("/**", f" * {about}", f" * {' '.join(told)}", " */"))
    return "\n".join(
        (
            head,
            f"export const {name} = ({', '.join(taken)}) => ({{",
            *lines,
            "});",
            "",
        )
    )


def _dimension(few: list[int], more: dict[str, list[int]]) -> str:
    """One dimension in JavaScript, by 6, 8, 14 states: where each count is 100, and where one of them is 300."""
    grown = [(count, many) for count, many in more.items() if many != few]
    if grown:
        (count, many), *others = grown
        if others or few[0] != few[1] or many[0] - few[0] != 200:
            raise ValueError(f"The page has no words for {few}, {more}")
        return count if few[0] == 100 else f"{count} + {few[0] - 100}"
    plain, lagged, full = few
    if plain == full:
        return str(plain)
    if lagged == full:
        return f"n === {layout.PLAIN} ? {plain} : {full}"
    slope = (full - plain) // (layout.FULL - layout.PLAIN)
    rest = plain - slope * layout.PLAIN
    if lagged != slope * layout.LAGGED + rest or full != slope * layout.FULL + rest:
        raise ValueError(f"The page has no words for {few}")
    term = "n" if slope == 1 else f"{slope} * n"
    return f"{term} + {rest}" if rest else term


FLIGHT_HEAD = """/**
 * What stands where in a flight's arrays, the words of its log and their ranges. Made of heli2dof_core/flight and
 * heli2dof_core/kernels/flight_layout.py by `python -m tests.page_kernel`; not to be changed by hand.
 */
"""
INPUTS = (
    *("MANUAL", "STICK", "REFERENCE", "TURN", "TURN_FROM", "PUSH", "GUST", "GUST_FROM", "GUST_TICKS"),
    *("THRUST", "HUNG", "STUCK", "NOISE", "SEED", "FLIGHT_INPUTS"),
)
CONTROLLER = (
    *("BY_REFERENCE", "BASE", "ZERO_ANGLE", "TRIM", "MEASURED_AS", "ORDER", "TICKS", "FLIGHT_CONTROLLER"),
)
MEMORY = (
    *("FILTERS", "HAS", "COMPUTED", "SEEN", "READ", "PHASE", "TICK", "ENDED_AS", "WISHED", "HITS", "PUSHED"),
    "FLIGHT_MEMORY",
)
ROW = (*("STATE", "SENSED", "VOLTAGE", "UNLIMITED", "SPEED", "WISH", "OUTSIDE", "ON_STOP", "FLIGHT_ROW"),)
LOG = ("FORMAT", "MOST_TICKS", "LONGEST", "MOST_EVENTS", "MOST_DESIGNS", "CHECK_EVERY", "AGREED")


def flights() -> str:
    """The module of a flight's layout."""
    own = {name: getattr(flight_layout, name) for name in CONTROLLER}
    sizes = {
        **{"STATES": layout.FULL, "CONSTANTS": layout.MORE_CONSTANTS, "MODES": layout.MORE_MODES},
        **{"OBSERVER_ROWS": layout.ESTIMATED[0], "OBSERVER_COLUMNS": layout.ESTIMATED[1]},
        **{"WORK_ROWS": layout.WORKSPACE[0], "WORK_COLUMNS": layout.WORKSPACE[1]},
    }
    within = {
        **{"RTOL": rig.TOLERANCE, "ATOL": ABSOLUTE_TOLERANCE * rig.TOLERANCE},
        **{"MOST_STEPS": rig.MOST_STEPS, "SAMPLED": SAMPLED, "MOST_SAMPLES": MOST_SAMPLE_TIMES},
        "GRAVITY": events.GRAVITY,
    }
    words = "\n".join(
        f"  {word}: {_rows([_value(*value) for value in known.values])},"
        for word, known in events.WORDS.items()
    )
    parts = (
        FLIGHT_HEAD,
        _places("What acts from outside.", "INPUT", flight_layout, INPUTS),
        _object(
            "A controller's settings, behind its sample time.", "CONTROLLER", {"TIME": layout.TIME, **own}
        ),
        _places("Of a loop's constants.", "CONSTANT", layout, ("LIMIT", "TRAVEL")),
        _places("Of a rig's modes.", "MODE", layout, ("REST",)),
        _places("What a flight remembers beside its state.", "MEMORY", flight_layout, MEMORY),
        _places("A row of its course.", "ROW", flight_layout, ROW),
        _places(
            "What a change of controller tells.",
            "TAKEN_OVER",
            flight_layout,
            ("JUMP", "JUMP_WITHOUT", "BUMPLESS", "TOLD"),
        ),
        _object("Sizes of the arrays.", "FLOWN", sizes),
        _object(
            "Tolerances within a tick, most steps; a continuous design's sample time, s; most samples; m/s².",
            "WITHIN",
            within,
        ),
        _places("Of a log.", "LOG", log, LOG),
        "/**\n * The words of a log: what each carries, its unit, and its range.\n"
        " * @type {Record<string, [name: string, unit: string, low: number, high: number][]>}\n */\n"
        f"export const WORDS = {{\n{words}\n}};\n",
    )
    return "\n".join(parts)


def _rows(entries: list[str]) -> str:
    """A list of lists: several stand one below the other."""
    if len(entries) == 1:
        return f"[{entries[0]}]"
    return "\n".join(("[", *(f"    {entry}," for entry in entries), "  ]"))


def _value(name: str, unit: str, low: float, high: float) -> str:
    return f"[{quoted(name)}, {quoted(unit)}, {literal(low)}, {literal(high)}]"


if __name__ == "__main__":
    FLIGHT.write_text(flights(), encoding="utf-8")
    PAGE.write_text(module(), encoding="utf-8")
    SHAPES.write_text(shapes(), encoding="utf-8")
