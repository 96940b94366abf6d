"""One controller on many rigs: the cloud of poles and the band of responses under uncertain parameters."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Annotated, Literal

import numpy as np

from .block import Task, fill_block, given_numbers, size_of
from .checks import require_within
from .engine import engine
from .errors import InvalidInputError
from .evaluate import Report, evaluate
from .frozen import Frozen, frozen, read_only
from .kernels.update_layout import made, rigs_shapes
from .on_rigs import require_continuous
from .parameters import PARAMETER_INFO
from .quantities import Quantity, documented, require_valid
from .rotors import Actuators
from .scratch import scratch
from .signals import AXES, Complexes, Floats
from .spec import Spec
from .tables import Shown, Table, number

Distribution = Literal["uniform", "normal"]
MOST_SAMPLES = 20_000
MOST_SPREAD = 0.95
"""Largest relative uncertainty of a parameter."""
CHUNK = 250
"""Rigs before the first report of progress; each next part is twice as large."""
SLICE = 100
"""Rigs between two checks whether the work is still wanted: a few milliseconds, or seconds where rigs are stiff."""
GRID = 101
"""Times at which responses are kept."""
PERCENTILES = (5.0, 50.0, 95.0)
SMALLEST = 0.02
"""Least share of its nominal value that a parameter keeps, whatever the distribution says."""
RTOL = 1e-5
LAGS = ("tau_p", "tau_y")
"""Time constants of both rotors, whose uncertainty is one of their own."""
_DEFAULT = MappingProxyType({name: 0.1 for name in PARAMETER_INFO if name != "g"})


@documented
@dataclass(frozen=True)
class Uncertainty:
    """How far the rigs differ from the nominal one.

    `spread` is per parameter its relative uncertainty: half width (uniform) or standard deviation (normal, cut at
    three of them).
    """

    spread: Mapping[str, float] = field(default_factory=lambda: _DEFAULT)
    distribution: Annotated[Distribution, Quantity("of the parameters")] = "uniform"
    samples: Annotated[int, Quantity("how many rigs", "", 1, MOST_SAMPLES)] = 200
    seed: Annotated[int, Quantity("of the random rigs", "", 0, 2**32 - 1)] = 0

    def __post_init__(self) -> None:
        require_valid(self)
        for name, share in self.spread.items():
            if name not in PARAMETER_INFO and name not in LAGS:
                raise InvalidInputError(
                    f"there is no parameter {name!r}",
                    field=f"spread.{name}",
                    hint="Known are " + ", ".join((*PARAMETER_INFO, *LAGS)) + ".",
                )
            require_within(share, f"spread.{name}", "", 0.0, MOST_SPREAD)


@dataclass(frozen=True, repr=False)
class Cloud(Frozen, Shown):
    """What is known after `done` of the rigs.

    Attributes:
        done, samples: rigs so far, and in all.
        loop_poles: of the whole loop, rad/s, (done, 6); fewer columns where fewer integrators drive a motor.
        t: s, (`GRID`,).
        percentiles: of the responses, % (5, 50, 95).
        envelopes: by output name, (3, `GRID`), rad, of the rigs whose responses stayed finite.
        share_stable: of the rigs whose linear loop is stable.
        share_within_limits: of those whose motors stay below their limits and whose pitch meets no stop.
    """

    done: int
    samples: int
    loop_poles: Complexes
    t: Floats
    percentiles: tuple[float, ...]
    envelopes: dict[str, Floats]
    share_stable: float
    share_within_limits: float

    def summary(self) -> str:
        """How many rigs, and the shares."""
        return (
            f"{self.done} of {self.samples} rigs; {100 * self.share_stable:.4g} % stable, "
            f"{100 * self.share_within_limits:.4g} % within the limits"
        )

    def tables(self) -> tuple[Table, ...]:
        """Shares, the rightmost pole's real part, and where the responses end."""
        decay = np.percentile(np.max(self.loop_poles.real, axis=1), self.percentiles)
        ends = (
            (f"{name} at the end (rad)", *map(number, bands[:, -1].tolist()))
            for name, bands in self.envelopes.items()
        )
        shares = (
            ("stable", f"{100 * self.share_stable:.4g} %"),
            ("within the limits", f"{100 * self.share_within_limits:.4g} %"),
        )
        heads = ("", *(f"{p:g} %" for p in self.percentiles))
        rows = (("Re of the slowest pole (rad/s)", *map(number, decay.tolist())), *ends)
        return Table.of("rigs", ("", "share"), shares), Table.of("percentiles", heads, rows)


def cloud(
    spec: Spec, uncertainty: Uncertainty = Uncertainty(), check: Callable[[], None] = lambda: None
) -> Cloud:
    """The whole cloud at once."""
    *_, last = cloud_in_parts(spec, uncertainty, check, first=uncertainty.samples)
    return last


def cloud_in_parts(
    spec: Spec, uncertainty: Uncertainty, check: Callable[[], None] = lambda: None, first: int = CHUNK
) -> Iterator[Cloud]:
    """The cloud after every few hundred rigs; who stops asking stops the work.

    K and the outer loop stay as they were designed for the nominal rig, and so does the trim.

    Args:
        spec: the nominal rig with its design and experiment.
        uncertainty: how the rigs differ from it.
        check: called after every few rigs; what it raises ends the work.
        first: rigs before the first cloud.

    Raises:
        InvalidInputError: the scenario has a digital controller or a disturbance.
        Heli2DofError: the design does not exist.
    """
    require_continuous(spec.scenario)
    report = evaluate(_nominal(spec))
    require_lags(spec.actuators, uncertainty)
    yield from rigs_in_parts(spec, report, random_factors(uncertainty), check, first)


