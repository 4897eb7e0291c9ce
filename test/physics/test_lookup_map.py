from __future__ import annotations

import math

import numpy as np
import pytest

from truck_blowout_sim.physics.layout import TOPOLOGY
from truck_blowout_sim.physics.tires.lookup_map import forces, interpolate
from truck_blowout_sim.vehicle import Packed


def toy_map() -> np.ndarray:
    """3 slips of 0.1 rad by 2 loads of 1 kN: force = 1000 slip index + 100 load index."""
    fy = [0.0, 100.0, 1000.0, 1100.0, 2000.0, 2100.0]
    return np.array([3.0, 2.0, 0.1, 1000.0, *fy, *(-0.1 * np.array(fy))])


def test_nodes_midpoints_and_edges() -> None:
    p = toy_map()
    assert interpolate(p, 0, 0, 0.1, 1000.0) == pytest.approx(1100.0)
    assert interpolate(p, 0, 0, 0.15, 500.0) == pytest.approx(1550.0)
    assert interpolate(p, 0, 1, 0.15, 500.0) == pytest.approx(-155.0)
    # held beyond the last slip and the last load
    assert interpolate(p, 0, 0, 9.0, 9000.0) == pytest.approx(2100.0)


def map_force(thesis: Packed, tan: float, fz: float) -> float:
    at = min(i for name, i in thesis.index.items() if name.startswith("tire.steer_left."))
    table = int(thesis.topology[TOPOLOGY.table_at] + thesis["tire.steer_left.map_table"])
    return forces(thesis.params, at, table, fz, 0.0, tan, 1.0, 1.0)[1]


def test_the_shipped_map_follows_the_recommended_tire(thesis: Packed) -> None:
    for degrees, expected in ((1, 2.86), (2, 5.60), (4, 10.4), (10, 18.1)):
        fy = map_force(thesis, math.tan(math.radians(degrees)), 25_400.0)
        assert fy / 1000.0 == pytest.approx(expected, rel=0.02)


def test_force_is_odd_in_slip(thesis: Packed) -> None:
    assert map_force(thesis, -0.05, 2e4) == -map_force(thesis, 0.05, 2e4)
