"""Labs are marked by the compiled kernels, as on a server that has run for a minute."""

from __future__ import annotations

import pytest

from heli2dof_core import warm_up


@pytest.fixture(scope="session", autouse=True)
def kernels():
    """Ready before the first test."""
    warm_up()
