"""What a format of an exported design is."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Protocol

from ..spec import Spec

Pins = Sequence[tuple[str, Spec]]
"""Other designs, by their names."""


@dataclass(frozen=True)
class Beside:
    """What stands beside a design in a file for people.

    Attributes:
        pins: other designs.
        required: what is asked of the rig's steps and of its loop, by a figure's short name (`Figure.key`), in the
            figure's unit: at most where lower is better, else at least.
        remarks: whether the findings are told.
    """

    pins: Pins = ()
    required: Mapping[str, float] = field(default_factory=dict)
    remarks: bool = True


NOTHING = Beside()


class Render(Protocol):
    """Writes a design as one file."""

    def __call__(self, spec: Spec, link: str = "") -> str | bytes:
        """The file's whole content; text is UTF-8.

        Args:
            spec: what the user chose.
            link: address that opens the design, named in the file where it is given.

        Raises:
            Heli2DofError: the design does not exist, see `evaluate`.
        """
        ...


class RenderBeside(Protocol):
    """Writes a design with something beside it."""

    def __call__(self, spec: Spec, link: str = "", beside: Beside = NOTHING) -> str | bytes:
        """As `Render`."""
        ...


@dataclass(frozen=True)
class Format:
    """One way to take a design away.

    Attributes:
        name: for programs.
        title: for people, in a few words.
        suffix: of the file's name, with its dot.
        media_type: as in Content-Type.
        render: makes the file.
        stem: of the file's name; the files name one another by it, and MATLAB wants an identifier.
        beside: makes the file with what stands beside the design; None where it has no room for that.
    """

    name: str
    title: str
    suffix: str
    media_type: str
    render: Render
    stem: str = "heli2dof_design"
    beside: RenderBeside | None = None

    @property
    def filename(self) -> str:
        """Of the file."""
        return self.stem + self.suffix

    def content(self, spec: Spec, link: str = "", beside: Beside = NOTHING) -> bytes:
        """The file as bytes; what is `beside` is left out where it has no room for it."""
        made = self.beside(spec, link, beside) if self.beside else self.render(spec, link)
        return made.encode() if isinstance(made, str) else made
