"""A tire on a rig: steady forces over slip and load, sound or flat, from the model's own tire.

References: physics/tires; thesis figures 18 to 21 draw such maps.
Known limits: pure side slip, no camber, dry road of friction 1; a flat tire is on its rim.
Validated with: test/simulation/test_tire_rig.py.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.jit import core
from truck_blowout_sim.physics.layout import N_STEP_COLUMNS, STEP_COLUMNS, TIRE, TOPOLOGY
from truck_blowout_sim.physics.tires.lanes import LANE, LANE_BLOCK
from truck_blowout_sim.physics.tires.tire import tire_at_load
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
_SPEED_MPS, _STEP_S, _STEPS = 20.0, 0.05, 80  # 80 m of rolling: the slip lag is over


@dataclass(frozen=True, eq=False)
class TireMap:
    """Over slip angle (first axis) and load (second axis); positive where the tire restores."""

    slip_rad: Floats
    load_n: Floats
    lateral_n: Floats
    aligning_nm: Floats


def tire_map(packed: Packed, tire: str, *, flat: bool, slip_rad: Floats, load_n: Floats) -> TireMap:
    """Lateral force and aligning moment of one tire of a truck.

    Args:
        packed: the truck.
        tire: name of the tire.
        flat: without air and on its rim; by a step law, its last step.
        slip_rad: slip angles.
        load_n: vertical loads.
    """
    spec = packed.vehicle.tire_specs[tire]
    topo, p = packed.topology, packed.params
    t = packed.index[f"tire.{tire}.unloaded_radius_m"] - TIRE.unloaded_radius_m
    table_at, lanes = int(topo[TOPOLOGY.table_at]), np.zeros(LANE_BLOCK)
    lanes[[LANE.vx_mps, LANE.spin_radps]] = _SPEED_MPS
    lanes[[LANE.radius_m, LANE.friction, LANE.axle_peak]] = 1.0
    lanes[LANE.pressure_pa] = 0.0 if flat else spec.pressure_pa
    lanes[LANE.rim] = float(flat)
    if p[t + TIRE.law] > 0.0:
        table = table_at + int(p[t + TIRE.table])
        row = table + 1 + (int(p[table]) - 1 if flat else 0) * N_STEP_COLUMNS
        lanes[[LANE.stepped, LANE.rim]] = 1.0, 0.0
        lanes[LANE.row_cornering] = p[row + STEP_COLUMNS.index("cornering_scale")]
        lanes[LANE.row_aligning] = p[row + STEP_COLUMNS.index("aligning_scale")]
    fy, mz = (np.empty((slip_rad.size, load_n.size)) for _ in range(2))
    _steady(p, t, table_at, lanes, slip_rad, load_n, fy, mz)
    return TireMap(slip_rad, load_n, fy, -mz)


@core
def _steady(p: Floats, t: int, table_at: int, lanes: Floats, slips: Floats, loads: Floats,
            fy: Floats, mz: Floats) -> None:
    """Roll until the lag is over, at every slip angle and load."""
    for i in range(slips.size):
        for j in range(loads.size):
            lanes[LANE.fz_n] = loads[j]
            lanes[LANE.vy_mps] = -_SPEED_MPS * np.tan(slips[i])
            lanes[LANE.slip] = lanes[LANE.slip_tan] = 0.0
            for _ in range(_STEPS):
                tire_at_load(p, t, table_at, lanes, 0, _STEP_S)
            fy[i, j], mz[i, j] = lanes[LANE.fy_n], lanes[LANE.mz_nm]
