"""What a format of an exported design is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

from ..spec import Spec

Pins = Sequence[tuple[str, Spec]]
"""Other designs, by their names."""


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
    """Writes a design with others beside it."""

    def __call__(self, spec: Spec, link: str = "", pins: Pins = ()) -> str | bytes:
        """As `Render`; `pins` are the others."""
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
        beside: makes the file where others stand beside the design; None where it has no room for them.
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

    def content(self, spec: Spec, link: str = "", pins: Pins = ()) -> bytes:
        """The file as bytes; `pins` are left out where it has no room for them."""
        made = self.beside(spec, link, pins) if pins and self.beside else self.render(spec, link)
        return made.encode() if isinstance(made, str) else made
