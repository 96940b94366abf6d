"""What a study says of its designs: percentiles over the rigs, and which share of them meets what is required."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from hashlib import sha256
from math import ceil, floor, inf, isfinite, isnan, nan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import Heli2DofError
from ..frozen import Frozen
from ..many import Measure
from ..measured import MEASURED
from ..on_rigs import OnRigs
from ..signals import Floats
from ..tables import NOTHING, Shown, Table, number
from .folder import Folder
from .part import Part
from .problems import StudyError
from .study import NOMINAL, Study, column_of

PERCENTILES = (5, 50, 95)
SHOWN = 20
"""Most designs in a table that is printed."""


@dataclass(frozen=True)
class Judged(Frozen):
    """One design over its rigs.

    Attributes:
        design: its number.
        exists: whether there is such a design.
        stable: share of the uncertain rigs whose loops are stable; NaN without such rigs.
        nominal: (measures,): NaN where there is none, ±∞ where it is unlimited.
        missing: (measures,), how many of the uncertain rigs have no value.
        percentiles: (`PERCENTILES`, measures), of the uncertain rigs; what has no value counts as the worst.
        shares: (requirements,), of the uncertain rigs that meet each; NaN without such rigs.
        all_met: share of these that meet all requirements; NaN without such rigs.
        meets: whether the design does: on the nominal rig, and on as many others as each requirement says.
    """

    design: int
    exists: bool
    stable: float
    nominal: Floats
    missing: NDArray[np.int64]
    percentiles: Floats
    shares: Floats
    all_met: float
    meets: bool


@dataclass(frozen=True, repr=False)
class Summary(Shown):
    """A study's outcome.

    Attributes:
        study: what was asked.
        designs: each, in their order.
        digest: of all numbers, bit for bit, hexadecimal: the same on every machine that computes the same.
        reason: why the first design that does not exist does not; empty where all do.
    """

    study: Study
    designs: tuple[Judged, ...]
    digest: str
    reason: str = ""

    @property
    def meeting(self) -> tuple[Judged, ...]:
        """The designs that meet what is required, the best first."""
        return tuple(own for own in self.ranked if own.meets)

    @property
    def ranked(self) -> list[Judged]:
        """All that exist, the best first where something is required; else in their order."""
        there = (own for own in self.designs if own.exists)
        return sorted(there, key=self._rank) if self.study.requirements else [*there]

    def _rank(self, own: Judged) -> tuple[bool, float, float, int]:
        """By what they meet, by the share that meets all, and by how much the nominal rig misses."""
        required = enumerate(self.study.requirements)
        missed = sum(float(asked.excess(own.nominal[self._at(k)])) for k, asked in required)
        return not own.meets, -own.all_met if isfinite(own.all_met) else 0.0, missed, own.design

    def summary(self) -> str:
        """How many designs, rigs, and how many meet what is required."""
        study, count = self.study, len(self.designs)
        words = f"{count:,} {'design' if count == 1 else 'designs'}"
        words += f" on {study.rigs.count:,} uncertain rigs each" if study.rigs is not None else ""
        if study.requirements:
            words += f"; {len(self.meeting):,} meet all requirements"
        missing = sum(not own.exists for own in self.designs)
        if missing:
            words += f"; {missing:,} do not exist: {self.reason}"
        return f"{words}; digest {self.digest[:16]}"

    def tables(self) -> tuple[Table, ...]:
        """Of one design its percentiles; of several the first ones, a row each; and what is required."""
        study = self.study
        if len(self.designs) == 1:
            shown = (self._of_one(self.designs[0]),)
        else:
            title = f"designs, the best {SHOWN} of {len(self.designs):,}" if study.requirements else "designs"
            if not study.requirements and len(self.designs) > SHOWN:
                title = f"the first {SHOWN} of {len(self.designs):,} designs"
            shown = (Table.of(title, self._heads, map(self._row, self.ranked[:SHOWN])),)
        return (*shown, *self._missing(), *self._required())

    def _missing(self) -> Iterator[Table]:
        """What stands where a figure has no value, what that means, and of how many rigs it is so."""
        study = self.study
        told = self.ranked[: SHOWN if len(self.designs) > 1 else 1]
        rows = []
        for k, measure in enumerate(study.measures):
            without = sum(isnan(own.nominal[k]) for own in told) if study.rigs is None else 0
            count = without or sum(int(own.missing[k]) for own in told)
            if count:
                of = len(told) * (1 if study.rigs is None else study.rigs.count)
                what = MEASURED[measure.name].words(measure.where)
                rows.append((what, measure.written(nan), _meaning(measure), f"{count:,} of {of:,}"))
        if rows:
            counted = "designs" if study.rigs is None else "uncertain rigs"
            counted += " under the designs above" if study.rigs is not None and len(told) > 1 else ""
            yield Table.of(
                "figures without a value, which count as the worst",
                ("figure", "shown as", "because", counted),
                rows,
            )

    @property
    def _heads(self) -> tuple[str, ...]:
        study = self.study
        uncertain = study.rigs is not None
        heads = [
            "design",
            *(" ".join(path.replace("-", ".").split(".")[-3:]) for path in study.designs.paths),
        ]
        worst = (PERCENTILES[k] for k in _worst_row(study.measures))
        heads += [
            f"{_head(own)} {p} %" if uncertain else _head(own)
            for own, p in zip(study.measures, worst, strict=True)
        ]
        heads += ["stable"] * uncertain
        if study.requirements:
            heads += ["meet all", "meets"] if uncertain else ["meets"]
        return tuple(heads)

    def _row(self, own: Judged) -> list[str]:
        study = self.study
        uncertain = study.rigs is not None
        cells = [str(own.design), *(_cell(value) for value in study.changes(own.design).values())]
        values = own.percentiles[_worst_row(study.measures)] if uncertain else own.nominal
        values = np.diagonal(values) if uncertain else values
        cells += [m.written(value) for m, value in zip(study.measures, values.tolist(), strict=True)]
        cells += [_percent(own.stable)] * uncertain
        if study.requirements:
            cells += [_percent(own.all_met)] * uncertain + ["yes" if own.meets else "no"]
        return cells

    def _of_one(self, own: Judged) -> Table:
        study = self.study
        heads = ("", "nominal", *(f"{p} %" for p in PERCENTILES)) if study.rigs is not None else ("", "value")
        rows = []
        for k, measure in enumerate(study.measures):
            values = [own.nominal[k], *own.percentiles[:, k]] if study.rigs is not None else [own.nominal[k]]
            rows.append(
                (MEASURED[measure.name].words(measure.where), *(measure.written(float(v)) for v in values))
            )
        if study.rigs is not None:
            rows.append(("stable", NOTHING, _percent(own.stable), *[NOTHING] * (len(PERCENTILES) - 1)))
        return Table.of(study.title or "study", heads, rows)

    def _required(self) -> Iterator[Table]:
        study = self.study
        if not study.requirements or not self.ranked:
            return
        best, uncertain = self.ranked[0], study.rigs is not None
        heads = (
            "requirement",
            "limit",
            "nominal",
            *(("rigs that meet it", "asked for") if uncertain else ()),
        )
        rows = []
        for k, own in enumerate(study.requirements):
            row = [own.words, own.limit_text, own.written(float(best.nominal[self._at(k)]))]
            if uncertain:
                row += [_percent(best.shares[k]), NOTHING if own.share is None else f"{100 * own.share:g} %"]
            rows.append(row)
        title = "requirements" if len(self.designs) == 1 else f"requirements, design {best.design}"
        yield Table.of(title, heads, rows)

    def _at(self, requirement: int) -> int:
        return self.study.measures.index(self.study.requirements[requirement].measure)

    def rows(self) -> Iterator[list[Any]]:
        """For files: a head, then a row for each design; values in the figures' own units, empty where none."""
        study = self.study
        uncertain = study.rigs is not None
        heads: list[Any] = ["design", *study.designs.paths, "exists"]
        for column in study.columns:
            heads += (
                [f"{column}_nominal", *(f"{column}_p{p}" for p in PERCENTILES)] if uncertain else [column]
            )
        heads += ["share_stable"] * uncertain
        if study.requirements:
            heads += [f"share_{k}" for k in range(len(study.requirements))] * uncertain
            heads += ["share_all"] * uncertain + ["meets"]
        yield heads
        for own in self.designs:
            row: list[Any] = [own.design, *study.changes(own.design).values(), own.exists]
            for k in range(len(study.columns)):
                row += [own.nominal[k], *own.percentiles[:, k]] if uncertain else [own.nominal[k]]
            row += [own.stable] * uncertain
            if study.requirements:
                row += [*own.shares, own.all_met, own.meets] if uncertain else [own.meets]
            yield ["" if isinstance(value, float) and isnan(value) else value for value in row]


