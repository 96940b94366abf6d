"""A client of the whole app, its derivation done."""

from __future__ import annotations

import logging
import time
from collections.abc import Iterator

import pytest
from starlette.testclient import TestClient

from app.main import create_app
from app.ops.settings import Settings
from tests.app.class_room import labs_folder


@pytest.fixture(scope="session")
def client(tmp_path_factory: pytest.TempPathFactory) -> Iterator[TestClient]:
    labs = labs_folder(tmp_path_factory.mktemp("labs"))
    with TestClient(create_app(Settings(labs=labs))) as client:
        deadline = time.monotonic() + 60
        while client.get("/healthz").status_code != 200:
            assert time.monotonic() < deadline
        yield client


@pytest.fixture(autouse=True)
def logging_as_it_was() -> Iterator[None]:
    """Takes back what `serve` sets up in this process: it would write to a stream that ends with its test."""
    root = logging.getLogger()
    before, level = set(root.handlers), root.level
    yield
    for handler in set(root.handlers) - before:
        if type(handler) is logging.StreamHandler:
            root.removeHandler(handler)
            root.setLevel(level)
