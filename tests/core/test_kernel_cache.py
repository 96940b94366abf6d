"""What is said of Numba's cache is true: what it does not hold is noticed before anything compiles."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from typing import Any

import pytest

from heli2dof_core.kernel_cache import KernelCache, NotKeptError

SOURCE = "from numba import njit\n\n\n@njit(cache=True, _nrt=False)\ndef times(x):\n    return {factor} * x\n"


@dataclass(frozen=True)
class Process:
    """What a new process has: a kernel that nobody has called, and the cache beside it."""

    cache: KernelCache
    times: Any

    def exercise(self) -> None:
        self.times(1.0)


@pytest.fixture
def start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., Process]:
    """Starts as a new process does; with a factor, after the source has changed."""
    monkeypatch.setattr(
        sys, "dont_write_bytecode", True
    )  # Python knows a source by its second and its length alone
    path = tmp_path / "tiny_kernels.py"
    path.write_text(SOURCE.format(factor=2))

    def started(factor: int | None = None) -> Process:
        if factor is not None:
            path.write_text(SOURCE.format(factor=factor))
        spec = spec_from_file_location(path.stem, path)
        assert spec is not None and spec.loader is not None
        module = module_from_spec(spec)
        monkeypatch.setitem(sys.modules, path.stem, module)
        spec.loader.exec_module(module)
        return Process(KernelCache(Path(module.times.stats.cache_path), [path]), module.times)

    return started


def kept(folder: Path, ending: str) -> Path:
    (found,) = folder.rglob(f"tiny_kernels.*{ending}")
    return found


def seal(folder: Path) -> Path:
    (found,) = folder.rglob("heli2dof-kernels.*.json")
    return found


def test_what_was_filled_is_loaded_and_never_compiled(start):
    first = start()
    assert not first.cache.whole()
    with pytest.raises(NotKeptError, match="times"):
        first.cache.load(first.exercise)
    assert first.times.signatures == []  # it was not compiled all the same
    first.cache.fill(first.exercise)
    later = start()
    assert later.cache.whole()
    later.cache.load(later.exercise)
    assert later.times(21.0) == 42.0
    assert sum(later.times.stats.cache_hits.values()) == 1
    assert not later.times.stats.cache_misses


def remove(ending: str) -> Callable[[Path], None]:
    return lambda folder: kept(folder, ending).unlink()


def write(ending: str, content: bytes) -> Callable[[Path], object]:
    return lambda folder: kept(folder, ending).write_bytes(content)


def claim(**what: str) -> Callable[[Path], object]:
    def change(folder: Path) -> None:
        path = seal(folder)
        path.write_text(json.dumps(json.loads(path.read_bytes()) | what))

    return change


@pytest.mark.parametrize(
    "damage",
    [
        remove(".nbc"),
        remove(".nbi"),
        write(".nbc", b""),
        write(".nbc", b"no machine code"),
        write(".nbi", b"no index"),
        lambda folder: seal(folder).write_text("{"),
        lambda folder: seal(folder).unlink(),
        claim(processor="i486"),
        claim(numba="0.1"),
        claim(python="2.7"),
    ],
    ids=[
        "no code",
        "no index",
        "empty",
        "garbage",
        "index",
        "half a seal",
        "no seal",
        "processor",
        "Numba",
        "Python",
    ],
)
def test_a_damaged_cache_is_not_whole_and_made_whole_again(start, tmp_path, damage):
    first = start()
    first.cache.fill(first.exercise)
    assert first.cache.whole()
    damage(tmp_path)
    later = start()
    assert not later.cache.whole()
    later.cache.fill(later.exercise)
    assert later.times(21.0) == 42.0
    last = start()
    assert last.cache.whole()
    last.cache.load(last.exercise)


def test_a_seal_that_lies_is_found_out_before_anything_compiles(start, tmp_path):
    first = start()
    first.cache.fill(first.exercise)
    code = kept(tmp_path, ".nbc")
    code.unlink()
    claimed = json.loads(seal(tmp_path).read_bytes())
    del claimed["files"][code.name]
    seal(tmp_path).write_text(json.dumps(claimed))
    later = start()
    assert later.cache.whole()
    with pytest.raises(NotKeptError):
        later.cache.load(later.exercise)
    assert later.times.signatures == []


def test_another_source_and_other_options_are_another_cache(start, monkeypatch):
    first = start()
    first.cache.fill(first.exercise)
    changed = start(factor=3)
    assert not changed.cache.whole()
    changed.cache.fill(changed.exercise)
    assert changed.times(14.0) == 42.0
    assert start().cache.whole()
    monkeypatch.setenv("NUMBA_OPT", "1")
    assert not start().cache.whole()
    monkeypatch.delenv("NUMBA_OPT")
    monkeypatch.setenv("NUMBA_CACHE_DIR", "elsewhere")  # where a copy lies does not matter
    assert start().cache.whole()
