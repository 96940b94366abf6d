"""What a format of an exported design is."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from ..spec import Spec


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
    """

    name: str
    title: str
    suffix: str
    media_type: str
    render: Render
    stem: str = "heli2dof_design"

    @property
    def filename(self) -> str:
        """Of the file."""
        return self.stem + self.suffix

    def content(self, spec: Spec, link: str = "") -> bytes:
        """The file as bytes."""
        made = self.render(spec, link)
        return made.encode() if isinstance(made, str) else made
