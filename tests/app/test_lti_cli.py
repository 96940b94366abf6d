"""`heli2dof lti`: registering platforms, keys, what waits."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner

from app.classes.engines import open_engines
from app.cli.lti import lti
from app.lti.store import all_platforms, shown_keys

MOODLE = ("--moodle", "https://moodle.example", "--client-id", "abc", "--deployment", "1")


@pytest.fixture
def database(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> str:
    setting = f"sqlite:///{tmp_path}/classes.db"
    monkeypatch.setenv("HELI2DOF_DATABASE", setting)
    return setting


def run(*words: str, status: int = 0) -> str:
    result = CliRunner().invoke(lti, words)
    assert result.exit_code == status, result.output
    return result.output


def registered(setting: str) -> dict[str, tuple[str, ...]]:
    engines = open_engines(setting)
    try:
        with engines.reading.begin() as connection:
            return {platform.name: platform.deployments for platform in all_platforms(connection)}
    finally:
        engines.dispose()


def test_a_platform_is_registered_changed_and_taken_out(database: str) -> None:
    assert "No platform is registered" in run("platforms")
    told = run("register", "uni", *MOODLE, "--address", "https://lab.example/x/")
    assert "https://lab.example/x/lti/login" in told and "hosts that are asked: moodle.example" in told
    run("deploy", "uni", "2", "3", "2")
    assert registered(database) == {"uni": ("1", "2", "3")}
    run("register", "uni", *MOODLE, "--address", "https://lab.example", "--host", "grades.example")
    assert registered(database) == {"uni": ("1",)}
    told = run("platforms")
    assert "https://lab.example/lti/launch" in told and "moodle.example, grades.example" in told
    run("remove", "uni")
    assert registered(database) == {}


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("register", "uni", *MOODLE, "--address", "http://lab.example"), "https://"),
        (("register", "Uni!", *MOODLE, "--address", "https://lab.example"), "no name"),
        (
            ("register", "uni", "--client-id", "a", "--deployment", "1", "--address", "https://lab.example"),
            "issuer",
        ),
        (("register", "uni", *MOODLE[:4], "--address", "https://lab.example"), "deployment"),
        (("register", "uni", *MOODLE, "--address", "https://lab.example", "--host", "https://x"), "no host"),
        (("remove", "other"), "No platform"),
        (("deploy", "other", "1"), "No platform"),
    ],
)
def test_what_is_refused_is_told(database: str, words: tuple[str, ...], why: str) -> None:
    assert why in run(*words, status=2)
    assert registered(database) == {}


def test_the_same_registration_under_two_names_is_refused(database: str) -> None:
    run("register", "uni", *MOODLE, "--address", "https://lab.example")
    assert "as 'uni'" in run("register", "two", *MOODLE, "--address", "https://lab.example", status=2)


def test_keys_are_rotated_and_old_ones_shown_for_a_while(database: str) -> None:
    run("register", "uni", *MOODLE, "--address", "https://lab.example")
    first = run("keys").split()[0]
    lines = run("keys", "--rotate").splitlines()
    assert len(lines) == 2 and first in lines[1] and "signs no more" in lines[1]
    engines = open_engines(database)
    with engines.reading.begin() as connection:
        from time import time

        assert len(shown_keys(connection, time())) == 2
        assert len(shown_keys(connection, time() + 8 * 86400)) == 1
    engines.dispose()


def test_the_database_is_the_server_s_own_where_nothing_is_set(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("HELI2DOF_DATABASE", raising=False)
    monkeypatch.setattr("app.classes.engines.default_file", lambda: tmp_path / "classes.db")
    run("register", "uni", *MOODLE, "--address", "https://lab.example")
    assert registered(f"sqlite:///{tmp_path}/classes.db") == {"uni": ("1",)}


def test_a_wrong_database_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("HELI2DOF_DATABASE", "mysql://secret@host/x")
    told = run("platforms", status=2)
    assert "HELI2DOF_DATABASE" in told and "secret" not in told
