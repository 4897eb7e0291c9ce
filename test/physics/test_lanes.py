"""Tires side by side: no lane touches another, and there is room for many."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import MAX_TIRES, TIRE, TIRE_BLOCK, TIRE_LANES, TOPOLOGY
from truck_blowout_sim.physics.tires.lanes import (
    LANE,
    LANE_BLOCK,
    lane_offset,
    tire_offset,
    whole_vectors,
)
from truck_blowout_sim.physics.tires.tire import tire_pass
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.packing.packed import side_by_side

Floats = NDArray[np.float64]
OUT = (LANE.fx_n, LANE.fy_n, LANE.fz_n, LANE.mz_nm, LANE.rolling_nm, LANE.slip, LANE.slip_tan)


def one_tire(truck: Packed, number: int) -> Floats:
    """Parameters of a tire of the truck."""
    at = int(truck.topology[TOPOLOGY.tire_at]) + tire_offset(number)
    return truck.params[at + np.array(TIRE)]


def moving(number: int) -> Floats:
    """Inputs of a lane, of which no two are alike."""
    lane = np.zeros(len(LANE))
    values = {"vx_mps": 5.0 + number, "vy_mps": 0.1 * number, "spin_radps": 10.0 + 2.1 * number,
              "above_m": 0.47 + 0.0005 * number, "sink_mps": 0.01 * number, "friction": 1.0,
              "axle_peak": 1.0, "pressure_pa": 7e5 - 2e4 * number, "softness": 1.0}
    for name, value in values.items():
        lane[LANE._fields.index(name)] = value
    return lane


def forces(tires: list[Floats], lanes_in: list[Floats]) -> Floats:
    """What the pass makes of tires side by side."""
    p = np.array(side_by_side(tires))
    lanes = np.zeros(-(-len(tires) // TIRE_LANES) * LANE_BLOCK)
    for k, lane in enumerate(lanes_in):
        lanes[lane_offset(k) + np.array(LANE)] = lane
    tire_pass(p, 0, 0, lanes, len(tires), 0.001)
    return np.array([lanes[lane_offset(k) + np.array(OUT)] for k in range(len(tires))])


def test_lanes_do_not_touch_each_other(truck: Packed) -> None:
    """40 tires in two blocks: each as if it were alone, to rounding."""
    tires = [one_tire(truck, k % 18) for k in range(40)]
    lanes = [moving(k) for k in range(40)]
    together = forces(tires, lanes)
    alone = np.array([forces([tires[k]], [lanes[k]])[0] for k in range(40)])
    assert np.isfinite(together).all()
    assert together == pytest.approx(alone, rel=1e-12)
    assert len(np.unique(together[:, 1])) == 40


def test_places_of_lanes_and_parameters() -> None:
    assert [tire_offset(k) for k in (0, 23, 24, 50)] == [0, 23, TIRE_BLOCK, 2 * TIRE_BLOCK + 2]
    assert [lane_offset(k) for k in (0, 23, 24, 50)] == [0, 23, LANE_BLOCK, 2 * LANE_BLOCK + 2]
    assert [whole_vectors(n) for n in (1, 8, 9, 18)] == [8, 8, 16, 24]


def test_more_tires_than_there_is_room_for_are_refused(truck: Packed) -> None:
    with pytest.raises(ValueError, match="at most"):
        side_by_side([one_tire(truck, 0)] * (MAX_TIRES + 1))
