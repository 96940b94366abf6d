"""The house's rules, proved: no cycles, small files, imports that stay light, nothing of other hosts."""

from __future__ import annotations

import ast
import re
import subprocess

import grimp
import pytest

from tests.children import ROOT, python

TRACKED = subprocess.run(
    ["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True
).stdout.split("\n")
SOURCES = [ROOT / name for name in TRACKED if name.endswith((".py", ".js", ".mjs", ".css", ".html"))]
SOURCES = [path for path in SOURCES if path.is_file()]


def test_no_import_cycle():
    graph = grimp.build_graph("heli2dof_core", "app", cache_dir=None)
    done: set[str] = set()

    def visit(module: str, path: tuple[str, ...]) -> None:
        assert module not in path, " → ".join((*path[path.index(module) :], module))
        if module not in done:
            for imported in graph.find_modules_directly_imported_by(module):
                visit(imported, (*path, module))
            done.add(module)

    for module in graph.modules:
        visit(module, ())
    assert len(done) > 40


LARGEST = {".css": 24_000}
LARGEST_OTHERS = 18_000
"""Bytes of a source file, as 400 lines of 45 characters have: who writes longer lines has fewer of them."""


def test_files_are_small():
    """In bytes, which neither long lines nor dense ones can get round."""
    read = [path for path in SOURCES if path.name != "table.js"]  # the kernels' own, which nobody reads
    sizes = {path: path.stat().st_size for path in read}
    large = [path for path, size in sizes.items() if size > LARGEST.get(path.suffix, LARGEST_OTHERS)]
    assert large == []


def imported(tree: ast.AST) -> set[str]:
    """Top packages that a file imports, wherever in it."""
    nodes = list(ast.walk(tree))
    names = [alias.name for node in nodes if isinstance(node, ast.Import) for alias in node.names]
    names += [node.module or "" for node in nodes if isinstance(node, ast.ImportFrom)]
    return {name.partition(".")[0] for name in names} | {
        name.partition(".")[2].partition(".")[0] for name in names if name.startswith("tests.")
    }


def test_the_cores_tests_know_no_app():
    for path in sorted((ROOT / "tests" / "core").glob("*.py")):
        assert "app" not in imported(ast.parse(path.read_text(encoding="utf-8"))), path


def test_no_test_waits_for_time():
    """Only `until` polls, and what an event loop does in a turn of its own takes no time."""
    for folder in ("app", "core", "deploy", "e2e", "examples"):
        for path in sorted((ROOT / "tests" / folder).glob("*.py")):
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                called = node.func if isinstance(node, ast.Call) else None
                name = getattr(called, "attr", getattr(called, "id", ""))
                if name in ("sleep", "wait_for_timeout"):
                    argument = node.args[0] if isinstance(node, ast.Call) and node.args else None
                    no_time = isinstance(argument, ast.Constant) and argument.value == 0
                    assert no_time, f"{path.relative_to(ROOT)}:{getattr(node, 'lineno', 0)}"


@pytest.mark.parametrize(
    ("statement", "forbidden"),
    [
        (
            "import heli2dof_core",
            (
                *("sympy", "control", "viser", "fastapi", "scipy.integrate", "scipy.signal"),
                *("h5py", "openpyxl", "scipy.io", "jinja2", "heli2dof_core.recordings.recording"),
            ),
        ),
        (
            "import app.main; app.main.create_app()",
            (
                *("sympy", "control", "viser", "scipy.integrate", "scipy.signal"),
                *("h5py", "openpyxl", "scipy.io", "jinja2", "sqlalchemy", "alembic", "yaml"),
            ),
        ),
        *(
            (
                "from heli2dof_core import Observer, Rotor, Rotors, Spec, evaluate;"
                "from app.contract.evaluation import report_reply;"
                f"spec = Spec.from_preset({changes}); report_reply(evaluate(spec, each_axis=True), spec)",
                ("sympy",),
            )
            for changes in (
                "",
                "rotors=Rotors(Rotor(0.1), Rotor(0.2)), place_rotors=True, observer=Observer()",
            )
        ),
    ],
)
def test_imports_stay_light(statement: str, forbidden: tuple[str, ...]):
    code = f"import sys; {statement}; print([m for m in {forbidden!r} if m in sys.modules])"
    assert python("-c", code).strip() == "[]"


def test_page_and_locks_name_no_other_host():
    for name in TRACKED:
        path = ROOT / name
        if path.suffix in (".js", ".html", ".css", ".json", ".txt") and path.is_file():
            hosts = set(re.findall(r"https?://([\w.-]+)", path.read_text(encoding="utf-8")))
            # names of vocabularies, and no addresses that anything is fetched from
            assert hosts <= {"www.w3.org", "127.0.0.1", "json-schema.org"}, (name, hosts)


EVALUATING = {"eval", "exec", "compile", "sympify", "parse_expr", "parse_latex", "literal_eval", "__import__"}
BETWEEN_OWN_PROCESSES = "app/jobs/packed.py"
"""Unpickles what a process of the server sends another over a socket that both alone hold."""
UNPICKLING = {"pickle", "cPickle", "dill", "cloudpickle", "joblib", "marshal", "shelve", "jsonpickle"}


def test_nothing_is_evaluated_from_text():
    """No call of an evaluator by any name, no unpickling import, no NumPy or SciPy reader that unpickles."""
    for name in TRACKED:
        if not name.startswith(("app/", "heli2dof_core/")) or not name.endswith(".py"):
            continue
        for node in ast.walk(ast.parse((ROOT / name).read_text(encoding="utf-8"))):
            where = f"{name}:{getattr(node, 'lineno', 0)}"
            if isinstance(node, ast.Call):
                called = node.func
                # re.compile is a method of a module, compile() Python's own.
                own = called.id if isinstance(called, ast.Name) else ""
                method = called.attr if isinstance(called, ast.Attribute) else ""
                assert own not in EVALUATING, where
                assert method not in EVALUATING - {"compile"}, where
                allowed = [k for k in node.keywords if k.arg == "allow_pickle"]
                assert all(isinstance(k.value, ast.Constant) and k.value.value is False for k in allowed), (
                    where
                )
            if isinstance(node, ast.Import | ast.ImportFrom) and name != BETWEEN_OWN_PROCESSES:
                modules = (
                    {node.module or ""} if isinstance(node, ast.ImportFrom) else {a.name for a in node.names}
                )
                assert not {m.partition(".")[0] for m in modules} & UNPICKLING, where


def test_sympy_is_imported_before_any_part_of_it():
    """Who asks for a part of a package that another thread is importing does not wait for the package."""
    found, parts = [], 0
    for path in (path for path in SOURCES if path.parts[-2] != "tests" and path.suffix == ".py"):
        if ROOT / "heli2dof_core" not in path.parents:
            continue
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            body = getattr(node, "body", None)
            if not isinstance(body, list) or (
                isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)
            ):
                continue
            whole = False
            for line in body:
                if isinstance(line, ast.Import):
                    whole = whole or any(name.name == "sympy" for name in line.names)
                elif isinstance(line, ast.ImportFrom) and (line.module or "").partition(".")[0] == "sympy":
                    parts += line.module != "sympy"
                    whole = whole or line.module == "sympy"
                    if not whole:
                        found.append(f"{path.relative_to(ROOT)}:{line.lineno}")
    assert parts > 10
    assert found == []
