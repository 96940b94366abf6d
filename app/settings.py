"""What can be set when the server starts: by the environment, or by the options of `heli2dof serve`."""

from __future__ import annotations

from pathlib import Path

from pydantic import Field
from pydantic_settings import BaseSettings, SettingsConfigDict


def static_folder() -> Path:
    """The page's files: inside this package in the wheel, beside it in a checkout."""
    here = Path(__file__).parent
    for folder in (here / "static", here.parent / "static"):
        if (folder / "index.html").is_file():
            return folder
    raise RuntimeError("the page's files are missing: install the package, or run from the checkout")


class Settings(BaseSettings):
    """Settings of one server; the environment's names have the prefix HELI2DOF_."""

    model_config = SettingsConfigDict(env_prefix="HELI2DOF_", frozen=True, extra="forbid")

    scenes: int = Field(100, ge=0, description="most 3D scenes at once; each costs a thread and about 0.2 MB")
    static: Path = Field(default_factory=static_folder, description="folder of the page's files")