def summarize(folder: Folder, check: Callable[[], None] = lambda: None) -> Summary:
    """The summary of a study that is whole.

    Raises:
        StudyError: a part is missing or damaged.
    """
    study, digest = folder.study, sha256()
    missing = study.parts - len(folder.done())
    if missing:
        raise StudyError(
            f"{missing:,} of {study.parts:,} parts are missing", hint="Start the study again: it goes on."
        )
    found = [_judged(study, rows) for rows in _by_design(_read(folder, digest.update, check))]
    reason = next((_reason(study, own.design) for own in found if not own.exists), "")
    return Summary(study, tuple(found), digest.hexdigest(), reason)


def _read(folder: Folder, digested: Callable[[bytes], object], check: Callable[[], None]) -> Iterator[Part]:
    for k in range(folder.study.parts):
        check()
        part = folder.read(k)
        digested(_bytes(part))
        yield part


def _bytes(part: Part) -> bytes:
    """Row by row, the same on every machine and however the rows are divided into parts."""
    kinds: list[Any] = [("design", "<i4"), ("rig", "<i4"), ("exists", "u1"), ("stable", "u1")]
    rows = np.empty(len(part.design), [*kinds, ("values", "<f8", (part.values.shape[1],))])
    for name in rows.dtype.names or ():
        rows[name] = getattr(part, name)
    rows["values"][np.isnan(part.values)] = nan  # whichever of them it was
    return rows.tobytes()


