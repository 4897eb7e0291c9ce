"""Rewrite golden_run.npz: only where a change of the step's arithmetic is meant.

python test/physics/golden_run.py
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent))

from test_step import GOLDEN, golden_run

from truck_blowout_sim.simulation import InitialState, Truck
from truck_blowout_sim.vehicle import load_vehicle

VEHICLE = "international_9400i_trailmobile"


def main() -> None:
    """Start at 20 m/s; steer, blow the first tire, steer back, brake with all circuits."""
    truck = Truck(load_vehicle(VEHICLE), initial=InitialState(speed_mps=20.0))
    inputs = np.zeros((8, 5))
    inputs[:, 0] = [0.0, 1.0, 1.0, 0.2, -0.8, -0.4, 0.0, 0.0]
    inputs[:5, 1] = 0.3
    inputs[5:, 2:] = 3e5
    stored = {"start": truck.state, "params": truck.packed.params,
              "topology": truck.packed.topology, "inputs": inputs}
    np.savez_compressed(GOLDEN, **stored, result=golden_run(stored))


if __name__ == "__main__":
    main()
