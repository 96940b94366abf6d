"""Settings and fixtures that all tests share."""

from __future__ import annotations

import os

import pytest
from hypothesis import HealthCheck, settings

from heli2dof_core import Design, PoleSet, Spec, place, preset
from heli2dof_core.engine import warm_up

settings.register_profile("ci", derandomize=True, deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("local", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("ci" if os.environ.get("CI") else "local")


@pytest.fixture(scope="session", autouse=True)
def compiled_kernels() -> None:
    """Nonlinear responses are many here; the interpreted kernels have a test of their own."""
    warm_up()


@pytest.fixture(scope="session")
def spec() -> Spec:
    """The default rig and the paper's example."""
    return Spec.from_preset(preset())


@pytest.fixture(scope="session")
def design(spec: Spec) -> Design:
    return place(spec)


@pytest.fixture(scope="session")
def complex_poles() -> PoleSet:
    return PoleSet([-3 + 4j, -3 - 4j, -5 + 2j, -5 - 2j])
