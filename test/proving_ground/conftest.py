from __future__ import annotations

import pytest

from proving_ground.individual import nominal
from proving_ground.run import Rig


@pytest.fixture(scope="session")
def rig() -> Rig:
    return Rig(nominal())
