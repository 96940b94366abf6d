"""Three replicas behind nginx, for all tests of this folder; whoever ends one starts it again."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from tests.deploy.farm import Farm, farm
from tests.patience import until


@pytest.fixture(scope="session")
def running_farm(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Farm]:
    with farm(tmp_path_factory.mktemp("farm"), 3) as running:
        yield running


@pytest.fixture(name="farm")
def whole_farm(running_farm: Farm) -> Farm:
    """The farm, whatever the tests before have ended in it."""
    for replica in running_farm.replicas:
        if replica.process.poll() is not None:
            replica.start()
    until(lambda: all(replica.ready() for replica in running_farm.replicas), "the replicas are back")
    until(running_farm.whole, "nginx asks every replica again")
    return running_farm
