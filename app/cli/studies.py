"""`heli2dof study`: designs times rigs from a file, on this machine's cores or on a cluster."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .output import console, load_kernels, print_json, refusals, show

if TYPE_CHECKING:
    from heli2dof_core.study import Folder, Progress, Summary, Workers

_FILE = click.Path(exists=True, dir_okay=False, path_type=Path)
_FOLDER = click.Path(file_okay=False, path_type=Path)


@click.command()
@click.argument("file", type=_FILE)
@click.option("--into", type=_FOLDER, help="Folder for the numbers; by default FILE's name with .study.")
@click.option(
    "--processes",
    type=click.IntRange(1, 1024),
    help="Worker processes; by default one for each core. 1: this process alone.",
)
@click.option(
    "--cluster",
    envvar="HELI2DOF_DASK",
    help="Address of a Dask scheduler, tcp://…, whose workers compute; by default HELI2DOF_DASK.",
)
@click.option(
    "--csv", "table", type=click.File("w", encoding="utf-8", lazy=True), help="Write all designs as CSV."
)
@click.option("--json", "as_json", is_flag=True, help="Print JSON.")
def study(file: Path, into: Path | None, as_json: bool, **options: Any) -> None:
    """Compute designs times rigs from FILE, TOML, and print what the designs do on their rigs.

    What is done is kept as Parquet. Whatever ends the command, the same command goes on where it was; the digits are
    the same on one process, on several and on a cluster.
    """
    from heli2dof_core.study import Folder, read_study, run, summarize

    with refusals(as_json):
        own = read_study(file.read_text(encoding="utf-8"))
        folder = Folder(into or file.with_suffix(".study"), own)
        missing = own.parts - len(folder.done())
        if missing:
            with _workers(options["processes"], options["cluster"], missing) as workers, _bar(folder) as tell:
                run(folder, workers, tell)
        summary = summarize(folder)
        if (table := options["table"]) is not None:
            csv.writer(table, lineterminator="\n").writerows(summary.rows())
        if as_json:
            return print_json(_told(summary, folder))
        show(summary.tables(), summary.summary(), f"numbers: {folder.path}")
    return None


@contextmanager
def _workers(processes: int | None, cluster: str | None, parts: int) -> Iterator[Workers]:
    from heli2dof_core.study import Alone, usable_cores
    from heli2dof_core.study import processes as local

    if cluster:
        with _cluster(cluster) as workers:
            yield workers
        return
    load_kernels()  # compiled once, not by each worker
    count = min(processes or usable_cores(), parts)
    if count == 1:
        yield Alone()
        return
    pool = local(count)
    try:
        yield pool
    finally:
        pool.close()


@contextmanager
def _cluster(address: str) -> Iterator[Workers]:
    from heli2dof_core.study import StudyError

    try:
        from ..jobs.dask_workers import DaskWorkers
    except ImportError:
        raise StudyError(
            "a cluster is asked for, and distributed is not installed",
            hint="Install it: pip install 'heli2dof[dask]'.",
        ) from None
    from ..jobs.workers import WorkerLostError

    workers = DaskWorkers(address)
    try:
        try:
            workers.connected()
        except WorkerLostError as error:
            raise StudyError(str(error), hint="Look whether the scheduler runs there.") from None
        yield workers
    finally:
        workers.shutdown(cancel_futures=True)


@contextmanager
def _bar(folder: Folder) -> Iterator[Callable[[Progress], None]]:
    """A bar on a terminal's stderr, and lines where there is none."""
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn

    out = console(stderr=True)
    columns = (BarColumn(), MofNCompleteColumn(), TextColumn("pairs"), TimeRemainingColumn())
    with Progress(*columns, console=out, transient=True, disable=not out.is_terminal) as progress:
        task = progress.add_task("pairs", total=folder.study.pairs)
        begun: list[int] = []
        lost = 0

        def tell(own: Any) -> None:
            nonlocal lost
            if not begun:
                begun.append(own.earlier)
                if own.earlier:
                    out.print(f"{own.earlier:,} of {own.of:,} pairs are there already; going on.")
            if own.again > lost:
                out.print(f"{own.again - lost} parts have lost their worker and are computed again.")
                lost = own.again
            progress.update(task, completed=own.pairs)

        yield tell


def _told(summary: Summary, folder: Folder) -> dict[str, Any]:
    """As JSON: the rows of the table by their heads, what is required, and the digest."""
    heads, *rows = summary.rows()
    return {
        "title": summary.study.title,
        "folder": str(folder.path),
        "digest": summary.digest,
        "pairs": summary.study.pairs,
        "designs": [
            {head: value for head, value in zip(heads, row, strict=True) if _finite(value)} for row in rows
        ],
        "requirements": [
            {"words": own.words, "limit": own.limit_text}
            | ({} if own.share is None else {"share": own.share})
            for own in summary.study.requirements
        ],
        "meet": [own.design for own in summary.meeting],
    }


def _finite(value: Any) -> bool:
    """Whether JSON can tell it: what has no value or no limit is left out."""
    return value != "" and not (isinstance(value, float) and value in (float("inf"), float("-inf")))
