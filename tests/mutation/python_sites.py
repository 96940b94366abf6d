"""Where a Python file can be changed in one place, and into what."""

from __future__ import annotations

import ast
import io
import tokenize
from collections.abc import Iterator
from itertools import pairwise
from typing import NamedTuple

ARITHMETIC = {
    ast.Add: ("+", "-"),
    ast.Sub: ("-", "+"),
    ast.Mult: ("*", "/"),
    ast.Div: ("/", "*"),
    ast.FloorDiv: ("//", "*"),
    ast.Mod: ("%", "*"),
    ast.Pow: ("**", "*"),
    ast.BitAnd: ("&", "|"),
    ast.BitOr: ("|", "&"),
}
COMPARISONS = {
    ast.Lt: ("<", ("<=", ">=")),
    ast.LtE: ("<=", ("<", ">")),
    ast.Gt: (">", (">=", "<=")),
    ast.GtE: (">=", (">", "<")),
    ast.Eq: ("==", ("!=",)),
    ast.NotEq: ("!=", ("==",)),
    ast.Is: ("is", ("is not",)),
    ast.IsNot: ("is not", ("is",)),
    ast.In: ("in", ("not in",)),
    ast.NotIn: ("not in", ("in",)),
}
TWINS = dict(
    pair
    for one, other in (("min", "max"), ("any", "all"), ("sin", "cos"), ("minimum", "maximum"))
    for pair in ((one, other), (other, one))
)


class Site(NamedTuple):
    """One change: characters start to end of the file become `new`; `scope` is the function around it."""

    start: int
    end: int
    new: str
    kind: str
    scope: str


def sites(source: str) -> list[Site]:
    """All changes of a file, in the file's order; nothing in strings, messages, annotations or decorators."""
    return sorted(_Finder(source).found(ast.parse(source), ""))


class _Finder:
    def __init__(self, source: str) -> None:
        self.source = source
        self.lines = source.splitlines(keepends=True)
        self.begins = [0]
        for line in self.lines:
            self.begins.append(self.begins[-1] + len(line))
        tokens = tokenize.generate_tokens(io.StringIO(source).readline)
        places = [(self.begins[t.start[0] - 1] + t.start[1], t.string) for t in tokens]
        self.words = [(at, word) for at, word in places if word.strip() and not word.startswith("#")]

    def place(self, node: ast.AST, end: bool = False) -> int:
        row = (node.end_lineno if end else node.lineno) - 1
        column = node.end_col_offset if end else node.col_offset  # in bytes
        return self.begins[row] + len(self.lines[row].encode()[:column].decode())

    def between(self, left: ast.AST, right: ast.AST, operator: str) -> tuple[int, int]:
        """The operator's own characters between two operands, which may stand in parentheses."""
        first, *rest = operator.split()
        low, high = self.place(left, end=True), self.place(right)
        words = [(at, word) for at, word in self.words if low <= at < high]
        at = next(at for at, word in words if word == first)
        last = next(at for at, word in words if word == rest[0]) + len(rest[0]) if rest else at + len(first)
        return at, last

    def found(self, node: ast.AST, scope: str) -> Iterator[Site]:
        if _is_silent(node):
            return
        for start, end, new, kind in self.changes(node):
            yield Site(start, end, new, kind, scope)
        inner = scope
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            inner = f"{scope}.{node.name}".lstrip(".")
        for name, value in ast.iter_fields(node):
            if name in ("annotation", "returns", "decorator_list", "bases"):
                continue
            for child in value if isinstance(value, list) else [value]:
                if isinstance(child, ast.AST):
                    yield from self.found(child, inner)

    def changes(self, node: ast.AST) -> Iterator[tuple[int, int, str, str]]:
        """What can be changed at this node itself."""
        yield from self.operators(node)
        yield from self.atoms(node)
        yield from self.conditions(node)

    def operators(self, node: ast.AST) -> Iterator[tuple[int, int, str, str]]:
        match node:
            case ast.BinOp(left, op, right) if type(op) in ARITHMETIC and not _is_text(left, right):
                old, new = ARITHMETIC[type(op)]
                yield *self.between(left, right, old), new, "arithmetic"
            case ast.AugAssign(target, op, value) if type(op) in ARITHMETIC:
                old, new = ARITHMETIC[type(op)]
                yield *self.between(target, value, f"{old}="), f"{new}=", "arithmetic"
            case ast.Compare(left, ops, others):
                for op, (one, other) in zip(ops, pairwise([left, *others]), strict=True):
                    old, news = COMPARISONS[type(op)]
                    for new in news:
                        kind = "boundary" if new.strip("=") == old.strip("=") else "comparison"
                        yield *self.between(one, other, old), new, kind
            case ast.BoolOp(op, values):
                old, new = ("and", "or") if isinstance(op, ast.And) else ("or", "and")
                for one, other in pairwise(values):
                    yield *self.between(one, other, old), new, "boolean"

    def atoms(self, node: ast.AST) -> Iterator[tuple[int, int, str, str]]:
        start, end = (self.place(node), self.place(node, end=True)) if hasattr(node, "lineno") else (0, 0)
        match node:
            case ast.UnaryOp(ast.Not() | ast.USub() as op):
                yield start, start + (3 if isinstance(op, ast.Not) else 1), "", "dropped sign or not"
            case ast.Constant(value):
                for new in _constants(value):
                    yield start, end, new, "constant"
            case ast.Name(name) | ast.Attribute(attr=name) if name in TWINS:
                yield end - len(name), end, TWINS[name], "function"
            case ast.Return(value) if value and not _is(value, None) and not _is_text(value):
                yield self.place(value), self.place(value, end=True), "None", "return"

    def conditions(self, node: ast.AST) -> Iterator[tuple[int, int, str, str]]:
        test = getattr(node, "test", None)
        for each in node.ifs if isinstance(node, ast.comprehension) else [test]:
            if isinstance(each, ast.Name | ast.Attribute | ast.Call | ast.Subscript):
                start, end = self.place(each), self.place(each, end=True)
                yield start, end, f"(not {self.source[start:end]})", "condition"


def _is_silent(node: ast.AST) -> bool:
    """Words for people, and what only the checker of types reads."""
    match node:
        case ast.Raise() | ast.JoinedStr() | ast.ImportFrom() | ast.Import() | ast.Assert():
            return True
        case ast.Assign(targets=[ast.Name("__all__")]):
            return True
        case ast.If(test=ast.Name("TYPE_CHECKING")):
            return True
        case ast.Call(func=ast.Name("cast" | "TypeVar" | "NewType")):
            return True
    return False


def _is_text(*operands: ast.AST) -> bool:
    return any(
        isinstance(o, ast.JoinedStr) or (isinstance(o, ast.Constant) and isinstance(o.value, str))
        for o in operands
    )


def _is(node: ast.AST, value: object) -> bool:
    return isinstance(node, ast.Constant) and node.value is value


def _constants(value: object) -> list[str]:
    if isinstance(value, bool):
        return [str(not value)]
    if isinstance(value, int):
        return [str(value + 1), str(value - 1)] if value < 20 else [str(2 * value), str(value // 2)]
    if isinstance(value, float):
        return [repr(2 * value), repr(value / 2)] if value else ["1.0"]
    return []
