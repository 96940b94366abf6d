"""What the page weighs: index.html and all that it and its modules name, as a compressing server would send it."""

from __future__ import annotations

import gzip
import re
from pathlib import Path

ROOT = Path(__file__).parents[1]
STATIC = ROOT / "static"
FIRST_VIEW, WHOLE = 236_000, 750_000
"""Bytes, compressed: of what the page needs at a first visit, and with all that it and its worker fetch later. The 3D
scene is a page of its own, in a frame, and not counted; nor is the kernel in WebAssembly, which no module imports.
The font of the formulas is, 34,000 of them."""
CLASS, AT_FIRST_CLASS = 152_000, 130_000
"""Bytes, compressed: of the instructor's page with all that it fetches later, and before that."""
SIZE = 15_000
"""Bytes of the largest module: who wants to read one reads no more than that. The kernels' table is read by none."""
LINKED = re.compile(r"""<(?:link|script|img)\b[^>]*?\b(?:href|src)="([^"]+)\"""")
OTHERS = {STATIC / "css" / name for name in ("login.css", "wall.css", "wall_sheets.css")}
LATE = sorted({*(STATIC / "css").glob("*.css")} - OTHERS)
"""The page's style sheets: those that index.html does not link are linked when their room comes."""
USED = re.compile(r"""\burl\("([^"]+)"\)""")  # of a style sheet
COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)  # types are imported in comments, which loads nothing
AT_FIRST = re.compile(r"""(?:\bfrom|\bimport)\s*["'](\.[^"']+)["']""")
IMPORTED = re.compile(r"""(?:\bfrom|\bimport|\bnew Worker\(new URL)\s*\(?\s*["'](\.[^"']+)["']""")


def loaded(imported: re.Pattern[str] = IMPORTED, page: Path = STATIC / "index.html") -> set[Path]:
    """A page, what it links, and every module reached from there by such imports."""
    late = LATE if page.name == "index.html" and imported is IMPORTED else []
    found, waiting = {page}, [ROOT / name for name in LINKED.findall(page.read_text("utf-8"))]
    while waiting:
        file = waiting.pop().resolve()
        if file in found:
            continue
        found.add(file)
        if file.suffix == ".js" and "vendor" not in file.parts:
            text = COMMENT.sub("", file.read_text("utf-8"))
            waiting += [file.parent / name for name in imported.findall(text)]
            waiting += late
        if file.suffix == ".css":
            waiting += [file.parent / name for name in USED.findall(file.read_text("utf-8"))]
    return found


def weight(file: Path) -> int:
    """Bytes after gzip at its default level."""
    return len(gzip.compress(file.read_bytes(), 6))


def test_the_page_is_light(record_property):
    first = loaded(AT_FIRST) | {file for file in loaded() if file.parent.name == "explore"}
    for files, limit, what in ((first, FIRST_VIEW, "first view"), (loaded(), WHOLE, "whole page")):
        weights = {str(file.relative_to(STATIC)): weight(file) for file in files}
        total = sum(weights.values())
        heaviest = sorted(weights.items(), key=lambda item: -item[1])[:5]
        record_property(what, total)
        print(f"\nthe {what}: {total} bytes in {len(weights)} files; heaviest: {heaviest}")
        assert {"main.js", "splane/math.js", "vendor/uplot/uPlot.esm.js", "css/style.css"} <= set(weights)
        late = {"css/math.css", "css/paper.css", "vendor/stix-two-math/stix-two-math.woff2"}
        assert late & set(weights) == (late if what == "whole page" else set())
        assert total <= limit


def test_the_instructors_page_is_light_and_adds_nothing_to_the_other(record_property):
    page = STATIC / "class.html"
    whole, first = loaded(page=page), loaded(AT_FIRST, page)
    weights = {str(file.relative_to(STATIC)): weight(file) for file in whole}
    total, at_first = sum(weights.values()), sum(map(weight, first))
    record_property("instructor's page", total)
    print(
        f"\nthe instructor's page: {total} bytes in {len(weights)} files, {at_first} in {len(first)} at first"
    )
    assert {"class.js", "wall/wall.js", "css/wall_sheets.css", "link/permalink.js"} <= set(weights)
    assert total <= CLASS and at_first <= AT_FIRST_CLASS
    own = {file for file in whole if file.parent.name == "wall"} | {page, STATIC / "class.js", *OTHERS}
    assert own & loaded() == set()


def test_every_module_of_the_page_is_loaded_and_small():
    modules = {file for file in STATIC.rglob("*.js") if "vendor" not in file.parts}
    scene_only = {STATIC / "scene" / name for name in ("partner.js", "shim.js", "spectator.js", "window.js")}
    api_only = {STATIC / "api_docs.js"}
    instructors = loaded(page=STATIC / "class.html")
    packaged_only = {*(STATIC / "scorm").glob("*.js"), STATIC / "net/packaged.js"}
    launch_only = {STATIC / "lti/launch.js"}
    others = instructors | scene_only | api_only | packaged_only | launch_only
    assert modules - loaded() - others == set()
    read = modules - {STATIC / "kernel/table.js"}
    assert {file.name: size for file in read if (size := file.stat().st_size) > SIZE} == {}


def types_of(file: Path) -> list[str]:
    """What a file says of types: in a module what stands in braces in its comments, else all but comments."""
    text = file.read_text("utf-8")
    if file.suffix == ".ts":
        return [COMMENT.sub("", text)]
    found = []
    for comment in COMMENT.findall(text):
        depth, start = 0, 0
        for at, letter in enumerate(comment):
            depth, before = max(depth + {"{": 1, "}": -1}.get(letter, 0), 0), depth
            if (before, depth) == (0, 1):
                start = at
            elif (before, depth) == (1, 0):
                found.append(re.sub("'[^']*'", "''", comment[start:at]))
    return found


def test_types_are_told():
    """Nowhere `any`, which turns the check of types off for all that it reaches."""
    files = [
        file for end in ("js", "d.ts") for file in STATIC.rglob(f"*.{end}") if "vendor" not in file.parts
    ]
    kinds = {file: types_of(file) for file in files}
    assert sum(map(len, kinds.values())) > 2000, "so many types are told"
    some = {file.name: n for file in files if (n := len(re.findall(r"\bany\b", " ".join(kinds[file]))))}
    assert some == {}
    off = [
        file.name
        for file in files
        if re.search(r"@ts-(?:ignore|nocheck|expect-error)", file.read_text("utf-8"))
    ]
    assert off == []


def test_types_are_fetched_by_nobody():
    """No module imports a file of declarations, and no browser could find one under the name that comments use."""
    declared = {file.name.removesuffix(".d.ts") for file in STATIC.glob("*.d.ts")}
    assert declared == {"contract", "types"}
    assert [name for name in declared if (STATIC / f"{name}.js").exists()] == []
    assert not {file for file in loaded() if ".d." in file.name}


def test_no_line_of_javascript_is_long():
    files = [
        *STATIC.rglob("*.js"),
        STATIC / "types.d.ts",
        *(ROOT / "tests").rglob("*.mjs"),
        ROOT / "eslint.config.js",
    ]
    lines = (
        f"{file.relative_to(ROOT)}:{number}"
        for file in files
        if "vendor" not in file.parts
        for number, line in enumerate(file.read_text("utf-8").splitlines(), 1)
        if len(line) > 120
    )
    assert list(lines) == []


def test_the_lock_names_no_registry():
    lock = (ROOT / "package-lock.json").read_text("utf-8")
    assert '"integrity"' in lock
    assert "resolved" not in lock and "://" not in lock
