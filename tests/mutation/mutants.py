"""Which changes there are, and which of them are a sample."""

from __future__ import annotations

import json
import subprocess
from collections import Counter, defaultdict
from dataclasses import dataclass
from hashlib import sha256
from itertools import zip_longest
from pathlib import Path

from .python_sites import sites

HOME = Path(__file__).parent
EQUAL = HOME / "equal.json"


@dataclass(frozen=True)
class Mutant:
    """One change of one file.

    Attributes:
        file: relative to the checkout.
        line: of the first character that changes, from 1.
        scope: the functions and classes around it, and #2, #3, … where the same change comes again in them.
        before, after: the lines that change, without indentation.
        source: the whole file as changed.
    """

    file: str
    line: int
    kind: str
    scope: str
    before: str
    after: str
    source: str

    @property
    def key(self) -> tuple[str, str, str, str]:
        """Names the change whatever happens elsewhere in the file."""
        return self.file, self.scope, self.before, self.after

    def __str__(self) -> str:
        return f"{self.file}:{self.line} ({self.kind})\n    - {self.before}\n    + {self.after}"


def core_mutants(root: Path) -> list[Mutant]:
    """Every change of heli2dof_core."""
    found = []
    for path in sorted((root / "heli2dof_core").rglob("*.py")):
        if path.match("kernels/examples.py"):
            continue  # their types make Numba compile; their values matter to nobody
        source = path.read_text(encoding="utf-8")
        found += _mutants(path.relative_to(root).as_posix(), source, [tuple(site) for site in sites(source)])
    return found


def page_mutants(root: Path, node: str) -> list[Mutant]:
    """Every change of the modules that the page's tests import."""
    reply = subprocess.run(
        [node, HOME / "page_sites.mjs", root], capture_output=True, encoding="utf-8", check=True
    )
    found = []
    for file, places in json.loads(reply.stdout).items():
        source = (root / file).read_text(encoding="utf-8")
        assert max(map(ord, source)) < 0x10000, f"{file}: JavaScript counts such letters twice"
        fields = ("start", "end", "new", "kind", "scope")
        found += _mutants(file, source, [tuple(place[name] for name in fields) for place in places])
    return found


def _mutants(file: str, source: str, places: list[tuple[int, int, str, str, str]]) -> list[Mutant]:
    times: Counter[tuple[str, ...]] = Counter()
    found = []
    for start, end, new, kind, scope in places:
        first = source.rfind("\n", 0, start) + 1
        last = source.find("\n", end)
        before, after = source[first:last], source[first:start] + new + source[end:last]
        before, after = " ".join(before.split()), " ".join(after.split())
        times[scope, before, after] += 1
        again = times[scope, before, after]
        name = scope if again == 1 else f"{scope}#{again}"
        line = source.count("\n", 0, start) + 1
        found.append(Mutant(file, line, kind, name, before, after, source[:start] + new + source[end:]))
    return found


def sample(mutants: list[Mutant], count: int, seed: int) -> list[Mutant]:
    """As many of each kind as there are; by a hash of seed and key, so that edits elsewhere move little."""
    by_kind = defaultdict(list)
    for mutant in sorted(mutants, key=lambda m: sha256(f"{seed} {m.key}".encode()).digest()):
        by_kind[mutant.kind].append(mutant)
    turns = zip_longest(*(by_kind[kind] for kind in sorted(by_kind)))
    return [mutant for turn in turns for mutant in turn if mutant][:count]


def equal_mutants() -> dict[tuple[str, str, str, str], str]:
    """The reasons of the changes that were judged to make no difference, by key."""
    entries = json.loads(EQUAL.read_text(encoding="utf-8"))
    return {(e["file"], e["scope"], e["before"], e["after"]): e["reason"] for e in entries}
