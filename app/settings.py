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

    scenes: int = Field(
        default=100, ge=0, description="most 3D scenes at once; each costs a thread and about 0.2 MB"
    )
    static: Path = Field(default_factory=static_folder, description="folder of the page's files")

    # Limits. A class of forty behind one address must never meet those per address: each of its pages opens four
    # sockets, with a second window eight, and asks some twenty calls when it opens.
    body_bytes: int = Field(
        default=2**20, ge=1024, description="largest body, bytes; a recording's file may have 32 MiB"
    )
    body_seconds: float = Field(default=60.0, gt=0, description="in which a request's body must have come, s")
    request_rate: float = Field(
        default=200.0, gt=0, description="API requests a second and address, in the long run"
    )
    request_burst: int = Field(default=2000, ge=1, description="API requests of one address at once")
    sockets: int = Field(default=2000, ge=1, description="most WebSockets at once")
    sockets_per_address: int = Field(default=500, ge=1, description="most WebSockets of one address at once")
    message_rate: float = Field(default=250.0, gt=0, description="messages a second on one WebSocket")
    slow_threads: int = Field(
        default=2, ge=1, le=64, description="threads for clouds, identifications, comparisons, exports"
    )
    slow_waiting: int = Field(default=256, ge=1, description="most jobs that wait for these threads")
    slow_each: int = Field(default=8, ge=1, description="most of them for one connection")
    slow_seconds: float = Field(default=60.0, gt=0, description="after which such a job is given up, s")
    recordings: int = Field(default=400, ge=1, description="most recordings kept at once")
    recordings_bytes: int = Field(
        default=256 * 2**20, ge=2**20, description="most bytes of recordings kept at once"
    )
