"""What can be set when the server starts: by the environment, or by the options of `heli2dof serve`."""

from __future__ import annotations

import os
import re
from importlib.util import find_spec
from ipaddress import ip_network
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AliasChoices, Field, SecretStr, ValidationError, field_validator
from pydantic_settings import BaseSettings, NoDecode, SettingsConfigDict

PREFIX = "HELI2DOF_"
Words = Annotated[tuple[str, ...], NoDecode]
"""Several words in one variable, with spaces or commas between them."""

_ORIGIN = re.compile(r"https?://(\[[0-9a-f:]+\]|[a-z0-9.-]+)(:\d{1,5})?", re.ASCII)
_ANCESTOR = re.compile(r"'self'|'none'|(https?://)?(\*\.)?[a-z0-9.-]+(:(\d{1,5}|\*))?", re.ASCII)
_HOST = re.compile(r"(\*\.)?[a-z0-9.-]+|\[[0-9a-f:]+\]", re.ASCII)
_SCHEDULER = re.compile(r"[a-z]+://[^\s/]+", re.ASCII)
_SHORTEST_TOKEN = 16


def static_folder() -> Path:
    """The page's files: inside this package in the wheel, beside it in a checkout."""
    here = Path(__file__).parents[1]
    for folder in (here / "static", here.parent / "static"):
        if (folder / "index.html").is_file():
            return folder
    raise RuntimeError("the page's files are missing: install the package, or run from the checkout")


