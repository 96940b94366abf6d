"""How matrices are written in the languages of the exported scripts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..signals import Floats


@dataclass(frozen=True)
class Dialect:
    """A language; expressions are given to it in Python's, and what differs by its methods.

    Attributes:
        matlab: MATLAB and Octave; else Python with NumPy.
        comment: what begins one.
        end: of a statement.
        integral: name of the integral action's matrix, as `I` is MATLAB's imaginary unit.
    """

    matlab: bool
    comment: str
    end: str
    integral: str

    def line(self, name: str, expression: str, comment: str = "") -> str:
        """An assignment."""
        own = self.of(expression)
        return f"{name} = {own}{self.end}" + (f"  {self.comment} {comment}" if comment else "")

    def of(self, expression: str) -> str:
        """An expression that was written for Python."""
        if not self.matlab:
            return expression
        return expression.replace(" @ ", " * ").replace(".T", "'").replace("**", "^")

    def zeros(self, rows: int, columns: int) -> str:
        """A matrix of zeros."""
        if self.matlab:
            return f"zeros({rows})" if rows == columns else f"zeros({rows}, {columns})"
        return f"np.zeros(({rows}, {columns}))"

    def eye(self, rows: int, columns: int) -> str:
        """Ones on the diagonal."""
        name = "eye" if self.matlab else "np.eye"
        return f"{name}({rows})" if rows == columns else f"{name}({rows}, {columns})"

    def function(self, name: str) -> str:
        """A function that both have by this name."""
        return name if self.matlab else f"np.{name}"

    def columns(self, name: str, first: int, last: int) -> str:
        """Columns of a matrix, counted from 0, `last` not among them."""
        return f"{name}(:, {first + 1}:{last})" if self.matlab else f"{name}[:, {first}:{last}]"

    def entry(self, name: str, i: int) -> str:
        """An entry of a vector, counted from 0."""
        return f"{name}({i + 1})" if self.matlab else f"{name}[{i}]"

    def vector(self, values: Sequence[float]) -> str:
        """A pair or so, as a column where the language knows columns."""
        if self.matlab:
            return f"[{'; '.join(map(repr, values))}]"
        return f"np.array([{', '.join(map(repr, values))}])"

    def rows(self, *rows: str) -> str:
        """A small matrix of numbers, its rows' entries separated by commas."""
        return f"[{'; '.join(rows)}]" if self.matlab else f"[{', '.join(f'[{row}]' for row in rows)}]"

    def beside(self, blocks: Sequence[str]) -> str:
        """Blocks side by side."""
        if len(blocks) == 1:
            return blocks[0]
        inner = ", ".join(blocks)
        return f"[{inner}]" if self.matlab else f"np.hstack([{inner}])"

    def stacked(self, blocks: Sequence[str]) -> str:
        """Blocks upon one another."""
        if len(blocks) == 1:
            return blocks[0]
        return f"[{'; '.join(blocks)}]" if self.matlab else f"np.vstack([{', '.join(blocks)}])"

    def block(self, rows: Sequence[Sequence[str]]) -> str:
        """A matrix of blocks; a line for each of its rows where they are many."""
        if len(rows) == 1:
            return rows[0][0]
        inner = [", ".join(row) for row in rows]
        if self.matlab:
            between = "; " if len(rows) == 2 else "; ...\n    "
            return f"[{'' if len(rows) == 2 else '...' + chr(10) + '    '}{between.join(inner)}]"
        if len(rows) == 2:
            return f"np.block([{', '.join(f'[{row}]' for row in inner)}])"
        lines = "".join(f"    [{row}],\n" for row in inner)
        return f"np.block([\n{lines}])"

    def matrix(self, name: str, rows: Floats, comment: str) -> str:
        """A constant matrix, with a comment on what it is."""
        numbers = [", ".join(map(repr, row)) for row in rows.tolist()]
        if self.matlab:
            inner = "; ...\n".join(f"    {row}" for row in numbers)
            return f"% {comment}\n{name} = [ ...\n{inner} ...\n];"
        inner = "\n".join(f"    [{row}]," for row in numbers)
        return f"{name} = np.array([  # {comment}\n{inner}\n])"


PYTHON = Dialect(False, "#", "", "I")
MATLAB = Dialect(True, "%", ";", "I_z")
