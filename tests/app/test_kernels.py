"""The child process that compiles a server's kernels."""

from __future__ import annotations

import inspect
import json
import shutil
import subprocess
from pathlib import Path

import pytest
from numba.core.caching import UserProvidedCacheLocator

import heli2dof_core
from app.jobs.kernel_compiler import compiler
from heli2dof_core.engine import engine
from tests.children import python


def test_it_compiles_the_package_that_serves_and_not_one_in_the_working_directory(tmp_path, monkeypatch):
    other = tmp_path / "heli2dof_core"
    other.mkdir()
    (other / "__init__.py").write_text("raise SystemExit('another one')")
    monkeypatch.chdir(tmp_path)
    command, environment = compiler("import heli2dof_core; print(heli2dof_core.__file__)")
    shown = subprocess.run(command, env=environment, capture_output=True, text=True, check=True).stdout
    assert shown.strip() == heli2dof_core.__file__


STARTS = """
import logging, sys
from app.jobs.kernel_compiler import COMPILE, KernelCompiler
from heli2dof_core.engine import engine
logging.basicConfig(level="INFO", format="%(message)s", stream=sys.stdout)
compilers = []
sys.addaudithook(lambda name, told: name == "subprocess.Popen" and COMPILE in told[1] and compilers.append(told))
KernelCompiler().run()
print(engine().compiled, len(compilers))
"""


@pytest.fixture
def cache(tmp_path: Path) -> Path:
    """A copy of the cache of this checkout, as a read-only container's server makes one."""
    own = Path(engine().integrate.stats.cache_path)
    kernels = inspect.getfile(engine().integrate.py_func)
    return shutil.copytree(own, tmp_path / UserProvidedCacheLocator.get_suitable_cache_subpath(kernels))


def test_a_whole_cache_needs_no_compiler(cache: Path):
    shown = python("-c", STARTS, NUMBA_CACHE_DIR=str(cache.parent)).strip().split("\n")
    assert shown[-1] == "True 0"
    assert shown[0].startswith("kernels ready")


def test_a_kernel_missing_against_expectation_is_the_compilers_work(cache: Path):
    """Its seal says whole: found out while loading, told, and mended by the child process."""
    gone = {path.name for path in cache.glob("loop.loop_matrices-*")}
    assert gone
    for name in gone:
        (cache / name).unlink()
    (seal,) = cache.glob("heli2dof-kernels.*.json")
    claimed = json.loads(seal.read_bytes())
    claimed["files"] = {name: sha for name, sha in claimed["files"].items() if name not in gone}
    seal.write_text(json.dumps(claimed))
    shown = python("-c", STARTS, NUMBA_CACHE_DIR=str(cache.parent))
    assert "compiled anew: Numba's cache does not hold loop_matrices" in shown
    assert shown.strip().endswith("True 1")
    assert {path.name for path in cache.glob("loop.loop_matrices-*")} == gone
