"""The size of the errors alone: the same figures as the whole comparison."""

from __future__ import annotations

import pytest

from truck_blowout_sim.comparison import compare, rms_errors
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.simulation.replay import simulate_inputs
from truck_blowout_sim.vehicle import load_vehicle, pack


@pytest.mark.parametrize("imposed", [False, True])
def test_rms_errors_are_those_of_the_comparison(imposed: bool) -> None:
    vehicle = load_vehicle("international_9400i_trailmobile")
    time_s = [0.02 * k for k in range(150)]
    channels = {name: Series(time_s, [0.0] * 150) for name in (
        "throttle", "brake_pressure_steer_pa", "brake_pressure_drive_pa",
        "brake_pressure_trailer_pa")}
    channels["steering_wheel_angle_rad"] = Series(time_s, [0.2 * t for t in time_s])
    channels["tractor_vx_mps"] = Series(time_s, [20.0] * 150)
    record = simulate_inputs(vehicle, Recording("made", channels))
    shifted = {name: Series(record[name].time_s, record[name].value + 0.01)
               for name in ("tractor_vx_mps", "tractor_yaw_rate_radps")}
    record = record.with_channels(shifted)

    whole = compare(record, vehicle, impose_speed=imposed)
    alone = rms_errors(record, pack(vehicle), impose_speed=imposed)

    assert alone == {c.name: c.rms for c in whole.channels if not c.imposed}
    assert ("tractor_vx_mps" in alone) is not imposed
