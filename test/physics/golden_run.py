"""Golden runs: what the step gave when its arithmetic was last meant to change.

Start, parameters and result are stored by name, so a new parameter that is neutral, or another
order of the vectors, rewrites nothing. Only where a change of the arithmetic is meant:

python test/physics/golden_run.py
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import N_WORK, TOPOLOGY
from truck_blowout_sim.physics.step import advance
from truck_blowout_sim.simulation import InitialState, Truck
from truck_blowout_sim.vehicle import Packed, load_vehicle, pack
from truck_blowout_sim.vehicle.packing.names import state_index

Floats = NDArray[np.float64]
GOLDEN = Path(__file__).with_name("golden_runs.npz")
STEPS = 250  # between two stored states
# vehicle, first tires to blow after 0.5 s, parameters that bring more of the model into play
RUNS: dict[str, tuple[str, tuple[str, ...], dict[str, float]]] = {
    "default": ("international_9400i_trailmobile", ("steer_left",), {}),
    "uneven": ("international_9400i_trailmobile", ("trailer_1_left_outer", "trailer_1_left_inner"),
               {"world.road_roughness_m": 0.002, "unit.trailer.gust_mps": 8.0,
                "unit.trailer.gust_start_s": 0.2, "world.friction_scale": 0.5}),
    "maps and steps": ("international_9400i_trailmobile_thesis",
                       ("steer_left", "drive_1_right_outer"), {}),
    "linear": ("ferrari_250lm", ("rear_left",), {"tire.front_left.saturation": 0.8}),
}


def inputs() -> Floats:
    """Steer, steer back, brake with all circuits: one row for each 250 steps."""
    rows = np.zeros((8, 5))
    rows[:, 0] = [0.0, 1.0, 1.0, 0.2, -0.8, -0.4, 0.0, 0.0]
    rows[:5, 1] = 0.3
    rows[5:, 2:] = 5e5
    return rows


def drive(packed: Packed, start: Floats, blown: tuple[str, ...]) -> Floats:
    """Named states [8, n] of 2 s from ``start``."""
    x, work, rows, at = start.copy(), np.zeros(N_WORK), [], state_index(packed.vehicle)
    for k, held in enumerate(inputs()):
        if k == 2:
            for tire in blown:
                x[at[f"tire.{tire}.blown_time_s"]] = x[0]
        advance(x, packed.params, packed.topology, held, 0.001, STEPS, work)
        rows.append(x[list(at.values())])
    return np.array(rows)


def stored_run(name: str) -> dict[str, Floats]:
    """What was stored of a run: names and values of parameters and states."""
    with np.load(GOLDEN) as file:
        return {key.partition(": ")[2]: file[key] for key in file
                if key.partition(": ")[0] == name}


def repeated(name: str, stored: Mapping[str, Floats]) -> Floats:
    """A stored run driven again: states [8, n] in the order of its names."""
    vehicle, blown, _ = RUNS[name]
    packed = pack(load_vehicle(vehicle))
    values = zip(stored["parameters"].tolist(), stored["values"].tolist(), strict=True)
    packed = packed.unchecked(dict(values))
    at = state_index(packed.vehicle)
    start = np.zeros(packed.topology[TOPOLOGY.n_state])
    start[[at[key] for key in stored["states"].tolist()]] = stored["start"]
    order = {key: k for k, key in enumerate(at)}
    return drive(packed, start, blown)[:, [order[key] for key in stored["states"].tolist()]]


def main() -> None:
    """Start all at 20 m/s and store what comes of it."""
    stored: dict[str, Floats] = {}
    for name, (vehicle, blown, values) in RUNS.items():
        packed = pack(load_vehicle(vehicle)).with_values(values)
        truck = Truck(packed, initial=InitialState(speed_mps=20.0))
        at = state_index(packed.vehicle)
        stored |= {f"{name}: {key}": array for key, array in {
            "parameters": np.array(list(packed.index)),
            "values": packed.params[list(packed.index.values())],
            "states": np.array(list(at)),
            "start": truck.state[list(at.values())],
            "result": drive(packed, truck.state, blown)}.items()}
    np.savez_compressed(GOLDEN, **stored)


if __name__ == "__main__":
    main()
