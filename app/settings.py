"""What can be set when the server starts."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Settings:
    """Settings of one server.

    Attributes:
        scenes: most 3D scenes at once; each costs a thread and about 0.2 MB.
        static: folder of the page's files.
    """

    scenes: int = 100
    static: Path = Path()

    def __post_init__(self) -> None:
        if self.static == Path():
            object.__setattr__(self, "static", static_folder())


def static_folder() -> Path:
    """The page's files: inside this package in the wheel, beside it in a checkout."""
    here = Path(__file__).parent
    for folder in (here / "static", here.parent / "static"):
        if (folder / "index.html").is_file():
            return folder
    raise RuntimeError("the page's files are missing: install the package, or run from the checkout")
