"""A user's program, checked by mypy in strict mode and never run: see test_style.py."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim import (
    Batch,
    Recording,
    Scenario,
    Truck,
    Vehicle,
    load_scenario,
    load_vehicle,
    pack,
    read_recording,
    simulate,
    simulate_batch,
    write_recording,
)

vehicle: Vehicle = load_vehicle("international_9400i_trailmobile")
recording: Recording = simulate(vehicle, "steer_axle_blowout")
peak_radps: float = float(np.max(np.abs(recording["tractor_yaw_rate_radps"].value)))
write_recording(recording, Path("out/run"))
again: Recording = read_recording(Path("out/run"))
weaker = pack(vehicle).with_values({"hub.trailer_2_left.brake_gain": 0.35})
truck: Truck = Truck(weaker)
fresh: bool = truck.blow("steer_left")
state: dict[str, float] = truck.outputs()
scenario: Scenario = load_scenario("fishhook")
batch: Batch = simulate_batch(
    "international_9400i_trailmobile", "fishhook",
    [{"start.speed_mph": mph} for mph in (25.0, 30.0)], channels=["tractor_yaw_rate_radps"],
)
turned: NDArray[np.float64] = batch.series("tractor_yaw_rate_radps")
