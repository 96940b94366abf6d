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

from tests.scene_server import until

ROOT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
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
    subprocess.run(command, check=True, capture_output=True)
    return next(folder.glob("heli2dof-*.whl"))


def test_wheel_holds_what_is_needed_and_nothing_else(wheel: Path):
    names = zipfile.ZipFile(wheel).namelist()
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"heli2dof_app", "heli2dof_core"}
    wanted = ("index.html", "main.js", "scene_shim.js", "vendor/uplot/uPlot.esm.js", "vendor/uplot/LICENSE")
    assert {f"heli2dof_app/static/{name}" for name in wanted} <= set(names)
    assert "heli2dof_core/py.typed" in names
    assert not [name for name in names if "__pycache__" in name or "test" in name or "node_modules" in name]
    tracked = subprocess.run(
        ["git", "ls-files", "static"], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert {f"heli2dof_app/{name}" for name in tracked.stdout.split()} <= set(names)


def test_wheel_has_the_command_line(wheel: Path, tmp_path: Path):
    zipfile.ZipFile(wheel).extractall(tmp_path)
    code = f"import sys; sys.path.insert(0, {str(tmp_path)!r}); from heli2dof_app.cli import main; main(sys.argv[1:])"
    for words, shown in (
        (["--help"], "robustness"),
        (["gains"], "51.17"),
        (["export", "csv", "-o", "-"], "theta"),
    ):
        command = [sys.executable, "-I", "-c", code, *words]
        result = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=True)
        assert shown in result.stdout


def test_wheel_serves_outside_the_checkout(wheel: Path, tmp_path: Path):
    zipfile.ZipFile(wheel).extractall(tmp_path)
    code = (
        f"import sys; sys.path.insert(0, {str(tmp_path)!r}); import heli2dof_app.cli as cli; "
        f"assert cli.__file__.startswith({str(tmp_path)!r}); cli.main(['serve', '--port', '0'])"
    )
    process = subprocess.Popen(
        [sys.executable, "-I", "-c", code],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        text=True,
    )
    try:
        assert process.stdout is not None
        found = re.search(r"http://127.0.0.1:(\d+)", process.stdout.readline())
        assert found
        url = found[0]
        until(lambda: httpx2.get(f"{url}/healthz").status_code == 200, "the wheel's app is ready", 60)
        assert "<title>" in httpx2.get(url).text
        assert httpx2.get(f"{url}/static/vendor/uplot/uPlot.esm.js").status_code == 200
        assert httpx2.post(f"{url}/api/v1/gains", json={}).json()["pole_error"] < 1e-9
        session = f"{url}/scene/wheel_wheel_wheel_wheel"
        assert "scene_shim.js" in httpx2.get(f"{session}/").text
        address = session.replace("http", "ws")
        with connect(address, subprotocols=["viser-v1.1.1"], compression=None, max_size=None) as scene:
            assert len(scene.recv(timeout=30)) > 1000
    finally:
        process.terminate()
        process.wait(30)
        process.stdout.close()
