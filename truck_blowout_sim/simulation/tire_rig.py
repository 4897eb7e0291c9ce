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
from truck_blowout_sim.physics.layout import N_STEP_COLUMNS, TIRE, TIRE_S, TOPOLOGY
from truck_blowout_sim.physics.tires.tire import tire_forces
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
    x = np.zeros(topo[TOPOLOGY.n_state])
    s = int(topo[TOPOLOGY.state_tire_at]) + packed.vehicle.tires.index(tire) * len(TIRE_S)
    x[s + TIRE_S.pressure_pa] = 0.0 if flat else spec.pressure_pa
    table_at, steps = int(topo[TOPOLOGY.table_at]), p[t + TIRE.law] > 0.0
    step, rim = -1, float(flat)
    if steps:
        table = table_at + int(p[t + TIRE.table])
        step, rim = table + 1 + (int(p[table]) - 1 if flat else 0) * N_STEP_COLUMNS, 0.0
    fy, mz = (np.empty((slip_rad.size, load_n.size)) for _ in range(2))
    _steady(x, s, p, t, table_at, slip_rad, load_n, rim, step, fy, mz)
    return TireMap(slip_rad, load_n, fy, -mz)


@core
def _steady(x: Floats, s: int, p: Floats, t: int, table_at: int, slips: Floats, loads: Floats,
            rim: float, step: int, fy: Floats, mz: Floats) -> None:
    """Roll until the lag is over, at every slip angle and load."""
    for i in range(slips.size):
        for j in range(loads.size):
            x[s + TIRE_S.slip] = x[s + TIRE_S.slip_tan] = 0.0
            across = -_SPEED_MPS * np.tan(slips[i])
            for _ in range(_STEPS):
                _, fy[i, j], mz[i, j] = tire_forces(
                    x, s, p, t, table_at, loads[j], rim, step, _SPEED_MPS, across, _SPEED_MPS,
                    0.0, 1.0, 1.0, _STEP_S)
