"""Side force and aligning moment of the recommended tire: the acceptance loads of its source."""

from __future__ import annotations

from math import radians

import pytest

from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.packing.formula import aligning_nm, cornering_nprad, lateral_n
from truck_blowout_sim.vehicle.schema.tire import TireSpec

SIDE = {
    9810: (1.19, 2.34, 4.31, 7.38),
    19610: (2.29, 4.48, 8.28, 14.3),
    25400: (2.86, 5.60, 10.4, 18.1),
    39230: (3.93, 7.73, 14.5, 26.1),
}
MOMENT = {
    9810: (20, 37, 59, 53),
    19610: (69, 129, 203, 185),
    25400: (104, 195, 307, 282),
    39230: (183, 344, 548, 514),
}
# load in N: cornering stiffness in N/deg
STIFFNESS = {9807: 1203, 14710: 1773, 19613: 2307, 24517: 2796, 29420: 3236, 34323: 3623}


@pytest.fixture(scope="module")
def tire(default_vehicle: Vehicle) -> TireSpec:
    return default_vehicle.tire_specs["steer_left"]


@pytest.mark.parametrize("load_n", SIDE)
def test_side_force(tire: TireSpec, load_n: float) -> None:
    kilonewtons = [lateral_n(tire, radians(a), load_n) / 1e3 for a in (1, 2, 4, 10)]
    assert kilonewtons == pytest.approx(SIDE[int(load_n)], rel=5e-3)


@pytest.mark.parametrize("load_n", MOMENT)
def test_aligning_moment(tire: TireSpec, load_n: float) -> None:
    moments = [aligning_nm(tire, radians(a), load_n) for a in (1, 2, 4, 8)]
    assert moments == pytest.approx(MOMENT[int(load_n)], rel=0.02, abs=1.0)


@pytest.mark.parametrize("load_n", STIFFNESS)
def test_cornering_stiffness(tire: TireSpec, load_n: float) -> None:
    assert cornering_nprad(tire, load_n) * radians(1) == pytest.approx(
        STIFFNESS[int(load_n)], rel=2e-3
    )
