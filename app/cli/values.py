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
