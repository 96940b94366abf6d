"""The wheel alone, away from the checkout, serves page, scene and numbers."""

from __future__ import annotations

import re
import subprocess
import sys
import zipfile
from pathlib import Path

import httpx2
import pytest
from websockets.sync.client import connect
from websockets.typing import Subprotocol

from tests.children import ROOT, environment, python, served
from tests.patience import PATIENCE, until
from tests.scene_client import VISER

pytestmark = pytest.mark.slow


@pytest.fixture(scope="session")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    command = [
        sys.executable,
        "-m",
        "pip",
        "wheel",
        "--quiet",
        "--no-deps",
        "--wheel-dir",
        str(folder),
        str(ROOT),
    ]
    subprocess.run(command, check=True, capture_output=True, env=environment())
    return next(folder.glob("heli2dof-*.whl"))


def test_wheel_holds_what_is_needed_and_nothing_else(wheel: Path):
    names = zipfile.ZipFile(wheel).namelist()
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"heli2dof_app", "heli2dof_core"}
    wanted = ("index.html", "main.js", "scene/shim.js", "vendor/uplot/uPlot.esm.js", "vendor/uplot/LICENSE")
    assert {f"heli2dof_app/static/{name}" for name in wanted} <= set(names)
    assert "heli2dof_core/py.typed" in names
    foreign = re.compile(r"(^|/)(__pycache__|node_modules|tests?)/|(^|/)test_|\.test\.")
    assert not [name for name in names if foreign.search(name)]
    tracked = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True)
    for name in tracked.stdout.split():
        top, _, inside = name.partition("/")
        if top in ("static", "app", "heli2dof_core"):  # templates among them
            installed = {"static": f"heli2dof_app/{name}", "app": f"heli2dof_app/{inside}"}.get(top, name)
            assert installed in names


@pytest.fixture(scope="session")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with what the wheel holds, as an installation has it."""
    folder = tmp_path_factory.mktemp("installed")
    zipfile.ZipFile(wheel).extractall(folder)
    return folder


def program(folder: Path, words: str) -> tuple[str, ...]:
    """Calls the command line of that installation alone."""
    code = (
        f"import sys; sys.path.insert(0, {str(folder)!r}); import heli2dof_app.cli as cli; "
        f"assert cli.__file__.startswith({str(folder)!r}); cli.main({words})"
    )
    return sys.executable, "-I", "-c", code


def test_wheel_has_the_command_line(installed: Path, tmp_path: Path):
    for words, shown in (
        (["--help"], "robustness"),
        (["gains"], "51.17"),
        (["export", "csv", "-o", "-"], "theta"),
        (["export", "report", "-o", "-"], "</html>"),
    ):
        assert shown in python(*program(installed, "sys.argv[1:]")[1:], *words, cwd=tmp_path)


def test_wheel_serves_outside_the_checkout(installed: Path, tmp_path: Path):
    with served(tmp_path, program(installed, "['serve', '--port', '0']")) as server:
        url = server.http
        until(lambda: server.answers, "the wheel's app is ready")
        assert "<title>" in httpx2.get(url).text
        assert httpx2.get(f"{url}/static/vendor/uplot/uPlot.esm.js").status_code == 200
        assert httpx2.post(f"{url}/api/v1/gains", json={}, timeout=PATIENCE).json()["pole_error"] < 1e-9
        session = "/scene/wheel_wheel_wheel_wheel"
        assert "scene/shim.js" in httpx2.get(f"{url}{session}/").text
        viser = {"subprotocols": [Subprotocol(VISER)], "compression": None, "max_size": None}
        with connect(f"{server.ws}{session}", **viser) as scene:
            assert len(scene.recv(timeout=PATIENCE)) > 1000


def test_an_editable_installation_runs_the_checkout(tmp_path: Path):
    command = [
        sys.executable,
        "-m",
        "pip",
        "install",
        "--quiet",
        "--no-deps",
        "--prefix",
        str(tmp_path),
        "-e",
    ]
    subprocess.run([*command, str(ROOT)], check=True, capture_output=True, env=environment())
    (packages,) = tmp_path.glob("lib/python*/site-packages")
    code = (
        f"import site, sys; known = [*sys.path]; site.addsitedir({str(packages)!r})\n"
        "sys.path[:] = [path for path in sys.path if path not in known] + known\n"
        "import heli2dof_app.cli, heli2dof_core\n"
        "print(heli2dof_app.cli.__file__, heli2dof_core.__file__); heli2dof_app.cli.main(['gains'])"
    )
    said = python("-I", "-c", code, cwd=tmp_path)
    assert f"{ROOT / 'app/cli/__init__.py'} {ROOT / 'heli2dof_core/__init__.py'}" in said and "51.17" in said