def uncertain_factors(spec: Spec, uncertainty: Uncertainty) -> Floats:
    """`random_factors` for a spec that can be put on uncertain rigs.

    Raises:
        InvalidInputError: the scenario has a digital controller or a disturbance, or a rotor without a time
            constant shall be uncertain of it.
    """
    require_continuous(spec.scenario)
    require_lags(spec.actuators, uncertainty)
    return random_factors(uncertainty)


def _nominal(spec: Spec) -> Spec:
    return replace(spec, scenario=replace(spec.scenario, samples=2))


def rigs_in_parts(
    spec: Spec,
    report: Report,
    factors: Floats,
    check: Callable[[], None] = lambda: None,
    first: int = CHUNK,
) -> Iterator[Cloud]:
    """The same of given rigs.

    Args:
        spec: the nominal rig with its design and experiment.
        report: of that, with any number of samples.
        factors: by which each rig's parameters and both time constants differ from the nominal ones, (n, 14).
        check: as above.
        first: as above.
    """
    loop, kernels, task = report.loop, engine(), Task.of(_nominal(spec), each_axis=False)
    size, (placed, L) = size_of(task.rest.order), report.given
    block = fill_block(task, placed=placed, L=L, most_steps=None, passing=False)
    t = np.linspace(0.0, spec.scenario.duration, GRID)
    numbers = given_numbers(task, placed, L, kernels.most_steps)
    poles = np.empty((len(factors), len(size)), dtype=np.complex128)
    angles, verdicts = np.empty((len(factors), 2, GRID)), np.empty((2, len(factors)))

    def respond(first: int, last: int) -> None:
        part = slice(first, last)
        *own, _, _, _, _ = made(rigs_shapes(len(size), 1, GRID))
        own[0] = t
        filled = (poles[part], angles[part], verdicts[0, part], verdicts[1, part])
        room = (*block.values(), *scratch.update(len(size), 2), *own)
        kernels.run_rigs(size, numbers, factors[part], RTOL, *room, *filled)

    with ThreadPoolExecutor(2) as pool:
        begin, chunk = 0, first
        while begin < len(factors):
            end = min(begin + chunk, len(factors))
            for start in range(begin, end, SLICE):
                check()
                stop = min(start + SLICE, end)
                middle = (start + stop) // 2
                list(pool.map(respond, (start, middle), (middle, stop)))
            known = angles[:end][np.all(np.isfinite(angles[:end]), axis=(1, 2))]
            bands = list(pool.map(_bands, (known, known), (0, 1)))
            yield _summary(t, poles[:, : len(loop.connected)], verdicts, bands, end)
            begin, chunk = end, 2 * chunk  # so that all summaries together cost as much as the last


def _bands(angles: Floats, axis: int) -> Floats:
    """`PERCENTILES` of one axis over the rigs, (3, GRID); zeros where there are none."""
    if not len(angles):
        return np.zeros((len(PERCENTILES), GRID))
    return np.percentile(np.ascontiguousarray(angles[:, axis].T), PERCENTILES, axis=1)


def _summary(t: Floats, poles: Complexes, verdicts: Floats, bands: Sequence[Floats], done: int) -> Cloud:
    stable, within = np.mean(verdicts[:, :done], axis=1).tolist()
    return Cloud(
        done=done,
        samples=len(poles),
        loop_poles=poles[:done].copy(),
        t=read_only(t),
        percentiles=PERCENTILES,
        envelopes=dict(zip(("theta", "psi"), bands, strict=True)),
        share_stable=stable,
        share_within_limits=within,
    )


def random_factors(uncertainty: Uncertainty) -> Floats:
    """By which each rig's parameters and both rotors' time constants differ from the nominal ones, (samples, 14).

    The time constants have random numbers of their own, so that the other columns are the same without them.
    """
    spread, lags = (
        np.array([uncertainty.spread.get(name, 0.0) for name in names]) for names in (PARAMETER_INFO, LAGS)
    )
    own = _factors(np.random.default_rng(uncertainty.seed), spread, uncertainty)
    return frozen(np.hstack((own, _factors(np.random.default_rng((uncertainty.seed, 1)), lags, uncertainty))))


def _factors(rng: np.random.Generator, spread: Floats, uncertainty: Uncertainty) -> Floats:
    """Random factors, (samples, len(spread))."""
    shape = (uncertainty.samples, len(spread))
    if uncertainty.distribution == "uniform":
        deviations = rng.uniform(-1.0, 1.0, shape)
    else:
        deviations = np.clip(rng.standard_normal(shape), -3.0, 3.0)
    return np.maximum(1.0 + spread * deviations, SMALLEST)


def require_lags(own: Actuators | None, uncertainty: Uncertainty) -> None:
    """Only a rotor that has a time constant can be uncertain of it.

    Raises:
        InvalidInputError: one is uncertain and has none.
    """
    known = np.zeros(2) if own is None else own.tau
    for name, axis, tau in zip(LAGS, AXES, known.tolist(), strict=True):
        share = uncertainty.spread.get(name, 0.0)
        if share and not tau:
            raise InvalidInputError(
                f"the {axis} motor's rotor follows at once, so there is no time constant to be uncertain of",
                field=f"spread.{name}",
                value=share,
                hint="Give this rotor a time constant, or leave its uncertainty out.",
            )
