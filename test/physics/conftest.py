"""Packed trucks and blank states for tests of single phenomena."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import N_WORK, TOPOLOGY
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack

Floats = NDArray[np.float64]


@pytest.fixture(scope="session")
def truck() -> Packed:
    return pack(load_vehicle("international_9400i_trailmobile"))


@pytest.fixture(scope="session")
def thesis() -> Packed:
    return pack(load_vehicle("international_9400i_trailmobile_thesis"))


@pytest.fixture
def state(truck: Packed) -> Floats:
    """All zero; tires whole."""
    return np.zeros(truck.topology[TOPOLOGY.n_state])


@pytest.fixture
def work() -> Floats:
    return np.zeros(N_WORK)


@pytest.fixture
def block(truck: Packed) -> Callable[[str], int]:
    """Position of the first parameter of a block, such as `tire.steer_left`."""

    def first(prefix: str) -> int:
        return min(i for name, i in truck.index.items() if name.startswith(f"{prefix}."))

    return first


@pytest.fixture
def slot(truck: Packed) -> Callable[[str, str], int]:
    """Position of the first state of an axle, hub or tire."""
    from truck_blowout_sim.physics.layout import AXLE_S, HUB_S, TIRE_S

    sizes = {"axle": len(AXLE_S), "hub": len(HUB_S), "tire": len(TIRE_S)}

    def first(kind: str, name: str) -> int:
        at = int(truck.topology[getattr(TOPOLOGY, f"state_{kind}_at")])
        names: tuple[str, ...] = getattr(truck.names, f"{kind}s")
        return at + names.index(name) * sizes[kind]

    return first
