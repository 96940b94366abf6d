"""What an option's text may be: poles, numbers, assignments, names that the shell completes."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Any

import click
from click.shell_completion import CompletionItem

_PAIR = re.compile(r"(?<=[\d.])(±|\+-|\+/-)")


class Poles(click.ParamType):
    """Four poles: ``-12,-10,-3+4j,-3-4j``, or ``-12,-10,-3±4j``."""

    name = "poles"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """As the REST API takes them."""
        found: list[complex] = []
        for word in value.replace("−", "-").replace("i", "j").split(","):
            plain = word.replace(" ", "")
            try:
                pole = complex(_PAIR.sub("+", plain))
            except ValueError:
                self.fail(
                    f"{word.strip()!r} is no pole; write -12,-10,-3+4j,-3-4j or -12,-10,-3±4j", param, ctx
                )
            found += [pole, pole.conjugate()] if _PAIR.search(plain) else [pole]
        return [{"re": p.real, "im": p.imag} if p.imag else p.real for p in found]


class Numbers(click.ParamType):
    """Numbers with commas between them."""

    name = "numbers"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """A list of floats."""
        try:
            return [float(word) for word in value.split(",")]
        except ValueError:
            self.fail(f"{value!r} is no list of numbers; write 0,1,10", param, ctx)


class Ranges(click.ParamType):
    """``-15:0,0:12``: from where to where x and y go."""

    name = "x:x,y:y"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """A list of pairs of floats."""
        try:
            return [[float(end) for end in side.split(":")] for side in value.replace("−", "-").split(",")]
        except ValueError:
            self.fail(f"{value!r} is no pair of ranges; write -15:0,0:12", param, ctx)


class Size(click.ParamType):
    """``64x48``: how many along x and along y."""

    name = "columns x rows"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """A list of two whole numbers."""
        try:
            return [int(word) for word in value.replace("×", "x").split("x")]
        except ValueError:
            self.fail(f"{value!r} is no size; write 64x48", param, ctx)


class Name(click.ParamType):
    """One of some names. The core refuses others, and says which there are."""

    name = "name"
    mark = ""
    """What the shell writes behind a name."""

    def __init__(self, names: Callable[[], Iterable[str]]) -> None:
        self.names = names

    def shell_complete(
        self, ctx: click.Context, param: click.Parameter, incomplete: str
    ) -> list[CompletionItem]:
        """The names that begin so."""
        return [CompletionItem(name + self.mark) for name in self.names() if name.startswith(incomplete)]


class Assignment(Name):
    """``name=number``."""

    name, mark = "name=number", "="

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """(name, number)."""
        name, _, text = value.partition("=")
        try:
            return name, float(text)
        except ValueError:
            self.fail(f"{value!r} gives no number; write it like J_p=0.04", param, ctx)


class Choice(Name):
    """``name=text``, such as ``theta=Pitch (deg)``."""

    name, mark = "name=text", "="

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """(name, text)."""
        name, mark, text = value.partition("=")
        if not mark or name not in self.names():
            self.fail(
                f"{value!r} names none of {', '.join(self.names())}; write it like {next(iter(self.names()))}=…"
            )
        return name, text


class Words(click.ParamType):
    """Words with commas between them."""

    name = "words"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """A list."""
        return [word.strip() for word in value.split(",")]


class Split(click.ParamType):
    """``1,3/2,4``: which poles, counted from 1, form pitch's pair and which yaw's."""

    name = "split"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Positions from 0, as the REST API takes them."""
        try:
            return [[int(word) - 1 for word in pair.split(",")] for pair in value.split("/")]
        except ValueError:
            self.fail(f"{value!r} deals no poles; write 1,3/2,4", param, ctx)


class Figures(click.ParamType):
    """Figures with commas between them, each with what it is of: ``settling_time:theta:linear,disk_margin``."""

    name = "figures"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """As the REST API takes them."""
        return [
            {"measure": name, **of} for name, of in (self.one(word, param, ctx) for word in value.split(","))
        ]

    def one(
        self, word: str, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[str, dict[str, Any]]:
        """A figure's name, and which response it is of."""
        name, *parts = word.strip().split(":")
        for part in parts:
            if part not in _KINDS:
                known = ", ".join(_KINDS)
                self.fail(f"{part!r} is none of {known}; write settling_time:theta:linear", param, ctx)
        return name.strip(), {_KINDS[part]: part for part in parts}


_KINDS = {
    **dict.fromkeys(("theta", "psi", "both"), "axis"),
    **dict.fromkeys(("V_p", "V_y"), "motor"),
    **dict.fromkeys(("linear", "nonlinear"), "model"),
    **dict.fromkeys(("alone", "together"), "steps"),
}


class Limits(Figures):
    """Limits of figures, in SI units but for %, with commas: ``settling_time<=0.8,overshoot:psi<=5@0.9``.

    Behind @ stands the share of uncertain rigs that have to meet it.
    """

    name = "limits"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """As the REST API takes them."""
        found: dict[str, list[dict[str, Any]]] = {}
        for word in value.replace("≤", "<=").replace("≥", ">=").split(","):
            parts = _LIMIT.fullmatch(word.strip())
            if parts is None:
                self.fail(
                    f"{word.strip()!r} is no limit; write settling_time<=0.8 or phase_margin>=0.7", param, ctx
                )
            figure, sign, limit, share = parts.groups()
            name, of = self.one(figure, param, ctx)
            try:
                own = {"max" if sign == "<=" else "min": float(limit)}
                own |= {} if share is None else {"share": float(share)}
            except ValueError:
                self.fail(f"{word.strip()!r} has no number for a limit; write settling_time<=0.8", param, ctx)
            found.setdefault(name, []).append({**of, **own})
        return {name: own[0] if len(own) == 1 else own for name, own in found.items()}


_LIMIT = re.compile(r"([^<>=@]+)(<=|>=)([^<>=@]+)(?:@([^<>=@]+))?")