def _by_design(parts: Iterable[Part]) -> Iterator[list[Part]]:
    """The rows of one design after another, in as many pieces as they came."""
    own: list[Part] = []
    for part in parts:
        ends = (np.flatnonzero(np.diff(part.design)) + 1).tolist()
        for first, last in zip([0, *ends], [*ends, len(part.design)], strict=True):
            piece = part.rows(first, last)
            if own and own[0].design[0] != piece.design[0]:
                yield own
                own = []
            own.append(piece)
    if own:
        yield own


def _judged(study: Study, pieces: Sequence[Part]) -> Judged:
    rig, exists = np.concatenate([p.rig for p in pieces]), np.concatenate([p.exists for p in pieces])
    stable, values = np.concatenate([p.stable for p in pieces]), np.concatenate([p.values for p in pieces])
    uncertain, nominal = rig != NOMINAL, values[np.argmax(rig == NOMINAL)]
    others, any_ = values[uncertain], bool(uncertain.any())
    met = [own.met(values[:, study.measures.index(own.measure)]) & exists for own in study.requirements]
    shares = np.array([np.mean(own[uncertain]) if any_ else nan for own in met])
    meets = bool(exists.all()) and all(
        bool(own[~uncertain].all()) and (asked.share is None or share >= asked.share)
        for own, asked, share in zip(met, study.requirements, shares.tolist(), strict=True)
    )
    everything = np.logical_and.reduce(met)[uncertain] if met and any_ else np.zeros(0)
    return Judged(
        design=int(pieces[0].design[0]),
        exists=bool(exists.all()),
        stable=float(np.mean(stable[uncertain])) if any_ else nan,
        nominal=nominal,
        missing=np.isnan(others).sum(axis=0),
        percentiles=np.column_stack([_percentiles(m, others[:, k]) for k, m in enumerate(study.measures)])
        if any_
        else np.full((len(PERCENTILES), len(study.measures)), nan),
        shares=shares,
        all_met=float(np.mean(everything)) if len(everything) else nan,
        meets=meets,
    )


def _percentiles(measure: Measure, values: Floats) -> Floats:
    """By nearest rank, so that each is a value that occurs; what has none is worse than any, and worst for size."""
    figure = MEASURED[measure.name].figure
    absent = -inf if figure.better == "higher" else inf
    own = np.abs(values) if figure.signed else values
    ordered = np.sort(np.where(np.isnan(own), absent, own))
    there = ~np.isnan(own)
    ranks = [max(ceil(p / 100 * len(ordered)), 1) - 1 for p in PERCENTILES]
    found = ordered[ranks]
    missing = len(own) - int(there.sum())
    low, high = (0, missing) if figure.better == "higher" else (len(own) - missing, len(own))
    return np.array([nan if low <= rank < high else value for rank, value in zip(ranks, found, strict=True)])


def _reason(study: Study, design: int) -> str:
    """Why a design does not exist."""
    try:
        spec = study.spec(design)
        if study.rigs is not None:
            OnRigs(spec, study.measures)
    except Heli2DofError as error:
        return f"design {design}: {error}"
    return f"design {design}: its gains cannot be found"


def _worst_row(measures: Sequence[Measure]) -> list[int]:
    """For each measure the percentile that says how bad it may get."""
    return [0 if MEASURED[own.name].figure.better == "higher" else len(PERCENTILES) - 1 for own in measures]


_BECAUSE = {
    "settling_time": "the response has not settled when the run ends",
    "rise_time": "the response does not come to 90 % of its step",
}
"""Why a stable loop has no such figure, where the registry's words are meant for a reply."""


def _meaning(measure: Measure) -> str:
    """Why there is no value, in plain words."""
    known = MEASURED[measure.name]
    absent = "" if known.unlimited else known.figure.absent.removeprefix("where ")
    why = _BECAUSE.get(measure.name, absent)
    return f"the loop is not stable, or {why}" if why else "the loop is not stable"


def _head(measure: Measure) -> str:
    """Its column's name in words, so that a narrow table breaks it; symbols stay whole."""
    own = column_of(measure).removeprefix(measure.name).split("_", 1)
    name = measure.name if measure.name[:2] == "V_" else measure.name.replace("_", " ")
    return " ".join((name, *own[1:]))


def _cell(value: Any) -> str:
    return str(value) if isinstance(value, (str, bool)) else number(float(value))


def _percent(share: float) -> str:
    """Rounded down: 99.96 % are not all."""
    return NOTHING if isnan(share) else f"{floor(1000 * share + 1e-9) / 10:g} %"