class Settings(BaseSettings):
    """Settings of one server; the environment's names have the prefix HELI2DOF_."""

    model_config = SettingsConfigDict(
        env_prefix=PREFIX,
        frozen=True,
        extra="forbid",
        populate_by_name=True,
        hide_input_in_errors=True,
        validate_default=False,
    )

    host: str = Field(
        default="127.0.0.1", min_length=1, description="address to listen on; `0.0.0.0` lets others in"
    )
    port: int = Field(
        default=8000,
        ge=0,
        le=65535,
        validation_alias=AliasChoices(f"{PREFIX}PORT", "PORT"),
        description="TCP port; `PORT` is understood, too; 0 takes a free one",
    )
    root_path: str = Field(
        default="",
        pattern=r"^(/[\w.~-]+)*$",
        description="path prefix that a proxy puts before all addresses, as `/lab`",
    )
    trusted_proxies: Words = Field(
        default=("127.0.0.1", "::1"),
        description="addresses or networks of proxies whose `X-Forwarded-For`, `-Proto` and `-Host` are believed",
    )
    allowed_hosts: Words = Field(
        default=(), description="names under which the server answers, as `lab.example`; empty: any"
    )
    scenes: int = Field(
        default=100, ge=0, description="most 3D scenes at once; each costs a thread and about 0.2 MB"
    )
    access_token: SecretStr | None = Field(
        default=None, description=f"if set, asked of everyone; {_SHORTEST_TOKEN} characters or more"
    )
    frame_ancestors: Words = Field(
        default=("'self'",),
        description="who may show the page in a frame, as `'self' https://moodle.example`",
    )
    cors_origins: Words = Field(
        default=(),
        description="other origins whose pages may use API and sockets, as `https://tools.example`; `*`: all",
    )
    log_format: Literal["plain", "json"] = Field(
        default="plain", description="`plain`, or `json` for one object a line"
    )
    log_level: Literal["debug", "info", "warning", "error"] = Field(
        default="info",
        description="`debug` (static files and health checks, too), `info`, `warning` or `error`",
    )
    metrics: bool = Field(default=True, description="whether `/metrics` tells Prometheus how the server does")
    drain: float = Field(
        default=0.0,
        ge=0.0,
        le=60.0,
        description="seconds for which it serves on after SIGTERM while `/healthz` says 503",
    )
    grace: float = Field(
        default=9.5,
        ge=1.0,
        le=3600.0,
        description="seconds after these in which answers are finished; then it ends, whatever still computes",
    )
    ping: float = Field(
        default=5.0,
        gt=0.0,
        le=3600.0,
        description="seconds between pings on a WebSocket; one that is not answered for as long ends it",
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
    request_burst: int = Field(default=5000, ge=1, description="API requests of one address at once")
    sockets: int = Field(default=4000, ge=1, description="most WebSockets at once")
    sockets_per_address: int = Field(default=1000, ge=1, description="most WebSockets of one address at once")
    message_rate: float = Field(default=250.0, gt=0, description="messages a second on one WebSocket")
    workers: int = Field(
        default=2,
        ge=0,
        le=64,
        description="processes for clouds, identifications, comparisons, exports; `0`: threads of the server",
    )
    worker_bytes: int = Field(
        default=2**30, ge=2**26, description="most memory of such a job, bytes, beyond what all share"
    )
    dask: str = Field(
        default="", description="scheduler of a Dask cluster in their place, as `tcp://host:8786`"
    )
    slow_waiting: int = Field(default=256, ge=1, description="most jobs that wait for these processes")
    slow_each: int = Field(default=8, ge=1, description="most of them for one connection")
    slow_seconds: float = Field(default=60.0, gt=0, description="after which such a job is given up, s")
    recordings: int = Field(default=400, ge=1, description="most recordings kept at once")
    recordings_bytes: int = Field(
        default=256 * 2**20, ge=2**20, description="most bytes of recordings kept at once"
    )

    # Classes that work on a lab.
    database: SecretStr | None = Field(
        default=None,
        description="where classes are kept, as `sqlite:////data/classes.db`, `postgresql://user:secret@host/name` "
        "or `memory`, gone with the process; empty: a file in the user's data folder",
    )
    classes: Literal["open", "operator", "off"] = Field(
        default="open",
        description="who may make classes: anyone (`open`), who knows the `operator` key, or nobody (`off`)",
    )
    operator_key: SecretStr | None = Field(
        default=None, description=f"of who may make classes; {_SHORTEST_TOKEN} characters or more"
    )
    labs: Path | None = Field(default=None, description="folder of labs of one's own, `*.yaml`")
    class_days: int = Field(
        default=90, ge=1, le=3660, description="days after which a class is deleted with all that is in it"
    )
    classes_most: int = Field(default=2000, ge=1, description="most classes at once")
    students_most: int = Field(default=500, ge=1, le=5000, description="most students of a class")

    @property
    def database_address(self) -> str:
        """Where classes are kept; empty: in the user's data folder."""
        return "" if self.database is None else self.database.get_secret_value()

    @field_validator("trusted_proxies", "allowed_hosts", "frame_ancestors", "cors_origins", mode="before")
    @classmethod
    def _words(cls, value: Any) -> Any:
        return tuple(value.replace(",", " ").lower().split()) if isinstance(value, str) else value

    @field_validator("cors_origins")
    @classmethod
    def _origins(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        return _each(value, _ORIGIN, "is no origin, as https://tools.example is", "*")

    @field_validator("trusted_proxies")
    @classmethod
    def _networks(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        for word in value:
            if word != "*":
                ip_network(word)
        return value

    @field_validator("allowed_hosts")
    @classmethod
    def _hosts(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        return _each(value, _HOST, "is no host's name")

    @field_validator("frame_ancestors", mode="after")
    @classmethod
    def _ancestors(cls, value: tuple[str, ...]) -> tuple[str, ...]:
        quoted = tuple(f"'{word}'" if word in ("self", "none") else word for word in value)
        return _each(quoted, _ANCESTOR, "is no source of frames, as https://moodle.example is") or ("'none'",)

    @field_validator("dask")
    @classmethod
    def _cluster(cls, value: str) -> str:
        if value and not _SCHEDULER.fullmatch(value):
            raise ValueError("it is no address of a scheduler, as tcp://host:8786 is")
        if value and find_spec("distributed") is None:
            raise ValueError("distributed is not installed: pip install 'heli2dof[dask]'")
        return value

    @field_validator("access_token", "operator_key")
    @classmethod
    def _token(cls, value: SecretStr | None) -> SecretStr | None:
        if value is None or not (text := value.get_secret_value()):
            return None
        if len(text) < _SHORTEST_TOKEN or not (text.isascii() and text.isprintable()) or " " in text:
            raise ValueError(f"it needs {_SHORTEST_TOKEN} characters or more, ASCII without spaces")
        return value


def _each(words: tuple[str, ...], pattern: re.Pattern[str], why: str, *also: str) -> tuple[str, ...]:
    for word in words:
        if word not in also and not pattern.fullmatch(word):
            raise ValueError(f"{word[:80]!r} {why}")
    return words


def variable(name: str) -> str:
    """The environment's name of a setting."""
    return PREFIX + name.upper()


def complaint(error: ValidationError) -> str:
    """One line that names the variable and says what is wrong with it; never its value, which may be secret."""
    first = error.errors(include_url=False, include_input=False, include_context=False)[0]
    given = str(first["loc"][0]) if first["loc"] else "settings"
    name = given if given.isupper() else variable(given)
    if name not in os.environ and name == variable("port") and "PORT" in os.environ:
        name = "PORT"
    message = first["msg"].removeprefix("Value error, ")
    return f"{name}: {message[:1].lower()}{message[1:]}"
